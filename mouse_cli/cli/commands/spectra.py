"""mouse spectra: frequency response functions of recordings, with their accuracy."""

import click

from mouse_cli.cli._options import answer_form, options
from mouse_cli.model.frf_test import KINDS
from mouse_cli.model.spectra import ESTIMATORS, WINDOWS

_FILE = (
    click.option(
        "--force", "forces", multiple=True, metavar="[SENSOR=]CHANNEL", help="A channel of a force; may be repeated."
    ),
    click.option(
        "--response",
        "responses",
        multiple=True,
        metavar="[SENSOR=]CHANNEL",
        help="A channel of a response. Default: all others.",
    ),
    click.option("--unit", "units", multiple=True, metavar="CHANNEL=UNIT", help="Unit of a channel, as acc3=g."),
    click.option(
        "--sample-rate",
        type=click.FloatRange(min=0, min_open=True),
        help="Samples a second, where the file does not say.",
    ),
    click.option("--time", metavar="CHANNEL", help="The time column. Default: one called t or time."),
    click.option(
        "--segment", type=int, nargs=2, metavar="FIRST LAST", help="Samples from FIRST, from 0, up to but without LAST."
    ),
)
_HOW = (
    click.option("--estimator", type=click.Choice(ESTIMATORS), default="h1", show_default=True, help="Where the noise is."),
    click.option("--window", type=click.Choice(WINDOWS), default="hann", show_default=True, help="Window of each block."),
    click.option("--lines", type=click.IntRange(min=2), help="Spectral lines, half the samples of a block. Default: by length."),
    click.option("--overlap", type=click.FloatRange(0, 0.95), help="Of blocks. Default: 0.5; 0 for uniform and exponential."),
    click.option(
        "--final", type=click.FloatRange(0, 1, min_open=True, max_open=True), default=0.01, show_default=True,
        help="Value of the exponential window at the end of a block.",
    ),
    click.option("--impact", is_flag=True, help="A block begins at each stroke of a hammer."),
    click.option("--pretrigger", type=click.IntRange(min=0), default=10, show_default=True, help="Samples before a stroke."),
    click.option("--period", type=click.IntRange(min=4), metavar="SAMPLES", help="Of a periodic excitation: means over periods."),
    click.option("--skip", type=click.IntRange(min=0), default=0, show_default=True, help="Samples left out at the beginning."),
    click.option("--kind", type=click.Choice(tuple(KINDS)), help="Kind of the functions. Default: that of the first response."),
)  # fmt: skip


@click.command()
@click.argument("source")
@click.option(
    "-o", "--output", metavar="FILE", help="Write the functions to FILE: .npz, .unv or .uff. `test.frf` reads it."
)
@click.option(
    "--recording", "titles", multiple=True, metavar="TITLE", help="Of a deck: this recording; may be repeated."
)
@options(_HOW, _FILE, answer_form("mouse.spectra/1"))
@click.option("-q", "--quiet", is_flag=True, help="No warnings on standard error.")
def command(
    source: str,
    output: str | None,
    titles: tuple[str, ...],
    form: str | None,
    numbers: str | None,
    quiet: bool,
    **given,
) -> int:
    """Frequency response functions of the recordings of SOURCE, a YAML deck or a file of measured data.

    Recordings of a deck that have the same channels are averaged together. The table says of each function how many lines and
    averages it has, its median coherence, and its noise.
    """
    from mouse_cli.cli._spectra import measured_data, spectra_options
    from mouse_cli.cli._terminal import json_text, show_diagnostics
    from mouse_cli.formats.frf_files import write_frf
    from mouse_cli.records.measurements import measure
    from mouse_cli.report import document, written

    how = spectra_options(given)
    data = measured_data(source, titles, given)
    found = measure(data.recordings, how, data.n, data.title, source, data.warnings)
    if not quiet:
        show_diagnostics(found.warnings)
    if output:
        if len(found.measured) > 1:
            names = ", ".join(each.recordings[0] for each in found.measured)
            raise click.UsageError(
                f"the recordings make {len(found.measured)} sets of functions ({names}); choose one with --recording"
            )
        write_frf(found.measured[0].frf, output, data.units)
    click.echo(
        json_text(document(found)) if form == "json" else written(found, form or "printout", numbers or "modern"),
        nl=form == "json",
    )
    return 0
