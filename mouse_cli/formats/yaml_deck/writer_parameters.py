"""The `parameters:`, `elements:` and `prior:` of a deck that is written."""

import numpy as np

from mouse_cli.formats.yaml_deck.ids import ranges
from mouse_cli.formats.yaml_deck.text import flow, real, word, wrapped
from mouse_cli.model.arrays import Matrix, dense, sparse_symmetric
from mouse_cli.model.problem import Problem

LARGEST_GROUP = 2000  # elements that one parameter moves; more go to a file
_KEYS = ("stiffness", "mass")


def parameters(problem: Problem, stem: str, attachments: dict[str, Matrix]) -> list[str]:
    """The sections `elements:`, when it differs from what the parameters imply, and `parameters:`."""
    columns = [_column(problem, j) for j in range(len(problem.parameters))]
    columns = [_in_file_order(problem, column) for column in columns]
    lines = _elements(problem, columns)
    if columns:
        lines += ["", "parameters:"]
    for j, column in enumerate(columns):
        lines += _parameter(problem, j, column, f"{stem}_parameter{j + 1}", attachments)
    return lines


def prior(problem: Problem) -> list[str]:
    """The section `prior:`, when the parameters' standard deviations do not tell all."""
    cov = problem.prior.dense()
    if np.array_equal(cov, np.diag([parameter.variance for parameter in problem.parameters])):
        return []
    rows = [f"    - {flow(map(real, row))}" for row in cov]
    return ["", "prior:", "  covariance:", *rows]


Column = dict[str, tuple[np.ndarray, np.ndarray]]  # for each matrix: listed elements (from 0), partials


def _column(problem: Problem, j: int) -> Column:
    """What parameter `j` moves, in the order of the listed elements."""
    column = dense(problem.A[:, [j]]).ravel()
    moved = np.flatnonzero(column)
    is_mass = problem.elements.is_mass[moved]
    return {key: (moved[is_mass == mass], column[moved[is_mass == mass]]) for mass, key in enumerate(_KEYS)}


def _in_file_order(problem: Problem, column: Column) -> Column:
    """A group that goes to a file is read back row by row."""
    found = {}
    for key, (index, values) in column.items():
        if len(index) > LARGEST_GROUP:
            order = np.lexsort((problem.elements.col[index], problem.elements.row[index]))
            index, values = index[order], values[order]
        found[key] = index, values
    return found


def _elements(problem: Problem, columns: list[Column]) -> list[str]:
    implied = [i for key in _KEYS for i in dict.fromkeys(i for c in columns for i in c[key][0].tolist())]
    imported = bool(problem.groups or problem.held)  # their order is of no account, and they are many
    if imported or implied == list(range(len(problem.elements))):
        return []
    lines = ["", "elements:  # order of the varying elements, from 1"]
    for mass, key in enumerate(_KEYS):
        listed = np.flatnonzero(problem.elements.is_mass == mass)
        lines.append(f"  {key}: {wrapped((flow(_pair(problem, i)) for i in listed), 2)}")
    return lines


def _pair(problem: Problem, i: int) -> tuple[str, str]:
    return str(problem.elements.row[i] + 1), str(problem.elements.col[i] + 1)


def _bound(problem: Problem, j: int) -> list[str]:
    """The elements whose property parameter `j` is."""
    own = [binding for binding in problem.bindings if binding.parameter == j]
    if not own:
        return []
    ids = np.unique(np.concatenate([problem.mesh.elements[binding.set].ids[binding.members] for binding in own]))
    names = list(dict.fromkeys(binding.property for binding in own))
    facts = [f"elements: {ranges(ids)}", f"property: {names[0] if len(names) == 1 else flow(names)}"]
    return facts + (["factor: true"] if own[0].factor else [])


def _parameter(problem: Problem, j: int, column: Column, stem: str, attachments: dict[str, Matrix]) -> list[str]:
    parameter, bound = problem.parameters[j], _bound(problem, j)
    facts = [f"name: {word(parameter.name)}", *bound]
    if parameter.nominal or bound:
        facts.append(f"nominal: {real(parameter.nominal)}")
    if parameter.unit or bound:
        facts.append(f"unit: {word(parameter.unit)}")
    facts.append(f"sd: {real(parameter.sd)}")
    facts += [f"{key}: {real(limit)}" for key in ("lower", "upper") if np.isfinite(limit := getattr(parameter, key))]
    if parameter.transform != "identity":
        facts.append(f"transform: {parameter.transform}")
    groups = [
        _group(problem, key, *column[key], f"{stem}_{key}.mtx", attachments) for key in _KEYS if len(column[key][0])
    ]
    short = f"  - {{{', '.join(facts + groups)}}}"
    if len(short) <= 110 and "\n" not in short:
        return [short]
    return ["  - " + facts[0], *(f"    {fact}" for fact in facts[1:] + groups)]


def _group(
    problem: Problem,
    key: str,
    index: np.ndarray,
    values: np.ndarray,
    name: str,
    attachments: dict[str, Matrix],
) -> str:
    if len(index) > LARGEST_GROUP:
        attachments[name] = _group_matrix(problem, index, values)
        return f"{key}: {{file: {word(name)}}}"
    items = [flow((*_pair(problem, i), real(value))) for i, value in zip(index, values, strict=True)]
    return f"{key}: {wrapped(items, 4)}"


def _group_matrix(problem: Problem, index: np.ndarray, values: np.ndarray) -> Matrix:
    row, col = problem.elements.row[index], problem.elements.col[index]
    return sparse_symmetric(row, col, values, problem.structure.n)
