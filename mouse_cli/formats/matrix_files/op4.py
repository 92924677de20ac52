"""Nastran OUTPUT4 files (.op4), text or binary, dense, sparse or BIGMAT: several named matrices in one file.

Own code rather than a package: pyyeti reads them too, but brings a compiler (numba) and pandas, and trusts the sizes in a file.
"""

import numpy as np

from mouse_cli.formats.data_files import FileFormat, line_span, reject
from mouse_cli.formats.matrix_files import MAX_ORDER, choose
from mouse_cli.formats.matrix_files.op4_records import Damaged, Header, Strings, binary_matrices, text_matrices
from mouse_cli.model.arrays import Matrix

_HELP = "write it again: ASSIGN OUTPUT4='k.op4',FORM=FORMATTED (or UNFORMATTED) and OUTPUT4 K//..."


def _read(path: str, variable: str | None) -> Matrix:
    """The matrix `variable`, or the only one, as a scipy.sparse.coo_array."""
    with open(path, "rb") as stream:
        data = stream.read()
    found: dict[str, tuple[Header, Strings]] = {}
    given: dict[str, int] = {}
    try:
        is_text = b"\0" not in data[:8]  # a binary file begins with the length of a record, 24 or 48 in four bytes
        for header, strings in text_matrices(data) if is_text else binary_matrices(data):
            name = _unique(header.name, found, given)
            wanted = variable is None or name.lower() == variable.lower()
            found[name] = header, strings if wanted else []
    except Damaged as error:
        span = line_span(path, error.line, error.text) if error.line else None
        reject("MD252", path, f"not an OUTPUT4 file: {error}", _HELP, span)
    name = choose(path, variable, list(found))
    header, strings = found[name]
    if header.type not in (1, 2):
        reject("MD253", path, f"matrix {name} is complex (type {header.type}); K and M are real", "write a real matrix")
    return _matrix(path, header, strings)


def _unique(name: str, found: dict, given: dict[str, int]) -> str:
    """The name, or where a file of superelements has it already, KAA:2, KAA:3 ...; given: how often each was met."""
    new = name
    while new in found:
        given[name] = given.get(name, 1) + 1
        new = f"{name}:{given[name]}"
    return new


def _matrix(path: str, header: Header, strings: Strings) -> Matrix:
    from scipy.sparse import coo_array

    rows, columns = header.rows, header.columns
    if max(rows, columns) > MAX_ORDER:
        reject("MD258", path, f"matrix {header.name} is {rows} x {columns}; at most {MAX_ORDER} is read", "condense it")
    if not strings:
        return coo_array((rows, columns), dtype=float)
    first, column, count = (
        np.array(x, dtype=np.int64) for x in zip(*((r, c, len(v)) for r, c, v in strings), strict=True)
    )
    ends = np.cumsum(count)
    row = np.arange(ends[-1]) + np.repeat(first - (ends - count), count)
    if (row < 0).any() or (row >= rows).any():
        reject("MD252", path, f"matrix {header.name} has a value outside its {rows} rows", _HELP)
    return coo_array(
        (np.concatenate([v for _, _, v in strings]), (row, np.repeat(column, count))), shape=(rows, columns)
    )


FORMAT = FileFormat("op4", _read, named=True)
