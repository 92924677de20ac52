"""Include files of ANSYS: MP, COMBIN14 and MASS21, for /INPUT in /PREP7."""

from collections.abc import Iterator

from mouse_cli.formats.solver_cards import SolverFormat, head, number, off_node
from mouse_cli.model.revision import Revision

_TYPES = 900  # element types and real constants of the new elements count from here


def _lines(revision: Revision) -> Iterator[str]:
    yield from head(revision, "!")
    yield "/PREP7"
    for i, material in enumerate(revision.materials, 1):
        yield from (f"! {material.name}: {note}" for note in material.notes)
        yield f"! material {i} is {material.name}: give it the number that it has in the model"
        for label, value in (("EX", material.E), ("PRXY", material.nu), ("DENS", material.density)):
            if value is not None:
                yield f"MP,{label},{i},{number(value)}"
    for section in revision.sections:
        yield from (f"! {section.name}: {note}" for note in section.notes)
        yield f"! section {section.name}: ASEC of A, Iyy, Iyz, Izz, Iw, J; give it the number that it has in the model"
        yield f"! SECDATA,{number(section.A)},{number(section.Iy)},0,{number(section.Iz)},0,{number(section.J)}"
    yield from _points(revision)
    yield "FINISH"


def _points(revision: Revision) -> Iterator[str]:
    number_of = _TYPES
    for spring in revision.springs:
        (node, direction), other = spring.ends[0], spring.ends[1:]
        yield f"! {spring.name}: {spring.note}"
        if other and other[0][1] != direction:
            yield "! not written: its ends move in different directions"
            continue
        yield from (
            f"ET,{number_of},COMBIN14",
            f"KEYOPT,{number_of},2,{direction}",
            f"R,{number_of},{number(spring.stiffness)}",
        )
        yield from (f"TYPE,{number_of}", f"REAL,{number_of}")
        if other:
            yield f"E,{node},{other[0][0]}"
        else:
            yield from ("*GET,MOUSE_N,NODE,,NUM,MAX", f"N,MOUSE_N+1,NX({node}),NY({node}),NZ({node})")
            yield from ("D,MOUSE_N+1,ALL,0", f"E,{node},MOUSE_N+1")
        number_of += 1
    for mass in revision.masses:
        yield f"! {mass.name}: {mass.note}"
        yield from off_node(mass, "!")
        values = ",".join(number(v) for v in (mass.mass, mass.mass, mass.mass, *mass.inertia))
        yield from (
            f"ET,{number_of},MASS21",
            f"R,{number_of},{values}",
            f"TYPE,{number_of}",
            f"REAL,{number_of}",
            f"E,{mass.node}",
        )
        number_of += 1


PROGRAM = SolverFormat("ansys", lambda revision: "\n".join(_lines(revision)) + "\n", whole=False)
