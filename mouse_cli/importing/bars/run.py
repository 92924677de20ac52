"""The import of a model of bars: read, built once to see that it is sound, written as a deck."""

import os
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from mouse_cli._atomic import write_text_atomically
from mouse_cli._errors import WARNING, DeckError, Diagnostic
from mouse_cli._span import Span
from mouse_cli.formats.rules.model import FAULTS
from mouse_cli.formats.yaml_deck.text import word
from mouse_cli.formats.yaml_deck.writer_structure import structure
from mouse_cli.importing.bars.parts import Bars
from mouse_cli.importing.bars.read import bars_of
from mouse_cli.importing.deck import DENSITY_SD, E_SD, SPRING_SD, stub
from mouse_cli.importing.material_units import units_of
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import Mesh

__all__ = ["ImportedBars", "bars_of", "imported_bars"]
_COUNT = 8  # frequencies that are found and reported
_RIGID = 1e-9  # eigenvalues below this share of the highest found are motions of a rigid body


@dataclass(frozen=True)
class ImportedBars:
    """What an import of bars made. hz (m,): the lowest elastic frequencies; mass: of everything."""

    mesh: Mesh
    order: int
    hz: np.ndarray
    mass: float
    files: list[Path]
    system: str
    remarks: tuple[Diagnostic, ...]

    def text(self) -> str:
        """What was read, checked and written, in a few lines."""
        counts: dict[str, int] = {}
        for members in self.mesh.elements:
            counts[members.type] = counts.get(members.type, 0) + len(members)
        hz = ", ".join(f"{f:.5g}" for f in self.hz) or "none"
        own = f" and {len(self.files) - 1} tables" if len(self.files) > 1 else ""
        return "\n".join([
            f"{len(self.mesh.node_ids)} nodes, {', '.join(f'{n} {kind}' for kind, n in counts.items())}; "
            f"{self.order} degrees of freedom; units {self.system or 'unknown'}",
            f"mass {self.mass:.6g}; frequencies of mouse's own elements: {hz} Hz: compare them with those of the job",
            f"written: {self.files[-1]}{own}",
        ])  # fmt: skip


def imported_bars(
    bars: Bars, path: str, target: Path, system: str | None, thickness: tuple[str, ...] = ()
) -> ImportedBars:
    """Makes the deck `target` of a model of bars. Raises DeckError, WrittenError."""
    if thickness:
        message = f"{thickness[0]} is no element set of shells: the job has bars alone"
        raise DeckError.of("MD272", message, Span(path, 1), help="leave --thickness out")
    mesh = bars.mesh()
    named = system or units_of((own["E"], own.get("density", 0.0)) for own in bars.materials.values())
    order, hz, mass = _checked(bars, mesh, path)
    tables: dict[str, str] = {}
    lines = [
        f"# Made by mouse import of {os.path.basename(path)}: {order} degrees of freedom, of mouse's own elements.",
        "mouse: 1",
        f"title: {word(_title(bars, path), flow=False)}",
        *([f"units: {named}"] if named else []),
        "model:",
        *structure(mesh, target.stem, tables),
        *_parameters(bars, mesh),
        *stub(hz, f"{mesh.node_ids[-1]}TZ"),
    ]
    files = [target.parent / name for name in tables]
    for file, text in zip(files, tables.values(), strict=True):
        write_text_atomically(file, text)
    write_text_atomically(target, "\n".join(lines) + "\n")
    remarks = tuple(_remarks(bars, path, named if not system else None))
    return ImportedBars(mesh, order, hz, mass, [*files, target], named, remarks)


def _title(bars: Bars, path: str) -> str:
    """TITLE of case control."""
    head = (line.partition("=") for line in bars.deck.bulk.lines[: bars.deck.bulk.begun])
    given = [text.strip() for name, _, text in head if name.strip().upper() == "TITLE"]
    return given[0] if given and given[0] else os.path.basename(path)


def _parameters(bars: Bars, mesh: Mesh) -> list[str]:
    """E and density of each material that elements have, each spring."""
    used = {(name, source) for members in mesh.elements for name, source in members.origin.items()}
    lines = []
    for name in bars.materials:
        for key, sd in (("E", E_SD), ("density", DENSITY_SD)):
            if (key, name) in used:
                lines.append(f"name: {word(f'{key} of {name}')}, material: {word(name)}, property: {key}, sd: {sd}")
    for spring in bars.springs:
        name = word(f"stiffness of {spring.name}")
        lines.append(f"name: {name}, elements: {spring.number}, property: {spring.direction}, sd: {SPRING_SD}")
    return ["", "parameters:", *(f"  - {{{line}, transform: log}}" for line in lines)] if lines else []


def _checked(bars: Bars, mesh: Mesh, path: str) -> tuple[int, np.ndarray, float]:
    """Order of the model, frequencies and mass. Raises DeckError at the card that is at fault."""
    from mouse_cli.dynamics.eigen import IndefiniteError
    from mouse_cli.dynamics.solver import eigensolution
    from mouse_cli.terms.assembly import Assembly
    from mouse_cli.terms.build import built
    from mouse_cli.terms.faults import MeshFault

    try:
        found = built(mesh)
    except MeshFault as fault:
        code = FAULTS.get(type(fault).__name__, "MD418")
        raise DeckError.of(code, str(fault), _place(bars, fault, path), help=fault.help) from None
    n = found.structure.n
    K, M = Assembly(found.structure, found.terms, 0).matrices(np.zeros(0))
    unlike = "the job has no frequencies" if n else "nothing of the job may move"
    try:
        if not n or not M.diagonal().any():
            raise np.linalg.LinAlgError("it has no mass" if n else "every direction is held, or has no stiffness")
        values = eigensolution(K, M, min(_COUNT + 6, n)).eigenvalues
    except (IndefiniteError, np.linalg.LinAlgError) as reason:
        help = "give densities or CONM2, and hold what has neither stiffness nor mass"
        raise DeckError.of("MD263", f"{unlike}: {reason}", Span(path, 1), help=help) from reason
    elastic = values[values > _RIGID * values.max(initial=0.0)][:_COUNT]
    return n, np.sqrt(elastic) / (2 * np.pi), _mass(mesh)


def _mass(mesh: Mesh) -> float:
    """Mass of everything, held or not: x' M x of a rigid translation x, in the direction in which most of it moves."""
    from mouse_cli.terms.assembly import Assembly
    from mouse_cli.terms.build import built

    found = built(replace(mesh, supports=np.zeros((0, 2), int)), searched=False)
    _, M = Assembly(found.structure, found.terms, 0).matrices(np.zeros(0))
    labels = np.array(found.structure.labels)
    along = (np.char.endswith(labels, direction).astype(float) for direction in DIRECTIONS[:3])
    return max(float(x @ (M @ x)) for x in along)


def _place(bars: Bars, fault, path: str) -> Span:
    """The card of the first element or grid point that a fault names."""
    cards = [part.card for part in bars.parts if part.number in fault.elements[:1]]
    cards += [bars.deck.grid_cards[node] for node in fault.nodes[:1] if node in bars.deck.grid_cards]
    return bars.deck.bulk.where(cards[0]) if cards else Span(path, 1)


def _remarks(bars: Bars, path: str, named: str | None):
    """Warnings: directions of points that are basic now, and units that were deduced."""
    turned = [node for node, card in bars.deck.grid_cards.items() if bars.systems.turned(card)]
    help = "state measured shapes in these directions, or give sensors theirs"
    if not np.allclose(bars.systems.made[0].R, np.eye(3), rtol=0, atol=1e-9):
        message = "all grid points move in one system of their own: the deck has its directions, and its coordinates"
        yield Diagnostic("MD276", WARNING, message, bars.deck.bulk.where(bars.deck.of("GRID")[0]), help=help)
    if turned:
        message = (
            f"grid point {turned[0]} has directions of its own ({len(turned)} such points), in the deck those of all"
        )
        yield Diagnostic("MD276", WARNING, message, bars.deck.bulk.where(bars.deck.grid_cards[turned[0]]), help=help)
    if named is not None:
        text = (
            f"taken for {named}, as E and density of its materials are" if named else "not determined by its materials"
        )
        yield Diagnostic("MD276", WARNING, f"the units of the job are {text}", Span(path, 1), help="give --units")
