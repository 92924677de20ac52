"""Samples in brief: whether the chain and the model can be trusted, and what the normal density is worth."""

from collections.abc import Iterator

from mouse_cli.model.sampled import Sampled
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import VERDICT, Options, Section


def verdict(found: Sampled, options: Options) -> Iterator[Block]:
    """What forbids to use the posterior first."""
    if found.result.rejected:
        yield Text("The form of the model is rejected: the posterior is that of a model which cannot give these data.")
    if not found.long_enough:
        yield Text("Do not use these samples: the chain is too short.")
    trusted = "may stand" if not found.doubtful else "must not stand"
    several = f" The posterior has {len(found.modes)} modes." if len(found.modes) > 1 else ""
    yield Text(
        f"The normal density of the run {trusted} for the posterior: Pareto k-hat of {found.draws} draws from it is {{}}.{several}",
        (round(found.k_hat, 2),),
    )


SECTION = Section("sample-verdict", 10, "Posterior by samples", verdict, (Sampled,), place=VERDICT)
