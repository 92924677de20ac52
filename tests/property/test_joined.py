"""Parts that pairs of nodes join, against the powers of their adjacency."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mouse_cli.terms.joined import parts


@settings(deadline=None)  # the first example imports scipy.sparse.csgraph
@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.integers(0, 60))
def test_nodes_of_one_part_reach_one_another(seed, count, links):
    """Parts are numbered in the order of their first nodes."""
    pairs = np.random.default_rng(seed).integers(0, count, (links, 2))
    reached = np.eye(count, dtype=int)
    reached[pairs[:, 0], pairs[:, 1]] = reached[pairs[:, 1], pairs[:, 0]] = 1
    for _ in range(count.bit_length()):
        reached = (reached @ reached > 0).astype(int)
    _, true = np.unique(reached.argmax(axis=1), return_inverse=True)
    np.testing.assert_array_equal(parts(pairs, count), true)


def test_a_long_row_in_any_order_is_one_part():
    order = np.random.default_rng(1).permutation(10_000)
    assert not parts(np.stack([order[:-1], order[1:]], axis=1), len(order)).any()
