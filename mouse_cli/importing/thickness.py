"""K and M of sets of shells by powers of their thickness t, from exports at two thicknesses, checked at a third.

With degrees of freedom in which strains are c_0 + c_1 z, c_0 the same at every t and c_1 z of the order of t, a flat shell has
K = (t / t_0) K_1 + (t / t_0)^3 K_3, membrane and bending, and M likewise with rotary inertia. CalculiX makes solids of shells: what
their faces move beside the mean of a node (`dofs`) is half of t times a rotation or a strain and goes by t, the quadratic motion
of C3D8I through the thickness, which no other element shares, by t^2. Where shells meet it has rotations as they are.
"""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli._errors import ERROR, WARNING, DeckError, Diagnostic
from mouse_cli._span import Span
from mouse_cli.importing.calculix import Exported, Solver
from mouse_cli.importing.cards import Card
from mouse_cli.importing.jobs import export, probed
from mouse_cli.importing.model import InputModel, layered
from mouse_cli.importing.separate import Parts, parts
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.held import Thickness

_SIZE, _OTHER = 1.25, 0.8  # t / t_0 of the exports, and of the one that checks
_OPEN = 1e-9  # of the largest difference: what the powers may leave of the export that checks; low modes go by small elements
_ROUNDING = 1e-11  # of the largest element
_INNER = 1e-6  # relative: to which the stiffness of an inner motion goes by 1 / t


def chosen(model: InputModel, names: tuple[str, ...]) -> list[Card]:
    """Shell sections of those element sets. Raises DeckError (MD272) where there is none."""
    sections = (c for c in model.kept if c.keyword == "SHELL SECTION" and not layered(c))
    shells = {c.options.get("ELSET", ""): c for c in sections}
    absent = [name for name in names if name.upper() not in shells]
    if absent:
        message = f"--thickness {absent[0]}: no *SHELL SECTION of one thickness is for that element set"
        help = f"give one of {', '.join(shells)}" if shells else "only shells have a thickness"
        raise DeckError.of("MD272", message, Span(model.path, 1), help=help)
    return [shells[name.upper()] for name in dict.fromkeys(names)]


def thicknesses(model: InputModel, found: Parts, solver: Solver, asked: list[Card]) -> dict[int, Thickness]:
    """Each group of shells (number) by its powers; none, with a remark, where they do not hold.

    asked: sections whose thickness must be had. Raises DeckError (MD274, MD275).
    """
    shells = [i for i, group in enumerate(model.groups) if group.shell]
    if not shells:
        return {}
    check = export(model, thick=_OTHER), f"the whole at {_OTHER:g} times the thickness"
    solver.begin([check])
    there, other = parts(model, solver, thick=_SIZE), solver.matrices(*check, *model.known)
    error = np.inf
    if there.whole.K.shape == found.whole.K.shape == other.K.shape:
        motions = _Motions(_order(model, found.whole, there.whole), _means(model, found.whole, solver))
        made = {i: _of_group(model, i, found, there, motions) for i in shells}
        error = max(_left(made.values(), found.whole, other, motions, x) for x in "KM")
    if error <= _OPEN:
        return made
    place = (asked[0] if asked else model.groups[shells[0]].owner).head.span
    message = f"powers of the thickness of shells leave {error:.2g} of what exports differ by"
    if asked:
        raise DeckError(
            Diagnostic("MD275", ERROR, message, place, help="leave out --thickness: the shells are curved, or S4R")
        )
    help = "a diagnosis weighs no thickness: a thinner set stands for itself as one that has lost stiffness and mass"
    model.remarks.append(Diagnostic("MD275", WARNING, message, place, help=help))
    return {}


def total(parts: Iterable[Thickness]) -> Thickness:
    """Several sets of one thickness as one."""
    first, *more = parts
    for each in more:
        K, M = ({n: a.get(n, 0) + b.get(n, 0) for n in a | b} for a, b in ((first.K, each.K), (first.M, each.M)))
        first = replace(first, K=K, M=M)
    return first


@dataclass(frozen=True)
class _Motions:
    """By which power of t the motion of each row goes, order (n,): 0, 1 or 2; of those beside a mean that constraints
    determine, mean (n, n): that mean by the motions of the rows.
    """

    order: np.ndarray
    mean: Matrix | None

    def at(self, size: float) -> Matrix:
        """S (n, n): motions u = S v at `size` times the thickness, of those v at the thickness of the file."""
        S = _diagonal(size ** self.order.astype(float))
        return S if self.mean is None else (S + _diagonal(1 - size ** self.order.astype(float)) @ self.mean).tocsr()


def _means(model: InputModel, whole: Exported, solver: Solver) -> Matrix | None:
    """Means (n, n) that constraints determine, a row for each coordinate beside one; None without any, or where they do not show.

    The solver says how: a spring from the node to one of its own has -1 times the mean in that node's row of K. Numbers of nodes
    that it adds itself come after these.
    """
    from scipy.sparse import csr_array

    follows = list(whole.rows.follows)
    if not follows:
        return None
    text, of = probed(model, follows)
    own, pointed, *rest = model.known
    found = solver.matrices(
        text, "what constraints make of nodes of shells", own, pointed | {node for node, _ in follows}, *rest
    )
    at, last, n = _by_dof(whole), max(model.nodes), whole.K.shape[0]
    entries: list[tuple[int, int, float]] = []
    for i, (node, d) in enumerate(found.rows.dofs.tolist()):
        if node not in of or follows[of[node]][1] != d:
            continue
        row = found.K[[i]].tocoo()
        for j, value in zip(row.col.tolist(), row.data.tolist(), strict=True):
            other, along = _dof(found, j)
            if other in of:
                continue
            column = at.get((other - len(of) if other > last else other, along))
            if column is None:
                return None
            entries += [(k, column, -value) for k in whole.rows.follows[follows[of[node]]]]
    rows, columns, values = zip(*entries, strict=True) if entries else ((), (), ())
    return csr_array((values, (rows, columns)), shape=(n, n))


def _dof(found: Exported, i: int) -> tuple[int, int]:
    """Node and direction of a coordinate: as of the input, or as the solver names what is none of its nodes."""
    node, d = found.rows.names[i].tolist() if found.rows.names[i, 1] else found.rows.dofs[i].tolist()
    return node, d


def _by_dof(whole: Exported) -> dict[tuple[int, int], int]:
    """Coordinates by node and direction, where these are of one row alone, or of a mean."""
    every = [_dof(whole, i) for i in range(len(whole.rows.names))]
    named = {dof for dof, (_, d) in zip(every, whole.rows.names.tolist(), strict=True) if d}
    count = Counter(every)
    return {dof: i for i, dof in enumerate(every) if whole.rows.names[i, 1] or (count[dof] == 1 and dof not in named)}


def _order(model: InputModel, whole: Exported, there: Exported) -> np.ndarray:
    """By which power (n,) of t the motion of each row goes: 0, 1 or 2."""
    shells = {node for group in model.groups if group.shell for e in group.elements for node in model.elements[e][1]}
    faces = np.isin(whole.rows.beside, list(shells)) & (whole.rows.beside > 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        inner = np.abs(there.K.diagonal() * _SIZE / whole.K.diagonal() - 1) < _INNER
    faces[[i for at in whole.rows.follows.values() for i in at]] = True
    quadratic = (faces & whole.rows.middle) | (inner & ~faces & (whole.rows.names[:, 1] == 0))
    return np.where(quadratic, 2, faces)


def _of_group(model: InputModel, i: int, found: Parts, there: Parts, motions: _Motions) -> Thickness:
    nominal = float(model.groups[i].owner.lines[0].words[0])
    return Thickness(
        nominal,
        "",
        *(_powers(getattr(found, x)[i], _scaled(getattr(there, x)[i], motions, _SIZE), motions) for x in "KM"),
    )


def _powers(at: Matrix, there: Matrix, motions: _Motions) -> dict[float, Matrix]:
    """A_1, A_3 and A_5 of at = sum A_n and there = sum s^n A_n: 3 and 5 between quadratic motions, 1 and 3 elsewhere."""
    both = _diagonal((motions.order == 2).astype(float))
    if motions.mean is not None:  # quadratic is what goes beyond the mean
        mean, one = both @ motions.mean, _diagonal(np.ones(len(motions.order)))
        at, there = ((one + mean).T @ each @ (one + mean) for each in (at, there))
    quadratic = both @ at @ both, both @ there @ both
    low, mid = _pair(at - quadratic[0], there - quadratic[1], 1)
    more, high = _pair(*quadratic, 3)
    largest = abs(at).max() if at.nnz else 0.0
    found = {1.0: low, 3.0: mid + more, 5.0: high}
    if motions.mean is not None:
        found = {n: (one - mean).T @ each @ (one - mean) for n, each in found.items()}
    kept = {n: _clean(each, largest) for n, each in found.items()}
    return {n: each for n, each in kept.items() if each.nnz}


def _pair(at: Matrix, there: Matrix, n: int) -> tuple[Matrix, Matrix]:
    """A_n and A_(n + 2)."""
    upper = (there - _SIZE**n * at) / (_SIZE ** (n + 2) - _SIZE**n)
    return at - upper, upper


def _left(made: Iterable[Thickness], whole: Exported, other: Exported, motions: _Motions, name: str) -> float:
    """What the powers leave of the difference between two exports, over the largest of it."""
    moved = _scaled(getattr(other, name), motions, _OTHER) - getattr(whole, name)
    said = sum((_OTHER**n - 1) * each for one in made for n, each in getattr(one, name).items())
    return float(abs(moved - said).max() / max(abs(moved).max(), 1e-300))


def _scaled(matrix: Matrix, motions: _Motions, size: float) -> Matrix:
    """Of the motions at the thickness of the file."""
    S = motions.at(size)
    return (S.T @ matrix @ S).tocsr()


def _diagonal(values: np.ndarray) -> Matrix:
    from scipy.sparse import diags_array

    return diags_array(values)


def _clean(part: Matrix, largest: float) -> Matrix:
    """Without what rounding leaves."""
    part = part.tocsr()
    part.data[abs(part.data) <= _ROUNDING * largest] = 0.0
    part.eliminate_zeros()
    return part
