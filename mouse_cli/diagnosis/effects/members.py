"""Members that lose or gain stiffness as a whole, all of A, Iy, Iz and J by one factor, and their mass with it.

In the coordinates of a large model, what they leave out of a member deforms with it, see `sites/left_out.py`.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import LOST, Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.effects.element_sets import missing
from mouse_cli.diagnosis.effects.of_sets import Growth, OfSets, of_section
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.gates import WHOLLY
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import displacements
from mouse_cli.diagnosis.sites.left_out import left_out
from mouse_cli.diagnosis.sites.members import ONE, SLENDER, Member, members, rods
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem
from mouse_cli.model.revision import GONE

_MOST = 240  # members that are looked at: those that hold most energy in the lowest modes
_HELD = 1e-6  # share of the energy of a mode below which a member has no part in it
_FEW, _WAYS = 24, 2  # ways that a search in few coordinates knows members to soften in, and of one member
_TELLS = 0.01  # share of an eigenvalue that is lost with such a member, at least
_LOST, _GAINED = Unknown(LOST, "1", 0.02, 0.99), Unknown("share gained", "1", 0.02, 20.0)
# Of a member that is missing, its mass alike: a hundredth of a diagonal is as stiff as the chords that do what it did.
_GONE = Unknown(LOST, "1", 0.02, 1 - 1e-7, at_end=WHOLLY)
_STIFF = {"beam": ("E",), "rod": ("E",), "storey": DIRECTIONS}
# Share of a member lost with its mass up to which what the coordinates leave out of it follows: it has inertia, by which what the
# member holds alone swings as before however little of it is left, and static it would all but stand still.
_BALANCED = 0.9
_LAST = 1e-5  # share that is left, about which its mass goes before its stiffness
_SECTIONS = {"beam": ("A", "Iy", "Iz", "J"), "rod": ("A",)}

Beyond = Callable[[float], np.ndarray] | None  # K (r, r) of the share lost or gained
Part = tuple[
    np.ndarray, np.ndarray, np.ndarray
]  # of a set: motion (e, 12, r) of the nodes, K and M (e, 12, 12) of the section


def of_members(model: Reduced, candidate: Candidate, sign: int = -1) -> list[Recipe]:
    """K - d K_e of each member, alone or with M - d M_e of its section; K + d K_e, and the same, by `sign`."""
    if model.motion is None:
        return missing(model, candidate) if sign < 0 else []
    parts: dict[int, Part] = {}
    sets, growth = OfSets(), Growth(model)
    bare = {member.elements: member for member in rods(model.problem.mesh)}
    listed = [*members(model.problem.mesh), *bare.values()]
    recipes = []
    for member, of_kind in chosen(model, listed, parts, _MOST, _HELD):
        K, M = (summed(member, parts, which) for which in (1, 2))
        heavy = bool(np.abs(M).max() > 0)
        share = of_kind - float(np.log(1 + heavy))
        beyond, made = _beyond(model, member, sets, sign), []
        if member.elements not in bare:
            words = ", its stiffness alone" * heavy
            made.append(_recipe(candidate, member, (sign * K, beyond), None, sign, share, model.problem, words))
        if heavy:
            most = np.inf if sign > 0 else _BALANCED
            alike = beyond and (lambda share, beyond=beyond, most=most: beyond(min(share, most)))
            of = (sign * K, alike), sign * M
            made.append(_recipe(candidate, member, *of, sign, share, model.problem, ", its mass alike"))
        recipes += [replace(each, grows=growth.of(member.elements)) for each in made]
    return recipes


def _beyond(model: Reduced, member: Member, sets: OfSets, sign: int) -> Beyond:
    """What a share lost or gained does beyond the coordinates; None: nothing."""
    nodes = np.array([model.problem.mesh.elements[s].nodes[i] for s, i in member.elements])
    left = left_out(model, member.elements, nodes, lambda there: sets.stiffness(there, member.elements))
    return left and (lambda share: left.correction(sign * share))


def softening(model: Reduced) -> np.ndarray:
    """Forces (c, r) by which members hold the rest as it vibrates: those first whose loss tells most, few at most; see `loosened`.

    Of a member K_e those by which it bears the lowest modes: K_e v_j = sum of s b, with b'K^-1 b = 1.
    """
    alone = [] if model.motion is None else [each for each in members(model.problem.mesh) if each.kind == ONE]
    if not alone:
        return np.zeros((0, model.r))
    parts: dict[int, Part] = {}
    tells, b = map(np.concatenate, zip(*(_borne(model, member, parts) for member in alone), strict=True))
    order = np.argsort(-tells, kind="stable")
    return b[order[tells[order] >= _TELLS]][:_FEW]


def _borne(model: Reduced, member: Member, parts: dict[int, Part]) -> tuple[np.ndarray, np.ndarray]:
    """How much of an eigenvalue is lost with each of the strongest forces (_WAYS,) of a member, and these (_WAYS, r)."""
    count, rates = model.low_modes(), np.maximum(model.eigenvalues, 1e-9 * model.eigenvalues[-1])
    borne, held = np.zeros((model.r, count)), []
    for s, i in member.elements:
        if s not in parts:
            parts[s] = of_set(model, s)
        u, K = parts[s][0][i] / np.sqrt(rates), parts[s][1][i]
        borne += u.T @ (K @ u[:, :count])
        held.append((u, K))
    ways, size, _ = (each[..., :_WAYS] for each in np.linalg.svd(borne, full_matrices=False))
    share = sum(np.einsum("iw,ij,jw->w", u @ ways, K, u @ ways) for u, K in held)
    return size**2 / (1 - _LOST.upper * np.minimum(share, 1.0)), (ways * np.sqrt(rates)[:, None]).T


def of_set(model: Reduced, s: int) -> Part:
    """See `Part`; M without what the section only carries."""
    found = of_section(model, s)
    elements = model.problem.mesh.elements[s]
    u = displacements(model.motion, elements.nodes, model.V)
    M = found["M"] if elements.type in SLENDER else np.zeros_like(found["K"])
    return u, found["K"], M


def chosen(
    model: Reduced,
    listed: list[Member],
    parts: dict[int, Part],
    most: int,
    least: float,
    part: Callable[[Reduced, int], Part] = of_set,
) -> list[tuple[Member, float]]:
    """Those of `listed` with most energy in the lowest modes, `most` at most, each with more than a share `least` of one, in order;
    and ln of the share of each in the prior, which is that of kinds alike, and of all of a kind.
    """
    found = [energy(model, member, parts, part) for member in listed]
    order = np.argsort([-each for each in found], kind="stable")[:most]
    own = [listed[i] for i in sorted(order.tolist()) if found[i] > least]
    kinds = [member.kind for member in own]
    return [(member, -float(np.log(len(set(kinds)) * kinds.count(member.kind)))) for member in own]


def energy(
    model: Reduced, member: Member, parts: dict[int, Part], part: Callable[[Reduced, int], Part] = of_set
) -> float:
    """The largest share of the strain energy of a low mode that a member holds, or that `part` of its sets has."""
    count = model.low_modes()
    scale = np.maximum(model.eigenvalues[:count], 1e-9 * model.eigenvalues[-1])
    held = np.zeros(count)
    for s in sorted({s for s, _ in member.elements}):
        if s not in parts:
            parts[s] = part(model, s)
        own = [i for t, i in member.elements if t == s]
        u, K = parts[s][0][own][:, :, :count], parts[s][1][own]
        held += np.einsum("eir,eij,ejr->r", u, K, u, optimize=True)
    return float((np.abs(held) / scale).max())


def summed(member: Member, parts: dict[int, Part], which: int) -> np.ndarray:
    """K or M (r, r) of a member."""
    total = 0.0
    for s in sorted({s for s, _ in member.elements}):
        own = [i for t, i in member.elements if t == s]
        u = parts[s][0][own]
        total = total + u.reshape(-1, u.shape[2]).T @ (parts[s][which][own] @ u).reshape(-1, u.shape[2])
    return total


def _recipe(
    candidate: Candidate,
    member: Member,
    stiff: tuple[np.ndarray, Beyond],
    M: np.ndarray | None,
    sign: int,
    share: float,
    deck: Problem,
    words: str,
) -> Recipe:
    """stiff: K that is added for a share of 1, and what goes beyond it; M: for a share of 1. words: which of both it is."""
    K, beyond = stiff
    d, site = _GAINED if sign > 0 else _LOST if M is None else _GONE, replace(member.site, text=member.site.text + words)
    kind, named = deck.mesh.elements[member.elements[0][0]].type, member.site.text if M is None else site.text
    numbers = [int(deck.mesh.elements[s].ids[i]) for s, i in member.elements]

    def change(values: np.ndarray) -> Change:
        d = values[0]
        added = d * K if beyond is None else d * K + beyond(d)
        return Change(added, None if M is None else (d if sign > 0 else _of_mass(d)) * M, spring=(d + sign) * K)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        own = [edit.element(number) for number in numbers]
        names = _SECTIONS[kind] if M is not None else _stiff(edit, own, kind)
        what = f"left of {named}" if sign < 0 else f"of {named}, strengthened"
        edit.bind(f"{'section' if M is not None else 'stiffness'} {what}", own, names, factor=1 + sign * values[0])
        return edit.done()

    return Recipe(
        candidate,
        (d,),
        change,
        (steps(d, 4) if sign > 0 else np.append(steps(d, 4), d.upper))[:, None],  # that it is missing is common
        lambda values: site,
        log_prior=share,
        extend=extend,
        title=lambda values: "a missing member" if values[0] > 1 - GONE and M is not None and sign < 0 else "",
    )


def _of_mass(d: float) -> float:
    """Share of its mass that a member loses with a share d of its stiffness: as much, but for the last that is left of it.

    That would swing as members like it do, a tuned mass that splits their modes by the root of its mass over theirs.
    """
    return 1 + (1 - d) * float(np.expm1(-(1 - d) / _LAST))


def _stiff(edit: Edit, own: list[tuple[int, int]], kind: str) -> tuple[str, ...]:
    """The properties that the stiffness of a type is in proportion to; G follows E unless it is given."""
    given = edit.sets[own[0][0]].properties
    names = tuple(name for name in _STIFF[kind] if kind != "storey" or name in given)
    return (*names, "G") if kind == "beam" and "G" in given else names
