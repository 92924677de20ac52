"""Arrangements that no fit has seen, predicted by what was fitted to the others, errors of theory that all share included.

With unknowns (x, e), e the shared errors, their derivatives A = [T, U] of the fitted data and B = [T_h, U_h] of those held out, and
the covariance P = (A'A + prior)^-1 of the fit,

    r_h - B P A'r ~ N(0, I + B P B')
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.configurations.model import Arranged, Points, Together
from mouse_cli.diagnosis.likelihoods.configurations.shared import Errors, Modes
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.model.arrangements import SharedError
from mouse_cli.model.diagnosis import Score
from mouse_cli.updating.chi_square import upper_tail

_COVERED = 1.6448536269514722  # standard deviations of a 90 % interval


@dataclass(frozen=True)
class Known:
    """What a fit knows of its unknowns and of the errors that are shared, the first of frequencies of `modes` (n,): mean and
    covariance of (x - x_fit, e). U: see `shared`, of arrangements that it did not see.
    """

    modes: np.ndarray
    mean: np.ndarray
    covariance: np.ndarray
    U: list[np.ndarray]


def known(one: Fit, further: tuple[Modes, ...] = ()) -> Known:
    """What a fit of arrangements knows, of its errors and of those of `further` arrangements."""
    model, at, base = one.model, one.point, one.model.base
    errors, own = Errors((*(model.modes(at) or base.errors.modes), *further), base.common_sd), len(base.parts)
    U = errors.U
    A = np.hstack([model.slopes(at), np.vstack(U[:own])])
    residual = np.concatenate([point.residual for point in at.points])
    prior = np.concatenate([np.ones(model.k), 2 * np.pi / model.width**2, np.ones(U[0].shape[1])])
    held = np.zeros(len(prior))
    held[: model.k] = at.x[: model.k]
    covariance = np.linalg.inv(A.T @ A + np.diag(prior))
    return Known(errors.numbers, covariance @ (A.T @ residual - held), covariance, U[own:])


def shared_errors(one: Fit) -> tuple[SharedError, ...]:
    """What theory errs in each mode, as far as a fit tells."""
    found, tau, first = known(one), one.model.base.common_sd, len(one.point.x)
    sd = np.sqrt(np.diag(found.covariance))
    parts = zip(found.modes, found.mean[first:], sd[first:], strict=False)
    return tuple(SharedError(int(mode), float(tau * value), float(tau * width)) for mode, value, width in parts)


def placed(one: Fit, others: Arranged) -> tuple[Together, Points] | None:
    """Other arrangements with the causes of a fit, where it has them; None where they have no place, or are not physical."""
    there = others.at(one.model.base.theta)
    recipes = tuple(there.like(recipe) for recipe in one.recipes)
    model = None if None in recipes else Together(there, recipes)
    at = model and model.point(one.point.x)
    return None if at is None else (model, at)


def predicted(one: Fit, held: Arranged) -> Score | None:
    """How a fit predicts the arrangements `held`; None where it has no place in them."""
    there = placed(one, held)
    if there is None:
        return None
    model, at = there
    tests = [part.data.test for part in held.parts]
    about = known(one, model.modes(at) or held.errors.modes)
    B = np.hstack([model.slopes(at), np.vstack(about.U)])
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
