"""The `laws:` of a deck that is written."""

from mouse_cli.formats.yaml_deck.text import flow, real, word
from mouse_cli.model.problem import Problem
from mouse_cli.terms.laws import registry


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
