"""One explanation of the data: its causes with their sites and sizes, and how probable it is."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.model.groups import counted, joined, shares
from mouse_cli.model.site import Site, as_read
from mouse_cli.model.units import Units

Places = tuple[tuple[tuple[Site, ...], float], ...]  # sites of one explanation, and their share in its probability

RIVAL = 0.05  # probability of a group, or share of a place, from which on it is listed with the leading one


@dataclass(frozen=True)
class Size:
    """One parameter of a cause: value and sd in `unit`, and the range (lower, upper) that was held possible."""

    name: str
    unit: str
    value: float
    sd: float
    lower: float
    upper: float


@dataclass(frozen=True)
class Cause:
    """One piece of physics that the model does not have. physics: key of its candidate; group: of those hard to tell apart.

    law: `structural` or `viscous` where FRFs show how its spring loses energy; empty: as the rest of the structure, or unknown.
    """

    physics: str
    group: str
    title: str
    site: Site
    sizes: tuple[Size, ...]
    law: str = ""

    def spelled(self, units: Units) -> "Cause":
        """With the names of the deck's units, in which its values are; those of SI stay where the deck declares none."""
        own = tuple(replace(size, unit=units.of(size.unit)) for size in self.sizes)
        return replace(self, sizes=own) if units.declared else self


@dataclass(frozen=True)
class Explanation:
    """No cause, one or more, fitted together with all parameters of the deck; causes in the order of `group`, then `physics`.

    chi2 on dof: what stays of the data's misfit; p of it; log_evidence: ln of the probability of the data; probability: of this
    explanation among all that were tried. theta (p,): values of the deck's own parameters. elsewhere: rival sites of the same
    causes, and the share of each in this probability. stands: whether it stands for its group, whatever is most probable there.
    """

    causes: tuple[Cause, ...]
    chi2: float
    dof: int
    p: float
    log_evidence: float
    theta: np.ndarray
    probability: float = 0.0
    elsewhere: Places = ()
    stands: bool = False

    def __post_init__(self) -> None:
        order = sorted(range(len(self.causes)), key=lambda i: (self.causes[i].group, self.causes[i].physics))
        sorts = lambda of: tuple(of[i] for i in order) if len(of) == len(order) else tuple(of)
        object.__setattr__(self, "causes", sorts(self.causes))
        object.__setattr__(self, "elsewhere", tuple((sorts(sites), share) for sites, share in self.elsewhere))

    @property
    def sites(self) -> tuple[Site, ...]:
        """One a cause."""
        return tuple(cause.site for cause in self.causes)

    @property
    def group(self) -> str:
        """Groups of its causes, `none` without one; see `joined`."""
        return joined([cause.group for cause in self.causes])

    @property
    def physics(self) -> str:
        """Keys of its causes, `none` without one."""
        return " + ".join(cause.physics for cause in self.causes) or "none"

    @property
    def title(self) -> str:
        """Its causes in words."""
        return counted([cause.title for cause in self.causes]) or "nothing"


def foremost(explanations: Sequence[Explanation], group: str) -> Explanation | None:
    """The explanation that stands for a group, else the first of it; None without any."""
    own = [one for one in explanations if one.group == group]
    return next((one for one in own if one.stands), next(iter(own), None))


def members(explanations: Sequence[Explanation], group: str) -> tuple[tuple[str, float], ...]:
    """Physics of the explanations of `group` and the probability of each within it, the largest first."""
    own = [one for one in explanations if one.group == group]
    total = sum(one.probability for one in own)
    return shares([one.physics for one in own], [one.probability / total for one in own]) if total > 0 else ()


def elsewhere(explanations: Sequence[Explanation], best: Explanation) -> Places:
    """Rival sites of the physics of `best` with more than RIVAL of its probability, the most probable first; the first of all
    where together they have more, and none has.

    Those of one fit stand in its `elsewhere`, others in explanations of the same physics; sites that read alike are the same.
    """
    alike = [one for one in explanations if one.physics == best.physics]
    total = sum(one.probability for one in alike)
    found: dict[tuple, list] = {}
    for one in alike if total > 0 else ():
        for sites, share in (*one.elsewhere, (one.sites, 1 - sum(share for _, share in one.elsewhere))):
            found.setdefault(as_read(sites), [sites, 0.0])[1] += share * one.probability / total
    found.pop(as_read(best.sites), None)
    every = sorted(((sites, share) for sites, share in found.values()), key=lambda each: -each[1])
    open_ = sum(share for _, share in every) > RIVAL
    return tuple(each for i, each in enumerate(every) if each[1] > RIVAL or (open_ and i == 0))
