"""Parts of a structure: nodes that pairs join, directly or through others."""

import numpy as np


def parts(pairs: np.ndarray, count: int) -> np.ndarray:
    """Number (count,) of the part of each node, from 0 in the order of their first nodes, for `pairs` (e, 2) that are joined."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    a, b = np.asarray(pairs, int).reshape(-1, 2).T
    return connected_components(coo_array((np.ones(len(a)), (a, b)), shape=(count, count)), directed=False)[1]
