"""From a mesh to the degrees of freedom and terms of a model."""

import re
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.model.arrays import Matrix, dense, is_sparse
from mouse_cli.model.geometry import DIRECTIONS, Geometry
from mouse_cli.model.mesh import Binding, ElementSet, Mesh
from mouse_cli.model.structure import Structure
from mouse_cli.model.term import Term
from mouse_cli.terms.bound_properties import nominal_properties
from mouse_cli.terms.constraints import Links, Motion, links
from mouse_cli.terms.element_matrices import ElementMatrices
from mouse_cli.terms.element_term import ElementTerm
from mouse_cli.terms.elements import ElementType, Layout, registry
from mouse_cli.terms.elements._beam import span
from mouse_cli.terms.faults import Disconnected, Loose, Remark, Unoriented, ZeroLength, unheld
from mouse_cli.terms.gravity import axial_forces
from mouse_cli.terms.mechanisms import search

LARGEST_DENSE = 500  # degrees of freedom
_LABEL = re.compile(r"(\d+)-?([TR][XYZ])")
_HELD = 1e-16  # a diagonal stiffness below this share of the largest of the element is rounding of its direction
_ALONG = 1e-9  # share of the motion of a node that is along an element, from which on it counts


@dataclass(frozen=True)
class Built:
    """A model made from a mesh: constant part with its degrees of freedom, terms, remarks, and the motion of every node."""

    structure: Structure
    terms: tuple[Term, ...]
    remarks: tuple[Remark, ...]
    motion: Motion


def build(
    mesh: Mesh, bindings: tuple[Binding, ...] = (), base: Structure | None = None
) -> tuple[Structure, tuple[Term, ...]]:
    """Structure and terms of `built`."""
    found = built(mesh, bindings, base)
    return found.structure, found.terms


def built(
    mesh: Mesh, bindings: tuple[Binding, ...] = (), base: Structure | None = None, searched: bool = True
) -> Built:
    """The model of `mesh`: degrees of freedom node by node, one term for each kind of element, nothing constant but `base`.

    base: matrices that the mesh is attached to; their degrees of freedom come first, and are those of the mesh with the same
    label (`12TY`). Directions that no element stiffens are left out, as after AUTOSPC in Nastran. Dense up to
    LARGEST_DENSE degrees of freedom, else sparse. searched: for motions that nothing resists. Raises a MeshFault.
    """
    given = mesh
    mesh, bindings = replace(mesh, elements=mesh.gathered.elements), mesh.gathered.bindings(bindings)
    kinds = [registry()[elements.type] for elements in mesh.elements]
    layouts = [_layout(kind, elements, mesh) for kind, elements in zip(kinds, mesh.elements, strict=True)]
    places = _base_places(mesh, base)
    free = links(mesh, max(0, int(places.max(initial=-1)) + 1 - 6 * len(mesh.node_ids)))
    sets = [_matrices(i, kind, at, mesh, bindings) for i, (kind, at) in enumerate(zip(kinds, layouts, strict=True))]
    motion, remarks = _numbered(mesh, sets, free, places)
    for i in (i for i, kind in enumerate(kinds) if kind.opens):
        layouts[i] = replace(layouts[i], stretches=_stretching(layouts[i], _dofs(mesh.elements[i]), motion))
        sets[i] = _matrices(i, kinds[i], layouts[i], mesh, bindings)
    structure = _structure(given, base, motion, places)
    terms = [ElementTerm(m, _dofs(m.elements), motion) for m in sets]
    K = _nominal_stiffness(structure, terms)
    if searched:
        held = _touched(mesh, sets, free, "K")
        held[6 * mesh.supports[:, 0] + mesh.supports[:, 1]] = True
        remarks += search(mesh, sets, motion, K, held & (motion.counts == 0), np.isin(motion.places, places))
    if mesh.gravity is not None:
        for i, axial in axial_forces(mesh, sets, motion, K).items():
            sets[i] = _matrices(i, kinds[i], replace(layouts[i], axial=axial), mesh, bindings)
            terms[i] = ElementTerm(sets[i], _dofs(sets[i].elements), motion)
    return Built(structure, tuple(terms), remarks, motion)


def _nominal_stiffness(structure: Structure, terms: list[ElementTerm]) -> Matrix:
    """K (n, n) where every property is as the mesh gives it."""
    n, own = structure.n, [term for term in terms if "K" in term.places]
    if not own:
        return structure.K
    row, col = (np.concatenate([getattr(term.places["K"], f) for term in own]) for f in ("row", "col"))
    values = np.concatenate([term.nominal()["K"] for term in own])
    if not is_sparse(structure.K):
        return structure.K + np.bincount(row.astype(np.int64) * n + col, values, minlength=n * n).reshape(n, n)
    from scipy.sparse import coo_array

    return (structure.K + coo_array((values, (row, col)), shape=(n, n))).tocsr()


def _layout(kind: ElementType, elements: ElementSet, mesh: Mesh) -> Layout:
    """Where the elements are. Raises ZeroLength or Unoriented."""
    options = {name: elements.options.get(name, option.default) for name, option in kind.options.items()}
    layout = Layout(mesh.coordinates[elements.nodes], options)
    if kind.reach:
        ends = layout.coordinates + _offsets(options)
        along = ends[:, -1] - ends[:, 0]
        length, size = np.linalg.norm(along, axis=1), np.abs(mesh.coordinates).max(initial=0.0)
        short = length <= 1e-12 * size
        if short.any():
            nodes = mesh.node_ids[np.unique(elements.nodes[short])]
            raise ZeroLength(tuple(elements.ids[short].tolist()), tuple(nodes.tolist()))
        if options.get("orientation") is not None:
            across = np.linalg.norm(np.cross(along, options["orientation"]), axis=1)
            parallel = across <= 1e-8 * length * np.linalg.norm(options["orientation"])
            if parallel.any():
                raise Unoriented(tuple(elements.ids[parallel].tolist()))
    return layout


def _stretching(layout: Layout, dofs: np.ndarray, motion: Motion) -> np.ndarray:
    """Mask (e,) of two-node elements whose ends the model lets move along them; dofs (e, 12)."""
    along = np.abs(span(layout).motion[:, (0, 6)]) > _ALONG
    return (along & (motion.counts[dofs] > 0)[:, None]).any(axis=(1, 2))


def _offsets(options: dict) -> np.ndarray:
    found = np.zeros((2, 3))
    for end, vector in (options.get("offsets") or {}).items():
        found[int(end) - 1] = vector
    return found


def _matrices(i: int, kind: ElementType, layout: Layout, mesh: Mesh, bindings: tuple[Binding, ...]) -> ElementMatrices:
    """Matrices of element set i. Raises Loose."""
    own = tuple(b for b in bindings if b.set == i)
    try:
        return ElementMatrices(kind, mesh.elements[i], layout, own)
    except np.linalg.LinAlgError:
        raise Loose(_loose(kind, mesh.elements[i], layout)) from None


def _loose(kind: ElementType, elements: ElementSet, layout: Layout) -> tuple[int, ...]:
    """Numbers of the elements whose matrices do not exist; all where none is at fault by itself."""
    nominal, found = nominal_properties(kind, elements, layout), []
    for j, number in enumerate(elements.ids.tolist()):
        try:
            kind.matrices(layout.of(np.array([j])), {name: value[[j]] for name, value in nominal.items()})
        except np.linalg.LinAlgError:
            found.append(number)
    return tuple(found or elements.ids.tolist())


def _dofs(elements: ElementSet) -> np.ndarray:
    """Directions of nodes (e, 6 k) as Motion counts them."""
    return (6 * elements.nodes[:, :, None] + np.arange(6)).reshape(len(elements), -1)


def _base_places(mesh: Mesh, base: Structure | None) -> np.ndarray:
    """Row of Motion for each degree of freedom of `base`: a direction of a node of the mesh, or beyond all of them."""
    if base is None:
        return np.zeros(0, int)
    nodes = {int(node): i for i, node in enumerate(mesh.node_ids)}
    found, extra = np.zeros(base.n, int), 6 * len(nodes)
    for i, label in enumerate(base.labels):
        named = _LABEL.fullmatch(label)
        if named and int(named[1]) in nodes:
            found[i] = 6 * nodes[int(named[1])] + DIRECTIONS.index(named[2])
        else:
            found[i], extra = extra, extra + 1
    return found


def _numbered(
    mesh: Mesh, matrices: list[ElementMatrices], free: Links, places: np.ndarray
) -> tuple[Motion, tuple[Remark, ...]]:
    """The motion of all nodes by the degrees of freedom. Raises Disconnected."""
    stiff, heavy = (_touched(mesh, matrices, free, name) for name in ("K", "M"))
    damped = _touched(mesh, matrices, free, "C")
    held = free.stiff(stiff | damped)
    held[places] = True
    lost = _lost(mesh, stiff | damped, places)
    if lost:
        raise Disconnected(tuple(mesh.node_ids[lost].tolist()))
    kept = held & free.free
    order = np.concatenate([places[free.free[places]], np.setdiff1d(np.flatnonzero(kept), places)])
    left = np.flatnonzero(free.stiff(heavy) & free.free & ~kept)
    left = left[(left % 6 < 3)]
    remarks = (unheld(tuple((int(mesh.node_ids[r // 6]), int(r % 6)) for r in left)),) if len(left) else ()
    return free.motion(order.astype(int)), remarks


def _lost(mesh: Mesh, touched: np.ndarray, places: np.ndarray) -> list[int]:
    """Nodes (indices) that neither elements nor imported matrices touch, nor nodes that follow them; those that follow are not."""
    touched = touched.copy()
    touched[places] = True
    used = touched[: 6 * len(mesh.node_ids)].reshape(-1, 6).any(axis=1)
    for _ in mesh.links:  # as many rounds as a chain of links may be long
        ahead = [link.independent for link in mesh.links if used[link.dependent]]
        if used[ahead].all():
            break
        used[ahead] = True
    used[[link.dependent for link in mesh.links]] = True
    return np.flatnonzero(~used).tolist()


def _touched(mesh: Mesh, matrices: list[ElementMatrices], free: Links, name: str) -> np.ndarray:
    """Mask of the directions of nodes in which any element has a diagonal entry of the matrix `name`."""
    found = np.zeros(len(free.free), bool)
    for m, elements in zip(matrices, mesh.elements, strict=True):
        if name in m.diagonals:
            sizes = m.diagonals[name]
            found[_dofs(elements)[sizes > _HELD * sizes.max(axis=1, keepdims=True)]] = True
    return found


def _structure(mesh: Mesh, base: Structure | None, motion: Motion, places: np.ndarray) -> Structure:
    """The constant part: zero, or `base` at its places."""
    k, order = len(mesh.node_ids), motion.places
    nodes, direction = np.where(order < 6 * k, order // 6, -1), np.where(order < 6 * k, order % 6, -1)
    labels = [f"{mesh.node_ids[i]}{DIRECTIONS[d]}" if i >= 0 else "" for i, d in zip(nodes, direction, strict=True)]
    if base is not None:
        named = dict(zip(places.tolist(), base.labels, strict=True))
        labels = [label or named[place] for label, place in zip(labels, order.tolist(), strict=True)]
    pairs = [e.nodes[:, [i, i + 1]] for e in mesh.elements for i in range(e.nodes.shape[1] - 1)]
    pairs += [np.array([[link.independent, link.dependent]]) for link in mesh.links]
    lines = np.concatenate([*pairs, np.zeros((0, 2), int)])
    geometry = Geometry(mesh.node_ids, mesh.coordinates, nodes, direction, lines)
    constant = {name: _constant(name, base, motion, places) for name in ("K", "M", "C", "D")}
    return Structure(**constant, labels=tuple(labels), geometry=geometry)


def _constant(name: str, base: Structure | None, motion: Motion, places: np.ndarray) -> Matrix | None:
    given, n = None if base is None else getattr(base, name), motion.n
    if given is None and name in ("C", "D"):
        return None
    if n <= LARGEST_DENSE:
        T = motion.rows(places)
        return np.zeros((n, n)) if given is None else T.T @ dense(given) @ T
    from scipy.sparse import coo_array, csr_array

    if given is None:
        return csr_array((n, n))
    stored = (given if is_sparse(given) else csr_array(given)).tocoo()
    entry, row, col, factor = motion.spread(places[stored.row], places[stored.col])
    values = stored.data if entry is None else stored.data[entry] * factor
    return coo_array((values, (row, col)), shape=(n, n)).tocsr()
