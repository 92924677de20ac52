"""A strut from a held node and a spring to the ground where it ends: one answer, said in two ways."""

from types import SimpleNamespace

import numpy as np
import pytest
from made_up_rankings import made_up, ranked

from mouse_cli.diagnosis.search import rank
from mouse_cli.diagnosis.search.grounded import one_tie
from mouse_cli.model.diagnosis import Site

MESH = SimpleNamespace(
    node_ids=np.array([1, 2, 3, 4]),
    coordinates=np.array([[0.0, 0, 0], [0, 3, 0], [4, 3, 0], [4, 0, 0]]),
    standing=np.array([(0, 0), (0, 1), (3, 0), (3, 1)]),
    elements=(SimpleNamespace(ids=np.array([7, 8]), nodes=np.array([[0, 1], [1, 2]])),),
)


def one(key: str, *ids: int, at=(0.0, 0.0, 0.0), sd: float = 0.0):
    """A fit of one mechanism at nodes, or at a place along a line known to within sd (m)."""
    structure = SimpleNamespace(geometry=SimpleNamespace(coordinates=MESH.coordinates))
    base = SimpleNamespace(problem=SimpleNamespace(mesh=MESH, structure=structure))
    recipe = SimpleNamespace(candidate=SimpleNamespace(key=key), unknowns=(SimpleNamespace(name="place"),))
    covariance = np.array([[sd**2]])
    model = SimpleNamespace(base=base, k=0)
    return SimpleNamespace(recipes=(recipe,), sites=(Site("node", ids, at),), model=model, covariance=covariance)


@pytest.mark.parametrize(
    ("strut", "spring", "same"),
    [
        (one("brace", 1, 3), one("ground-spring", 3, at=(4.0, 3.0, 0.0)), True),
        (one("brace", 1, 3), one("inclined-spring", at=(3.9, 3.0, 0.0)), True),
        (one("brace", 1, 3), one("ground-spring", at=(2.8, 3.0, 0.0)), False),
        (one("brace", 1, 3), one("ground-spring", at=(2.8, 3.0, 0.0), sd=0.7), True),
        (one("brace", 2, 3), one("ground-spring", 3, at=(4.0, 3.0, 0.0)), False),  # neither end is held
        (one("brace", 1, 3, 2, 4), one("ground-spring", 3, at=(4.0, 3.0, 0.0)), False),  # crossed: two ends
        (one("brace", 1, 3), one("mass", 3, at=(4.0, 3.0, 0.0)), False),
        (one("brace", 1, 3), one("brace", 4, 2), False),
    ],
)
def test_a_strut_from_a_held_node_is_a_spring_to_the_ground_at_its_other_end(strut, spring, same):
    assert one_tie(strut, spring) is same and one_tie(spring, strut) is same


@pytest.mark.parametrize(("elements", "same"), [((8,), True), ((7,), False)])
def test_a_spring_anywhere_along_a_row_is_where_the_strut_ends(elements, same):
    """A row that is stiff along itself is tied to the ground wherever along it that is."""
    spring = one("ground-spring")
    spring.sites = (Site("element", elements, None, "anywhere along a row, TX"),)
    assert one_tie(one("brace", 1, 3), spring) is same


@pytest.mark.parametrize("first", ["ground-spring", "brace"])
def test_both_count_as_the_more_probable(first, monkeypatch):
    other = {"ground-spring": "brace", "brace": "ground-spring"}[first]
    pair = {"ground-spring", "brace"}
    monkeypatch.setattr(rank, "one_tie", lambda a, b: {*a.groups, *b.groups} == pair)
    elsewhere = made_up("mass")
    fits = made_up(first), made_up(other, elsewhere=((elsewhere, 0.25),)), made_up(first), made_up()
    groups = dict(ranked(*fits, p=(0.5, 0.32, 0.1, 0.08)).groups)
    assert groups[first] == pytest.approx(0.5 + 0.75 * 0.32 + 0.1) and groups[other] == pytest.approx(0.25 * 0.32)
