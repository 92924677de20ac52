"""Which starts are fitted next: the first of each law and group, what is like the leader, and the same begun elsewhere."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.terms.laws import registry as laws
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.regression import Start
from mouse_cli.updating.recordings.study import Study

POLISHED, _AGAIN = 4, 8  # starts that are fitted in any case; of the nearest law again
_ELSEWHERE = 4  # places at which a law that comes near is tried besides, and laws at its place
_STOP, _HARDER = "clearance", 10.0  # group of laws of contacts; times the stiffness with which they are begun again
_ALIKE = 6  # starts that are fitted although an adequate law was found, as they are like it


def alike(order: list[Start], tried: list[Start], leader: tuple[str, str]) -> list[Start]:
    """Starts that were not tried yet and are most like the leader, law and place: other laws there, those of fewer sizes first, and
    its law elsewhere.

    Where data are few or noisy a law explains them that is not true, and a first look may have had the true one behind others: a
    mass behind oscillators above the band, which are one there.
    """
    gone = set(map(where, tried))
    shares = lambda at: at not in gone and (at[0] == leader[0]) != (at[1] == leader[1])
    like = [one for one in order if shares(where(one))]
    count = len(laws()[leader[0]].parameters) if leader[0] in laws() else 0
    plain = lambda one: where(one)[1] == leader[1] and len(one.hypothesis.parts[-1].unknowns) < count
    return ([one for one in like if plain(one)][: _ALIKE // 2] + [one for one in like if not plain(one)])[:_ALIKE]


def elsewhere(order: list[Start], tried: list[Start], law: str) -> list[Start]:
    """Starts of a law at places where it was not tried yet, the most promising ones."""
    gone = set(map(where, tried))
    return [one for one in order if one.hypothesis.law.key == law and where(one) not in gone][:_ELSEWHERE]


def others_there(order: list[Start], tried: list[Start], place: str) -> list[Start]:
    """Starts of laws that were not tried yet at a place, the most promising ones."""
    gone = set(map(where, tried))
    return [one for one in order if where(one)[1] == place and where(one) not in gone][:_ELSEWHERE]


def where(one: Start | Fit) -> tuple[str, str]:
    """Key and place of its last law."""
    return one.hypothesis.law.key, one.hypothesis.place.where


def from_mean(one: Fit) -> Start:
    """Its sizes, with nuisances at their mean."""
    own = one.hypothesis
    return Start(own, np.concatenate([own.mean[: own.nuisances], one.x[own.nuisances :]]), 0.0)


def begun_again(study: Study, best: Fit) -> Iterator[tuple[Start, float]]:
    """Further starts of a law that was fitted, with the cost that they have to beat: where it ended, then other sizes.

    A first look may put nuisances that act alike many sd apart, along a valley in which a fit runs out of steps: friction then
    left twice the noise, and a little more friction elsewhere was found for the rest.
    """
    yield Start(best.hypothesis, best.x, 0.0), np.inf
    last = best.hypothesis.parts[-1]
    for start in study.at(last.place).apart(last.law, last.variant, _AGAIN)[1:]:
        yield start, best.cost


def harder(order: list[Start]) -> list[Start]:
    """The most promising stops, ten times as stiff and with nuisances at their mean: a first look takes the motion from the record,
    whose impacts are short, and finds hard contacts soft.
    """
    found = []
    for one in [one for one in order if one.hypothesis.law.group == _STOP][:_ELSEWHERE]:
        own, x = one.hypothesis, np.array(one.x)
        x[: own.nuisances], x[own.nuisances] = own.mean[: own.nuisances], x[own.nuisances] + np.log(_HARDER)
        found.append(Start(own, np.clip(x, *own.bounds), one.left))
    return found


def varied(order: list[Start]) -> list[Start]:
    """The first of each law at each place; after the leaders the first of each group that is not among them."""
    seen, found = set(), []
    for one in order:
        key = one.hypothesis.law.key, id(one.hypothesis.place)
        if key not in seen:
            seen.add(key)
            found.append(one)
    known = {one.hypothesis.law.group for one in found[:POLISHED]}
    groups, others = [], []
    for one in found[POLISHED:]:
        (others if one.hypothesis.law.group in known else groups).append(one)
        known.add(one.hypothesis.law.group)
    return found[:POLISHED] + groups + others
