"""What to measure next: where two explanations of the same data part most, against what is uncertain in both.

D = 1/2 (h_A - h_B)' (R + J_A C_A J_A' + J_B C_B J_B')^-1 (h_A - h_B): above 4 the measurement will settle it, below 1 it will not.
Each prediction h and its derivatives J are those of the fitted model itself.
"""

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.unseen import unmeasured_hz, unseen
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.sites.points import directions
from mouse_cli.diagnosis.validate.measurements import SHAPE_SD, Measurement, listed, measurements, places, unaltered
from mouse_cli.model.diagnosis import Effort, Proposal

_STEP = 1e-2  # of a standard deviation
_SENSORS = 4  # places at most of shapes that were not measured yet
_FREE = 1e3  # largest components: sd of the unknown scale of a shape
_ENOUGH = 6.0  # nats from which on no further place is sought

Prediction = tuple[np.ndarray, np.ndarray]  # h (h,) and J C J' (h, h)


class Rivals:
    """Several fits, and what each says of a measurement, computed once."""

    def __init__(self, fits: list[Fit], names: list[str]):
        self.fits, self.names = fits, names
        self.every = list(measurements(*fits))
        self._known: dict[tuple[int, int], Prediction | None] = {}
        self._spots = places(fits[0].model.base, directions)

    def proposals(self, first: int, second: int) -> list[Proposal]:
        """The best measurement of each kind that separates two of them, of further modes the fewest that will."""
        pair, best = (self.names[first], self.names[second]), {}
        for number, each in enumerate(self.every):
            if each.kind == "modes" and "modes" in best and best["modes"].promise == 2:
                continue
            separation = _distance(self._of(first, number), self._of(second, number), each.sd)
            if np.isfinite(separation) and (each.kind not in best or separation > best[each.kind].separation):
                best[each.kind] = Proposal(each.text, pair, separation, each.effort)
        others = self._shapes(first, second, pair), self._own_mode(first, second, pair)
        return [*best.values(), *(each for each in others if each is not None)]

    def _of(self, which: int, number: int) -> Prediction | None:
        if (which, number) not in self._known:
            self._known[which, number] = predicted(self.fits[which], self.every[number])
        return self._known[which, number]

    def _own_mode(self, first: int, second: int, pair: tuple[str, str]) -> Proposal | None:
        """To look for a mode that one of the two has and no test yet; where there is none, its absence speaks as `unseen` says."""
        found = [unmeasured_hz(self.fits[which]) for which in (first, second)]
        if all(found) or not any(found):
            return None
        which, hz = (first, found[0]) if found[0] else (second, found[1])
        where = ", ".join(f"{value:.3g}" for value in hz)
        what = " and ".join(recipe.candidate.title for recipe in self.fits[which].recipes)
        text = f"whether there is a mode at about {where} Hz, which {what} would make"
        return Proposal(text, pair, unseen(self.fits[which]), Effort.MODES)

    def _shapes(self, first: int, second: int, pair: tuple[str, str]) -> Proposal | None:
        """Shapes at the fewest places that separate the two, where none were measured."""
        test = self.fits[0].model.base.data.test
        if self.fits[0].model.base.data.has_shape.any() or len(self._spots) < 2:
            return None
        parts = [self._all_shapes(which) for which in (first, second)]
        if any(part is None for part in parts):
            return None
        chosen, separation = chosen_places(*parts, len(self._spots), test.m)
        where = "; ".join(self._spots[i].text for i in chosen)
        modes = f"mode{'s' if test.m > 1 else ''} {listed(test.number)}"
        text = f"the shapes of {modes} at {where} (to {100 * SHAPE_SD:g} % of the largest component)"
        return Proposal(text, pair, separation, Effort.SHAPES)

    def _all_shapes(self, which: int) -> Prediction | None:
        """Shapes (places x m,) of unit length at all places, place by place."""
        if (which, -1) not in self._known:

            def read(at: Point, fitted: Fit, modes: np.ndarray) -> np.ndarray:
                shapes = np.array([spot.shape(at, fitted, modes) for spot in self._spots])
                size = np.linalg.norm(shapes, axis=0)
                turned = np.sign(np.sum(shapes**3, axis=0))
                return (shapes * np.where(turned < 0, -1, 1) / np.where(size > 0, size, 1.0)).ravel()

            whole = Measurement("shapes", "", Effort.SHAPES, unaltered, read, SHAPE_SD)
            self._known[which, -1] = predicted(self.fits[which], whole)
        return self._known[which, -1]


def proposals(fits: list[Fit], names: list[str], most: int = 6) -> tuple[Proposal, ...]:
    """What separates the first fit from the second by each kind of measurement, then from each of the others by the best.

    Those that will settle it come first, the least effort before more; then those that may.
    """
    rivals = Rivals(fits, names)
    found = sorted(rivals.proposals(0, 1), key=order)[:most]
    for other in range(2, len(fits)):
        found += sorted(rivals.proposals(0, other), key=order)[:1]
    return tuple(found)


def order(proposal: Proposal) -> tuple[int, int, float]:
    """Key by which proposals are sorted: what it promises, the effort, the separation."""
    return -proposal.promise, int(proposal.effort), -proposal.separation


def separated(one: Fit, other: Fit, measurement: Measurement) -> float:
    """D of a measurement; NaN where one of the models cannot be measured so."""
    return _distance(predicted(one, measurement), predicted(other, measurement), measurement.sd)


def _distance(one: Prediction | None, other: Prediction | None, sd: float) -> float:
    if one is None or other is None:
        return float("nan")
    (h, spread), (g, more) = one, other
    apart = h - g
    return float(0.5 * apart @ np.linalg.solve(sd**2 * np.eye(len(apart)) + spread + more, apart))


def chosen_places(one: Prediction, other: Prediction, count: int, m: int) -> tuple[list[int], float]:
    """The fewest of `count` places at which shapes (count x m,) of two models part enough, and D there; scale and sign are free."""
    (h, spread), (g, more) = one, other
    h, g = h.reshape(count, m), g.reshape(count, m)
    turned = np.where(np.sum(h * g, axis=0) < 0, -1, 1)
    g, every = g * turned, np.tile(turned, count)
    total, largest = spread + every[:, None] * more * every, np.abs(h).max(axis=0)
    chosen: list[int] = []
    best = 0.0
    while len(chosen) < min(_SENSORS, count) and best < _ENOUGH:
        trials = [(_apart(h, g, total, largest, [*chosen, i]), i) for i in range(count) if i not in chosen]
        best, i = max(trials)
        chosen.append(i)
        if len(chosen) == 1:  # one place has no shape, only a scale
            best = 0.0
    return sorted(chosen), best


def _apart(h: np.ndarray, g: np.ndarray, total: np.ndarray, largest: np.ndarray, chosen: list[int]) -> float:
    """D of shapes (count, m) at some places, of unknown scale; of one place alone, how much it moves at all."""
    if len(chosen) == 1:
        return float(np.sum((h[chosen[0]] / largest) ** 2))
    m = h.shape[1]
    at = (np.array(chosen)[:, None] * m + np.arange(m)).ravel()
    noise = np.tile(SHAPE_SD * largest, len(chosen))
    scale = np.zeros((len(at), m))
    scale[np.arange(len(at)), np.tile(np.arange(m), len(chosen))] = _FREE * h[chosen].ravel()
    R = np.diag(noise**2) + scale @ scale.T + total[np.ix_(at, at)]
    apart = (h - g)[chosen].ravel()
    return float(0.5 * apart @ np.linalg.solve(R, apart))


def predicted(fitted: Fit, measurement: Measurement) -> Prediction | None:
    """h (h,) and J C J' (h, h); None where the model cannot be measured so."""
    changes = measurement.altered(fitted)
    if changes is None:
        return None
    model, x = Model(fitted.model.base, (*fitted.recipes, *changes)), fitted.point.x
    at = model.point(x)
    modes = None if at is None else _followed(fitted.point, at, fitted)
    here = None if modes is None else measurement.read(at, fitted, modes)
    if here is None:
        return None
    points = [model.point(x + _STEP * direction) for direction in fitted.root.T]
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
