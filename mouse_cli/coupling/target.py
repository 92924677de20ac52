"""Which mass or spring moves a mode to a frequency (lecture 22: a mass or spring at one point, used backwards).

With alpha the undamped receptance at the place, the modified structure resonates at omega where 1 + z alpha = 0:

    mass       1 - omega^2 m alpha(omega) = 0        m = 1 / (omega^2 alpha(omega))
    spring     1 + k alpha(omega) = 0                k = -1 / alpha(omega)

A change of rank one moves each frequency at most to its neighbour (Weyl): mass lowers mode i down to the (i-1)th frequency of the
structure with the place held, a spring raises it up to the ith. To first order sd(m) = omega^2 m^2 sd(alpha).
"""

import numpy as np

from mouse_cli.coupling.changed import changed
from mouse_cli.coupling.receptance import Receptance
from mouse_cli.coupling.whole import kernel
from mouse_cli.dynamics.eigen import IndefiniteError
from mouse_cli.dynamics.frequency import eigenvalue, frequency_hz, sd_frequency_hz
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.coupling import ABOVE, BELOW, EXACTLY, MASS, Connection, Modification, Point, Target
from mouse_cli.model.modified import Need
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import Forecast
from mouse_cli.terms.assembly import assembly as assemble

_SHOWN = 12  # places of a target without one that are looked at in full
_SIDES = {
    90: 1.281552,
    95: 1.644854,
    99: 2.326348,
}  # standard deviations by which one side is met at a confidence level
# Likeness below which the mode that comes to the frequency is called another, and its place is passed over
_LIKE = 0.25
_STEPS = 4  # towards what meets a target for sure
_MET = 1e-6  # relative, to which the modified model must have the frequency that was asked for


def needs(modification: Modification, problem: Problem, after: Forecast) -> tuple[Need, ...]:
    """The answers to all targets, place by place, about the model with the changes of the deck."""
    found: list[Need] = []
    for target in modification.targets:
        known = Receptance(problem)
        weights, names = known.places(
            modification, [target.place] if target.place is not None else [], target.mode - 1, after
        )
        found += _needs(target, known, weights, names, after)
    return tuple(found)


def _needs(target: Target, known: Receptance, weights: Matrix, names: tuple[str, ...], after: Forecast) -> list[Need]:
    """One target at every place; the smallest first where it names none."""
    lam, goal = eigenvalue(after.frequencies_hz), float(eigenvalue(target.hz))
    now = float(after.frequencies_hz[target.mode - 1])
    if (target.side == BELOW and now <= target.hz) or (target.side == ABOVE and now >= target.hz):
        reason = f"mode {target.mode} lies at {now:.6g} Hz as it is"
        return [Need(target, "", 0.0, 0.0, 0.0, now, np.nan, 1.0, reason)]
    value, _, _, likeness = _values(target, known, goal, weights, after)
    possible = _possible(target, lam, goal, value) & (likeness >= _LIKE)
    order = np.argsort(np.where(possible, np.abs(value), np.inf), kind="stable")
    if target.place is None:
        order = order[possible[order]][:_SHOWN]
    found = [_checked(target, known, weights[[i]], names[i], after) for i in order]
    return found or [Need(target, "", *(np.nan,) * 6, "no single location suffices")]


def _values(
    target: Target, known: Receptance, goal: float, weights: Matrix, after: Forecast
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """What puts an eigenvalue at `goal` at each place, its sd, the sd of the frequency with that in place, Hz, and the
    likeness of the mode there, u = (K - goal M)^-1 w, with the mode asked for: (x'Mu)^2 / u'Mu = (x'w / (lambda - goal))^2 /
    u'Mu; (P,) each."""
    own = weights @ after.shapes[:, target.mode - 1] / (eigenvalue(after.frequencies_hz[target.mode - 1]) - goal)
    alpha, sd, mass = known.at(goal, weights)
    with np.errstate(divide="ignore", invalid="ignore"):
        value = 1 / (goal * alpha) if target.means == MASS else -1 / alpha
        spread = value**2 * sd * (goal if target.means == MASS else 1.0)
        modal = mass + value * alpha**2 if target.means == MASS else mass
        return value, spread, sd_frequency_hz(frequency_hz(goal), sd / modal), own**2 / mass


def _sure(target: Target, known: Receptance, w: Matrix, after: Forecast, sd_hz: float) -> float:
    """With which the mode lies on the right side by so many of its standard deviations as the confidence level asks; NaN:
    nothing does."""
    if target.side == EXACTLY:
        return np.nan
    times = _SIDES[known.problem.run.confidence] * (-1 if target.side == BELOW else 1)
    value = np.nan
    for _ in range(_STEPS):
        hz = target.hz + times * sd_hz
        if hz <= 0:
            return np.nan
        goal = float(eigenvalue(hz))
        found, _, sd, _ = _values(target, known, goal, w, after)
        if not _possible(target, eigenvalue(after.frequencies_hz), goal, found)[0]:
            return np.nan
        value, sd_hz = float(found[0]), float(sd[0])
    return value


def _possible(target: Target, lam: np.ndarray, goal: float, value: np.ndarray) -> np.ndarray:
    """Whether each value puts that very mode there: a change of rank one moves no mode past its neighbour."""
    below = int(np.count_nonzero(lam < goal))
    raising = value < 0 if target.means == MASS else value > 0
    return np.isfinite(value) & np.where(raising, below == target.mode, below == target.mode - 1)


def _checked(target: Target, known: Receptance, w: Matrix, name: str, after: Forecast) -> Need:
    """The need at one place, the mode of the modified model found anew, and how far the mode could be moved there."""
    limit = _limit(target, known, w)
    goal = float(eigenvalue(target.hz))
    found = _values(target, known, goal, w, after)
    value, sd, sd_hz, likeness = (float(each[0]) for each in found)
    if _possible(target, eigenvalue(after.frequencies_hz), goal, found[0])[0]:
        one = Connection("", Point(0, 0), **{"mass" if target.means == MASS else "stiffness": value})
        try:
            K, M = assemble(changed(known.problem, (one,), w)).matrices(known.problem.prior.mean)
            reached = float(EigenSolver().solve(K, M, target.mode + 1).frequencies_hz[target.mode - 1])
        except (IndefiniteError, np.linalg.LinAlgError):
            reached = np.nan
        if abs(reached / target.hz - 1) <= _MET:
            return Need(target, name, value, sd, _sure(target, known, w, after, sd_hz), reached, limit, likeness)
        return Need(target, name, np.nan, np.nan, np.nan, reached, limit, likeness, "there is not so much to take away")
    return Need(target, name, np.nan, np.nan, np.nan, np.nan, limit, np.nan, _why(target, limit))


def _why(target: Target, limit: float) -> str:
    what = "mass" if target.means == MASS else "spring to the ground"
    return f"whatever {what} is added there, mode {target.mode} stays {'above' if target.means == MASS else 'below'} {limit:.6g} Hz"


def _limit(target: Target, known: Receptance, w: Matrix) -> float:
    """Frequency of the structure with the place held that mode i comes to under an infinite mass (i - 1) or spring (i)."""
    K, M = known.matrices
    L = kernel(w)
    held = [L.T @ (each @ L) for each in (K, M)]
    held = [each.tocsr() if is_sparse(each) else each for each in held]
    which = target.mode - 1 if target.means == MASS else target.mode
    if which < 1:
        return 0.0
    if which > L.shape[1]:
        return np.inf
    return float(frequency_hz(EigenSolver().solve(*held, which).eigenvalues[which - 1]))
