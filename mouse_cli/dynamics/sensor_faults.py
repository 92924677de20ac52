"""Which sensors of a test are mounted backwards, exchanged, or wrong in gain: what one change of a row does to all MACs.

The misfit of paired shapes is J = sum over modes (1 - MAC), the share of each shape that is not the model's, on
N = sum (components - 1) degrees of freedom. A fault is named only when mending it lowers J by far more than chance, or an error
of the model spread over all sensors, would: by a multiple of J/N as it is afterwards.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mouse_cli.dynamics.correlation import mac
from mouse_cli.model.correlation import GAIN, REVERSED, STRANGE, SWAPPED, SensorFault

_CLEAR = 30.0  # gain in J, in units of J/N, below which a fault is not named
_UNIQUE = 9.0  # lead on the next best explanation, in the same units
_HALF = 0.6  # share of J that may remain
_WORSE = 0.05  # no mode may lose more MAC than this
_USUAL = 1.3  # gains from 1/1.3 to 1.3 are left alone: amplitudes of a wrong model err as much
_DEAD = 0.05


@dataclass(frozen=True)
class _Change:
    """A way to mend one fault: macs (a,) after it, `free` numbers fitted by it, and the gain it found."""

    kind: str
    sensors: tuple[int, ...]
    macs: np.ndarray
    free: int
    gain: float = np.nan

    @property
    def misfit(self) -> float:
        """J of the mended shapes."""
        return float(np.sum(1 - self.macs))


def sensor_faults(test: np.ndarray, sd: np.ndarray, model: np.ndarray) -> list[SensorFault]:
    """Faults of the sensors of paired shapes: `test`, its standard deviations and `model`, all (s, a); at most s/3 of them.

    At least two modes must speak for a fault, and no mode against it. Faults are found one after another, the clearest first.
    """
    found: list[SensorFault] = []
    while len(found) < max(1, len(test) // 3):
        change = _clearest(test, sd, model)
        if change is None or set(change.sensors) & {k for fault in found for k in fault.sensors}:
            break
        before = float(np.mean(_macs(test, model)))
        fault = SensorFault(change.kind, change.sensors, change.gain, before, float(np.mean(change.macs)))
        found.append(fault)
        test = _mended(test, change)
    return found


def _clearest(test: np.ndarray, sd: np.ndarray, model: np.ndarray) -> _Change | None:
    """The change that lowers J most, when it does so clearly and alone."""
    have = np.isfinite(test)
    N = int(np.sum(have.sum(axis=0) - 1))
    if test.shape[1] < 2 or have.sum(axis=0).min() < 3:
        return None
    now = _macs(test, model)
    noise = float(np.nansum(sd**2 / np.nansum(test**2, axis=0)))
    changes = sorted(_changes(test, model, now), key=lambda c: c.misfit + 0.1 * c.free * noise / max(N, 1))
    changes = [c for c in changes if _supported(c, now)]
    if not changes:
        return None
    best, J = changes[0], float(np.sum(1 - now))
    unit = max(best.misfit, noise, 1e-9) / max(
        N - best.free, 1
    )  # what chance, or an error spread over all sensors, adds
    simpler = [c for c in changes[1:] if c.free < best.free and c.misfit - best.misfit < _UNIQUE * unit]
    best = _turned(min(simpler, key=lambda c: c.free, default=best), changes)
    rivals = [c.misfit for c in changes if c is not best and c.free <= best.free and c.sensors != best.sensors]
    clear = J - best.misfit > _CLEAR * unit * best.free and best.misfit < _HALF * J
    return best if clear and min(rivals, default=np.inf) - best.misfit > _UNIQUE * unit else None


def _turned(best: _Change, changes: list[_Change]) -> _Change:
    """The sensor turned round where it reads about -1 times what it should: likelier than a gain that happens to be that."""
    if not -_USUAL < best.gain < -1 / _USUAL:
        return best
    return next((c for c in changes if c.kind == REVERSED and c.sensors == best.sensors), best)


def _supported(change: _Change, now: np.ndarray) -> bool:
    """Whether at least two modes gain by the change and none loses."""
    gained = change.macs - now
    return bool(np.sum(gained > 0.1 * gained.max(initial=0.0)) >= 2 and gained.max() > 0 and gained.min() > -_WORSE)


def _macs(test: np.ndarray, model: np.ndarray) -> np.ndarray:
    """MAC (a,) of each pair."""
    return mac(test, np.where(np.isfinite(test), model, 0.0)).diagonal() if test.shape[1] else np.zeros(0)


def _changes(test: np.ndarray, model: np.ndarray, now: np.ndarray) -> Iterator[_Change]:
    """Every single fault that could be mended."""
    t = np.nan_to_num(test)
    x = np.where(np.isfinite(test), model, 0.0)
    size = np.sqrt(np.sum(t**2, axis=0) * np.sum(x**2, axis=0))
    size = np.where(size > 0, size, np.inf)
    t, x = t / np.linalg.norm(t, axis=0), x / np.where(np.isfinite(size), np.linalg.norm(x, axis=0), 1.0)
    product = t * x
    c = product.sum(axis=0)
    moving = np.flatnonzero(np.abs(product).max(axis=1) > 0)
    for k in moving:
        yield _Change(REVERSED, (int(k),), (c - 2 * product[k]) ** 2, 1, -1.0)
        rest_x, rest_c = 1 - x[k] ** 2, c - product[k]
        predicted = x[k] * rest_c / np.maximum(rest_x, 1e-12)
        gain = float(predicted @ t[k] / max(float(predicted @ predicted), 1e-300))
        rest_t = 1 - t[k] ** 2
        without = rest_c**2 / np.maximum(rest_t * rest_x, 1e-12)
        if abs(gain) > _DEAD and not 1 / _USUAL < gain < _USUAL:
            mended = (rest_c + product[k] / gain) ** 2 / np.maximum(rest_t + (t[k] / gain) ** 2, 1e-12)
            yield _Change(GAIN, (int(k),), mended, 2, gain)
        yield _Change(STRANGE, (int(k),), np.minimum(without, 1.0), t.shape[1], gain)
    whole = [k for k in moving if np.isfinite(test[k]).all()]
    for i, k in enumerate(whole):
        for other in whole[i + 1 :]:
            swapped = (c + (x[k] - x[other]) * (t[other] - t[k])) ** 2
            yield _Change(SWAPPED, (int(k), int(other)), swapped, 1)


def _mended(test: np.ndarray, change: _Change) -> np.ndarray:
    """The shapes without the fault."""
    test, rows = test.copy(), list(change.sensors)
    if change.kind == SWAPPED:
        test[rows] = test[rows[::-1]]
    elif change.kind == STRANGE:
        test[rows] = np.nan
    else:
        test[rows] /= change.gain
    return test
