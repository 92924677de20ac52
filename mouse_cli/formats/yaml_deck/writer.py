"""A Problem as a YAML deck that reads back as the same problem; large matrices go to files beside it."""

import os
from dataclasses import fields

from mouse_cli.formats.yaml_deck.kinds import MAX_WHOLE, VERSION
from mouse_cli.formats.yaml_deck.modal_damping import modal_damping_lines
from mouse_cli.formats.yaml_deck.nodes import compose
from mouse_cli.formats.yaml_deck.text import flow, real, word, wrapped
from mouse_cli.formats.yaml_deck.theory import theory_lines
from mouse_cli.formats.yaml_deck.writer_laws import laws
from mouse_cli.formats.yaml_deck.writer_modes import test_lines
from mouse_cli.formats.yaml_deck.writer_parameters import parameters, prior
from mouse_cli.formats.yaml_deck.writer_parts import parts
from mouse_cli.formats.yaml_deck.writer_rows import rows
from mouse_cli.formats.yaml_deck.writer_structure import structure
from mouse_cli.model.arrays import Matrix, is_sparse, upper_triangle
from mouse_cli.model.held import freed
from mouse_cli.model.problem import Problem, RunOptions
from mouse_cli.model.units import system

LARGEST_INLINE = 2000  # stored entries of a matrix; more go to a file


def write(problem: Problem, stem: str = "deck", folder: str | None = None) -> tuple[str, dict[str, Matrix | str]]:
    """The deck, and the matrices and tables (texts) that belong beside it, by file name; names begin with `stem`.

    folder: that the deck is written to, None: that of the deck it was read from. Raises WrittenError where its recordings are not
    below. Whatever a reader could take otherwise is written out, so the result stays the same when defaults change.
    """
    attachments: dict[str, Matrix | str] = {}
    whole = problem if problem.held is None else freed(problem)
    lines = [
        *_heading(problem),
        *_model(whole, stem, attachments),
        *parts(problem, stem, attachments),
        *modal_damping_lines(problem.modal_damping),
        *laws(problem),
        *parameters(whole, stem, attachments),
    ]
    lines += [*prior(problem), *test_lines(problem, folder), *theory_lines(problem.theory), *_run(problem.run)]
    return "\n".join(lines) + "\n", attachments


def _heading(problem: Problem) -> list[str]:
    note = _source_note(problem)
    return [
        f"mouse: {VERSION}",
        f"title: {word(problem.title, flow=False)}",
        *([f"source: {word(note, flow=False)}"] if note else []),
        *([f"units: {system(problem.units)}"] if problem.units.declared else []),
    ]


def _source_note(problem: Problem) -> str:
    """What the deck said of its source, or the card deck that it was converted from."""
    source = problem.source
    if source.format == "cards":
        return f"converted from {os.path.basename(source.path)}"
    if source.format != "yaml" or not source.lines:
        return ""
    _, root = compose("\n".join(source.lines), source.path)
    return next(
        (value.value for key, value in root.value if key.value == "source" and isinstance(value.value, str)),
        "",
    )


def _model(problem: Problem, stem: str, attachments: dict[str, Matrix | str]) -> list[str]:
    found, own = problem.structure, problem.mesh is not None and problem.structure.geometry is not None
    matrices = {"stiffness": found.K, "mass": found.M, "damping": found.C, "structural_damping": found.D}
    given = {key: matrix for key, matrix in matrices.items() if matrix is not None}
    if own and not any(_stored(matrix) for matrix in given.values()):
        return ["", "model:", *structure(problem.mesh, stem, attachments)]
    lines = ["", "model:  # before the test: upper triangles, rows and columns from 1"]
    imported = bool(problem.groups or problem.held)
    lines += [
        f"  {key}: {_matrix(each, f'{stem}_{key}.mtx', attachments, key, imported)}" for key, each in given.items()
    ]
    lines += rows(found, stem, attachments, places=problem.mesh is None)
    if problem.mesh is not None:
        lines += structure(problem.mesh, stem, attachments, () if own else found.labels)
    return lines


def _stored(matrix: Matrix) -> bool:
    """Whether any element is not zero."""
    return bool(matrix.nnz if is_sparse(matrix) else matrix.any())


def _matrix(matrix: Matrix, name: str, attachments: dict[str, Matrix], key: str, imported: bool) -> str:
    row, col, values = upper_triangle(matrix)
    massless = imported or (key == "mass" and not (matrix.diagonal() > 0).all())  # which files alone may be
    if len(row) > LARGEST_INLINE or massless:
        attachments[name] = matrix
        return f"{{file: {word(name)}}}"
    n = matrix.shape[0]
    if len(row) == n and (row == col).all():
        return f"{{identity: {n}}}" if (values == 1).all() else f"{{diagonal: {wrapped(map(real, values), 2)}}}"
    entries = [flow((str(i + 1), str(j + 1), real(v))) for i, j, v in zip(row, col, values, strict=True)]
    return f"{{order: {n}, entries: {wrapped(entries, 2)}}}"


def _run(run: RunOptions) -> list[str]:
    lines = ["", "run:"]
    for option in fields(run):
        value = getattr(run, option.name)
        if option.name == "total_mass_dofs":
            continue
        if option.name == "fix_total_mass" and run.fix_total_mass and run.total_mass_dofs:
            dofs = flow(str(dof + 1) for dof in run.total_mass_dofs)
            lines.append(f"  fix_total_mass: {{dofs: {dofs}}}")
        else:
            lines.append(f"  {option.name}: {_option(value)}")
    return lines


def _option(value: object) -> str:
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return real(value)
    return str(min(value, MAX_WHOLE)) if isinstance(value, int) else word(str(value))
