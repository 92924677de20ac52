"""What a careful reader of a sweep or a bootstrap should know, in words."""

from collections.abc import Iterator

from mouse_cli.model.campaign import Bootstrap, Sweep
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import VERDICT, Options, Section
from mouse_cli.report.sections._wording import remarks as worded


def remarks(found: Sweep | Bootstrap, options: Options) -> Iterator[Block]:
    """One paragraph a remark, or one that says that there is none."""
    yield from worded(found.warnings, options)
    if not found.warnings and isinstance(found, Sweep):
        yield Text("No property moves by more than one posterior standard deviation.")
    if not found.warnings and isinstance(found, Bootstrap):
        yield Text("The scatter agrees with the stated accuracies, and no single measurement dominates.")


SECTION = Section("campaign-remarks", 60, "Verdict", remarks, (Sweep, Bootstrap), place=VERDICT)
