"""Changes of a model as options of the command line: the text of `modify:` that says the same."""

from math import isfinite

import click

CHANGES = (
    click.option("--mass", "masses", multiple=True, metavar="DOF=KG", help="Add a mass; negative: take it away."),
    click.option(
        "--spring",
        "springs",
        multiple=True,
        metavar="DOF[,DOF]=N/M",
        help="Add a spring to the ground, or between two.",
    ),
    click.option("--dashpot", "dashpots", multiple=True, metavar="DOF[,DOF]=NS/M", help="Add a dashpot."),
    click.option(
        "--absorber",
        "absorbers",
        multiple=True,
        metavar="DOF=KG,HZ[,RATIO]",
        help="Hang a mass on a spring and a dashpot; `mode2` instead of HZ tunes it to mode 2.",
    ),
    click.option(
        "--target",
        "targets",
        multiple=True,
        metavar="MODE<HZ",
        help="Which mass (or spring, --by) does that? Also MODE>HZ, MODE=HZ.",
    ),
    click.option(
        "--sweep",
        "sweeps",
        multiple=True,
        metavar="MODE:THING=SIZE",
        help="Best locations of one mass, spring or absorber.",
    ),
    click.option("--by", type=click.Choice(["mass", "spring"]), help="What targets are met by. Default: mass."),
    click.option(
        "--place",
        metavar="DOF",
        help="Location of the change that meets the target. Default: every location, one by one.",
    ),
)


def changes_text(given: dict[str, object], count: int | None) -> str:
    """The deck of changes that the options CHANGES state. Raises click.BadParameter."""
    changes = [_item(f"mass: {_number(v, '--mass')}", p) for p, v in _split(given["masses"], "--mass")]
    for key in ("spring", "dashpot"):
        option = f"--{key}"
        changes += [_item(f"{key}: {_number(v, option)}", p) for p, v in _split(given[f"{key}s"], option)]
    changes += [_item(f"absorber: {_absorber(v)}", p) for p, v in _split(given["absorbers"], "--absorber")]
    lines = ["mouse: 1", "modify:", "  deck: model", *_listed("changes", changes)]
    lines += _listed("targets", [_target(text, given) for text in given["targets"]])
    lines += _listed("sweeps", [_sweep(text) for text in given["sweeps"]])
    return "\n".join([*lines, *([f"  count: {count}"] if count else [])]) + "\n"


def _listed(key: str, items: list[str]) -> list[str]:
    return [f"  {key}:", *(f"    - {{{item}}}" for item in items)] if items else []


def _split(texts: tuple[str, ...], option: str) -> list[tuple[str, str]]:
    found = []
    for text in texts:
        place, equals, value = text.rpartition("=")
        if not equals or not place.strip():
            raise click.BadParameter(f"'{text}' is not DOF=NUMBER", param_hint=option)
        found.append((place.strip(), value.strip()))
    return found


def _item(what: str, places: str) -> str:
    at, _, to = places.partition(",")
    return f"{what}, at: {_quoted(at)}" + (f", to: {_quoted(to)}" if to else "")


def _quoted(name: str) -> str:
    """A name as YAML takes it whatever it holds."""
    return "'" + name.strip().replace("'", "''") + "'"


def _number(text: str, option: str) -> str:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not isfinite(value):
        raise click.BadParameter(f"'{text}' is not a finite number", param_hint=option)
    return repr(value)


def _absorber(text: str) -> str:
    parts = [part.strip() for part in text.split(",")]
    if len(parts) not in (2, 3):
        raise click.BadParameter(f"'{text}' is not KG,HZ or KG,HZ,RATIO", param_hint="--absorber")
    tuned = parts[1].lower().startswith("mode") and parts[1][4:].isdecimal()
    to = f"tuned_to: {parts[1][4:]}" if tuned else f"frequency: {_number(parts[1], '--absorber')}"
    ratio = f", damping_ratio: {_number(parts[2], '--absorber')}" if len(parts) == 3 else ""
    return f"{{mass: {_number(parts[0], '--absorber')}, {to}{ratio}}}"


def _target(text: str, given: dict[str, object]) -> str:
    sides = {"<": "below", ">": "above", "=": "at"}
    sign = next((c for c in text if c in sides), "")
    mode, _, hz = text.partition(sign) if sign else ("", "", "")
    if not mode.strip().isdecimal():
        raise click.BadParameter(f"'{text}' is not MODE<HZ, MODE>HZ or MODE=HZ", param_hint="--target")
    place = f", place: {_quoted(given['place'])}" if given["place"] else ""
    return f"mode: {int(mode)}, {sides[sign]}: {_number(hz, '--target')}, by: {given['by'] or 'mass'}{place}"


def _sweep(text: str) -> str:
    mode, _, rest = text.partition(":")
    thing, _, size = rest.partition("=")
    if not mode.strip().isdecimal() or thing.strip() not in ("mass", "spring", "absorber"):
        raise click.BadParameter(
            f"'{text}' is not MODE:mass=KG, MODE:spring=N/M or MODE:absorber=KG", param_hint="--sweep"
        )
    return f"mode: {int(mode)}, by: {thing.strip()}, size: {_number(size, '--sweep')}"
