"""mouse sweep: how an answer depends on what nobody knows exactly."""

import click

from mouse_cli.cli._campaigns import TABLE
from mouse_cli.cli._engine import CLUSTER, JOBS, folder
from mouse_cli.cli._options import OUTSIDE, QUIET, RUN, answer_form, options

_MOST = 100_000


@click.command()
@click.argument("deck")
@click.option(
    "--vary", "varied", multiple=True, required=True, metavar="NAME=VALUES",
    help="a,b,c or low:high:count or log:low:high:count; NAME: an option of run, a property (its prior value), PROPERTY.sd, "
    "frequency_sd*, shape_sd*, or the path of a value in the deck such as test.modes.shape_sd. Repeat it for a grid.",
)  # fmt: skip
@click.option("--points", type=click.IntRange(1, _MOST), help="So many points that fill the ranges, instead of a grid.")
@click.option(
    "--design", type=click.Choice(("sobol", "latin-hypercube")), default="sobol", show_default=True, help="Of --points."
)
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Of --points.")
@options(folder("mouse-sweep"), JOBS, CLUSTER, answer_form("mouse.campaign/1"), TABLE, OUTSIDE, QUIET, RUN)
def command(
    deck: str,
    varied: tuple[str, ...],
    points: int | None,
    design: str,
    seed: int,
    output: str,
    jobs: int | None,
    limit_s: float | None,
    scheduler: str | None,
    cluster: int | None,
    csv_file: str | None,
    **given: object,
) -> int:
    """Run DECK over ranges of its assumptions.

    Reports the sensitivity of the answer. Each point is a job as of `mouse batch`: existing answers are kept.

    Exit code: the highest of the points' own: 5, 4, 1, 0.
    """
    from mouse_cli.batch.job import Job
    from mouse_cli.campaigns import sweep
    from mouse_cli.cli._campaigns import deck_of, deliver_campaign
    from mouse_cli.cli._engine import done
    from mouse_cli.cli._options import outside

    problem, base = deck_of(deck, given)
    wanted, at = _points(deck, varied, problem, points, design, seed)
    every = [Job(deck, options=base, outside=outside()), *sweep.jobs(deck, wanted, at, base, outside())]
    first, *outcomes = done(every, output, jobs, scheduler, cluster, limit_s)
    found = sweep.summed(problem, wanted, at, outcomes, first)
    deliver_campaign(found, csv_file)
    return found.exit_code


def _points(deck: str, varied: tuple[str, ...], problem, points: int | None, design: str, seed: int) -> tuple:
    """The quantities, and where they are varied. Raises click.UsageError, DeckError."""
    from math import prod

    from mouse_cli.campaigns.design import drawn, grid
    from mouse_cli.campaigns.sweep import checked
    from mouse_cli.cli._vary import varied as quantity

    wanted = tuple(quantity(text, problem, points is not None) for text in varied)
    if len({each.name for each in wanted}) < len(wanted):
        raise click.UsageError("--vary names a quantity twice")
    checked(deck, problem, wanted)
    if points is not None:
        return wanted, drawn(wanted, points, design, seed)
    if prod(len(each.values) for each in wanted) > _MOST:
        raise click.UsageError(f"the grid has more than {_MOST} points: give --points")
    return wanted, grid(wanted)
