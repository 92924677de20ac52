"""Truths: drives with Coulomb friction and play, integrated from event to event.

Between events everything is linear: y' = A y with y = [x (n,), v (n,), w (q,), w' (q,), 1], w the inputs, linear between knots.
y moves by matrix exponentials; slip, stick and contact change where a linear function of y does, found by bisection.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import expm

SUBSTEPS = 4  # between knots, at which events are looked for
_BISECTED = 60
_LEAST = 1e-13  # s: events closer than that are one


@dataclass(frozen=True)
class Drive:
    """m (n,), c (n,): masses and dashpots to the ground, n 1 or 2; shaft: spring, dashpot and half of the play between the two.

    friction: Coulomb force on mass `at`; offset: constant force on the first mass, that nobody measures. gains: kp (N/m) and
    kd (N s/m) of a loop that follows the input (a position, from its velocity); None: the input is the force on the first mass.
    """

    m: np.ndarray
    c: np.ndarray
    friction: float = 0.0
    at: int = 0
    offset: float = 0.0
    shaft: tuple[float, float, float] = (0.0, 0.0, 0.0)
    gains: tuple[float, float] | None = None

    @property
    def n(self) -> int:
        """Number of masses."""
        return len(self.m)

    @cached_property
    def force(self) -> np.ndarray:
        """Row (2n + 5,) that reads the measured force from y."""
        row, n = np.zeros(2 * self.n + 5), self.n
        if self.gains is None:
            row[2 * n] = 1.0
        else:
            kp, kd = self.gains
            row[[0, n]] = -kp, -kd
            row[2 * n : 2 * n + 2] = kp, kd
        return row

    def forces(self, contact: int) -> np.ndarray:
        """All forces but friction (n, 2n + 5) from y; contact: -1, 0, 1, the side of the play that is closed."""
        n = self.n
        found = np.zeros((n, 2 * n + 5))
        found[0] = self.force
        found[0, -1] += self.offset
        found[:, n : 2 * n] -= np.diag(self.c)
        if n == 2:
            k, d, play = self.shaft
            pull = np.zeros(2 * n + 5)
            pull[2:4] = -d, d
            if contact or not play:
                pull[:2], pull[-1] = (-k, k), -k * play * contact
            found += np.outer([1.0, -1.0], pull)
        return found

    def rates(self, slip: int, contact: int) -> np.ndarray:
        """A (2n + 5, 2n + 5); slip: sign of the velocity of the mass with friction, 0 while it sticks."""
        n = self.n
        forces = self.forces(contact)
        forces[self.at, -1] -= slip * self.friction
        if not slip and self.friction:
            forces[self.at] = 0.0
        A = np.zeros((2 * n + 5, 2 * n + 5))
        A[:n, n : 2 * n] = np.eye(n)
        A[n : 2 * n] = forces / self.m[:, None]
        A[2 * n : 2 * n + 2, 2 * n + 2 : 2 * n + 4] = np.eye(2)
        return A


class Motion:
    """A drive on its way: y, whether and whither it slips, and which side of the play is closed."""

    def __init__(self, drive: Drive, h: float):
        self.drive, self.h, self.n = drive, h, drive.n
        self.y = np.zeros(2 * drive.n + 5)
        self.y[-1] = 1.0
        self.slip, self.contact = (0 if drive.friction else 1), 0
        self.events = 0
        self._kept: dict[tuple[int, int], tuple[np.ndarray, np.ndarray, np.ndarray]] = {}

    @property
    def own(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """A, its exponential over a substep, and the forces on the masses, as things are."""
        key = self.slip, self.contact
        if key not in self._kept:
            A = self.drive.rates(*key)
            self._kept[key] = A, expm(A * self.h / SUBSTEPS), self.drive.forces(self.contact)
        return self._kept[key]

    def _over(self, y: np.ndarray) -> float:
        """Largest amount by which y is beyond an event as things are; negative: none of them has come."""
        drive, amounts = self.drive, [-np.inf]
        if drive.friction and self.slip:
            amounts.append(-self.slip * y[self.n + drive.at])
        elif drive.friction:
            amounts.append(abs(self.own[2][drive.at] @ y) - drive.friction)
        if drive.shaft[2]:
            side = (y[1] - y[0]) / drive.shaft[2]
            amounts.append(abs(side) - 1 if not self.contact else 1 - self.contact * side)
        return max(amounts)

    def _turn(self) -> None:
        """What follows an event at y: the side of the play, then slip or stick."""
        self.events += 1
        y, drive = self.y, self.drive
        if drive.shaft[2]:
            side = (y[1] - y[0]) / drive.shaft[2]
            if not self.contact and abs(side) >= 1:
                self.contact = int(np.sign(side))
            elif self.contact and self.contact * side <= 1:
                self.contact = 0
        if drive.friction:
            at = self.n + drive.at
            pull = self.own[2][drive.at] @ y
            if not self.slip and abs(pull) >= drive.friction:
                self.slip = int(np.sign(pull))
            elif self.slip and self.slip * y[at] <= 0:
                y[at] = 0.0
                self.slip = 0 if abs(pull) <= drive.friction else int(np.sign(pull))

    def advance(self, seconds: float) -> None:
        """Forward by at most a substep, through all events."""
        while seconds > _LEAST:
            A, whole, _ = self.own
            E = whole if abs(seconds - self.h / SUBSTEPS) < _LEAST else expm(A * seconds)
            there = E @ self.y
            if self._over(there) <= 0:
                self.y = there
                return
            early, late = 0.0, seconds
            for _ in range(_BISECTED):
                middle = (early + late) / 2
                early, late = (early, middle) if self._over(expm(A * middle) @ self.y) > 0 else (middle, late)
                if late - early < _LEAST:
                    break
            self.y = expm(A * late) @ self.y
            seconds -= late
            self._turn()


def run(drive: Drive, knots: np.ndarray, h: float) -> dict[str, np.ndarray]:
    """x, v, a (t, n) and f (t,) at knots of the input (t, 2), h s apart: a force and nothing, or a position and its velocity."""
    motion, n = Motion(drive, h), drive.n
    found = {key: np.zeros((len(knots), n)) for key in "xva"} | {"f": np.zeros(len(knots))}
    slopes = np.diff(knots, axis=0, append=knots[-1:]) / h
    for i, (w, slope) in enumerate(zip(knots, slopes, strict=True)):
        motion.y[2 * n : 2 * n + 2], motion.y[2 * n + 2 : 2 * n + 4] = w, slope
        found["x"][i], found["v"][i] = motion.y[:n], motion.y[n : 2 * n]
        found["a"][i], found["f"][i] = (motion.own[0] @ motion.y)[n : 2 * n], drive.force @ motion.y
        for _ in range(SUBSTEPS if i + 1 < len(knots) else 0):
            motion.advance(h / SUBSTEPS)
    return found
