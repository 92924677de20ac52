"""mouse identify: modes of recordings and of frequency response functions, with their covariance."""

import os

import click

from mouse_cli.cli._answers import answer_text
from mouse_cli.cli._options import OUTSIDE, QUIET, answer_form, options, plotting, value_of
from mouse_cli.cli._recording_options import CHANNELS, SEGMENT, SPECTRA


@click.command()
@click.argument("sources", nargs=-1, required=True, metavar="SOURCE...")
@click.option(
    "-o", "--output", metavar="FILE", help="Write the modes as `test:` to FILE: a whole deck where SOURCE has a model."
)
@click.option("--band", type=click.FloatRange(min=0), nargs=2, metavar="LOW HIGH", help="Hz. Default: all lines.")
@click.option("--orders", type=click.IntRange(min=4), metavar="N", help="Highest order of the stabilisation diagram.")
@click.option("--output-only", is_flag=True, help="Do not use measured forces.")
@click.option(
    "--free-decay", is_flag=True, help="Recordings begin where the force has ended: ring-down, or release from rest."
)
@options(plotting("Write figures: to a folder, or to one file (.pdf, .png, .svg). Needs matplotlib."))
@click.option(
    "--recording", "titles", multiple=True, metavar="TITLE", help="Of a deck: this recording; may be repeated."
)
@options(SPECTRA, CHANNELS, SEGMENT, OUTSIDE, answer_form("mouse.identification/1"))
@options(QUIET)
def command(
    sources: tuple[str, ...],
    output: str | None,
    band: tuple[float, float] | None,
    orders: int | None,
    output_only: bool,
    free_decay: bool,
    **given: object,
) -> int:
    """Identify modes from recordings or FRFs.

    Natural frequencies, damping and mode shapes. SOURCE: a YAML deck, or files of FRFs or time histories; several are
    repeats, or have one force each. Without forces, or with --output-only, the outputs alone are used. Exit 0: modes found.
    1: none, or none to be trusted. 4: rejected.
    """
    from mouse_cli.cli._identify import Excited, identified, write
    from mouse_cli.cli._terminal import check_figures, drawn, progress, warn

    check_figures()
    if band and not band[0] < band[1]:
        raise click.BadParameter(f"{band[0]:g} is not below {band[1]:g}", param_hint="--band")
    if output and any(os.path.exists(s) and os.path.exists(output) and os.path.samefile(s, output) for s in sources):
        raise click.UsageError(f"-o {output} would overwrite {output}")
    with progress() as (_, say):
        found, warnings = identified(sources, band, orders, Excited(output_only, free_decay), given, say)
    warn((*warnings, *found.doubts, *found.remarks))
    drawn(found)
    files = write(found, output)
    _answer(found, output, files)
    return found.exit_code


def _answer(found, output: str | None, files: list[str]) -> None:
    """Print the answer, and what became of `-o`."""
    from mouse_cli.cli._terminal import json_text, say
    from mouse_cli.report import document

    if value_of("form") == "json":
        say(json_text(document(found) | {"deck": files[-1] if files else None}))
        return
    text = answer_text(found, "modern")
    if output:
        text += (
            f"\nThe modes are in {files[-1]}.\n"
            if files
            else f"\nNothing was written to {output}: there are no modes.\n"
        )
    say(text, end="")
