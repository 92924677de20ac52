"""Time histories of M u'' + C u' + K u + B F(B'u, B'u', z) = P f: exact linear part, local forces by predictor and corrector.

The linear part is stepped exactly for forces that are linear between steps (first-order hold, matrix exponential: Van Loan, IEEE
Trans. Autom. Control 23, 1978). Many models and many segments of a record advance together.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

# force(x, v, z) -> (F, z): r local motions x, v (P, r, G) and internal states z to forces (P, r, G) and next states
LocalForce = Callable[[np.ndarray, np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
# (v, F before, free, drop) -> (F, F at the end): of a step that begins with v, ends with free - drop F, and may hold a jump of the
# force; F is what would do the same without a jump
Implicit = Callable[[np.ndarray, np.ndarray, np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
_BLOCK = 250_000  # numbers of states that are kept until sensors read them: what a cache holds
CORRECTIONS = 2  # of the local force at the end of a step; each gains a factor h^2 F'/(6 m)


@dataclass(frozen=True)
class Plant:
    """P linear models alike in size: M, C, K (P, n, n); inputs (P, n, i); local (n, r): motions at which local forces act.

    sensing (s, n); order (s,): 0 displacement, 1 velocity, 2 acceleration.
    """

    M: np.ndarray
    C: np.ndarray
    K: np.ndarray
    inputs: np.ndarray
    local: np.ndarray
    sensing: np.ndarray
    order: np.ndarray

    @property
    def count(self) -> int:
        """How many models, P."""
        return len(self.M)

    @property
    def states(self) -> int:
        """Displacements and velocities, 2n."""
        return 2 * self.M.shape[1]


@dataclass(frozen=True)
class LocalForces:
    """All local forces, and how those of them that jump with the velocity follow from the end of a step, by their place in r."""

    force: LocalForce
    implicit: dict[int, Implicit]

    def __call__(self, x: np.ndarray, v: np.ndarray, z):
        """Forces and next internal states."""
        return self.force(x, v, z)


@dataclass(frozen=True)
class Discrete:
    """A plant stepped by h: next (P, 2n + 2r, 2n + 2i + r) takes [xi, f now, f next, F now] to [xi, B'u, B'u'] next without the
    local force there, xi = state + hold F; drop (P, 2r, r): what that force takes off B'u, B'u'.

    outputs (P, s, 2n + i + r) reads sensors from [xi, f, F].
    """

    next: np.ndarray
    drop: np.ndarray
    outputs: np.ndarray
    hold: np.ndarray


def discrete(plant: Plant, h: float) -> Discrete:
    """The plant stepped by h s, exactly for forces that are linear within a step."""
    n, i, r = plant.M.shape[1], plant.inputs.shape[2], plant.local.shape[1]
    local = np.broadcast_to(-plant.local, (plant.count, n, r))
    flexible = np.linalg.solve(plant.M, np.concatenate([plant.inputs, local], axis=2))
    A = np.zeros((plant.count, 2 * n, 2 * n))
    A[:, :n, n:] = np.eye(n)
    A[:, n:, :n], A[:, n:, n:] = -np.linalg.solve(plant.M, plant.K), -np.linalg.solve(plant.M, plant.C)
    B = np.concatenate([np.zeros_like(flexible), flexible], axis=1)
    step, now, after = held(A, B, h)
    hold = -after[:, :, i:]
    read = np.zeros((2 * r, 2 * n))
    read[:r, :n], read[r:, n:] = plant.local.T, plant.local.T
    advance = np.concatenate([step, now[:, :, :i], after[:, :, :i], now[:, :, i:] - step @ hold], axis=2)
    outputs = _outputs(plant, A, B)
    outputs[:, :, 2 * n + i :] -= outputs[:, :, : 2 * n] @ hold
    return Discrete(np.concatenate([advance, read @ advance], axis=1), read @ hold, outputs, hold)


def held(A: np.ndarray, B: np.ndarray, h: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """exp(Ah) and the matrices that inputs at the beginning and at the end of a step act through: x1 = E x0 + B0 f0 + B1 f1."""
    from scipy.linalg import expm

    n, m = B.shape[-2:]
    whole = np.zeros((*A.shape[:-2], n + 2 * m, n + 2 * m))
    whole[..., :n, :n], whole[..., :n, n : n + m] = A * h, B * h
    whole[..., n : n + m, n + m :] = np.eye(m)
    found = expm(whole)[..., :n, :]
    after = found[..., n + m :]
    return found[..., :n], found[..., n : n + m] - after, after


def _outputs(plant: Plant, A: np.ndarray, B: np.ndarray) -> np.ndarray:
    """What sensors read from [u, u', f, F] (P, s, 2n + i + r)."""
    n = plant.M.shape[1]
    whole = np.concatenate([A, B], axis=2)
    found = np.zeros((plant.count, len(plant.order), whole.shape[2]))
    for order, first in ((0, 0), (1, n)):
        own = plant.order == order
        found[:, own, first : first + n] = plant.sensing[own]
    own = plant.order == 2
    found[:, own] = plant.sensing[own] @ whole[:, n:]
    return found


def simulate(
    plant: Plant,
    h: float,
    force: np.ndarray,
    start: np.ndarray,
    local: LocalForce | LocalForces | None = None,
    z: np.ndarray | None = None,
) -> np.ndarray:
    """Sensors (P, s, t, G) at every step.

    h: s; force (t, i, G): at every step; start (P, 2n, G): displacements and velocities; z: internal states of the local forces.
    """
    (t, i, G), P, n2 = force.shape, plant.count, plant.states
    if not local:
        plant = replace(plant, local=plant.local[:, :0])
    by, r = discrete(plant, h), plant.local.shape[1]
    steps = max(1, min(t, _BLOCK // max(P * (n2 + 2 * i + r) * G, 1)))
    x, last = np.zeros((steps + 1, P, n2 + 2 * i + r, G)), None
    x[0, :, :n2] = start
    if local:
        last, z = _begun(plant, start, local, z)
        x[0, :, n2 + 2 * i :] = last[1]
        x[0, :, :n2] += by.hold @ last[1]
    idle = np.zeros((P, len(plant.order), i))  # sensors do not read the forces of the next step
    seen = np.concatenate([by.outputs[:, :, : n2 + i], idle, by.outputs[:, :, n2 + i :]], axis=2)
    out, jumps = np.zeros((P, len(plant.order), t, G)), {}
    for begin in range(0, t, steps):
        count = min(steps, t - begin)
        following = min(count, t - 1 - begin)
        x[:count, :, n2 : n2 + i] = force[begin : begin + count, None]
        x[:following, :, n2 + i : n2 + 2 * i] = force[begin + 1 : begin + 1 + following, None]
        last, z, jumped = _advanced(by, local, x, last, z, following)
        jumps |= {begin + k: jump for k, jump in jumped.items()}
        out[:, :, begin : begin + count] = np.matmul(seen, x[:count]).transpose(1, 2, 0, 3)
        x[0] = x[count]
    _shared(out, jumps, by.outputs[:, :, n2 + i :] + by.outputs[:, :, :n2] @ by.hold)
    return out


def _advanced(by: Discrete, local: LocalForce | LocalForces | None, x: np.ndarray, last, z, count: int):
    """`count` steps of states and forces x (t, P, 2n + 2i + r, G) in place, from the `last` velocities and forces at local motions;
    these and internal states after them, and by step how much forces jumped within the one before.
    """
    n2, r, jumps = by.hold.shape[1], by.hold.shape[2], {}
    forces = x.shape[2] - r
    for k in range(count):
        y, after = by.next @ x[k], x[k + 1]
        after[:, :n2] = y[:, :n2]
        if not local:
            continue
        over, F, z, moved = _corrected(local, y[:, n2:], by.drop, last, z)
        after[:, forces:] = F
        if over is not F:
            after[:, :n2] += by.hold @ (F - over)
            jumps[k + 1] = (over - F) / 2
        last = moved[:, r:], F
    return last, z, jumps


def _shared(out: np.ndarray, jumps: dict[int, np.ndarray], feed: np.ndarray) -> None:
    """Into `out` what jumps of forces within the step before do to accelerations: samples on either side share each of them, so
    that their sum is the change of velocity. feed (P, s, r): of sensors by local forces.
    """
    for k, jump in jumps.items():
        out[:, :, k] += feed @ jump


def _begun(plant: Plant, start: np.ndarray, local: LocalForce, z):
    """Velocities and forces (P, r, G) at local motions in the initial state, and internal states after it."""
    n = plant.states // 2
    x, v = plant.local.T @ start[:, :n], plant.local.T @ start[:, n:]
    F, z = local(x, v, z)
    return (v, F), z


def _corrected(local: LocalForce | LocalForces, free: np.ndarray, drop: np.ndarray, last, z):
    """F over a step and at its end, states and local motions with it, by fixed-point iteration from `last`, v and F before it."""
    v, F = last
    r, implicit = F.shape[1], local.implicit if isinstance(local, LocalForces) else None
    if not implicit:
        for _ in range(CORRECTIONS):
            moved = free - drop * F if r == 1 else free - drop @ F
            F, after = local(moved[:, :r], moved[:, r:], z)
        return F, F, after, moved
    if len(implicit) == r == 1:  # alone, such a force follows from the step at once
        over, end = implicit[0](v[:, 0], F[:, 0], free[:, 1], drop[:, 1])
        one = over[:, None]
        return one, one if over is end else end[:, None], z, free - drop * one
    over = end = F
    for _ in range(CORRECTIONS):
        moved = free - drop @ over
        there, after = local(moved[:, :r], moved[:, r:], z)
        end = there.copy()
        for i, solved in implicit.items():
            own = drop[:, r + i, i, None]
            there[:, i], end[:, i] = solved(v[:, i], F[:, i], moved[:, r + i] + own * over[:, i], own)
        over = there
    return over, end, after, free - drop @ over
