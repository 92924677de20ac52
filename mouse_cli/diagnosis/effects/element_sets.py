"""Named element sets of imported matrices that lose, or gain, stiffness or mass as a whole."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.effects.change import LOST, Change, Recipe, Unknown, product, proportional, steps
from mouse_cli.diagnosis.extend.matrices import NOTHING, Entries, with_entries, with_part_left
from mouse_cli.diagnosis.extend.points import found as new_parameter
from mouse_cli.diagnosis.gates import WHOLLY
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.sets import sets_in
from mouse_cli.model.arrays import Matrix, upper_triangle
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.held import ElementGroup
from mouse_cli.model.problem import Problem
from mouse_cli.model.revision import DENSITY_TIMES, E_TIMES, GONE, MASS_GAINED, MASS_LOST, PART_LEFT

# Share lost of a set that is missing: a thousandth of a stiff plate still holds what it is fastened to, and of a slender part less
# than 1e-8 is lost in the 14 digits of a solver's file.
_GONE = 1 - 1e-7
_MISSING, _HEAVIER = Unknown(LOST, "1", 0.02, _GONE, at_end=WHOLLY), Unknown("share gained", "1", 0.02, 20.0)
LIGHTER = Unknown(LOST, "1", 0.02, 0.99)
_AS_A_WHOLE = Unknown(LOST, "1", 1 - GONE, _GONE)  # of what is lost without it
# Of E and density, over those of the deck: from foam or a plastic for steel to the other way round.
_STIFFER = Unknown("stiffness over that of the deck", "1", 0.02, 50.0)
_DENSER = Unknown("mass over that of the deck", "1", 0.05, 20.0)
_FELT = 1e-6  # share of the energy of a mode below which a set has no part in it


@dataclass(frozen=True)
class _Part:
    """What a set gives to one matrix: stored (n, n), at the nominal parameters; own (r, r), where causes are weighed.

    slopes (p,): how its share grows with each parameter; grows: the same over the share that is there.
    """

    stored: Matrix
    own: np.ndarray
    slopes: np.ndarray
    grows: np.ndarray

    def entries(self, sign: int) -> Entries:
        """Of `stored`, times `sign`."""
        row, col, values = upper_triangle(self.stored)
        return row, col, sign * values


_Set = tuple[ElementGroup, _Part | None, _Part | None]  # what it gives to K and to M


def listed(model: Reduced) -> list[tuple[str, Entries, np.ndarray]]:
    """Sets with stiffness: name, entries of -K in the matrices of the model, and K (r, r)."""
    return [(text(group), K.entries(-1), K.own) for group, K, _ in _sets(model) if K is not None]


def missing(model: Reduced, candidate) -> list[Recipe]:
    """K - d K_s and M - d M_s of each set that has both: a part that is missing, wholly or in part, or thinner; and what K and M
    lose without it, where others hold less then.
    """
    found, without = _held(model), _without(model)
    whole = [(group, *without[group.name]) for group, *_ in found if group.name in without]
    shares = [(each, _MISSING) for each in found] + [(each, _AS_A_WHOLE) for each in whole]
    return [_missing(candidate, *each, len(shares), share) for each, share in shares]


def heavier(model: Reduced, candidate) -> list[Recipe]:
    """M + d M_s of each set but point masses: a lining, a filling, something that is fastened all over it."""
    found = [(group, M) for group, K, M in _sets(model) if M is not None and not _is_point(group, K)]
    return [_weighed(candidate, *each, len(found), _HEAVIER, MASS_GAINED, 1) for each in found]


def heavier_points(model: Reduced, candidate) -> dict[int, Recipe]:
    """The same of each set that is a mass at one node, by that node; their prior is that of masses there."""
    found = [(group, M) for group, K, M in _sets(model) if M is not None and _is_point(group, K)]
    return {group.nodes[0]: _weighed(candidate, group, M, 1, _HEAVIER, MASS_GAINED, 1) for group, M in found}


def _is_point(group: ElementGroup, K: _Part | None) -> bool:
    """Whether a set is nothing but mass at one node, as *MASS is."""
    return K is None and len(group.nodes) == 1


def lighter(model: Reduced, candidate) -> list[Recipe]:
    """M - d M_s of each set: a tank that is empty, a lining that is gone."""
    found = [(group, M) for group, _, M in _sets(model) if M is not None]
    return [_weighed(candidate, *each, len(found), LIGHTER, MASS_LOST, -1) for each in found]


def remade(model: Reduced, candidate) -> list[Recipe]:
    """(a - 1) K_s and (b - 1) M_s of each set that has both: a part of another material."""
    found = _held(model)
    return [_remade(candidate, *each, len(found)) for each in found]


def text(group: ElementGroup) -> str:
    """A set in words."""
    return f"element set {group.name}"


def _missing(candidate, group: ElementGroup, K: _Part, M: _Part, count: int, share: Unknown) -> Recipe:
    def extend(problem: Problem, values: np.ndarray) -> Problem:
        left = new_parameter(PART_LEFT.format(group.name), 1 - values[0], "1")
        return with_part_left(problem, left, K=(K.entries(1), K.slopes), M=(M.entries(1), M.slopes))

    found = _recipe(candidate, share, group, count, (K.own, M.own), -1, extend)
    return replace(found, grows=(K.grows, M.grows), title=lambda values: "a missing part" if values[0] > 1 - GONE else "")


def _remade(candidate, group: ElementGroup, K: _Part, M: _Part, count: int) -> Recipe:
    def extend(problem: Problem, values: np.ndarray) -> Problem:
        stiffer, denser = (
            new_parameter(name.format(group.name), value, "1")
            for name, value in zip((E_TIMES, DENSITY_TIMES), values, strict=True)
        )
        deck = with_part_left(problem, stiffer, K=(K.entries(1), K.slopes), M=(NOTHING, M.slopes))
        return with_part_left(deck, denser, K=(NOTHING, K.slopes), M=(M.entries(1), M.slopes))

    site = Site("dof", (), None, text(group))
    return Recipe(
        candidate,
        (_STIFFER, _DENSER),
        lambda values: Change(K=(values[0] - 1) * K.own, M=(values[1] - 1) * M.own),
        product(steps(_STIFFER, 6), steps(_DENSER, 4)),
        lambda values: site,
        log_prior=-float(np.log(count)),
        extend=extend,
        grows=(K.grows, M.grows),
    )


def _weighed(candidate, group: ElementGroup, M: _Part, count: int, share: Unknown, name: str, sign: int) -> Recipe:
    def extend(problem: Problem, values: np.ndarray) -> Problem:
        return with_entries(problem, new_parameter(name.format(group.name), values[0], "1"), M=M.entries(sign))

    return _recipe(candidate, share, group, count, (np.zeros_like(M.own), M.own), sign, extend)


def _recipe(candidate, share: Unknown, group: ElementGroup, count: int, of: tuple, sign: int, extend) -> Recipe:
    """of: K and M (r, r) that are added, times `sign`, for a share of 1."""
    K, M = of
    site = Site("dof", (), None, text(group))
    return proportional(candidate, share, 4, site, -float(np.log(count)), extend, K=sign * K, M=sign * M)


def _held(model: Reduced) -> list[_Set]:
    """Sets with stiffness and mass, and a share in the energy of a measured mode."""
    return [each for each in _sets(model) if None not in each[1:] and has_energy(model, each[1].own)]


def _sets(model: Reduced) -> list[_Set]:
    """All sets; a parameter such as E of a material moves what its sets give, and a set that is missing goes with it."""
    of_each = []
    for name in "KM":
        sets = sets_in(model, name)
        of_each.append([
            None if stored is None else _Part(stored, own if factor == 1 else factor * own, slopes, slopes / factor)
            for stored, own, factor, slopes in zip(
                sets.stored, sets.projected, sets.factors(model), sets.slopes.T, strict=True
            )
        ])  # fmt: skip
    return list(zip(model.problem.groups, *of_each, strict=True))


def _without(model: Reduced) -> dict[str, tuple[_Part, _Part]]:
    """By name of a set what K and M lose without it, where that is more than it gives; it grows as what the set gives."""
    found: dict[str, list[_Part]] = {}
    for name in "KM":
        sets = sets_in(model, name)
        for i, (factor, slopes) in enumerate(zip(sets.factors(model), sets.slopes.T, strict=True)):
            if sets.missing[i] is not None:
                part = _Part(sets.missing[i], factor * sets.less[i], slopes, slopes / factor)
                found.setdefault(model.problem.groups[i].name, []).append(part)
    return {name: tuple(parts) for name, parts in found.items() if len(parts) == 2}


def has_energy(model: Reduced, K: np.ndarray) -> bool:
    """Whether a set holds a share of the energy of a measured mode."""
    count = model.low_modes()
    scale = np.maximum(model.eigenvalues[:count], 1e-9 * model.eigenvalues[-1])
    return bool((np.diag(K)[:count] / scale).max() > _FELT)
