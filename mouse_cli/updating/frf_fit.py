"""What the frequency response functions say at the beginning and at the end of a run."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.dynamics.frf_slopes import Change
from mouse_cli.model.frf_fit import FrfFit, Modelled
from mouse_cli.observables.frf import FrfObservable, accuracy, usable
from mouse_cli.updating.frf_state import FrfState
from mouse_cli.updating.state import State

_MOST = 40_000_000  # derivatives of all functions at all lines by all parameters, above which bands are left out
_LINES = 256  # worked on at once


@dataclass(frozen=True)
class Fits:
    """Fields of a Result: one for each measurement, fitted and held out."""

    frf: tuple[FrfFit, ...] = ()
    held_frf: tuple[FrfFit, ...] = ()


def fits(start: State, end: State, prior_root: np.ndarray, root: Callable[[], np.ndarray]) -> Fits:
    """What both models say of all measurements; roots (p, k) of the covariances of u before and after."""
    if start.frf is None:
        return Fits()
    found, fitted = tuple(_fits(start, end, prior_root, root())), len(start.frf.setting.observables)
    return Fits(found[:fitted], found[fitted:])


def _fits(start: State, end: State, prior_root: np.ndarray, root: np.ndarray) -> Iterator[FrfFit]:
    setting = start.frf.setting
    parts = zip(setting.everything, start.frf.everywhere(), end.frf.everywhere(), strict=True)
    for k, (o, before, after) in enumerate(parts):
        sd, assumed = accuracy(o.test)
        models = (
            Modelled("prior", "prior", before, _sd(start, k, o, prior_root)),
            Modelled("revised", "revised", after, _sd(end, k, o, root)),
        )
        yield FrfFit(
            test=o.test,
            form=o.form,
            lines=o.lines if k < len(setting.observables) else np.zeros(0, int),
            have=usable(o.test, sd, "log"),
            sd=sd,
            assumed=assumed,
            models=models,
            basis=0 if end.frf.model.V is None else end.frf.model.d,
            basis_error=end.frf.model.error,
        )


def _sd(state: State, k: int, o: FrfObservable, root: np.ndarray) -> np.ndarray:
    """Standard deviations (f, o, i) of ln|H| at all lines of measurement k."""
    out, p = np.full(o.test.H.shape, np.nan), len(state.u)
    if o.test.H.size * p > _MOST:
        return out
    setting, frf = state.setting, state.frf
    change = setting.change(state.theta)
    slope = setting.coordinates.slope(state.u)
    for first in range(0, len(out), _LINES):
        at = slice(first, first + _LINES)
        lines = np.arange(len(out))[at]
        out[at] = _of_lines(frf, k, replace(o, lines=lines, width=0.0), change, slope[:, None] * root)
    return out


def _of_lines(frf: FrfState, k: int, o: FrfObservable, change: Change, root: np.ndarray) -> np.ndarray:
    fields = frf.model.at(o.nodes)
    alpha = frf.read(k, fields)
    with np.errstate(divide="ignore", invalid="ignore"):
        H = o.expected(alpha)
        T = np.empty((*H.shape, change.p))
        for part, values in frf.slopes(k, fields, change, alpha):
            T[..., part] = (o.expected(values) / H[..., None]).real
        return np.linalg.norm(T @ root, axis=-1)
