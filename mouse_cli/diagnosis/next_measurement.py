"""What to measure next: where two explanations of the same data part most, against what is uncertain in both.

D = 1/2 (h_A - h_B)' (R + J_A C_A J_A' + J_B C_B J_B')^-1 (h_A - h_B): above 4 the measurement will settle it, below 1 it will not.
"""

from collections.abc import Callable, Iterator

import numpy as np

from mouse_cli.diagnosis.change import Change, Recipe
from mouse_cli.diagnosis.fit import Fit, Model
from mouse_cli.diagnosis.scales import total_mass
from mouse_cli.model.diagnosis import Proposal

_MORE = 3  # modes above the highest measured one
_ADDED = 0.05  # of the total mass
_STEP = 1e-2  # of a standard deviation
_PLACES = 12
Predictor = Callable[[Model, np.ndarray], np.ndarray | None]


def proposals(one: Fit, other: Fit, names: tuple[str, str], most: int = 4) -> tuple[Proposal, ...]:
    """The measurements that separate two fits best, the best first, one of each kind."""
    found: dict[str, Proposal] = {}
    for (kind, text, *here), (_, _, *there) in zip(_measurements(one), _measurements(other), strict=False):
        separation = _separation((one, *here), (other, *there))
        if separation is not None and (kind not in found or separation > found[kind].separation):
            found[kind] = Proposal(text, names, separation)
    return tuple(sorted(found.values(), key=lambda p: -p.separation)[:most])


def _measurements(one: Fit) -> Iterator[tuple[str, str, tuple[Recipe, ...], Predictor, float]]:
    """Kind, words, what is altered for it, what it would read, and its sd."""
    base = one.model.base
    test = base.data.test
    sd = float(np.nanmedian(test.frequency_sd_hz / test.frequency_hz))
    last = int(test.number.max())
    numbers = test.number - 1
    for more in range(1, _MORE + 1):
        text = (
            f"the frequency of mode {last + 1}"
            if more == 1
            else f"the frequencies of modes {last + 1} to {last + more}"
        )
        yield f"modes {more}", text, (), _frequencies(np.arange(last, last + more)), sd
    mass = _ADDED * total_mass(base)
    for text, change in _places(one):
        added = (Recipe(None, (), lambda values, B=change: Change(M=mass * B.T @ B), np.zeros((1, 0))),)
        words = f"the frequencies of modes {_list(test.number)} with {mass:.3g} kg more at {text}"
        yield "mass", words, added, _frequencies(numbers), sd
    if test.s:
        noise = float(np.nanmedian(test.shape_sd / np.nanmax(np.abs(test.shapes), axis=0)))
        for text, change in _places(one):
            for row in change:
                yield "sensor", f"the shapes at {text} too", (), _shape_at(row), noise


def _list(numbers: np.ndarray) -> str:
    return f"{numbers[0]} to {numbers[-1]}" if len(numbers) > 1 else str(numbers[0])


def _places(one: Fit) -> list[tuple[str, np.ndarray]]:
    """Some places, and their translations (d, r)."""
    from mouse_cli.diagnosis.points import all_motions

    found = []
    for point in all_motions(one.model.base):
        for values in point.starts[:: max(1, len(point.starts) // _PLACES)]:
            found.append((point.site(values).text, point.motion(values)))
    return found[:: max(1, len(found) // _PLACES)]


def _frequencies(numbers: np.ndarray) -> Predictor:
    def read(model: Model, x: np.ndarray) -> np.ndarray | None:
        at = model.point(x)
        if at is None or numbers.max() >= len(at.eigenvalues):
            return None
        return 0.5 * np.log(np.maximum(at.eigenvalues[numbers], 1e-300))

    return read


def _shape_at(row: np.ndarray) -> Predictor:
    """Shapes of the measured modes at one more sensor, in units of their largest component."""

    def read(model: Model, x: np.ndarray) -> np.ndarray | None:
        at = model.point(x)
        if at is None:
            return None
        return at.a * (row @ at.X[: len(row)][:, at.modes]) / np.nanmax(np.abs(model.base.data.test.shapes), axis=0)

    return read


def _separation(*sides: tuple[Fit, tuple[Recipe, ...], Predictor, float]) -> float | None:
    parts = []
    for fitted, added, predictor, sd in sides:
        model = Model(fitted.model.base, (*fitted.recipes, *added))
        here = predictor(model, fitted.point.x)
        if here is None:
            return None
        root, columns = np.linalg.cholesky(fitted.covariance), []
        for direction in root.T:
            there = predictor(model, fitted.point.x + _STEP * direction)
            if there is None:
                return None
            columns.append((there - here) / _STEP)
        J = np.stack(columns, axis=1) if columns else np.zeros((len(here), 0))
        parts.append((here, J @ J.T))
    apart = parts[0][0] - parts[1][0]
    total = sd**2 * np.eye(len(apart)) + parts[0][1] + parts[1][1]
    return float(0.5 * apart @ np.linalg.solve(total, apart))
