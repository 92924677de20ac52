"""What to measure next: where two explanations of the same data part most, against what is uncertain in both.

D = 1/2 (h_A - h_B)' (R + J_A C_A J_A' + J_B C_B J_B')^-1 (h_A - h_B): above 4 the measurement will settle it, below 1 it will not.
Each prediction h and its derivatives J are those of the fitted model itself.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.altered import Model, Point
from mouse_cli.diagnosis.change import Change, Recipe
from mouse_cli.diagnosis.fit import Fit
from mouse_cli.diagnosis.points import Points, all_motions, directions
from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.diagnosis.scales import lowest, total_mass
from mouse_cli.model.diagnosis import Proposal

_MORE = 3  # modes above the highest measured one
_MASS = 0.05  # of the total mass, added
_TIED = 1.0  # of the lowest modal stiffness: of a spring to the ground
_STEP = 1e-2  # of a standard deviation
_PLACES = 12


@dataclass(frozen=True)
class Measurement:
    """kind: of those alike only the best is told; text: in words; sd: of what is read.

    altered(fit): what is changed in the model for it. read(point, fit, modes): what it reads (h,), with the modes of the model
    (m,) that are the measured ones; None where it cannot be.
    """

    kind: str
    text: str
    altered: Callable[[Fit], tuple[Recipe, ...]]
    read: Callable[[Point, Fit, np.ndarray], np.ndarray | None]
    sd: float


def proposals(one: Fit, other: Fit, names: tuple[str, str], most: int = 4) -> tuple[Proposal, ...]:
    """The measurements that separate two fits best, the best first, one of each kind."""
    found: dict[str, Proposal] = {}
    for each in measurements(one):
        separation = separated(one, other, each)
        if np.isfinite(separation) and (each.kind not in found or separation > found[each.kind].separation):
            found[each.kind] = Proposal(each.text, names, separation)
    return tuple(sorted(found.values(), key=lambda p: -p.separation)[:most])


def separated(one: Fit, other: Fit, measurement: Measurement) -> float:
    """D of a measurement; NaN where one of the models cannot be measured so."""
    parts = [_predicted(fitted, measurement) for fitted in (one, other)]
    if any(part is None for part in parts):
        return float("nan")
    (h, spread), (g, more) = parts
    apart = h - g
    return float(0.5 * apart @ np.linalg.solve(measurement.sd**2 * np.eye(len(apart)) + spread + more, apart))


def _predicted(fitted: Fit, measurement: Measurement) -> tuple[np.ndarray, np.ndarray] | None:
    """h (h,) and J C J' (h, h)."""
    model, x = Model(fitted.model.base, (*fitted.recipes, *measurement.altered(fitted))), fitted.point.x

    at = model.point(x)
    modes = None if at is None else _followed(fitted.point, at, fitted)
    here = None if modes is None else measurement.read(at, fitted, modes)
    if here is None:
        return None
    root = np.linalg.cholesky(fitted.covariance)
    points = [model.point(x + _STEP * direction) for direction in root.T]
    if any(point is None for point in points):
        return None
    there = [measurement.read(point, fitted, modes) for point in points]
    J = np.reshape([(each - here) / _STEP for each in there], (len(there), len(here))).T
    return here, J @ J.T


def _followed(before: Point, after: Point, fitted: Fit) -> np.ndarray:
    """Modes (m,) after a change that are the measured ones `before`: the same numbers, but for modes that were not measured.

    Such as that of a hidden oscillator, which sensors hardly see: as many of the least visible ones are passed over.
    """
    modes = before.modes
    if (modes == fitted.model.base.data.test.number - 1).all():
        return modes
    count = int(modes.max()) + 1
    passed = count - len(modes)
    seen = np.linalg.norm(after.seen[:, :count], axis=0)
    left = np.sort(np.argsort(seen, kind="stable")[passed:])
    return left[np.argsort(np.argsort(modes))]


def measurements(one: Fit) -> Iterator[Measurement]:
    """Further modes, a mass added, a spring to the ground, one more sensor."""
    base = one.model.base
    test = base.data.test
    sd, last = float(np.nanmedian(base.data.sd_log)), int(test.number.max())
    for more in range(1, _MORE + 1):
        words = f"frequencies of modes {last + 1} to {last + more}" if more > 1 else f"frequency of mode {last + 1}"
        yield Measurement("modes", f"the {words}", _unaltered, _above(more), sd)
    own = f"the frequencies of modes {_list(test.number)} with"
    mass, spring = _MASS * total_mass(base), _TIED * lowest(base) * total_mass(base)
    for place in _places(base, all_motions):
        yield Measurement("mass", f"{own} {mass:.3g} kg more at {place.text}", place.altered(M=mass), _measured, sd)
    for place in _places(base, directions):
        words = f"{own} {place.text} tied to the ground by {spring:.3g} N/m"
        yield Measurement("support", words, place.altered(K=spring), _measured, sd)
    if test.s:
        noise = float(np.nanmedian(test.shape_sd / np.nanmax(np.abs(test.shapes), axis=0)))
        for place in _places(base, directions):
            yield Measurement("sensor", f"the shapes at {place.text} too", _unaltered, place.seen, noise)


@dataclass(frozen=True)
class Spot:
    """A place, as each of two models knows it: number `which` of what `among` finds in it, at `values`."""

    among: Callable[[Reduced], list[Points]]
    which: int
    values: np.ndarray
    text: str

    def motion(self, base: Reduced) -> np.ndarray:
        """Rows (d, r)."""
        return self.among(base)[self.which].motion(self.values)

    def altered(self, K: float = 0.0, M: float = 0.0) -> Callable[[Fit], tuple[Recipe, ...]]:
        """The model with a spring to the ground or a mass there."""

        def made(fitted: Fit) -> tuple[Recipe, ...]:
            B = self.motion(fitted.model.base)
            change = Change(K=K * B.T @ B, M=M * B.T @ B)
            return (Recipe(None, (), lambda values: change, np.zeros((1, 0))),)

        return made

    def seen(self, at: Point, fitted: Fit, modes: np.ndarray) -> np.ndarray:
        """Shapes of the measured modes there, in units of their largest component."""
        row = self.motion(fitted.model.base)[0]
        return at.a * (row @ at.X[: len(row)][:, modes]) / np.nanmax(np.abs(fitted.model.base.data.test.shapes), axis=0)


def _list(numbers: np.ndarray) -> str:
    return f"{numbers[0]} to {numbers[-1]}" if len(numbers) > 1 else str(numbers[0])


def _places(base: Reduced, among: Callable[[Reduced], list[Points]]) -> list[Spot]:
    """Some places all over the structure."""
    points = among(base)
    found = [(i, values) for i, point in enumerate(points) for values in point.starts]
    chosen = found[:: max(1, -(-len(found) // _PLACES))]
    return [Spot(among, i, values, points[i].site(values).text) for i, values in chosen]


def _unaltered(fitted: Fit) -> tuple[Recipe, ...]:
    return ()


def _measured(at: Point, fitted: Fit, modes: np.ndarray) -> np.ndarray:
    """ln of the frequencies of the measured modes."""
    return 0.5 * np.log(np.maximum(at.eigenvalues[modes], 1e-300))


def _above(more: int) -> Callable[[Point, Fit, np.ndarray], np.ndarray | None]:
    """ln of the frequencies of so many modes above the highest measured one."""

    def read(at: Point, fitted: Fit, modes: np.ndarray) -> np.ndarray | None:
        last = int(modes.max())
        return (
            _measured(at, fitted, np.arange(last + 1, last + 1 + more)) if last + more < len(at.eigenvalues) else None
        )

    return read
