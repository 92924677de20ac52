"""A field in words: each place once."""

from types import SimpleNamespace

import numpy as np

from mouse_cli.diagnosis.nameless.fit import _in_words
from mouse_cli.model.site import Site


def test_a_bar_that_bends_in_two_planes_is_one_place():
    """It has a cell in each, which a field of one length gives one value: tables had every row twice."""
    sites = [Site("element", (i,), None, f"element {i}") for i in (1, 2, 1, 2)]
    field = SimpleNamespace(
        cells=SimpleNamespace(sites=sites, unit="m"), rival=SimpleNamespace(property="spring"), spread=0.3, length=1.0
    )
    found = _in_words(field, np.array([0.5, 0.25, 0.5 + 1e-15, 0.25]), np.full(4, 0.1), 3.0)
    assert [each.site.ids for each in found.values] == [(1,), (2,)]
    apart = _in_words(field, np.array([0.5, 0.25, -0.5, 0.25]), np.full(4, 0.1), 3.0)
    assert [each.value for each in apart.values] == [0.5, 0.25, -0.5]
