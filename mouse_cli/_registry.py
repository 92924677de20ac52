"""Members of a kind are files of a folder: adding one is adding a file, and no list is edited."""

import sys
from functools import cache
from glob import glob
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

from mouse_cli._errors import PluginError


@cache
def names(package: str) -> tuple[str, ...]:
    """Sorted names of the modules in `package` that hold a member, none of a module; nothing is imported but the package itself."""
    path = getattr(import_module(package), "__path__", ())
    return tuple(sorted(m.name for m in iter_modules(path) if not m.name.startswith("_")))


@cache
def discover(package: str, attribute: str) -> dict[str, Any]:
    """Every member of a kind, by key, sorted: `attribute` of each module in `package`, then third-party entry points.

    A module may hold several in a tuple called by the plural of the attribute, and `package` may be such a module. A module with
    neither is support code and is passed over. A member has a `key`.
    Third parties register under the entry-point group named like the package, e.g. `mouse_cli.estimators`.

    Raises ValueError when two members claim one key, PluginError when a third party's cannot be used.
    """
    found = list(vars(import_module(package)).get(f"{attribute}S", ()))
    for name in names(package):
        held = vars(import_module(f"{package}.{name}"))
        found += [held[attribute]] if attribute in held else held.get(f"{attribute}S", ())
    found += plugins(package)
    members: dict[str, Any] = {}
    for member in found:
        if member.key in members:
            raise ValueError(f"two members of {package} are called '{member.key}'")
        members[member.key] = member
    return dict(sorted(members.items()))


def member(package: str, attribute: str, key: str, kind: str) -> Any:
    """The member called `key`; its file alone is loaded when it bears that name.

    Raises ValueError that lists the known ones, as members of that `kind`.
    """
    file = key.replace("-", "_")
    if file in names(package):
        found = getattr(import_module(f"{package}.{file}"), attribute, None)
        if found is not None and found.key == key:
            return found
    known = discover(package, attribute)
    if key not in known:
        raise ValueError(f"no {kind} is called '{key}'; there are {', '.join(known)}")
    return known[key]


def plugins(package: str) -> list[Any]:
    """Members that other installed distributions register for `package`.

    importlib.metadata takes as long to load as a small deck to run, so it is asked only where something is registered.
    """
    heading = f"[{package}]"
    files = (file for folder in sys.path if folder for file in glob(f"{folder}/*.dist-info/entry_points.txt"))
    if not any(heading in _text(file) for file in files):
        return []
    from importlib.metadata import entry_points

    return [_loaded(entry) for entry in entry_points(group=package)]


def _loaded(entry: Any) -> Any:
    """The member that an entry point names. Raises PluginError when there is none."""
    try:
        member = entry.load()
    except Exception as reason:  # whatever a stranger's module does on import
        raise _unusable(entry, f"cannot be loaded: {reason}") from reason
    if not isinstance(getattr(member, "key", None), str):
        raise _unusable(entry, "names something that has no `key`")
    return member


def _unusable(entry: Any, why: str) -> PluginError:
    place = f"{entry.name} = {entry.value} in group {entry.group}"
    help = "let the entry point name the object itself, package.module:OBJECT, or uninstall its distribution"
    return PluginError.of("MD511", f"the entry point {place} {why}", help=help)


def _text(path: str) -> str:
    with open(path, errors="replace") as file:
        return file.read()
