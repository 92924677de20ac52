"""Supports and element sets of imported matrices, for a deck that is written."""

import re

from mouse_cli.formats.yaml_deck.text import word, wrapped
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.problem import Problem

_NO_WORD = re.compile(r"\W+")


def parts(problem: Problem, stem: str, attachments: dict[str, Matrix | str]) -> list[str]:
    """Lines of `model.supports` and `model.sets`; the matrices of the sets go to files."""
    lines = []
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
        given = []
        for key, matrix in (("stiffness", group.K), ("mass", group.M)):
            if matrix is not None:
                name = f"{stem}_{key}_{number}_{_NO_WORD.sub('_', group.name)}.mtx"
                attachments[name] = matrix
                given.append(f"{key}: {{file: {word(name)}}}")
        nodes = [f"nodes: {wrapped(map(str, group.nodes), 6)}"] if group.nodes else []
        lines.append(f"    {word(group.name)}: {{{', '.join(given + nodes)}}}")
    return lines
