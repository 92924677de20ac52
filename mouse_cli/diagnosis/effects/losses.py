"""Elements other than bars, springs between degrees of freedom, and groups of matrix elements, that lose or gain stiffness."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects import element_sets
from mouse_cli.diagnosis.effects.change import LOST, Change, Recipe, Unknown
from mouse_cli.diagnosis.effects.of_sets import Growth, matrices_of
from mouse_cli.diagnosis.effects.rows import runs
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.matrices import Entries, of_matrices, with_entries
from mouse_cli.diagnosis.extend.points import found as new_parameter
from mouse_cli.diagnosis.gates import WHOLLY
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.left_out import Left, left_out
from mouse_cli.diagnosis.sites.lines import elements as in_words
from mouse_cli.diagnosis.sites.points import wanted
from mouse_cli.model.arrays import dense
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem
from mouse_cli.model.revision import GONE

_MOST, _RUNS = 60, 240  # places, and runs of them in a row, that are looked at: those that hold most energy in the lowest modes
_FEW = 12  # directions of them that a search in few coordinates knows to soften
_STIFF = {"rod": ("E",), "spring": DIRECTIONS, "storey": DIRECTIONS, "joint": DIRECTIONS}
_BEGIN, _GAINS = (0.1, 0.5, 0.9), (0.1, 1.0, 8.0)  # shares to begin from: what is left of a stiffness counts
_LOST, _GAINED = Unknown(LOST, "1", 0.02, 0.999, at_end=WHOLLY), Unknown("share gained", "1", 0.02, 20.0)


def of_elements(model: Reduced, candidate: Candidate, sign: int = -1, directed: bool = False) -> list[Recipe]:
    """K - d K_e of each rod, spring, storey and joint, or K + d K_e by `sign`; directed: of each of its directions alone too, and
    of springs that are one mount, or one kind, or next to one another in a row, alike.
    """
    found = _parts(model, directed)
    sets = _strained(model, _mounts(model, found)) + _runs(model, found) if directed else []
    count = len({each[:2] for each in found}) + len(sets)
    parts = [((each[:2],), *each[2:]) for each in _strained(model, found)] + sets
    growth = Growth(model)
    return [replace(_elements(model, candidate, each, count, sign), grows=growth.of(each[0])) for each in parts]


def loosened(model: Reduced) -> np.ndarray:
    """Forces (c, r) by which springs and joints hold the rest in each direction, a few: those first whose loss tells most.

    With K_e = b b' and g = b'K^-1 b, what is left of it after a share d is lost bears 1 / (1 - d g) times as much as modes show.
    """
    parts = [K for *_, direction, share, K in _parts(model, True) if direction or share == 1.0]
    if not parts:
        return np.zeros((0, model.r))
    at = [int(np.argmax(K.diagonal())) for K in parts]
    b = np.array([K[i] / np.sqrt(max(K[i, i], 1e-300)) for i, K in zip(at, parts, strict=True)])
    return by_effect(model, b)[:_FEW]


def by_effect(model: Reduced, b: np.ndarray, least: float = 0.0) -> np.ndarray:
    """Those b (c, r) first, of stiffnesses b b', whose loss tells most; only such as change an eigenvalue by that share."""
    count = model.low_modes()
    share = b**2 / np.maximum(model.eigenvalues, 1e-9 * model.eigenvalues[-1])
    tells = share[:, :count].max(axis=1) / (1 - _LOST.upper * np.minimum(share.sum(axis=1), 1.0))
    order = np.argsort(-tells, kind="stable")
    return b[order[tells[order] >= least]]


def _parts(model: Reduced, directed: bool) -> list[tuple]:
    """Number of a set, and what `_stiffness` says of its members, for all."""
    mesh = model.problem.mesh
    found = [] if mesh is None else [_stiffness(model, s, directed) for s in range(len(mesh.elements))]
    return [(s, *part) for s, parts in enumerate(found) for part in parts]


def _strained(model: Reduced, found: list) -> list:
    """Those of (..., K_e (r, r)) that hold most energy in the lowest modes, of those that hold any."""
    return [found[i] for i in _most_held([_held(model, each[-1]) for each in found], _MOST)]


def _held(model: Reduced, K: np.ndarray) -> np.ndarray:
    """Shares (m,) of the energies of the lowest modes that K (r, r) holds."""
    count = model.low_modes()
    return np.diag(K)[:count] / np.maximum(model.eigenvalues[:count], 1e-9 * model.eigenvalues[-1])


def _most_held(held: list[np.ndarray], most: int) -> list[int]:
    """Numbers of those that hold the largest share of a mode, in order, of those that hold any."""
    energy = np.array([each.max() for each in held])
    return [i for i in sorted(np.argsort(-energy)[:most].tolist()) if energy[i] > 1e-6]


def _stiffness(model: Reduced, s: int, directed: bool) -> list[tuple[int, str, float, np.ndarray]]:
    """Members of set s, "" or a direction, its share of what is thought of, and K_e (r, r): whole, or of that direction."""
    mesh, keep = model.problem.mesh, wanted(model)
    elements = mesh.elements[s]
    if elements.type not in _STIFF:
        return []
    whole = matrices_of(model, s)["K"]
    rows = {int(n): _node(model, int(n)) for n in np.unique(elements.nodes)}
    chosen = [i for i in range(len(elements)) if keep is None or keep[elements.nodes[i]].any()]
    named = [name for name in _STIFF[elements.type] if directed and name in elements.properties]
    alone = {name: whole - matrices_of(model, s, **{name: 0.0})["K"] for name in named}
    found = []
    for i in chosen:
        u = np.concatenate([rows[int(n)] for n in elements.nodes[i]])
        own = [name for name in alone if alone[name][i].any()]
        parts = [("", whole[i], 0.5 if len(own) > 1 else 1.0)]
        parts += [(name, alone[name][i], 0.5 / len(own)) for name in own if len(own) > 1]
        found += [(i, name, share, u.T @ K @ u) for name, K, share in parts]
    return found


def _node(model: Reduced, n: int) -> np.ndarray:
    """Motion (6, r) of a node, or of a degree of freedom that serves as one."""
    if model.motion is not None:
        return model.node(n)
    return np.vstack([model.V[n : n + 1], np.zeros((5, model.r))])


def _mounts(model: Reduced, found: list[tuple]) -> list[tuple]:
    """Springs between the same nodes, all springs in one direction and all springs: numbers of sets and members, "", 1, and K."""
    mesh, parts = model.problem.mesh, {}
    for s, i, direction, _, K in found:
        own = mesh.elements[s]
        if own.type != "spring" or direction:
            continue
        acts = tuple(name for name in DIRECTIONS if name in own.properties and own.properties[name][i])
        for key in (tuple(own.nodes[i].tolist()), acts, "all"):
            parts.setdefault(key, []).append((s, i, K))
    joined = {tuple(each[:2] for each in own): sum(each[2] for each in own) for own in parts.values() if len(own) > 1}
    return [(of, "", 1.0, K) for of, K in joined.items()]


def _runs(model: Reduced, found: list[tuple]) -> list[tuple]:
    """Springs and joints next to one another in a row, but not all of one kind, that hold most energy: as `_mounts` has them.

    Runs are many, and matrices are summed of those alone that are looked at.
    """
    K = {(s, i): own for s, i, direction, _, own in found if not direction}
    held = {member: _held(model, own) for member, own in K.items()}
    every = runs(model.problem.mesh, list(K)) if K else []
    chosen = _most_held([sum(held[member] for member in of) for of in every], _RUNS)
    return [(every[n], "", 1.0, sum(K[member] for member in every[n])) for n in chosen]


def _elements(model: Reduced, candidate: Candidate, part: tuple, count: int, sign: int) -> Recipe:
    """part: numbers of sets and members that act as one, and what `_stiffness` says of them."""
    which, direction, share, K = part
    mesh = model.problem.mesh
    numbers = tuple(int(mesh.elements[s].ids[i]) for s, i in which)
    nodes = np.unique(np.concatenate([mesh.elements[s].nodes[i] for s, i in which]))
    kind = mesh.elements[which[0][0]].type
    text = in_words(numbers).replace("element", kind) + (f", {direction}" if direction else ", alike" if numbers[1:] else "")
    site = Site("element", numbers, tuple(mesh.coordinates[nodes].mean(axis=0).tolist()), text)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        name = f"stiffness left of {text}" if sign < 0 else f"stiffness of {text}, strengthened"
        given = [edit.element(number) for number in numbers]
        acts: dict[tuple[str, ...], list] = {}
        for s, i in given:
            own = edit.sets[s].properties
            may = (direction,) if direction else _STIFF[kind]
            acts.setdefault(tuple(name for name in may if name in own and own[name][i]), []).append((s, i))
        (first, alike), *others = acts.items()
        edit.bind(name, alike, first, factor=1 + sign * values[0])
        for stiff, alike in others:
            edit.follow(alike, stiff, factor=True)
        return edit.done()

    return _recipe(candidate, sign * K, site, count / share, extend, sign, _left_out(model, which, direction))


def _left_out(model: Reduced, which: tuple[tuple[int, int], ...], direction: str) -> Left | None:
    """What the coordinates of a large model leave out of one element that joins two nodes, or of a direction of it."""
    (s, i), mesh = which[0], model.problem.mesh
    if model.motion is None or len(which) > 1 or mesh.elements[s].nodes.shape[1] != 2:
        return None

    def stiffness(there: Reduced) -> np.ndarray:
        without = matrices_of(there, s, **{direction: 0.0})["K"] if direction else 0.0
        return (matrices_of(there, s)["K"] - without)[[i]]

    return left_out(model, ("element", s, i, direction), mesh.elements[s].nodes[[i]], stiffness)


def _recipe(
    candidate: Candidate, K: np.ndarray, site: Site, count: float, extend, sign: int, left: Left | None = None
) -> Recipe:
    """K: what is added for a share of 1; left: what the coordinates leave out of it."""
    share = _LOST if sign < 0 else _GAINED
    beyond = lambda d: 0.0 if left is None else left.correction(sign * d)
    return Recipe(
        candidate,
        (share,),
        lambda values: Change(K=values[0] * K + beyond(values[0]), spring=(values[0] + sign) * K),
        np.array(_BEGIN if sign < 0 else _GAINS)[:, None],
        lambda values: site,
        log_prior=-float(np.log(count)),
        extend=extend,
        title=lambda values: "a part that bears nothing" if sign < 0 and values[0] > 1 - GONE else "",
    )


def of_springs(model: Reduced, candidate: Candidate, sign: int = -1) -> list[Recipe]:
    """K - d k b b' of each spring that a model of matrices shows, and K - d theta_j dK/dtheta_j of parameters of more than one.

    Or K + d ... by `sign`.
    """
    if not of_matrices(model.problem) or (model.problem.mesh is not None and not len(model.problem.elements)):
        return []
    found = _strained(model, listed_springs(model))
    return [_listed(candidate, sign * K, entries, text, len(found), sign) for text, entries, K in found]


Listed = tuple[str, Entries, np.ndarray]


def listed_springs(model: Reduced) -> list[Listed]:
    """Named element sets of a model of matrices, else springs and groups: name, entries of -K in its matrices, and K (r, r)."""
    return element_sets.listed(model) or _springs(model) + _groups(model)


def _springs(model: Reduced) -> list[Listed]:
    """Pairs of degrees of freedom with K_ij < 0, and what ties them to the ground where all are springs."""
    from scipy.sparse import coo_array

    K, keep = model.assembly.matrices(model.theta)[0], wanted(model)
    labels, at = model.problem.structure.labels, model.problem.structure.geometry
    stored = coo_array(K)
    upper = (stored.row < stored.col) & (stored.data < 0)
    if keep is not None:
        upper &= keep[stored.row] & keep[stored.col]
    if at is not None:
        upper &= (at.direction[stored.row] == at.direction[stored.col]) & (at.direction[stored.row] < 3)
        upper &= at.placed[stored.row] & at.placed[stored.col]
    pairs = zip(stored.row[upper].tolist(), stored.col[upper].tolist(), -stored.data[upper], strict=True)
    found = [
        _spring(model, f"the spring between {labels[i]} and {labels[j]}", k, i, j) for i, j, k in _largest(model, pairs)
    ]
    if not (stored.data[stored.row != stored.col] > 0).any() and K.shape[0] <= 10 * _MOST:
        ground = np.asarray(K.sum(axis=1)).ravel()
        tied = np.flatnonzero(ground > 1e-6 * K.diagonal())
        found += [_spring(model, f"the spring from {labels[i]} to the ground", ground[i], int(i), None) for i in tied]
    return found


def _largest(model: Reduced, pairs) -> list[tuple[int, int, float]]:
    """The pairs (i, j, k) whose springs hold most energy in the lowest modes."""
    count = model.low_modes()
    pairs = list(pairs)
    if not pairs:
        return []
    i, j, k = (np.array(part) for part in zip(*pairs, strict=True))
    energy = (k[:, None] * (model.V[i, :count] - model.V[j, :count]) ** 2).max(axis=1)
    return [pairs[n] for n in sorted(np.argsort(-energy)[:_MOST])]


def _spring(model: Reduced, text: str, k: float, i: int, j: int | None) -> Listed:
    if j is None:
        b, entries = model.V[i], (np.array([i]), np.array([i]), np.array([-k]))
    else:
        b, entries = (
            model.V[i] - model.V[j],
            (np.array([i, i, j]), np.array([i, j, j]), k * np.array([-1.0, 1.0, -1.0])),
        )
    return text, entries, k * np.outer(b, b)


def _groups(model: Reduced) -> list[Listed]:
    """Stiffness that follows a parameter of its own, where that is more than one spring."""
    problem, found = model.problem, []
    listed = problem.elements
    for j, parameter in enumerate(problem.parameters if len(problem.parameters) <= _MOST else ()):
        column = dense(problem.A[:, [j]]).ravel() if len(listed) else np.zeros(0)
        own = np.flatnonzero((column != 0) & ~listed.is_mass)
        if len(own) > 3 and model.theta[j]:
            entries = listed.row[own], listed.col[own], -model.theta[j] * column[own]
            found.append((f"what '{parameter.name}' stands for", entries, model.theta[j] * model.dK[j]))
    return found


def _listed(candidate: Candidate, K: np.ndarray, entries: Entries, text: str, count: int, sign: int) -> Recipe:
    row, col, lost = entries

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        name = f"share {'lost' if sign < 0 else 'gained'} by {text}"
        return with_entries(problem, new_parameter(name, values[0], "1"), K=(row, col, -sign * lost))

    return _recipe(candidate, K, Site("dof", (), None, text), count, extend, sign)
