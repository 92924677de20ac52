"""From the matrices and the structure of a draft to the model: its constant part, its terms, its degrees of freedom."""

from dataclasses import replace

from mouse_cli.formats.draft import Draft, Entries
from mouse_cli.formats.rules import imported, matrices, supports
from mouse_cli.formats.rules import mesh as mesh_rules
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.structure import Structure
from mouse_cli.model.term import Term

_CODES = {
    "Disconnected": "MD410",
    "ZeroLength": "MD411",
    "Unoriented": "MD412",
    "Loose": "MD421",
    "Overconstrained": "MD417",
    "LinkLoop": "MD417",
    "Mechanism": "MD418",
    "NoLoadPath": "MD422",
}
Model = tuple[Structure, tuple[Term, ...]]


def model(draft: Draft) -> Model | None:
    """Structure and terms, after their rules; sets order and labels of the draft. None when a rule is broken."""
    found = {name: getattr(draft, name) for name in ("K", "M", "C", "D")}
    found = {name: matrices.matrix(draft, source, name) for name, source in found.items() if source is not None}
    mesh_rules.mesh(draft)
    if draft.has_errors:
        return None
    if draft.mesh is None:
        base = supports.applied(draft, Structure(**found, labels=draft.labels, geometry=draft.geometry))
        if base is not None:
            _massive(draft, base.K, base.M)
        return None if draft.has_errors else (base, ())
    made = _built(draft, Structure(**found, labels=draft.labels) if found else None)
    if made is not None:
        draft.order, draft.labels = made[0].n, made[0].labels
        _masses(draft, *made)
    return made


def _built(draft: Draft, base: Structure | None) -> Model | None:
    """What the element library makes of the mesh; what it finds wrong becomes a diagnostic."""
    from mouse_cli.terms.build import built
    from mouse_cli.terms.faults import MeshFault

    given = draft.mesh
    on_dofs = bool(given.labels)
    if on_dofs:  # the degrees of freedom are the nodes, and each moves along X
        base = replace(base, labels=tuple(f"{i + 1}TX" for i in range(base.n)))
    try:
        found = built(given.mesh, tuple(given.bindings), base)
    except MeshFault as fault:
        place = mesh_rules.fault_place(given, fault.nodes, fault.elements)
        draft.error(_CODES.get(type(fault).__name__, "MD418"), str(fault), place, help=fault.help)
        return None
    for remark in found.remarks:
        if len(remark.nodes) == len(given.mesh.node_ids) and remark.kind == "floating":
            continue  # a structure that is free as a whole is no slip
        draft.warn("MD423", remark.message, mesh_rules.fault_place(given, remark.nodes, ()))
    structure = found.structure
    if on_dofs:
        structure = replace(structure, labels=given.labels, geometry=None)
    return structure, found.terms


def _masses(draft: Draft, structure: Structure, terms: tuple[Term, ...]) -> None:
    from mouse_cli.terms.assembly import Assembly

    if not structure.n:
        draft.error(
            "MD424", "no direction of the structure is free to move", draft.mesh.span, help="take supports away"
        )
        return
    if draft.has_errors or any(p.sd != p.sd for p in draft.parameters):
        return
    nominal = matrices.nominal(draft)
    _massive(draft, *Assembly(structure, terms, len(nominal)).matrices(nominal))


def _massive(draft: Draft, K: Matrix, M: Matrix) -> None:
    """The rule for masses: zero is allowed in matrices of other programs alone."""
    if draft.M is None or isinstance(draft.M, Entries):
        matrices.positive_masses(draft, M)
    else:
        imported.masses(draft, K, M)
