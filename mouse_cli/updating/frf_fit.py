"""What the frequency response functions say at the beginning and at the end of a run."""

from collections.abc import Callable

import numpy as np

from mouse_cli.dynamics.frf_slopes import Change
from mouse_cli.model.frf_fit import FrfFit
from mouse_cli.observables.frf import FrfObservable, accuracy, usable
from mouse_cli.updating.frf_state import FrfState
from mouse_cli.updating.state import State

_MOST = 40_000_000  # derivatives of all functions at all lines by all parameters, above which bands are left out
_LINES = 256  # worked on at once


def fits(start: State, end: State, prior_root: np.ndarray, root: Callable[[], np.ndarray]) -> tuple[FrfFit, ...]:
    """One for each measurement; roots (p, k) of the covariances of u before and after."""
    if start.frf is None:
        return ()
    before, after = list(start.frf.everywhere()), list(end.frf.everywhere())
    found = []
    for k, o in enumerate(start.frf.setting.observables):
        sd, assumed = accuracy(o.test)
        found.append(
            FrfFit(
                test=o.test,
                form=o.form,
                lines=o.lines,
                have=usable(o.test, sd, "log"),
                sd=sd,
                assumed=assumed,
                prior=before[k],
                revised=after[k],
                prior_sd=_sd(start, k, o, prior_root),
                revised_sd=_sd(end, k, o, root()),
                basis=0 if end.frf.model.V is None else end.frf.model.d,
                basis_error=end.frf.model.error,
            )
        )
    return tuple(found)


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
        out[at] = _of_lines(frf, k, 1j * o.test.omega[at], change, slope[:, None] * root)
    return out


def _of_lines(frf: FrfState, k: int, s: np.ndarray, change: Change, root: np.ndarray) -> np.ndarray:
    fields = frf.model.at(s)
    alpha = fields.receptance(2 * k, 2 * k + 1)
    T = np.empty((*alpha.shape, change.p))
    with np.errstate(divide="ignore", invalid="ignore"):
        for part, values in fields.slopes(change, 2 * k, 2 * k + 1):
            T[..., part] = (values / alpha[..., None]).real
        return np.linalg.norm(T @ root, axis=-1)
