"""mouse list: what there is to choose from."""

from collections.abc import Iterator
from importlib import import_module

import click

_MEMBERS = {  # of each kind: where its members are (a mapping, or what returns one), and what is told of each
    "candidates": ("diagnosis.names:known", "{0.title} ({0.group})"),
    "codes": ("codes:catalogue", "{0.title}"),
    "elements": ("terms.elements:registry", "{0.meaning}"),
    "estimators": ("estimators:registry", "{0.equation}"),
    "expansions": ("dynamics.expansion:registry", "{0.title}: {0.equation}"),
    "methods": ("methods:registry", "{0.title}: {0.equation}"),
    "nameless": ("diagnosis.nameless:registry", "{0.title} ({0.property})"),
    "plots": ("plots:registry", "{0.title}"),
    "recursions": ("updating.loop:RECURSIONS", "{0.MEANING}"),
    "reductions": ("coupling.reductions:registry", "{0.title}: {0.equation}"),
}


def _commands() -> Iterator[tuple[str, str]]:
    context = click.get_current_context().find_root()
    for name in context.command.list_commands(context):
        yield name, context.command.get_command(context, name).get_short_help_str(90)


def _statuses() -> Iterator[tuple[str, str]]:
    from mouse_cli.updating.statuses import STATUSES

    codes = {entry.key: entry.exit_code for entry in STATUSES.values()}
    for key, code in codes.items():
        advice = " ".join(entry.advice for entry in STATUSES.values() if entry.key == key)
        yield key, f"exit {code}. {advice}".strip()


def _sections() -> Iterator[tuple[str, str]]:
    from mouse_cli.report.section import registry

    for section in sorted(registry().values(), key=lambda s: s.order):
        yield section.key, section.title


def _groups() -> Iterator[tuple[str, str]]:
    from mouse_cli.formats.cards import layout

    for group in layout.GROUPS:
        yield str(group.number), f"{group.name} {group.symbol}".strip() + f", {group.format}"


_OTHERS = {"commands": _commands, "groups": _groups, "sections": _sections, "statuses": _statuses}
KINDS = sorted([*_MEMBERS, *_OTHERS])


def entries(kind: str) -> Iterator[tuple[str, str]]:
    """Names of a kind, and what each is; where they are is imported for it alone."""
    if kind in _OTHERS:
        yield from _OTHERS[kind]()
        return
    place, words = _MEMBERS[kind]
    module, _, name = place.partition(":")
    found = getattr(import_module(f"mouse_cli.{module}"), name)
    for key, member in (found() if callable(found) else found).items():
        yield key, words.format(member)


@click.command()
@click.argument("kind", type=click.Choice(KINDS), required=False)
def command(kind: str | None) -> int:
    """List estimators, mechanisms, codes and other names."""
    for name in [kind] if kind else KINDS:
        if not kind:
            click.echo(f"{name}:")
        rows = list(entries(name))
        width = max(len(key) for key, _ in rows)
        for key, text in rows:
            click.echo(f"{'' if kind else '  '}{key:<{width}}  {text}".rstrip())
    return 0
