"""Where one force that the model lacks would make the shapes that were measured, whatever its law."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.localise.matching import Matcher, Matches, Shapes, shapes
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.sites.channels import LIKELY, Channel, channels
from mouse_cli.model.diagnosis import Location, Place
from mouse_cli.updating.chi_square import upper_tail

_REGION = 0.9  # probability that the region holds
_POINTS = 30  # most values of z that are tried besides the update and the prior mean
_SETTLED = 0.5  # of the cost, that one more step for a place would gain
_SCALES = np.linspace(-2.0, 2.0, 9)  # prior standard deviations of what moves all eigenvalues together
_TRIES = 5  # steps for one place
_FARTHEST = 2.0  # length of one
_RIVAL = 12.0  # nats that a place may promise to be below the best and still be followed
_TRUSTED = 2.0  # gain up to which the last step of a place is taken for granted
_SHOWN = 400  # places that are kept
_RIVAL = 12.0  # nats below the best up to which the z of a place is followed


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
    gain = found.matches.gain()
    chi2 = found.matches.cost - np.where(gain < _TRUSTED, gain, 0.0)
    least, dof = float(chi2.min()), max(found.measured.dof, 1)
    score = -0.5 * (chi2 + found.matches.volume()) / max(1.0, least / dof)
    log_posterior = score + log_prior(found.channels)
    probability = np.exp(log_posterior - log_posterior.max())
    probability /= probability.sum()
    order = np.argsort(-log_posterior, kind="stable")
    region = int(np.searchsorted(np.cumsum(probability[order]), _REGION)) + 1
    places = tuple(_place(found, i, float(probability[i]), float(score.max() - score[i])) for i in order[:_SHOWN])
    return Location(places, min(region, len(places)), upper_tail(least, dof))


def scores(model: Reduced) -> Scores | None:
    """The matching of all places; None where no shape tells them apart."""
    measured, ways = shapes(model), channels(model)
    if measured.dof < 1 or not len(measured.modes) or not ways:
        return None
    rows = np.concatenate([one.rows for one in ways])
    return Scores(ways, matched(model, measured, rows), measured)


def matched(model: Reduced, measured: Shapes, rows: np.ndarray, most: int = _POINTS) -> Matches:
    """Places B (j, r), each at the best z found for it: every z that a leading place leads to is tried for all of them."""
    found = None
    for point in _starts(model):
        found = _better(found, _matches(model, measured, point, rows))
    damping, followed = np.zeros(len(rows)), np.zeros(len(rows), int)
    for number in range(most):
        gain = found.gain()
        done = (gain < _SETTLED) | (followed >= _TRIES)
        hope = np.where(done, found.cost, np.maximum(found.cost - gain, 0.0))
        rivals = np.flatnonzero(hope < found.cost.min() + 2 * _RIVAL)
        left = rivals[~done[rivals]]
        if not len(left):
            break
        place = left[np.argmin((found.cost if number % 2 else hope)[left])]
        step, before = found.step(damping)[place], found.cost[place]
        z = found.z[place] + step * min(1.0, _FARTHEST / np.linalg.norm(step))
        found = _better(found, _matches(model, measured, z, rows[rivals]), rivals)
        followed[place] += 1
        damping[place] = damping[place] / 10 if found.cost[place] < before else max(10 * damping[place], 0.1)
    return found


def _starts(model: Reduced) -> list[np.ndarray]:
    """z (k,) of the update, and along what moves all eigenvalues together, which a missing force upsets most."""
    update, zero = fit(Model(model), np.zeros(0)), np.zeros_like(model.z)
    first = [] if update is None else [update.point.x]
    dK, dM = model.slopes(zero)
    count = int(model.data.test.number.max())
    lam = np.maximum(np.abs(model.eigenvalues[:count]), 1e-9 * np.abs(model.eigenvalues).max())
    moved = np.einsum("krr->kr", dK)[:, :count] / lam - np.einsum("krr->kr", dM)[:, :count]
    common = moved.mean(axis=1)
    length = np.linalg.norm(common)
    return first + ([zero] if length == 0 else [t * common / length for t in _SCALES])


def _matches(model: Reduced, measured: Shapes, z: np.ndarray, rows: np.ndarray) -> Matches | None:
    """At z; None where the model is not physical there."""
    try:
        return Matcher(model, measured, z).match(rows)
    except np.linalg.LinAlgError:
        return None


def _better(one: Matches | None, other: Matches | None, places: np.ndarray | slice = slice(None)) -> Matches | None:
    """For each place the match of lower cost; `other` is of `places` alone."""
    if one is None or other is None:
        return one or other
    take = other.cost < one.cost[places]
    into = np.arange(len(one.cost))[places][take]
    for name in Matches.__annotations__:
        getattr(one, name)[into] = getattr(other, name)[take]
    return one


def log_prior(ways: list[Channel]) -> np.ndarray:
    """ln of what is held likely before the test (j,): of each channel, times the share of it that a place stands for."""
    total: dict[str, float] = {}
    for one in ways:
        total[one.name] = total.get(one.name, 0.0) + float(one.weight.sum())
    return np.concatenate([np.log(LIKELY[one.name] * one.weight / total[one.name]) for one in ways])


def _place(found: Scores, i: int, probability: float, deficit: float) -> Place:
    one, number = found.find(i)
    return Place(one.site(number), one.name, probability, deficit)
