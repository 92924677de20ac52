"""Include files of Nastran: MAT1, PBAR, CELAS2 and CONM2 in large fields of 16 columns."""

from collections.abc import Iterator

from mouse_cli.formats.solver_cards import SolverFormat, head
from mouse_cli.model.revision import RevisedSection, Revision

Field = float | int | str
_IN_LINE = 8  # numbers of elements


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
    weight = revision.job.weight if revision.job else 1.0
    for i, material in enumerate(revision.materials, 1):
        yield from (f"$ {material.name}: {note}" for note in material.notes)
        known = revision.job.materials.get(material.name) if revision.job else None
        if known is None:
            yield f"$ MID {i} is {material.name}: give it the MID that it has in the model"
            yield from _of(material.elements)
        yield from _wide(
            "MAT1", known or i, float(material.E), "", float(material.nu), float(material.density or 0.0) / weight
        )
    for i, section in enumerate(revision.sections, 1):
        yield from (f"$ {section.name}: {note}" for note in section.notes)
        yield from _section(revision, section, i)
    count = iter(range(revision.first, revision.first + len(revision.springs) + len(revision.masses)))
    for spring in revision.springs:
        yield f"$ {spring.name}: {spring.note}"
        ends = [part for end in spring.ends for part in end]
        yield from _wide("CELAS2", _number(revision, spring.number, count), spring.stiffness, *ends)
    for mass in revision.masses:
        yield f"$ {mass.name}: {mass.note}"
        x, y, z, xy, xz, yz = (each / weight for each in (*mass.inertia, *mass.products))
        about = (x, xy or "", y, xz or "", yz or "", z) if any(mass.inertia) or any(mass.products) else ()
        off = (*mass.offset, "", *about) if about or any(mass.offset) else ()
        yield from _wide("CONM2", _number(revision, mass.number, count), mass.node, 0, mass.mass / weight, *off)


def _of(elements: tuple[int, ...]) -> Iterator[str]:
    """Comments with the numbers of elements that a card is for."""
    for i in range(0, len(elements), _IN_LINE):
        yield f"$ of elements {', '.join(map(str, elements[i : i + _IN_LINE]))}"


def _section(revision: Revision, section: RevisedSection, i: int) -> Iterator[str]:
    """A PBAR in the place of the property that the job has by this name; without a job, to be numbered."""
    own = revision.job.sections.get(section.name) if revision.job else None
    constants = section.A, section.Iz, section.Iy, section.J
    if own is None:
        yield f"$ PID {i} is {section.name}: give it the PID and MID that it has in the model"
        yield from _of(section.elements)
        yield from _wide("PBAR", i, 1, *constants)
        return
    if own.turned:
        yield f"$ not written: PBAR {own.number} has a product of inertia I12; about principal axes it has"
        yield "$ A, I1, I2 and J of " + ", ".join(f"{value:.6g}" for value in constants)
        return
    shear = (*[""] * 9, *own.shear) if any(own.shear) else ()
    yield from _wide("PBAR", own.number, own.material, *constants, own.mass or "", *shear)


def _number(revision: Revision, own: int | None, count: Iterator[int]) -> int:
    """That of an element of the job, whose card it replaces, else the next new one."""
    return own if revision.job and own in revision.job.elements else next(count)


PROGRAM = SolverFormat("nastran", lambda revision: "\n".join(_lines(revision)) + "\n")
