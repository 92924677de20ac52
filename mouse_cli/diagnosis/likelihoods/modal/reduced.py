"""The baseline in few coordinates: its modes, what its parameters do to them, and what forces where sensors are would do.

u = V q with V'M V = I and V'K V diagonal at the parameters that the update found. A small model keeps all of its modes, and is
exact; of a large one V holds the lowest, the static responses to unit loads at sensors and at places that matter, and the
derivatives of the measured modes by the parameters.
"""

from collections.abc import Callable, Hashable
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.data import Data
from mouse_cli.diagnosis.likelihoods.modal.directions import Directions, directions, projected
from mouse_cli.diagnosis.likelihoods.modal.finer import Finer, refined
from mouse_cli.diagnosis.likelihoods.modal.given import Given
from mouse_cli.diagnosis.sites.bars import Bars, bars, motion_of, stiffening
from mouse_cli.diagnosis.sites.residual import Static, static
from mouse_cli.dynamics.contraction import Stack
from mouse_cli.dynamics.eigen import dense_solution
from mouse_cli.dynamics.sensing import read
from mouse_cli.model.arrays import Matrix, dense
from mouse_cli.model.modal_test import ModalTest, restricted
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import Assembly, assembly
from mouse_cli.terms.constraints import Motion
from mouse_cli.updating.coordinates import Coordinates

WHOLE = 200  # degrees of freedom up to which a model is not reduced
_RIGID = 1e-12  # share of the highest eigenvalue up to which one is that of a rigid body
_BEYOND = 6  # modes that are corrected for their mesh, beyond twice those of the test


@dataclass(frozen=True)
class Reduced(Given):
    """theta (p,): where causes are weighed. eigenvalues (r,) where V is taken: there, or at `origin` (p,). dK, dM (k, r, r):
    derivatives along `directions` (p, k) of theta.

    sensing (s, r); V (n, r); data: the test. places: degrees of freedom (from 0) at which a force is exact, of a large model;
    None: everywhere. ties: pairs of places that are worth looking at, and sizes, see `localise/ties.py`; None: no look was taken.
    static: what a large model does statically in all degrees of freedom. finer: by what its mesh is corrected; None: it is not.
    mesh (n,): sd of ln f that this leaves, by number of the mode; of modes beyond, none is known.
    """

    problem: Problem
    theta: np.ndarray
    coordinates: Coordinates
    directions: np.ndarray
    V: np.ndarray
    eigenvalues: np.ndarray
    dK: np.ndarray
    dM: np.ndarray
    sensing: np.ndarray
    data: Data
    assembly: Assembly
    places: np.ndarray | None = None
    origin: np.ndarray | None = None
    ties: dict[tuple[int, int, int], float] | None = None
    static: Static | None = None
    finer: Finer | None = None
    mesh: np.ndarray = field(default_factory=lambda: np.zeros(0), compare=False)
    built_once: dict = field(default_factory=dict, repr=False, compare=False)

    @property
    def r(self) -> int:
        """Number of coordinates."""
        return len(self.eigenvalues)

    @cached_property
    def least_elastic(self) -> float:
        """The lowest eigenvalue that is none of a rigid body; 0 where all are."""
        return float(next(iter(self.eigenvalues[self.eigenvalues > _RIGID * self.eigenvalues[-1]]), 0.0))

    def low_modes(self, beyond: int = 1) -> int:
        """Number of its modes up to the highest one of the test, and so many beyond."""
        return min(self.r, int(self.data.test.number.max()) + beyond)

    def refined(self, eigenvalues: np.ndarray, X: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Eigenvalues (size,) and modes X (r or more, size), the lowest as half as long elements have them."""
        if self.finer is None:
            return eigenvalues, X
        most = min(len(eigenvalues), 2 * int(self.data.test.number.max()) + _BEYOND)
        return refined(self._finer, eigenvalues, X, X[: self.r, : self.finer.corrected(self.eigenvalues, most)])

    @cached_property
    def _finer(self) -> tuple[np.ndarray, np.ndarray]:
        """What corrects the mesh, in the coordinates."""
        return self.finer.of(self.V)

    @cached_property
    def L(self) -> np.ndarray:
        """Root (p, k) of the prior, in the coordinates u in which parameters are estimated."""
        L = self.coordinates.L
        return np.diag(L) if L.ndim == 1 else L

    def parameters(self, z: np.ndarray) -> np.ndarray:
        """Values (p,) of the deck's parameters at z (k,), prior standard deviations from the prior mean."""
        return self.coordinates.value(self.coordinates.mean + self.L @ z)

    def matrices(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """K and M (r, r) at z (k,)."""
        if (key := z.tobytes()) not in self._at:
            step, r = self.step(z), self.r
            K, M = (step @ d.reshape(len(step), r**2) for d in (self.dK, self.dM))
            K[:: r + 1] += self.eigenvalues
            M[:: r + 1] += 1.0
            self._at.clear()
            self._at[key] = K.reshape(r, r), M.reshape(r, r)
        return self._at[key]

    def step(self, z: np.ndarray) -> np.ndarray:
        """How far (d,) the parameters at z are along each direction from where V was taken."""
        return self.along @ (self.parameters(z) - (self.theta if self.origin is None else self.origin))

    def rates(self, z: np.ndarray) -> np.ndarray:
        """Its derivatives (k, d)."""
        return (self.along @ self.by(z)).T

    def by(self, z: np.ndarray) -> np.ndarray:
        """d(parameters)/dz (p, k) at z (k,)."""
        return self.coordinates.slope(self.coordinates.mean + self.L @ z)[:, None] * self.L

    @cached_property
    def _at(self) -> dict[bytes, tuple[np.ndarray, np.ndarray]]:
        """K and M at the z that was asked for last: many causes are looked at with the same parameters."""
        return {}

    def slopes(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """dK/dz and dM/dz (k, r, r)."""
        return tuple(np.tensordot(self.rates(z), d, 1) for d in (self.dK, self.dM))

    def moved(self, z: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """dK/dz u and dM/dz u (k, r, m) for motion u (r, m)."""
        by = self.rates(z)
        return tuple(np.tensordot(by, d @ u, 1) for d in (self.dK, self.dM))

    @cached_property
    def along(self) -> np.ndarray:
        """From changes of the parameters to steps in the directions (k, p)."""
        return np.linalg.pinv(self.directions)

    @cached_property
    def z(self) -> np.ndarray:
        """z (k,) of theta."""
        u = np.where(self.coordinates.logarithmic, np.log(np.maximum(self.theta, 1e-300)), self.theta)
        if not self.L.size:
            return np.zeros(self.L.shape[1])
        return np.linalg.lstsq(self.L, u - self.coordinates.mean, rcond=None)[0]

    @cached_property
    def motion(self) -> Motion | None:
        """How nodes follow degrees of freedom; None without a mesh."""
        return None if self.problem.mesh is None else motion_of(self.problem)

    @cached_property
    def bars(self) -> Bars | None:
        """Bars that bend; None where there are none."""
        found = None if self.motion is None else bars(self.problem, self.motion, self.theta, self.V)
        if found is None or self.static is None:
            return found
        return replace(found, residual=self.static.left(found, self.eigenvalues))

    @cached_property
    def stiffening(self) -> np.ndarray:
        """d ln EI / dz (b, k) of the bars: what softens them follows their stiffness."""
        return stiffening(self.problem, self.bars, self.theta) @ self.by(self.z)

    def second_slopes(self, z: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
        """Unknowns i and j (c,) of z, and d2K/dz_i dz_j u (c, r, m) for motion u (r, m), where that matters; None: nowhere."""
        return None

    @cached_property
    def total_mass(self) -> float:
        """Mass (kg) that moves when the structure translates; without geometry the sum of the diagonal."""
        _, M = self.assembly.matrices(self.theta)
        at = self.problem.structure.geometry
        if at is None:
            return float(M.diagonal().sum())
        rigid = ((at.direction == np.arange(3)[:, None]) & (at.node >= 0)).astype(float)
        return max(float(row @ (M @ row)) for row in rigid) or float(M.diagonal().sum())

    def once(self, key: Hashable, build: Callable[[Problem], Problem]) -> tuple[Problem, Assembly]:
        """What `build` makes of the deck, and its assembly: the same at all parameters and in all coordinates, and built once."""
        if key not in self.built_once:
            made = build(self.problem)
            self.built_once[key] = made, assembly(made)
        return self.built_once[key]

    def project(self, matrix) -> np.ndarray:
        """V' matrix V (r, r)."""
        return self.V.T @ (matrix @ self.V)

    def node(self, index: int) -> np.ndarray:
        """Motion (6, r) of a node in each coordinate."""
        rows = np.zeros((6, self.r))
        for d in range(6):
            dofs, factor = self.motion.of(index, d)
            rows[d] = factor @ self.V[dofs] if len(dofs) else 0.0
        return rows

    def bare(self, z: np.ndarray) -> np.ndarray:
        """z (k,) of the model as it is: without a field, where there is one."""
        return z

    def within(self, Q: np.ndarray) -> "Reduced":
        """The same model in fewer coordinates, combinations Q (r, c) of its own with Q'Q = I."""
        eigenvalues, W = np.linalg.eigh((Q.T * self.eigenvalues) @ Q)
        Q = Q @ W
        return replace(
            self,
            V=self.V @ Q,
            eigenvalues=eigenvalues,
            dK=Q.T @ self.dK @ Q,
            dM=Q.T @ self.dM @ Q,
            sensing=self.sensing @ Q,
        )

    def recipes(self, candidate) -> list:
        """What `candidate` can do to this model, and where."""
        return candidate.recipes(self, candidate)

    def looked_at(self, do: Callable[["Reduced"], "Reduced"]) -> "Reduced":
        """What a first look is made with: what `do` makes of it."""
        return do(self)

    def each(self, do: Callable[["Reduced", bool], "Reduced"]) -> "Reduced":
        """What `do` makes of every configuration, and of whether it has what is sought: this is the only one."""
        return do(self, True)

    @property
    def first(self) -> "Reduced":
        """The first configuration: the only one."""
        return self

    def judged_by(self, data: Data) -> "Reduced":
        """The same model for other data of the same structure; what it computed when asked is known there too."""
        same = copy(self)
        object.__setattr__(same, "data", data)
        return same

    def at(self, theta: np.ndarray) -> "Reduced":
        """The same model at other values theta (p,) of its parameters; a large one in the same coordinates and places."""
        if self.V.shape[0] <= WHOLE:
            matrices = self.assembly.matrices(theta)
            there = exact(self.problem, self.assembly, *matrices, theta)
            return replace(there, data=self.data, ties=self.ties, finer=self.finer, mesh=self.mesh, built_once=self.built_once)
        return replace(self, theta=theta, origin=self.theta if self.origin is None else self.origin)

    def without(self, keep_modes: np.ndarray) -> "Reduced":
        """The same model with fewer measured modes: mask `keep_modes` (m,)."""
        return self.with_test(restricted(self.data.test, keep_modes))

    def with_test(self, test: ModalTest, beside: ModalTest | None = None) -> "Reduced":
        """The same model for another test of the same sensors, some modes of which are known to be others; see `Data`."""
        data, known = Data(test, self.problem.theory, beside), test.number <= len(self.mesh)
        if known.any():
            left = np.zeros(test.m)
            left[known] = self.mesh[test.number[known] - 1]
            data = data.loosened(left, np.zeros(data.has_shape.shape))
        return replace(self, data=data)

    def left_out(self, i: int) -> "Reduced":
        """The same model for measured mode i alone, which is none of the others."""
        own = np.arange(self.data.m) == i
        return self.with_test(restricted(self.data.test, own), restricted(self.data.test, ~own))


def exact(problem: Problem, total: Assembly, K: Matrix, M: Matrix, theta: np.ndarray) -> Reduced:
    """The model of K and M (n, n) at theta (p,) in all of its modes; how degrees of freedom without mass follow is static."""
    from scipy.linalg import cho_factor, cho_solve

    K, M = dense(K), dense(M)
    solution = dense_solution(K, M)
    stack = Stack(total.n, total.p, total.slopes(theta))
    V, eigenvalues = solution.shapes, solution.eigenvalues
    model = built(problem, total, theta, V, eigenvalues, directions(problem, total, theta, stack, V, eigenvalues), stack)
    if model.r == total.n:
        return model
    shift = -0.3 * model.least_elastic
    factor = cho_factor(K - shift * M)
    by_all = static(problem, model.motion, model.bars, shift, partial(cho_solve, factor), V[:, : model.low_modes(2)])
    return replace(model, static=by_all)


def built(
    problem: Problem,
    total: Assembly,
    theta: np.ndarray,
    V: np.ndarray,
    eigenvalues: np.ndarray,
    by: Directions,
    stack: Stack,
) -> Reduced:
    """The model in the coordinates V (n, r), whose parameters move it in the directions `by`."""
    dK, dM = projected(stack, by.values, V)
    seen = np.asarray(read(problem.test.measured_at, V))
    data = Data(problem.test, problem.theory)
    return Reduced(problem, theta, by.coordinates, by.values, V, eigenvalues, dK, dM, seen, data, total)
