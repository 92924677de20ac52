"""The `laws:` of a YAML deck."""

from mouse_cli.formats.law_draft import LawDraft
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.sections import Section


def laws(deck: Section) -> tuple[LawDraft, ...]:
    """Those that could be read."""
    node, document = deck.nodes.get("laws"), deck.document
    if node is None:
        return ()
    found = []
    for i, item in enumerate(yaml_values.items(document, node, "laws", "a list, one item for each law") or [], 1):
        section = Section(document, item, "law", f"laws[{i}]")
        law, dofs, below = section.value("law"), section.value("at"), section.section("values")
        if law is None or dofs is None or below is None:
            continue
        values = {key: below.value(key) for key in below.nodes}
        if None not in values.values():
            found.append(LawDraft(law, section.value("variant", ""), dofs, values, document.span(section.node)))
    return tuple(found)
