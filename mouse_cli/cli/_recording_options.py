"""Options of the commands that read recordings: which channels there are, and how they become functions."""

import click

from mouse_cli.model.frf_test import KINDS
from mouse_cli.model.spectra import ESTIMATORS, FOUND, WINDOWS

CHANNELS = (
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
        help="Sample rate in Hz, where the file has none.",
    ),
    click.option("--time", metavar="CHANNEL", help="The time column. Default: one called t or time."),
)
SEGMENT = (
    click.option(
        "--segment", type=int, nargs=2, metavar="FIRST LAST", help="Samples from FIRST, from 0, up to but without LAST."
    ),
)
SPECTRA = (
    click.option("--estimator", type=click.Choice(ESTIMATORS), default="h1", show_default=True, help="Where the noise is."),
    click.option("--window", type=click.Choice(WINDOWS), help="Window of each block. Default: hann; uniform with --impact."),
    click.option("--lines", type=click.IntRange(min=2), help="Spectral lines, half the samples of a block. Default: by length."),
    click.option("--overlap", type=click.FloatRange(0, 0.95), help="Of blocks. Default: 0.5; 0 for uniform and exponential."),
    click.option(
        "--final", type=click.FloatRange(0, 1, min_open=True, max_open=True), default=0.01, show_default=True,
        help="Value of the exponential window at the end of a block.",
    ),
    click.option("--impact", is_flag=True, help="A block begins at each stroke of a hammer."),
    click.option("--pretrigger", type=click.IntRange(min=0), default=10, show_default=True, help="Samples before a stroke."),
    click.option(
        "--force-window", type=click.IntRange(min=FOUND), is_flag=False, flag_value=FOUND, metavar="[SAMPLES]",
        help="With --impact: the force counts as 0 so many samples after the beginning of a block. Alone: the length is found.",
    ),
    click.option("--period", type=click.IntRange(min=4), metavar="SAMPLES", help="Of a periodic excitation: means over periods."),
    click.option("--skip", type=click.IntRange(min=0), default=0, show_default=True, help="Samples left out at the beginning."),
    click.option("--kind", type=click.Choice(tuple(KINDS)), help="Kind of the functions. Default: that of the first response."),
)  # fmt: skip
