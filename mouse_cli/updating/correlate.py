"""The test beside the prior model, before anything is revised: which modes are the same, how alike, and what does not fit."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from mouse_cli._errors import Diagnostic
from mouse_cli.dynamics import condensation
from mouse_cli.dynamics.correlation import (
    ANY_FREQUENCY,
    comac,
    distance,
    ecomac,
    mac,
    match,
    scale_factors,
    subspace_cosines,
)
from mouse_cli.dynamics.eigen import EigenSolution, IndefiniteError, clusters
from mouse_cli.dynamics.sensor_faults import sensor_faults
from mouse_cli.dynamics.solver import EigenSolver, Notice
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.correlation import ALONE, Correlation, Orthogonality, Subspace
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem
from mouse_cli.observables.modal import ModalObservable
from mouse_cli.terms.assembly import assembly as assemble
from mouse_cli.updating import refusals
from mouse_cli.updating.correlation_remarks import orthogonality_refused, remarks
from mouse_cli.updating.expand import expanded
from mouse_cli.updating.state import aligned, reference_eigenvalue, solve

_BEYOND = 1.3  # model modes are sought up to so many times the highest measured frequency
_EDGE = 0.05  # a model mode so far outside the band of the test is no business of the test
_CLOSE = 0.03  # modes nearer than this, relative, are compared as a subspace too
_LOOSE = 1.2  # distance up to which pairs may speak of faulty sensors: those faults drive modes apart


@dataclass(frozen=True)
class _Sides:
    """Test and model once their modes are paired: hz (n,), zero for rigid modes; apart (m, n) distances; modes (m,) partners.

    shaped (m,): mask of the modes with a measured shape; k: how many model modes are compared; seen (s, k): their shapes.
    """

    problem: Problem
    K: Matrix
    M: Matrix
    solution: EigenSolution
    rigid: int
    hz: np.ndarray
    apart: np.ndarray
    modes: np.ndarray
    shaped: np.ndarray
    k: int
    seen: np.ndarray

    @property
    def basis(self) -> np.ndarray:
        """Model modes by which the test may be described: the paired ones, then the others, rigid last, at most one a sensor."""
        paired, r = self.modes[self.modes != ALONE], min(self.rigid, self.k)
        others = [j for j in [*range(r, self.k), *range(r)] if j not in paired]
        return np.sort(np.concatenate([paired, others])[: self.problem.test.s]).astype(int)

    def pairs(self, modes: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Measured shapes, their sd, and the shapes of their partners `modes` (m,), each (s, pairs)."""
        test, kept = self.problem.test, np.flatnonzero((modes != ALONE) & self.shaped)
        return test.shapes[:, kept], test.shape_sd[:, kept], test.read(self.solution.shapes[:, modes[kept]])


def correlate(
    problem: Problem, method: str | None = None, exact: bool = False, notice: Notice = lambda text: None
) -> Correlation:
    """Compare the test of `problem` with its prior model; `method`: expand the measured shapes by that expansion.

    exact: measured components stay as they are where the method would smooth them. notice is called with a sentence as each
    phase of a large model begins. Raises DeckError for a deck without a test, NumericalError where no eigensolution, or no
    such expansion, exists.

    >>> import mouse_cli
    >>> found = mouse_cli.correlate(mouse_cli.read_deck("decks/cantilever.yaml"))
    >>> (found.modes + 1).tolist(), found.mac.diagonal().round(3).tolist()
    ([1, 2, 3], [1.0, 0.999, 0.998])
    """
    if problem.test is None:
        raise refusals.no_test(problem)
    K, M = assemble(problem).matrices(problem.prior.mean)
    try:
        sides = _sides(problem, K, M, *_modes(problem, K, M, EigenSolver(notice)))
    except (IndefiniteError, np.linalg.LinAlgError) as reason:
        raise refusals.unphysical(problem, str(reason)) from None
    found = _compared(sides)
    if method:
        shapes = expanded(problem, K, M, sides.solution, sides.modes, sides.basis, method, exact)
        found = replace(found, expanded=shapes)
    return remarks(found)


def _modes(problem: Problem, K: Matrix, M: Matrix, solver: EigenSolver) -> tuple[EigenSolution, int]:
    """The modes of the prior model up to somewhat above the band of the test, and how many of them are rigid."""
    test, n = problem.test, problem.structure.n
    highest = np.nanmax(np.append(test.frequency_hz, 0.0))
    count = min(int(test.number.max()) + 6, n)
    solution = solve(problem, K, M, count, solver)
    while (
        len(solution.eigenvalues) < n and solution.frequencies_hz[-1] < _BEYOND * highest and count < 20 * test.m + 100
    ):
        count = min(2 * count, n)
        solution = solve(problem, K, M, count, solver)
    return solution, solution.rigid(reference_eigenvalue(problem, solution.eigenvalues))


def _sides(problem: Problem, K: Matrix, M: Matrix, solution: EigenSolution, rigid: int) -> _Sides:
    """Modes paired, and model shapes of equal frequencies turned onto the measured ones."""
    test, shaped = problem.test, _shaped(problem.test)
    hz = solution.frequencies_hz.copy()
    hz[:rigid] = 0.0
    apart = distance(_likeness(test, solution, shaped), test.frequency_hz, hz, ANY_FREQUENCY)
    modes = match(apart)
    solution = _turned(problem, solution, modes, shaped)
    k = _shown(test, hz, modes)
    seen = test.read(solution.shapes[:, :k])
    return _Sides(problem, K, M, solution, rigid, hz, apart, modes, shaped, k, seen)


def _compared(sides: _Sides) -> Correlation:
    """All figures but expanded shapes."""
    problem, test, shaped, k, seen = sides.problem, sides.problem.test, sides.shaped, sides.k, sides.seen
    paired, hz = sides.modes != ALONE, sides.hz[:k]
    partner = test.read(sides.solution.shapes[:, np.where(paired, sides.modes, 0)])
    length = np.linalg.norm(seen, axis=0)
    one, _, other = sides.pairs(sides.modes)
    judged, refused = _orthogonality(sides)
    return Correlation(
        problem=problem,
        frequencies_hz=hz,
        rigid_modes=sides.rigid,
        visible=length / (length.max(initial=0.0) or 1.0) if test.s else np.full(k, np.nan),
        modes=sides.modes,
        unclaimed=_unclaimed(test, hz, sides.modes),
        mac=np.where(shaped[:, None], mac(test.shapes, seen), np.nan),
        auto_test=np.where(np.outer(shaped, shaped), mac(test.shapes, test.shapes), np.nan),
        auto_model=mac(seen, seen),
        scale_factor=np.where(paired & shaped, scale_factors(test.shapes, partner), np.nan),
        sensors=test.sensors or tuple(problem.structure.labels[dof] for dof in test.dofs),
        comac=comac(one, other),
        ecomac=ecomac(one, other),
        faults=tuple(sensor_faults(*sides.pairs(match(sides.apart, _LOOSE)))),
        orthogonality=judged,
        subspaces=tuple(_subspaces(test, hz, sides.modes, shaped, seen)),
        expanded=None,
        warnings=refused,
    )


def _shaped(test: ModalTest) -> np.ndarray:
    """Mask (m,) of the modes of which enough was measured to speak of a shape: two components."""
    return np.isfinite(test.shapes).sum(axis=0) >= 2


def _likeness(test: ModalTest, solution: EigenSolution, shaped: np.ndarray) -> np.ndarray:
    """MAC (m, k) of measured with model shapes, for equal model frequencies with all shapes that they span; NaN without shape."""
    seen = test.read(solution.shapes)
    likeness = np.where(shaped[:, None], mac(test.shapes, seen), np.nan)
    family = clusters(solution.eigenvalues, solution.zero)
    for cluster in np.flatnonzero(np.bincount(family) > 1):
        members = np.flatnonzero(family == cluster)
        for i in np.flatnonzero(shaped):
            share = subspace_cosines(test.shapes[:, [i]], seen[:, members])[0]
            likeness[i, members] = likeness[i, members] if np.isnan(share) else share
    return likeness


def _turned(problem: Problem, solution: EigenSolution, modes: np.ndarray, shaped: np.ndarray) -> EigenSolution:
    """The solution with shapes of equal frequencies turned onto the measured ones."""
    test, kept = problem.test, np.flatnonzero((modes != ALONE) & shaped)
    if not len(kept):
        return solution
    part = ModalTest(
        test.number[kept],
        test.frequency_hz[kept],
        test.frequency_sd_hz[kept],
        test.dofs,
        test.shapes[:, kept],
        test.shape_sd[:, kept],
        test.scale,
        test.sensing,
        test.sensors,
    )
    unscaled = ModalObservable(part, part.shapes, part.shape_sd, np.ones(part.m), np.eye(part.s))
    return aligned(solution, modes[kept], unscaled)


def _shown(test: ModalTest, hz: np.ndarray, modes: np.ndarray) -> int:
    """How many model modes are compared: those in the band of the test, the paired ones, and one above."""
    highest = np.nanmax(np.append(test.frequency_hz, 0.0)) * (1 + _EDGE)
    return min(len(hz), max(int(np.sum(hz <= highest)), int(modes.max(initial=0)) + 1) + 1)


def _unclaimed(test: ModalTest, hz: np.ndarray, modes: np.ndarray) -> np.ndarray:
    """Model modes within the band of the test that no measured mode claims."""
    known = test.frequency_hz[np.isfinite(test.frequency_hz)]
    if not len(known):
        return np.zeros(0, int)
    inside = (hz >= known.min() * (1 - _EDGE)) & (hz <= known.max() * (1 + _EDGE))
    inside[modes[modes != ALONE]] = False
    return np.flatnonzero(inside)


def _orthogonality(sides: _Sides) -> tuple[tuple[Orthogonality, ...], tuple[Diagnostic, ...]]:
    """Measured and model shapes with the mass matrix reduced statically, and by modes of the model."""
    test, solution, basis, seen = sides.problem.test, sides.solution, sides.basis, sides.seen
    if test.s < 2 or not len(basis):
        return (), ()
    found, refused = [], ()
    try:
        reduced = condensation.static(sides.K, sides.M, test.measured_at)
        found.append(_judged(test, "static", "mass matrix reduced statically (Guyan)", reduced.M, seen))
    except condensation.LooseError as reason:
        refused = (orthogonality_refused(str(reason)),)
    reduced = condensation.modal(solution.eigenvalues[basis], test.read(solution.shapes[:, basis]))
    title = f"mass matrix reduced by {len(basis)} model modes (SEREP)"
    found.append(_judged(test, "modal", title, reduced.M, seen))
    return tuple(found), refused


def _judged(test: ModalTest, key: str, title: str, mass: np.ndarray, seen: np.ndarray) -> Orthogonality:
    product = condensation.orthogonality
    return Orthogonality(
        key,
        title,
        product(test.shapes, test.shapes, mass),
        condensation.sd_orthogonality(test.shapes, test.shape_sd, mass),
        product(test.shapes, seen, mass),
        product(seen, seen, mass),
    )


def _subspaces(test: ModalTest, hz: np.ndarray, modes: np.ndarray, shaped: np.ndarray, seen: np.ndarray):
    """Groups of close modes, on either side, that belong together by their pairs."""
    m, pairs = test.m, [(i, int(modes[i])) for i in np.flatnonzero((modes != ALONE) & shaped)]
    group = np.arange(m + len(hz))
    links = [(i, m + j) for i, j in pairs]
    links += [(i, j) for i, j in _neighbours(np.where(shaped, test.frequency_hz, np.nan))]
    links += [(m + i, m + j) for i, j in _neighbours(np.where(hz > 0, hz, np.nan))]
    for a, b in links:
        group[group == group[b]] = group[a]
    for name in dict.fromkeys(group[i] for i, _ in pairs):
        members = np.flatnonzero(group == name)
        ours, theirs = members[members < m], members[members >= m] - m
        if len(ours) > 1 or len(theirs) > 1:
            cosines = subspace_cosines(test.shapes[:, ours], seen[:, theirs])
            yield Subspace(tuple(map(int, ours)), tuple(map(int, theirs)), cosines)


def _neighbours(hz: np.ndarray) -> list[tuple[int, int]]:
    """Pairs of modes next to each other in frequency that are close."""
    order = [int(i) for i in np.argsort(hz, kind="stable") if np.isfinite(hz[i])]
    return [(a, b) for a, b in pairwise(order) if hz[b] - hz[a] <= _CLOSE * hz[b]]
