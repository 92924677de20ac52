"""The `run:` of a YAML deck: run options."""

from mouse_cli._span import Span
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.nodes import Node
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.formats.yaml_deck.sensors import place
from mouse_cli.model.problem import RunOptions


def run_options(section: Section | None) -> tuple[RunOptions, dict[str, Span]]:
    """The options, and the place of each key that is given."""
    if section is None:
        return RunOptions(), {}
    simple = {key: section.value(key) for key in section.nodes if key != "fix_total_mass"}
    given = {key: value for key, value in simple.items() if value is not None}
    return RunOptions(**given, **_total_mass(section)), {
        key: section.document.span(node) for key, node in section.nodes.items()
    }


def _total_mass(section: Section) -> dict[str, object]:
    """Degrees of freedom by number, or by label: which of the model's that is, only its rules can tell."""
    node = section.nodes.get("fix_total_mass")
    if node is None:
        return {}
    what = section.what("fix_total_mass")
    if not yaml_values.is_mapping(node):
        fixed = yaml_values.flag(section.document, node, what, KINDS["flag or dofs"].words)
        return {"fix_total_mass": bool(fixed)}
    below = Section(section.document, node, "total_mass", what)
    found = [_dof(section, item, below.what("dofs")) for item in below.read("dofs", yaml_values.items, "") or []]
    numbers = () if None in found else tuple(found)
    return {"fix_total_mass": True, "total_mass_dofs": numbers}


def _dof(section: Section, node: Node, what: str) -> int | str | None:
    """A number, from 0, or a label."""
    dof = place(section.document, node, what)
    return dof - 1 if isinstance(dof, int) else dof
