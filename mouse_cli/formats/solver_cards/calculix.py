"""Include files of CalculiX: *MATERIAL, *SPRING and *MASS."""

from mouse_cli.formats.solver_cards import SolverFormat
from mouse_cli.formats.solver_cards._keywords import keyword_lines
from mouse_cli.model.revision import Revision


def _write(revision: Revision) -> str:
    return "\n".join(keyword_lines(revision, inertia=False)) + "\n"


PROGRAM = SolverFormat("calculix", _write, "**")
