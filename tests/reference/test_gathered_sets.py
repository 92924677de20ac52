"""A deck that lists its elements one by one has the same model as one that lists them together, and is taken as one."""

import numpy as np
import pytest

import mouse_cli
from mouse_cli.terms.assembly import assembly

_DECK = """
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: 4, start: [0, 0, 0], end: [3, 1, 0]}}}}
    supports: {{1: all}}
    materials: {{steel: {{E: 2.1e11, nu: 0.3, density: 7850}}}}
    sections: {{bar: {{A: 1e-3, Iy: 2e-7, Iz: 1e-7, J: 3e-7}}}}
    elements:
{elements}
parameters:
  - {{name: E, elements: "1, 3", property: E, sd: 5 %}}
  - {{name: heavy, elements: "2-3", property: density, factor: true, sd: 5 %}}
"""
_ONE = "{{{{id: {0}, type: beam, nodes: [{0}, {1}], material: steel, section: bar}}}}"
_EACH = "\n".join(f"      - {_ONE.format(i, i + 1)}" for i in (1, 2, 3))
_TOGETHER = "      - {id: 1-3, type: beam, nodes: 1-4, material: steel, section: bar}"


def read(tmp_path, elements: str):
    deck = tmp_path / "deck.yaml"
    deck.write_text(_DECK.format(elements=elements.replace("{{", "{").replace("}}", "}")))
    return mouse_cli.read_deck(deck)


def test_elements_listed_one_by_one_make_one_term(tmp_path):
    each = read(tmp_path, _EACH)
    assert (len(each.mesh.elements), len(each.terms)) == (3, 1)
    assert each.mesh.gathered.group == (0, 0, 0)
    assert [part.tolist() for part in each.mesh.gathered.origin(0)] == [[0, 1, 2], [0, 0, 0]]


@pytest.mark.parametrize("theta", [(2.1e11, 1.0), (1.3e11, 1.7)])
def test_both_ways_to_list_them_make_the_same_matrices(tmp_path, theta):
    one, other = (assembly(read(tmp_path, text)) for text in (_EACH, _TOGETHER))
    for a, b in zip(one.matrices(np.array(theta)), other.matrices(np.array(theta)), strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-14)
