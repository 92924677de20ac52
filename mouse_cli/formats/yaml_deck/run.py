"""The `run:` of a YAML deck: run options."""

from mouse_cli._span import Span
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.model import dofs
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.problem import RunOptions


def run_options(section: Section | None, labels: tuple[str, ...]) -> tuple[RunOptions, dict[str, Span]]:
    """The options, and the place of each key that is given."""
    if section is None:
        return RunOptions(), {}
    simple = {key: section.value(key) for key in section.nodes if key != "fix_total_mass"}
    given = {key: value for key, value in simple.items() if value is not None}
    return RunOptions(**given, **_total_mass(section, labels)), _where(section)


def _where(section: Section) -> dict[str, Span]:
    return {key: section.document.span(node) for key, node in section.nodes.items()}


def _total_mass(section: Section, labels: tuple[str, ...]) -> dict[str, object]:
    node = section.nodes.get("fix_total_mass")
    if node is None:
        return {}
    what = section.what("fix_total_mass")
    if not yaml_values.is_mapping(node):
        fixed = yaml_values.flag(section.document, node, what, KINDS["flag or dofs"].words)
        return {"fix_total_mass": bool(fixed)}
    below = Section(section.document, node, "total_mass", what)
    found = dofs(section.document, below.nodes["dofs"], below.what("dofs"), labels) if "dofs" in below else None
    numbers = () if found is None else tuple(int(dof) - 1 for dof in found)
    return {"fix_total_mass": True, "total_mass_dofs": numbers}
