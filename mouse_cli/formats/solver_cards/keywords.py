"""Include files of Abaqus and CalculiX: *MATERIAL, *SPRING and *MASS; of Abaqus *ROTARY INERTIA too."""

from collections.abc import Iterator

from mouse_cli.formats.solver_cards import SolverFormat, head, number, off_node, tag
from mouse_cli.model.revision import Revision

_IN_LINE = 8  # numbers of elements


def keyword_lines(revision: Revision, inertia: bool) -> Iterator[str]:
    """The lines; inertia: the program has point inertias (ROTARYI)."""
    used: set[str] = set()
    yield from head(revision, "**")
    for material in revision.materials:
        yield from (f"** {material.name}: {note}" for note in material.notes)
        if material.elements:
            yield f"*ELSET,ELSET={tag(f'OF_{material.name}', used)}"
            for i in range(0, len(material.elements), _IN_LINE):
                yield ",".join(map(str, material.elements[i : i + _IN_LINE]))
        yield f"*MATERIAL,NAME={material.name}"
        yield from ("*ELASTIC", f"{number(material.E)},{number(material.nu)}")
        if material.density:
            yield from ("*DENSITY", number(material.density))
    for section in revision.sections:
        yield from (f"** {section.name}: {note}" for note in section.notes)
        values = (
            f"A = {number(section.A)}, Iy = {number(section.Iy)}, Iz = {number(section.Iz)}, J = {number(section.J)}"
        )
        yield f"** section {section.name}: {values}"
    yield from _points(revision, used, inertia)


def _points(revision: Revision, used: set[str], inertia: bool) -> Iterator[str]:
    element = revision.first
    for spring in revision.springs:
        name = tag(spring.name, used)
        yield f"** {spring.name}: {spring.note}"
        yield f"*ELEMENT,TYPE=SPRING{len(spring.ends)},ELSET={name}"
        yield ",".join(map(str, (element, *(node for node, _ in spring.ends))))
        yield f"*SPRING,ELSET={name}"
        yield from (",".join(str(d) for _, d in spring.ends), number(spring.stiffness))
        element += 1
    for mass in revision.masses:
        name = tag(mass.name, used)
        yield f"** {mass.name}: {mass.note}"
        yield from off_node(mass, "**")
        yield from (
            f"*ELEMENT,TYPE=MASS,ELSET={name}",
            f"{element},{mass.node}",
            f"*MASS,ELSET={name}",
            number(mass.mass),
        )
        element += 1
        if any(mass.inertia) and inertia:
            name = tag(f"{mass.name}_turning", used)
            yield from (
                f"*ELEMENT,TYPE=ROTARYI,ELSET={name}",
                f"{element},{mass.node}",
                f"*ROTARY INERTIA,ELSET={name}",
            )
            yield ",".join(map(number, mass.inertia))
            element += 1
        elif any(mass.inertia):
            yield f"** not written: moments of inertia {', '.join(map(number, mass.inertia))}"


def _text(revision: Revision, inertia: bool) -> str:
    return "\n".join(keyword_lines(revision, inertia)) + "\n"


PROGRAMS = (
    SolverFormat("abaqus", lambda revision: _text(revision, inertia=True)),
    SolverFormat("calculix", lambda revision: _text(revision, inertia=False)),
)
