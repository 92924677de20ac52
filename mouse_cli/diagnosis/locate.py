"""Where one force that the model lacks would make the shapes that were measured, whatever its law."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.channels import LIKELY, Channel, channels
from mouse_cli.diagnosis.matching import Matcher, Matches, Shapes, shapes
from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.model.diagnosis import Location, Place
from mouse_cli.updating.chi_square import upper_tail

_REGION = 0.9  # probability that the region holds
_POINTS = 8  # most values of z that the matching is linearised at
_NEAR = 0.3  # prior standard deviations from such a value within which the linearisation is trusted
_SHOWN = 400  # places that are kept
_LEADING = 5  # places whose own z is followed


@dataclass(frozen=True)
class Scores:
    """Costs of all places (j,), one channel behind the other; noise_scale: of the misfit of the best one."""

    channels: list[Channel]
    matches: Matches
    measured: Shapes

    @property
    def rows(self) -> np.ndarray:
        """B (j, r) of all places."""
        return np.concatenate([one.rows for one in self.channels])

    def find(self, place: int) -> tuple[Channel, int]:
        """The channel of a place, and its number in it."""
        for one in self.channels:
            if place < len(one):
                return one, place
            place -= len(one)
        raise IndexError(place)


def locate(model: Reduced) -> Location:
    """Places and channels by their probability.

    Needs two components of shape in a mode at least; without them no place is named, and p is 1.
    """
    found = scores(model)
    if found is None:
        return Location((), 0, 1.0)
    chi2 = float(found.matches.chi2[np.argmin(found.matches.cost)])
    dof = max(found.measured.dof, 1)
    score = -0.5 * found.matches.cost / max(1.0, chi2 / dof)
    weighed = score + _log_prior(found.channels)
    probability = np.exp(weighed - weighed.max())
    probability /= probability.sum()
    order = np.argsort(-weighed, kind="stable")
    region = int(np.searchsorted(np.cumsum(probability[order]), _REGION)) + 1
    places = tuple(_place(found, i, float(probability[i]), float(score.max() - score[i])) for i in order[:_SHOWN])
    return Location(places, min(region, len(places)), upper_tail(chi2, dof))


def scores(model: Reduced) -> Scores | None:
    """The matching of all places; None where no shape tells them apart."""
    measured, ways = shapes(model), channels(model)
    if measured.dof < 1 or not len(measured.modes) or not ways:
        return None
    rows = np.concatenate([one.rows for one in ways])
    return Scores(ways, matched(model, measured, rows), measured)


def matched(model: Reduced, measured: Shapes, rows: np.ndarray) -> Matches:
    """Places B (j, r), each from the point z that is nearest to its own: prior mean, update, and those of the leading places."""
    points = [model.z, np.zeros_like(model.z)]
    best = None
    for count in range(_POINTS):
        if count == len(points):
            break
        try:
            there = Matcher(model, measured, points[count]).match(rows)
        except np.linalg.LinAlgError:  # no mass matrix so far from the update
            continue
        best = there if best is None else _nearer(best, there)
        if count + 1 == len(points):
            leading = np.argsort(best.cost)[:_LEADING]
            far = leading[best.step[leading] > _NEAR]
            points += [best.z[far[0]]] if len(far) else []
    return best


def _nearer(one: Matches, other: Matches) -> Matches:
    """For each place the match with the shorter step."""
    take = other.step < one.step
    return Matches(
        *(
            np.where(take[:, None] if a.ndim == 2 else take, b, a)
            for a, b in ((getattr(one, name), getattr(other, name)) for name in Matches.__annotations__)
        )
    )


def _log_prior(ways: list[Channel]) -> np.ndarray:
    """ln of what is held likely before the test (j,): of each channel, times the share of it that a place stands for."""
    total: dict[str, float] = {}
    for one in ways:
        total[one.name] = total.get(one.name, 0.0) + float(one.weight.sum())
    return np.concatenate([np.log(LIKELY[one.name] * one.weight / total[one.name]) for one in ways])


def _place(found: Scores, i: int, probability: float, deficit: float) -> Place:
    one, number = found.find(i)
    return Place(one.site(number), one.name, probability, deficit)
