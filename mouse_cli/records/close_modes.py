"""Whether what a fit leaves near a mode looks like a second one within its bandwidth.

Two poles much closer than a bandwidth have, but for terms of second order, R_1 / (s - lambda) + R_2 / (s - lambda)^2. A fit with
one pole finds R_1, and of R_2 only what has the shape of the mode. Errors that 1 / (s - lambda)^2 explains, each channel by a
number of its own, are a second shape; where the structure is not linear, or drifted during the test, they look alike.
"""

import numpy as np

from mouse_cli.records.identify_frf import Found
from mouse_cli.records.modal_model import partial_fractions, synthesised

_REACH = 3.0  # half-power bandwidths to either side
_LEAST = 10  # lines there
_CHANCE = 1e-4  # at most, that noise alone makes it


def beside(found: Found) -> np.ndarray:
    """Mask (m,) of the modes of a fit beside which another one seems to be.

    F, the mean square that the term explains over that which is left, is compared with that of a single independent channel (errors
    of a force are common to all), P(F) = e^-F, and with neighbouring lines correlated as the fit shows them.
    """
    model, lines = found.fit.model, found.lines
    errors = np.where(np.isfinite(lines.sd), (lines.H - synthesised(lines, model)) / lines.sd, 0)
    alike = max(1.0, 1 + 2 * float(np.real(found.errors.rho[1:]).sum()))
    limit = np.log(max(model.m, 1) / _CHANCE) * alike
    return np.array([_ratio(found, errors, pole) > limit for pole in model.poles], bool)


def _ratio(found: Found, errors: np.ndarray, pole: complex) -> float:
    """F near one pole, for errors (f, o, i) over their sd; 0 for too few lines."""
    lines = found.lines
    near = np.abs(lines.s.imag - pole.imag) < _REACH * 2 * -pole.real
    if near.sum() < _LEAST:
        return 0.0
    s, one = lines.s[near], np.array([pole])
    once, twice = (partial_fractions(s, lines.kind, one, power)[0][:, 0] for power in (1, 2))
    away = (s - s.mean()) / np.abs(s - s.mean()).max()
    explained, left = 0.0, 0.0
    for o, i in np.ndindex(errors.shape[1:]):
        weight = 1 / lines.sd[near, o, i]
        columns = np.stack([once, np.ones(len(s)), away, twice], axis=1) * weight[:, None]
        columns = columns[:, np.abs(columns).max(axis=0) > 0]
        if columns.shape[1] < 4:
            continue
        Q, _ = np.linalg.qr(columns / np.linalg.norm(columns, axis=0))
        parts = Q.conj().T @ errors[near, o, i]
        explained += abs(parts[-1]) ** 2
        left += (np.linalg.norm(errors[near, o, i]) ** 2 - np.linalg.norm(parts) ** 2) / (len(s) - 4)
    return explained / left if left > 0 else 0.0
