"""Heading of samples of a posterior: program, deck, how long the chain is."""

from collections.abc import Iterator

from mouse_cli.model.sampled import Sampled
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import counted, deck_table


def heading(found: Sampled, options: Options) -> Iterator[Block]:
    """What was sampled and how well."""
    yield deck_table(found.problem)
    kept, walkers = found.chain.log_posterior.shape
    yield Text(
        f"An ensemble of {counted(walkers, 'walker')} took {counted(found.steps, 'step')} each from the result of the run "
        f"(estimator bayes, recursion anchored), of which the first {found.burn} are left out; {{}} of 100 proposals were taken. "
        f"The autocorrelation time is {{}} steps, so that each walker went on for {{}} of them; seed {found.seed}, "
        f"{counted(found.evaluations, 'model')} solved.",
        (round(100 * found.acceptance), round(found.tau, 1), round(kept / found.tau)),
    )


SECTION = Section("sample-heading", 10, "Sampling", heading, (Sampled,))
