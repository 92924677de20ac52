"""mouse import: an input file of Abaqus, CalculiX or Nastran becomes a deck with supports, element sets and materials by name."""

import click

from mouse_cli.cli._options import OUTSIDE, QUIET, options, outside


@click.command("import")
@click.argument("job")
@click.option(
    "-o", "--output", metavar="FILE", help="The deck to write; by default the name of the job with .yaml, here."
)
@click.option(
    "--units", type=click.Choice(["SI", "mm-t-N", "mm-kg-mN", "m-t-kN", "in-lbf", "ft-lbf"]),
    help="Of the job; by default deduced from its materials.",
)  # fmt: skip
@click.option(
    "--thickness", metavar="SET", multiple=True,
    help="Element set of shells whose thickness is to be a parameter; may be repeated.",
)  # fmt: skip
@click.option("--no-cache", is_flag=True, help="Run the solver even where an earlier import left its matrices.")
@options(QUIET, OUTSIDE)
def command(job: str, output: str | None, units: str | None, thickness: tuple[str, ...], no_cache: bool) -> int:
    """Make a deck of an Abaqus or CalculiX JOB (.inp), or of bulk data of Nastran (.bdf).

    CalculiX (ccx) writes K and M without supports, once for the whole and once for each set of groups that do not touch; the
    deck names supports, element sets and materials as the job does. Sums and frequencies are checked against the solver.
    """
    from pathlib import Path

    from mouse_cli.cli._terminal import progress, say, warn
    from mouse_cli.importing.run import imported

    target = Path(output) if output else Path(Path(job).stem + ".yaml")
    with progress() as (_, tell):
        found = imported(job, target, units, not no_cache, tell, outside(), thickness)
    warn(found.remarks)
    say(found.text())
    return 0
