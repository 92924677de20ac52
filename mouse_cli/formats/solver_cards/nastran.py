"""Include files of Nastran: MAT1, PBAR, CELAS2 and CONM2 in large fields of 16 columns."""

from collections.abc import Iterator

from mouse_cli.formats.solver_cards import SolverFormat, head
from mouse_cli.model.revision import Revision

Field = float | int | str


def _wide(card: str, *fields: Field) -> Iterator[str]:
    """One card: four fields in a line, continued on lines that begin with *."""
    words = [f"{_shown(field):>16}" for field in fields]
    for i in range(0, len(words), 4):
        yield f"{card + '*' if i == 0 else '*':<8}" + "".join(words[i : i + 4]).rstrip()
    if len(words) <= 4:
        yield "*"


def _shown(field: Field) -> str:
    return f"{field:.9E}" if isinstance(field, float) else str(field)


def _lines(revision: Revision) -> Iterator[str]:
    yield from head(revision, "$")
    for i, material in enumerate(revision.materials, 1):
        yield from (f"$ {material.name}: {note}" for note in material.notes)
        yield f"$ MID {i} is {material.name}: give it the MID that it has in the model"
        yield from _wide("MAT1", i, float(material.E), "", float(material.nu), float(material.density or 0.0))
    for i, section in enumerate(revision.sections, 1):
        yield from (f"$ {section.name}: {note}" for note in section.notes)
        yield f"$ PID {i} is {section.name}: give it the PID and MID that it has in the model"
        yield from _wide("PBAR", i, 1, section.A, section.Iz, section.Iy, section.J)
    element = revision.first
    for spring in revision.springs:
        yield f"$ {spring.name}: {spring.note}"
        ends = [part for end in spring.ends for part in end]
        yield from _wide("CELAS2", element, spring.stiffness, *ends)
        element += 1
    for mass in revision.masses:
        yield f"$ {mass.name}: {mass.note}"
        x, y, z = mass.inertia
        turning = ("", "", "", "", x, "", y, "", "", z) if any(mass.inertia) else ()
        yield from _wide("CONM2", element, mass.node, 0, mass.mass, *turning)
        element += 1


PROGRAM = SolverFormat("nastran", lambda revision: "\n".join(_lines(revision)) + "\n")
