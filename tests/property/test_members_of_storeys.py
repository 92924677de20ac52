"""Members of one storey are one site: columns whatever their sections, braces and beams of one section; each set once."""

from mouse_cli.diagnosis.sites.members import STOREY, members
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

DECK = """
mouse: 1
model:
  structure:
    nodes: {1: [0, 0], 2: [4, 0], 3: [8, 0], 11: [0, 3], 12: [4, 3], 13: [8, 3], 21: [0, 6], 22: [4, 6], 23: [8, 6]}
    materials: {steel: {E: 2.1e11, nu: 0.3, density: 7850}}
    sections: {column: {A: 0.01, Iz: 1.0e-4}, corner: {A: 0.02, Iz: 2.0e-4}, beam: {A: 0.005, Iz: 5.0e-5},
      light: {A: 0.001, Iz: 1.0e-7}, heavy: {A: 0.002, Iz: 2.0e-7}}
    elements:
      - {id: 1, type: beam, nodes: [1, 11], material: steel, section: corner}
      - {id: 2, type: beam, nodes: [2, 12], material: steel, section: column}
      - {id: 3, type: beam, nodes: [11, 21], material: steel, section: corner}
      - {id: 4, type: beam, nodes: [12, 22], material: steel, section: column}
      - {id: 5, type: beam, nodes: [3, 13], material: steel, section: corner}
      - {id: 11, type: beam, nodes: [1, 12], material: steel, section: light}
      - {id: 12, type: beam, nodes: [2, 11], material: steel, section: light}
      - {id: 13, type: beam, nodes: [2, 13], material: steel, section: heavy}
      - {id: 14, type: beam, nodes: [11, 22], material: steel, section: light}
      - {id: 15, type: beam, nodes: [13, 22], material: steel, section: light}
      - {id: 21, type: beam, nodes: [11, 12], material: steel, section: beam}
      - {id: 22, type: beam, nodes: [12, 13], material: steel, section: heavy}
      - {id: 23, type: beam, nodes: [21, 22], material: steel, section: light}
      - {id: 24, type: beam, nodes: [22, 23], material: steel, section: light}
    supports: {1: all, 2: all, 3: all}
"""


def test_members_of_one_storey_are_one_site_and_no_set_is_two():
    found = members(assemble(yaml_deck.read(DECK, "deck.yaml")).mesh)
    assert {each.site.text: each.site.ids for each in found if each.kind == STOREY} == {
        "the columns between Y = 0 and 3": (1, 2, 5),
        "the columns between Y = 3 and 6": (3, 4),
        "the braces between Y = 0 and 3": (11, 12),
        "the braces between Y = 3 and 6": (14, 15),
    }
    assert (23, 24) in {each.site.ids for each in found}  # in one line and of one section: a member, before it is of a storey
    assert len({frozenset(each.elements) for each in found}) == len(found)
