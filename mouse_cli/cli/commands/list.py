"""mouse list: what there is to choose from."""

from collections.abc import Callable, Iterator

import click


def _estimators() -> Iterator[tuple[str, str]]:
    from mouse_cli._registry import discover

    for key, estimator in discover("mouse_cli.estimators", "ESTIMATOR").items():
        yield key, estimator.equation


def _methods() -> Iterator[tuple[str, str]]:
    from mouse_cli.methods import registry

    for key, method in registry().items():
        yield key, f"{method.title}: {method.equation}"


def _recursions() -> Iterator[tuple[str, str]]:
    from mouse_cli.updating.loop import RECURSIONS

    for key, recursion in RECURSIONS.items():
        yield key, recursion.MEANING


def _codes() -> Iterator[tuple[str, str]]:
    from mouse_cli.codes import catalogue

    for code, entry in catalogue().items():
        yield code, entry.title


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


def _expansions() -> Iterator[tuple[str, str]]:
    from mouse_cli.dynamics.expansion import registry

    for key, expansion in registry().items():
        yield key, f"{expansion.title}: {expansion.equation}"


def _reductions() -> Iterator[tuple[str, str]]:
    from mouse_cli.coupling.reductions import registry

    for key, reduction in registry().items():
        yield key, f"{reduction.title}: {reduction.equation}"


def _elements() -> Iterator[tuple[str, str]]:
    from mouse_cli.terms.elements import registry

    for key, kind in registry().items():
        yield key, kind.meaning


def _candidates() -> Iterator[tuple[str, str]]:
    from mouse_cli.diagnosis.names import known

    for key, candidate in known().items():
        yield key, f"{candidate.title} ({candidate.group})"


def _nameless() -> Iterator[tuple[str, str]]:
    from mouse_cli.diagnosis.nameless import registry

    for key, rival in registry().items():
        yield key, f"{rival.title} ({rival.property})"


def _plots() -> Iterator[tuple[str, str]]:
    from mouse_cli.plots import registry

    for key, plot in registry().items():
        yield key, plot.title


def _groups() -> Iterator[tuple[str, str]]:
    from mouse_cli.formats.cards import layout

    for group in layout.GROUPS:
        yield str(group.number), f"{group.name} {group.symbol}".strip() + f", {group.format}"


KINDS: dict[str, Callable[[], Iterator[tuple[str, str]]]] = {
    "candidates": _candidates,
    "codes": _codes,
    "commands": _commands,
    "elements": _elements,
    "estimators": _estimators,
    "expansions": _expansions,
    "groups": _groups,
    "methods": _methods,
    "nameless": _nameless,
    "plots": _plots,
    "recursions": _recursions,
    "reductions": _reductions,
    "sections": _sections,
    "statuses": _statuses,
}


@click.command()
@click.argument("kind", type=click.Choice(sorted(KINDS)), required=False)
def command(kind: str | None) -> int:
    """List names: estimators, recursions, codes, card groups and so on."""
    for name in [kind] if kind else sorted(KINDS):
        if not kind:
            click.echo(f"{name}:")
        rows = list(KINDS[name]())
        width = max(len(key) for key, _ in rows)
        for key, text in rows:
            click.echo(f"{'' if kind else '  '}{key:<{width}}  {text}".rstrip())
    return 0
