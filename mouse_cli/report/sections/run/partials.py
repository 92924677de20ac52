"""The partial derivatives of the data, when they were asked for (JFLAG = 1)."""

from collections.abc import Iterator

from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Matrix, Text
from mouse_cli.report.section import APPENDIX, Options, Section
from mouse_cli.report.sections._wording import names


def partials(result: Result, options: Options) -> Iterator[Block]:
    """B by the listed elements, T = B A by the properties; the data are named x(mode,component)."""
    if result.B is None or result.T is None:
        return
    yield Text(
        "lambda i is the eigenvalue of mode i in (rad/s) squared, x(i,u) is component u of mode i. An element off the diagonal "
        "moves together with its mirror image."
    )
    data = result.labels
    elements = result.problem.elements.labels()
    if len(elements):
        yield Matrix("B: by the listed elements", result.B, data, elements, corner=("datum", "element"))
    yield Matrix("T: by the properties", result.T, data, names(result.problem), corner=("datum", "property"))
    if any(p.transform == "log" for p in result.problem.parameters):
        yield Text("Of a property with the transform log, T is the derivative by its natural logarithm.")


SECTION = Section("partials", 60, "Partial derivatives at the revised model", partials, place=APPENDIX)
