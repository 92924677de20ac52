"""mouse bootstrap: how far an answer spreads when the test is drawn anew."""

import click

from mouse_cli.cli._campaigns import TABLE
from mouse_cli.cli._engine import CLUSTER, JOBS, folder
from mouse_cli.cli._options import OUTSIDE, QUIET, RUN, answer_form, options


@click.command()
@click.argument("deck")
@click.option(
    "--over",
    type=click.Choice(("modes", "sensors", "both", "functions", "records")),
    help="What is drawn; both: modes and sensors.  [default: what the deck has first of modes, functions, records]",
)
@click.option("--replicates", type=click.IntRange(2, 100_000), default=200, show_default=True, help="Tests drawn.")
@click.option("--jackknife", is_flag=True, help="Jackknife only: leave each out once, and resample none.")
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Of the random numbers.")
@options(folder("mouse-bootstrap"), JOBS, CLUSTER, answer_form("mouse.campaign/1"), TABLE, OUTSIDE, QUIET, RUN)
def command(
    deck: str,
    over: str | None,
    replicates: int,
    jackknife: bool,
    seed: int,
    output: str,
    jobs: int | None,
    limit_s: float | None,
    scheduler: str | None,
    cluster: int | None,
    csv_file: str | None,
    **given: object,
) -> int:
    """Resample the test of DECK: how far its answer spreads.

    Reports the scatter, and the influence of each mode, sensor, function or record. Each replicate is a job as of `mouse
    batch`: existing answers are kept.

    Exit code: that of the run of DECK itself.
    """
    from mouse_cli.campaigns import bootstrap, resampled
    from mouse_cli.cli._campaigns import deck_of, deliver_campaign
    from mouse_cli.cli._engine import done
    from mouse_cli.cli._options import outside

    problem, base = deck_of(deck, given, recordings=True)
    plan = bootstrap.plan(problem, over or bootstrap.natural(problem), 0 if jackknife else replicates, seed)
    outcomes = done(bootstrap.jobs(deck, plan, base, outside()), output, jobs, scheduler, cluster, limit_s)
    found = resampled.summed(problem, plan, outcomes, seed)
    deliver_campaign(found, csv_file)
    return found.exit_code
