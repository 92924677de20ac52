"""Include files of Abaqus: *MATERIAL, *SPRING and *MASS with *ROTARY INERTIA."""

from mouse_cli.formats.solver_cards import SolverFormat
from mouse_cli.formats.solver_cards._keywords import keyword_lines
from mouse_cli.model.revision import Revision


def _write(revision: Revision) -> str:
    return "\n".join(keyword_lines(revision, inertia=True)) + "\n"


PROGRAM = SolverFormat("abaqus", _write, "**")
