"""Which poles stay where they are while the order of the model rises: the stabilisation diagram, read by rule.

Poles of one order are assigned to the tracks of earlier orders so that the sum of their relative distances is least; a pole is
stable when frequency, damping and participation have moved less than stated since the order before.
"""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli.records.lscf import OrderPoles

FREQUENCY, DAMPING, LIKENESS = 0.01, 0.2, 0.8  # most change of frequency and of damping, least MAC of participations
SHARE, ORDERS = 0.5, 6  # of the orders since it appeared that a mode must be stable in; and how many at least
_FORGOTTEN = 4  # orders without a pole after which a track ends


@dataclass(eq=False)
class Track:
    """A pole followed over orders: (order, pole, participation) of each member; stable: whether it had come to rest.

    window: first and last line of the diagram it belongs to. Compared by identity.
    """

    window: tuple[int, int] = (0, 0)
    order: list[int] = field(default_factory=list)
    pole: list[complex] = field(default_factory=list)
    participation: list[np.ndarray] = field(default_factory=list)
    stable: list[bool] = field(default_factory=list)

    def add(self, order: int, pole: complex, participation: np.ndarray, stable: bool) -> None:
        """Append one order's pole."""
        self.order.append(order)
        self.pole.append(complex(pole))
        self.participation.append(participation)
        self.stable.append(stable)

    @property
    def stable_orders(self) -> int:
        """In how many orders the pole was stable."""
        return sum(self.stable)

    def centre(self) -> tuple[complex, np.ndarray]:
        """Median pole of the stable members, and the participation of the member next to it."""
        poles = np.array(self.pole)
        kept = poles[self.stable] if any(self.stable) else poles
        middle = complex(np.median(kept.real), np.median(kept.imag))
        return middle, self.participation[int(np.abs(poles - middle).argmin())]


def tracks(found: list[OrderPoles], window: tuple[int, int] = (0, 0)) -> list[Track]:
    """Tracks of damped poles, in the order of their frequencies."""
    from scipy.optimize import linear_sum_assignment

    every: list[Track] = []
    for step in found:
        damped = step.poles.real < 0
        poles, participation = step.poles[damped], step.participation[:, damped]
        alive = [track for track in every if step.order - track.order[-1] <= _FORGOTTEN]
        last = np.array([track.pole[-1] for track in alive], complex)
        distance = (
            np.abs(poles - last[:, None]) / np.abs(last)[:, None] if len(alive) and len(poles) else np.zeros((0, 0))
        )
        near = distance < 2 * FREQUENCY
        pairs = linear_sum_assignment(np.where(near, distance, 1e3)) if distance.size else ((), ())
        taken = {int(k): int(t) for t, k in zip(*pairs, strict=True) if near[t, k]}
        for k, pole in enumerate(poles):
            track = alive[taken[k]] if k in taken else Track(window)
            rest = k in taken and _rests(track, pole, participation[:, k])
            track.add(step.order, pole, participation[:, k], rest)
            if k not in taken:
                every.append(track)
    return sorted(every, key=lambda track: abs(track.centre()[0]))


def _rests(track: Track, pole: complex, participation: np.ndarray) -> bool:
    """Whether the pole is where the track's last one was."""
    before, other = track.pole[-1], track.participation[-1]
    ratio, zeta, former = abs(pole) / abs(before), -pole.real / abs(pole), -before.real / abs(before)
    likeness = abs(other.conj() @ participation) ** 2 / ((abs(other) ** 2).sum() * (abs(participation) ** 2).sum())
    return abs(ratio - 1) < FREQUENCY and abs(zeta - former) < DAMPING * former and likeness > LIKENESS


def persistent(track: Track, orders: range) -> bool:
    """Whether a track is stable in enough of the orders from its first one on."""
    possible = sum(order > track.order[0] for order in orders)
    return track.stable_orders >= max(ORDERS, SHARE * possible)
