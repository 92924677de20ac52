"""mouse spectra: frequency response functions of recordings, with their accuracy."""

import click

from mouse_cli.cli._answers import answer_text
from mouse_cli.cli._options import OUTSIDE, QUIET, answer_form, options
from mouse_cli.cli._recording_options import CHANNELS, SEGMENT, SPECTRA


@click.command()
@click.argument("source")
@click.option(
    "-o", "--output", metavar="FILE", help="Write the functions to FILE: .npz, .unv or .uff. `test.frf` reads it."
)
@click.option(
    "--recording", "titles", multiple=True, metavar="TITLE", help="Of a deck: this recording; may be repeated."
)
@options(SPECTRA, CHANNELS, SEGMENT, OUTSIDE, answer_form("mouse.spectra/1"))
@options(QUIET)
def command(source: str, output: str | None, titles: tuple[str, ...], **given: object) -> int:
    """Estimate FRFs from the recordings of SOURCE.

    SOURCE is a YAML deck or a file of measured data. Recordings of a deck that have the same channels are averaged
    together. The table lists lines, averages, median coherence and noise of each FRF.
    """
    from mouse_cli.cli._spectra import measured_data, spectra_options
    from mouse_cli.cli._terminal import say, warn
    from mouse_cli.formats.frf_files import write_frf
    from mouse_cli.records.measurements import measure

    how = spectra_options(given)
    data = measured_data(source, titles, given)
    found = measure(data.recordings, how, data.n, data.title, source, data.warnings)
    warn(found.warnings)
    if output:
        if len(found.measured) > 1:
            names = ", ".join(each.recordings[0] for each in found.measured)
            raise click.UsageError(
                f"the recordings make {len(found.measured)} sets of functions ({names}); choose one with --recording"
            )
        write_frf(found.measured[0].frf, output, data.units)
    say(answer_text(found, "modern").rstrip("\n"))
    return 0
