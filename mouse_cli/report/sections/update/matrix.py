"""The updated stiffness matrix, where it fits the page."""

from collections.abc import Iterator

from mouse_cli.model.arrays import dense
from mouse_cli.model.updated import Updated
from mouse_cli.report.blocks import Block, Matrix
from mouse_cli.report.section import APPENDIX, Options, Section


def matrix(found: Updated, options: Options) -> Iterator[Block]:
    """K; --json holds it up to 140 degrees of freedom."""
    if found.problem.structure.n <= options.matrix_dofs:
        labels = found.problem.structure.labels
        yield Matrix("updated stiffness matrix", dense(found.K), labels, labels)


SECTION = Section("update-matrix", 50, "Updated stiffness matrix", matrix, (Updated,), place=APPENDIX)
