"""Undamped receptances alpha_p(lambda) = w_p' (K - lambda M)^-1 w_p of many places of one model at one frequency, and their
accuracy."""

import numpy as np

from mouse_cli.dynamics.condensation import LooseError, bordered
from mouse_cli.dynamics.frf_slopes import Change
from mouse_cli.estimators.linear import in_prior_units
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.coupling import Modification
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import Forecast
from mouse_cli.terms.assembly import assembly as assemble
from mouse_cli.updating.coordinates import coordinates

_MOST, _AT_ONCE = 2000, 200  # places that are tried, and solved for at once


class Receptance:
    """Of the model of `problem` at its prior mean."""

    def __init__(self, problem: Problem):
        self.problem, self.assembly = problem, assemble(problem)
        theta = problem.prior.mean
        self.matrices = self.assembly.matrices(theta)
        self._change = Change(self.assembly.n, self.assembly.p, self.assembly.slopes(theta))
        self._prior = coordinates(problem, self.assembly)

    def places(
        self, modification: Modification, wanted: list[int], mode: int, after: Forecast
    ) -> tuple[Matrix, tuple[str, ...]]:
        """Weights (P, n) and names (P,) of the places wanted; without any, those of the deck; else every one that translates,
        of very many those that move most in `mode`."""
        from scipy.sparse import csr_array

        n, chosen = self.assembly.n, wanted or list(modification.candidates)
        if chosen:
            weights = modification.part.weights[chosen].copy()
            weights.resize((len(chosen), n))
            return weights, tuple(modification.part.places[i] for i in chosen)
        structure = modification.problem.structure
        geometry = structure.geometry
        dofs = np.arange(structure.n)
        if geometry is not None and (geometry.direction < 3).any():
            dofs = dofs[geometry.direction[: structure.n] < 3]
        if len(dofs) > _MOST:
            dofs = np.sort(dofs[np.argsort(-np.abs(after.shapes[dofs, mode]))[:_MOST]])
        weights = csr_array((np.ones(len(dofs)), (np.arange(len(dofs)), dofs)), shape=(len(dofs), n))
        return weights, tuple(structure.labels[i] for i in dofs)

    def at(self, lam: float, weights: Matrix) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """alpha (P,), its standard deviation (P,) and u'Mu (P,), with u = (K - lambda M)^-1 w and d alpha = -u'(dK - lambda dM) u.

        All NaN where lambda is an eigenvalue.
        """
        from scipy.sparse import csr_array

        K, M = self.matrices
        n = self.assembly.n
        try:
            solve = bordered(K - lam * M, csr_array((0, n)))
        except LooseError:
            return tuple(np.full((3, weights.shape[0]), np.nan))
        alpha, sd, mass = np.empty((3, weights.shape[0]))
        for first in range(0, len(alpha), _AT_ONCE):
            at = slice(first, first + _AT_ONCE)
            w = weights[at].toarray()
            u = solve(w.T, np.zeros((0, len(w))))[0].T
            alpha[at] = np.einsum("pn,pn->p", w, u)
            sd[at] = [self._sd(lam, each) for each in u]
            mass[at] = np.einsum("pn,np->p", u, M @ u.T)
        return alpha, sd, mass

    def _sd(self, lam: float, u: np.ndarray) -> float:
        if not self._change.p:
            return 0.0
        dA = self._change.projected(u[None, :])
        slopes = np.zeros(self._change.p)
        for name, weight in (("K", -1.0), ("M", lam)):
            if name in dA:
                slopes += weight * dA[name][:, 0, 0]
        return float(
            np.linalg.norm(in_prior_units((slopes * self._prior.slope(self._prior.mean))[None, :], self._prior.L))
        )
