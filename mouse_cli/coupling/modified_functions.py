"""Frequency response functions before and after changes, with the variance that the parameters give them: var = |dH/dtheta
L|^2, S = L L'."""

import numpy as np

from mouse_cli.coupling.parts import model_of
from mouse_cli.coupling.peaks import peaks
from mouse_cli.dynamics.frf import Dynamics, FrfModel
from mouse_cli.dynamics.frf_slopes import Change, slopes
from mouse_cli.dynamics.solver import Notice
from mouse_cli.estimators.linear import in_prior_units
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.coupling import Modification
from mouse_cli.model.frf_test import KINDS, FrfTest
from mouse_cli.model.modified import ModifiedFunctions
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import assembly as assemble
from mouse_cli.updating.coordinates import coordinates

_ROOM = 2_000_000  # complex numbers of derivatives held at once


def modified_functions(
    modification: Modification, before: Problem, after: Problem, notice: Notice = lambda text: None
) -> ModifiedFunctions:
    """The functions that the deck asks for, of both models."""
    hz = modification.lines.frequency_hz
    power = KINDS[modification.kind]
    hz = hz[hz > 0] if power else hz
    old, _ = _functions(modification, before, hz, notice)
    new, sd_log = _functions(modification, after, hz, notice)
    return ModifiedFunctions(old, new, sd_log, peaks(old), peaks(new))


def _functions(
    modification: Modification, problem: Problem, hz: np.ndarray, notice: Notice
) -> tuple[FrfTest, np.ndarray]:
    """Functions with their variance, and standard deviations (f, o, i) of the logarithm of their magnitudes."""
    assembly, theta, s = assemble(problem), problem.prior.mean, 2j * np.pi * hz
    places = [list(modification.responses), list(modification.forces)]
    weights = _wide(modification.part.weights, problem.structure.n)
    dynamics = Dynamics(*assembly.matrices(theta), *assembly.damping(theta))
    model = model_of(dynamics, tuple(weights[at] for at in places), s, notice)
    change = Change(assembly.n, assembly.p, assembly.slopes(theta))
    H, variance, sd_log = _solved(model, s, change, coordinates(problem, assembly))
    factor = (s ** KINDS[modification.kind])[:, None, None]
    names = [tuple(modification.part.places[i] for i in at) for at in places]
    test = FrfTest(
        hz, H * factor, modification.kind, np.arange(len(names[0])), np.arange(len(names[1])), variance * np.abs(factor) ** 2,
        *names, title=modification.title, path=modification.path,
    )  # fmt: skip
    return test, sd_log


def _solved(model: FrfModel, s: np.ndarray, change: Change, prior) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Receptance, variance, and sd of ln|H|, some lines at a time."""
    slope, parts = prior.slope(prior.mean), []
    each = max(1, _ROOM // (model.d * model.loads.shape[1] + model.loads.shape[1] ** 2 * max(change.p, 1)))
    for first in range(0, len(s), each):
        fields = model.at(s[first : first + each])
        H = fields.receptance()
        J = np.zeros((*H.shape, max(change.p, 1)), complex)
        if change.p:
            for part, values in slopes(fields, change):
                J[..., part] = values
            J = in_prior_units((J * slope).reshape(-1, change.p), prior.L).reshape(*H.shape, -1)
        with np.errstate(divide="ignore", invalid="ignore"):
            relative = (J / H[..., None]).real
        parts.append((H, (np.abs(J) ** 2).sum(axis=-1), np.sqrt((relative**2).sum(axis=-1))))
    return tuple(np.concatenate(column) for column in zip(*parts, strict=True))


def _wide(weights: Matrix, n: int) -> Matrix:
    """Rows of the places over the degrees of freedom of the modified model, absorbers among them."""
    found = weights.copy()
    found.resize((weights.shape[0], n))
    return found
