"""Files that say which node and direction each row of a matrix is: one module = one format, whose read(path) gives Rows."""

from mouse_cli.formats import data_files
from mouse_cli.formats.data_files import natural, reject
from mouse_cli.model.dof_map import SCALAR, DofMap
from mouse_cli.model.geometry import DIRECTIONS

_NAMES = {
    **{name: i for i, name in enumerate(DIRECTIONS)},
    **{str(i + 1): i for i in range(len(DIRECTIONS))},
    **{name: i for i, name in enumerate(("UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"))},
    "0": SCALAR,
    "S": SCALAR,
}
Rows = list[
    tuple[int, str, str, str]
]  # of each row of the matrix, in their order: line number, line, node and direction as words


def read_dofs(path: str) -> DofMap:
    """The node and direction of each degree of freedom.

    A direction is one of TX ... RZ, UX ... ROTZ or 1 to 6; 0 or S is that of a scalar. Raises DeckError (MD250 to MD262).
    """
    nothing = "the file names no degree of freedom", "give a node and a direction on each line"
    rows = data_files.rows_of(__name__, path, "a map of degrees of freedom", *nothing)
    seen: dict[tuple[int, int], int] = {}
    for number, line, node, direction in rows:
        span = data_files.line_span(path, number, line)
        if not natural(node) or direction.upper() not in _NAMES:
            message = f"node '{node[:16]}', direction '{direction[:16]}': expected a node number and one of TX ... RZ or 1 to 6"
            reject("MD252", path, message, "write one degree of freedom on each line", span)
        key = int(node), _NAMES[direction.upper()]
        if key in seen:
            reject("MD252", path, f"this degree of freedom stands on line {seen[key]} too", "give each once", span)
        seen[key] = number
    return DofMap([node for node, _ in seen], [direction for _, direction in seen])
