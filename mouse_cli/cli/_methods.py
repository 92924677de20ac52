"""Options that choose a method of updating, and the run by one."""

from collections.abc import Iterable

import click

from mouse_cli.cli._options import value_of

METHOD = (
    click.option(
        "--method", metavar="METHOD", help="Update by this method instead of the loop; see `mouse list methods`."
    ),
    click.option("--expand", metavar="EXPANSION", help="With --method: how measured shapes are expanded."),
)


def checked(keys: tuple[str, ...], how: str | None) -> str:
    """The expansion to use. Raises click.BadParameter for methods and expansions that there are not."""
    from mouse_cli.dynamics.expansion import expansion
    from mouse_cli.methods import method
    from mouse_cli.methods.update import EXPANSION

    for name, find, given in (("--method", method, keys), ("--expand", expansion, (how,) if how else ())):
        for key in given:
            try:
                find(key)
            except ValueError as error:
                raise click.BadParameter(str(error), param_hint=name) from None
    return how or EXPANSION


def chosen(key: str | None, how: str | None) -> tuple[str | None, str]:
    """The method, and the expansion of shapes for it. Raises click.UsageError for what does not go with it."""
    if key is None:
        if how:
            raise click.UsageError("--expand belongs to --method")
        return None, ""
    if value_of("plot"):
        raise click.UsageError("--plot draws what the loop fits; a --method has no figures")
    return key, checked((key,), how)


def by_method(problems: Iterable, key: str, how: str) -> list:
    """The answers of one method to each problem."""
    from mouse_cli.cli._decks import without_laws
    from mouse_cli.cli._terminal import progress, warn
    from mouse_cli.methods.update import update

    answers = []
    for problem in problems:
        warn((*problem.warnings, *without_laws(problem, modes=True)))
        with progress() as (_, say):
            answers.append(update(problem, key, how, say))
    return answers
