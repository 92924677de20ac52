"""Convergence: the misfit after each cycle."""

from collections.abc import Iterator

from mouse_cli.page.charts import curve
from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import shown
from mouse_cli.page.section import PageSection
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_HEADS = ("cycle", "chi-square", "data outside their limits", "allowed", "cost", "damping of the step")


def convergence(document: Part) -> Iterator[Markup]:
    """Chi-square by cycle as a curve, then every cycle."""
    cycles = document.parts("cycles")
    chi2 = [cycle.number("chi2") for cycle in cycles]
    spoken = "; ".join(f"cycle {i}: {shown(value, 4)}" for i, value in enumerate(chi2))
    told = f"Sum of squared differences over their variances, logarithmic; cycle 0 is the prior model. {spoken}."
    yield curve("chi-square", "Chi-square after each cycle", told, chi2)
    keys = ("chi2", "exceedances", "allowed", "cost", "damping")
    rows = [(Cell(c.number("cycle"), c.label("cycle")), *(c.number(key) for key in keys)) for c in cycles]
    yield table("cycles", "Cycles of the run", _HEADS, rows)


SECTION = PageSection("convergence", 70, "Convergence", convergence)
