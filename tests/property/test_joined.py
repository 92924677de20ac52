"""Parts that pairs of nodes join are those of scipy's graphs, whatever the pairs."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mouse_cli.terms.joined import parts


@settings(deadline=None)  # the first example imports scipy.sparse.csgraph
@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.integers(0, 60))
def test_parts_are_those_of_scipy(seed, count, links):
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    pairs = np.random.default_rng(seed).integers(0, count, (links, 2))
    joined = coo_array((np.ones(links), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    np.testing.assert_array_equal(parts(pairs, count), connected_components(joined, directed=False)[1])


def test_a_long_row_in_any_order_is_one_part():
    order = np.random.default_rng(1).permutation(10_000)
    assert not parts(np.stack([order[:-1], order[1:]], axis=1), len(order)).any()
