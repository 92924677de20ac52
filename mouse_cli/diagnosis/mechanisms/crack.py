"""An open crack across a bar of rectangular section."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.effects.fracture import factors
from mouse_cli.diagnosis.effects.hinges import hinged, lines, places, with_hinge
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.reasons import bars
from mouse_cli.model.problem import Problem
from mouse_cli.terms.fracture import compliance

_STILL = 1e-9  # elongation over bending strain times length below which a bar does not stretch


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """F + c_turning b b' + (4 / l^2) c_sliding on the antisymmetric strain + what it parts besides, b = [1, eta, e].

    The compliances are those of the element `cracked_beam`. e: distance of the point about which the crack turns from the axis;
    what it parts there comes to the elongation. A bar that does not stretch in the model has no axial force: it turns about its
    axis, e = 0, for else the crack were held shut.
    """
    bars, depth = model.bars, Unknown("depth over height", "1", 0.05, 0.7)
    stretches = None if bars is None else _stretching(bars)

    def compliances(bar: int, depth: float) -> tuple[float, float, float, float]:
        """Angle for a unit moment, sliding and parting for unit forces, and e."""
        height = np.sqrt(12 * bars.EI[bar] / bars.E[bar] / bars.A[bar])
        c = compliance(factors(depth), height, bars.EI[bar], bars.nu[bar])
        e = c.both / c.turning * stretches[bar]
        return c.turning, c.sliding, c.parting - e**2 * c.turning, e

    def does(bar: int, at: float, values: np.ndarray) -> Change:
        turning, sliding, parting, e = compliances(bar, values[0])
        b = np.array([1.0, 2 * at - 1, e])
        added = turning * np.outer(b, b) + np.diag([0.0, 4 / bars.length[bar] ** 2 * sliding, parting])
        return hinged(bars, bar, at, added)

    def extend(problem: Problem, bar: int, at: float, values: np.ndarray) -> Problem:
        turning, sliding, parting, e = compliances(bar, values[0])
        name = f"crack in {bars.site(bar, at).text}"
        return with_hinge(problem, bars, bar, at, name, 1 / turning, 1 / sliding, 1 / parting, e)

    return places(model, candidate, (depth,), does, steps(depth, 3), extend, lines(model))


def _stretching(bars: Bars) -> np.ndarray:
    """Mask (b,) of the bars whose ends move along them, one against the other."""
    size = np.abs(bars.strain).max(axis=2)
    return size[:, 2] > _STILL * bars.length * size[:, :2].max(axis=1)


CANDIDATE = Candidate(
    "crack",
    "an open crack",
    "local-stiffness",
    "an open edge crack across a bar of rectangular section: a compliance in bending about a point off the axis, and a little "
    "in tension and shear, by its depth (linear fracture mechanics)",
    recipes,
    bars,
)
