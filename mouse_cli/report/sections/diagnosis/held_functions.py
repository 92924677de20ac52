"""Frequency response functions, or lines of them, that the deck holds out: with the cause and without."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._functions import covered, functions


def held_out(found: Diagnosis, options: Options) -> Iterator[Block]:
    """The same tables as of those that were fitted, and whether the mechanism predicts them better."""
    yield from functions(found.held_frf)
    yield from covered(found.held_frf)
    for fit in found.held_frf:
        if len(fit.models) > 1 and fit.median_db(fit.revised) > fit.median_db(fit.prior):
            yield Text("The mechanism increases the error of held-out FRFs: that is evidence against it.")


SECTION = Section("diagnosis-held-functions", 84, "Frequency response functions held out", held_out, (Diagnosis,))
