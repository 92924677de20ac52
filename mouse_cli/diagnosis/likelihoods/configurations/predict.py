"""Arrangements that no fit has seen, predicted by what was fitted to the others, errors of theory that all share included.

With unknowns (x, e), e the shared errors, their derivatives A = [T, U] of the fitted data and B = [T_h, U_h] of those held out, and
the covariance P = (A'A + prior)^-1 of the fit,

    r_h - B P A'r ~ N(0, I + B P B')
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.configurations.model import Arranged, Together, common
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.model.arrangements import SharedError
from mouse_cli.model.diagnosis import Score
from mouse_cli.updating.chi_square import upper_tail

_COVERED = 1.6448536269514722  # standard deviations of a 90 % interval


@dataclass(frozen=True)
class Known:
    """What a fit knows of its unknowns and of the shared errors of `modes` (m,): mean and covariance of (x - x_fit, e)."""

    modes: np.ndarray
    mean: np.ndarray
    covariance: np.ndarray


def known(one: Fit, further: np.ndarray) -> Known:
    """What a fit of arrangements knows, of its modes and of the numbers `further` besides."""
    model, at, base = one.model, one.point, one.model.base
    own = np.unique(np.concatenate([part.data.test.number for part in base.parts]))
    modes = np.union1d(own, further)
    A = np.hstack([model.slopes(at), np.vstack([common(part, modes, base.common_sd) for part in base.parts])])
    residual = np.concatenate([point.residual for point in at.points])
    prior = np.concatenate([np.ones(model.k), 2 * np.pi / model.width**2, np.ones(len(modes))])
    held = np.zeros(len(prior))
    held[: model.k] = at.x[: model.k]
    covariance = np.linalg.inv(A.T @ A + np.diag(prior))
    return Known(modes, covariance @ (A.T @ residual - held), covariance)


def shared_errors(one: Fit) -> tuple[SharedError, ...]:
    """What theory errs in each mode, as far as a fit tells."""
    found, tau = known(one, np.zeros(0, int)), one.model.base.common_sd
    first = len(found.mean) - len(found.modes)
    sd = np.sqrt(np.diag(found.covariance))[first:]
    parts = zip(found.modes, found.mean[first:], sd, strict=True)
    return tuple(SharedError(int(mode), float(tau * value), float(tau * width)) for mode, value, width in parts)


def predicted(one: Fit, held: Arranged) -> Score | None:
    """How a fit predicts the arrangements `held`; None where its causes have no place, or are not physical there."""
    there = held.at(one.model.base.theta)
    recipes = tuple(there.like(recipe) for recipe in one.recipes)
    model = None if None in recipes else Together(there, recipes)
    at = model and model.point(one.point.x)
    if at is None:
        return None
    tests = [part.data.test for part in held.parts]
    about = known(one, np.unique(np.concatenate([test.number for test in tests])))
    own = [common(part, about.modes, held.common_sd) for part in held.parts]
    B = np.hstack([model.slopes(at), np.vstack(own)])
    left = np.concatenate([point.residual for point in at.points]) - B @ about.mean
    total = np.eye(len(left)) + B @ about.covariance @ B.T
    misfit = float(left @ np.linalg.solve(total, left))
    density = -0.5 * (misfit + np.linalg.slogdet(total)[1])
    density -= sum(part.data.log_sd for part in held.parts)
    rows = np.concatenate([_of_frequencies(part) for part in held.parts])
    off, sd = left[rows], np.sqrt(np.diag(total)[rows])
    measured = np.concatenate([test.frequency_hz[np.isfinite(test.frequency_hz)] for test in tests])
    stated = np.concatenate([part.data.sd_log[part.data.has_frequency] for part in held.parts])
    hz = measured * np.exp(-off * stated)
    return Score(
        rms_frequency_error=float(np.sqrt(np.mean((hz / measured - 1) ** 2))),
        log_predictive_density=float(density),
        covered=float(np.mean(np.abs(off) < _COVERED * sd)),
        frequencies_hz=hz,
        sd_hz=hz * stated * sd,
        mac=np.full(len(hz), np.nan),
        p=upper_tail(misfit, len(left)),
    )


def _of_frequencies(part) -> np.ndarray:
    """Mask of the data of one arrangement that are frequencies."""
    data = part.data
    count = int(data.has_frequency.sum())
    return np.arange(count + int(data.has_shape.sum())) < count
