"""Stiffness and mass before and after, and the partial derivatives."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.arrays import dense, is_sparse, upper_triangle
from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Heading, Matrix, Table, Text, heads
from mouse_cli.report.section import APPENDIX, Options, Section
from mouse_cli.report.sections._wording import counted, names


def matrices_before(result: Result, options: Options) -> Iterator[Block]:
    """K, M, S and [A] (elements by properties) of a small model of matrices; elements of a structure have no [A]."""
    problem = result.problem
    if problem.terms or problem.structure.n > options.matrix_dofs or len(problem.parameters) > options.properties:
        return
    dofs, properties = problem.structure.labels, names(problem)
    yield Matrix("stiffness matrix before optimization", dense(result.prior.K), dofs, dofs)
    yield Matrix("mass matrix before optimization", dense(result.prior.M), dofs, dofs)
    cov = problem.prior.cov
    if cov.ndim == 1 or not (cov - np.diag(np.diag(cov))).any():  # what is correlated stands above
        yield Matrix(
            "covariance S of the properties before optimization", problem.prior.dense(), properties, properties
        )
    yield Matrix("[A], elements by properties", dense(problem.A), problem.elements.labels(), properties)


def partials(result: Result, options: Options) -> Iterator[Block]:
    """B by the listed elements, T = B A by the properties; the data are named x(mode,component)."""
    if result.B is None or result.T is None:
        return
    yield Text(
        "lambda i is the eigenvalue of mode i in (rad/s) squared, x(i,u) is component u of mode i. An element off the diagonal "
        "moves together with its mirror image."
    )
    data = result.labels
    elements = result.problem.elements.labels()
    if len(elements):
        yield Matrix("B: by the listed elements", result.B, data, elements, corner=("datum", "element"))
    yield Matrix("T: by the properties", result.T, data, names(result.problem), corner=("datum", "property"))
    if any(p.transform == "log" for p in result.problem.parameters):
        yield Text("Of a property with the transform log, T is the derivative by its natural logarithm.")


_MOST_ENTRIES = 20  # of a matrix that elements of a structure make, which are seldom read one by one


def matrices(result: Result, options: Options) -> Iterator[Block]:
    """Stiffness and mass matrix after revision: in full while they fit the page, else the elements that were revised."""
    for name, mass, before, after in (
        ("stiffness matrix", False, result.prior.K, result.revised.K),
        ("mass matrix", True, result.prior.M, result.revised.M),
    ):
        moved = np.flatnonzero((result.problem.elements.is_mass == mass) & (_change(result) != 0))
        if result.problem.structure.n <= options.matrix_dofs:
            labels = result.problem.structure.labels
            yield Matrix(f"{name} after optimization", dense(after), labels, labels)
        if result.problem.terms and result.problem.structure.n > options.matrix_dofs:
            yield from _entries(result, name, before, after, options.elements)
        elif not len(moved) and not result.problem.terms:
            yield Text(f"No element of the {name} was revised.")
        elif result.problem.structure.n > options.matrix_dofs and len(moved):
            yield from _elements(result, name, moved, before, after, options.elements)


def _entries(result: Result, name: str, before, after, most: int) -> Iterator[Block]:
    """Table of the entries of the matrix called `name` that the terms of the model changed most, on and above its diagonal."""
    row, col, change = upper_triangle(after - before)
    if not len(row):
        yield Text(f"No element of the {name} was revised.")
        return
    largest = np.sort(np.argsort(-np.abs(change), kind="stable")[: min(most, _MOST_ENTRIES)])
    yield Text(
        f"{counted(len(row), 'element')} of the {name} were revised; the {len(largest)} largest changes are shown."
    )
    columns = heads("<row | <column | prior | revised | change")
    labels = result.problem.structure.labels
    before, after = (m.tocsr() if is_sparse(m) else m for m in (before, after))
    rows = tuple(
        (labels[row[k]], labels[col[k]], before[row[k], col[k]], after[row[k], col[k]], change[k]) for k in largest
    )
    yield Heading(f"elements of the {name} that were revised", 2)
    yield Table(columns, rows, keys=2)


def _change(result: Result) -> np.ndarray:
    """Change (e,) of the listed elements, Eq. O-9."""
    return np.asarray(result.problem.A @ (result.revised.theta - result.prior.theta))


def _elements(result: Result, name: str, moved: np.ndarray, before, after, most: int) -> Iterator[Block]:
    """Table of the elements `moved` of the matrix called `name`, the strongest changes only when there are too many."""
    change, listed, labels = _change(result), result.problem.elements, result.problem.elements.labels()
    shown = moved
    if len(moved) > most:
        shown = np.sort(moved[np.argsort(-np.abs(change[moved]), kind="stable")[:most]])
        yield Text(
            f"{counted(len(moved), 'element')} of the {name} were revised; the {most} largest changes are shown."
        )
    yield Heading(f"elements of the {name} that were revised", 2)
    columns = heads("<element | prior | revised | change")
    before, after = (m.tocsr() if is_sparse(m) else m for m in (before, after))
    rows = tuple(
        (labels[k], before[i, j], after[i, j], change[k])
        for k, i, j in zip(shown, listed.row[shown], listed.col[shown], strict=True)
    )
    yield Table(columns, rows)


SECTIONS = (
    Section("matrices-before", 35, "Stiffness and mass matrices before optimization", matrices_before, place=APPENDIX),
    Section("partials", 60, "Partial derivatives at the revised model", partials, place=APPENDIX),
    Section("matrices", 70, "Stiffness and mass matrices after optimization", matrices, place=APPENDIX),
)
