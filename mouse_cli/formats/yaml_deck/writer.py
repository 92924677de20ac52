"""A Problem as a YAML deck that reads back as the same problem; large matrices go to files beside it."""

import os
import re
from dataclasses import fields

from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import MAX_WHOLE, VERSION
from mouse_cli.formats.yaml_deck.modal_damping import modal_damping_lines
from mouse_cli.formats.yaml_deck.nodes import compose
from mouse_cli.formats.yaml_deck.text import flow, real, word, wrapped
from mouse_cli.formats.yaml_deck.theory import theory_lines
from mouse_cli.formats.yaml_deck.writer_parameters import parameters, prior
from mouse_cli.formats.yaml_deck.writer_structure import structure
from mouse_cli.formats.yaml_deck.writer_tests import test_lines
from mouse_cli.model.arrays import Matrix, is_sparse, sparse_symmetric, upper_triangle
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.held import Thickness, freed
from mouse_cli.model.problem import Problem, RunOptions
from mouse_cli.model.structure import Structure
from mouse_cli.model.units import system
from mouse_cli.terms.laws import registry

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
        *parts(problem, stem, attachments, whole.structure.n),
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
    note = yaml_values.keys_of(root).get("source")
    return note.value if note is not None and isinstance(note.value, str) else ""


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


_LABEL = re.compile(rf"(\d+)({'|'.join(DIRECTIONS)}|S)")


def rows(structure: Structure, stem: str, attachments: dict[str, str], places: bool) -> list[str]:
    """Lines `dofs:` and `nodes:` and their tables, where there are `places` and labels tell node and direction; else `labels:`."""
    if structure.labels == tuple(str(i + 1) for i in range(structure.n)):
        return []
    parts = [_LABEL.fullmatch(label) for label in structure.labels]
    if not places or structure.geometry is None or None in parts:
        return [f"  labels: {wrapped(map(word, structure.labels), 2)}"]
    dofs, nodes = f"{stem}_dofs.csv", f"{stem}_nodes.csv"
    each = zip(structure.geometry.node_ids.tolist(), structure.geometry.coordinates, strict=True)
    attachments[dofs] = "node,direction\n" + "".join(f"{part[1]},{part[2]}\n" for part in parts)
    attachments[nodes] = "node,x,y,z\n" + "".join(f"{node},{','.join(map(real, place))}\n" for node, place in each)
    return [f"  dofs: {{file: {word(dofs)}}}", f"  nodes: {{file: {word(nodes)}}}"]


_NO_WORD = re.compile(r"\W+")


def parts(problem: Problem, stem: str, attachments: dict[str, Matrix | str], n: int) -> list[str]:
    """Lines of `model.supports` and `model.sets`; the matrices of the sets go to files, of order `n` as those of the model."""
    lines, files = [], {}
    if problem.held is not None:
        labels = problem.held.structure.labels
        lines.append("  supports:")
        lines += [
            f"    {word(each.name)}: {{dofs: {wrapped((word(labels[i]) for i in each.dofs), 6)}}}"
            for each in problem.held.supports
        ]
    if problem.groups:
        lines.append("  sets:")
    for number, group in enumerate(problem.groups, 1):
        stem_of = f"{stem}_{{}}_{number}_{_NO_WORD.sub('_', group.name)}"
        given = _files({"stiffness": group.K, "mass": group.M}, stem_of, files)
        given += [f"nodes: {wrapped(map(str, group.nodes), 6)}"] if group.nodes else []
        if group.thickness is not None:
            given.append(f"thickness: {_by_thickness(group.thickness, stem_of, files)}")
        if group.missing is not None:
            of = dict(zip(("stiffness", "mass"), group.missing, strict=True))
            given.append(f"missing: {{{', '.join(_files(of, f'{stem_of}_missing', files))}}}")
        lines.append(f"    {word(group.name)}: {{{', '.join(given)}}}")
    for name, each in files.items():  # degrees of freedom that were added since are of no set
        attachments[name] = each if each.shape[0] == n else sparse_symmetric(*upper_triangle(each), n)
    return lines


def _files(given: dict[str, Matrix | None], name: str, files: dict[str, Matrix]) -> list[str]:
    """Keys with the files of matrices; `name` has a place for the key."""
    there = {key: matrix for key, matrix in given.items() if matrix is not None}
    files |= {f"{name.format(key)}.mtx": matrix for key, matrix in there.items()}
    return [f"{key}: {{file: {word(f'{name.format(key)}.mtx')}}}" for key in there]


def _by_thickness(one: Thickness, name: str, files: dict[str, Matrix]) -> str:
    powers = []
    for n in one.powers:
        given = {"stiffness": one.K.get(n), "mass": one.M.get(n)}
        powers.append(f"{n:g}: {{{', '.join(_files(given, f'{name}_t{n:g}', files))}}}")
    of = f", unit: {word(one.unit)}" if one.unit else ""
    return f"{{nominal: {real(one.nominal)}{of}, powers: {{{', '.join(powers)}}}}}"


def laws(problem: Problem) -> list[str]:
    """One line each; none where there is none."""
    if not problem.laws:
        return []
    labels, lines = problem.structure.labels, ["", "laws:"]
    for one in problem.laws:
        sizes = registry()[one.law].sizes
        values = ", ".join(f"{key}: {real(one.values[name])}" for key, name in sizes.items())
        variant = f", variant: {word(one.variant)}" if one.variant else ""
        at = flow(word(labels[dof]) for dof in one.dofs)
        lines.append(f"  - {{law: {one.law}{variant}, at: {at}, values: {{{values}}}}}")
    return lines
