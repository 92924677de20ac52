"""Parts of a structure: nodes that pairs join, directly or through others."""

import numpy as np


def parts(pairs: np.ndarray, count: int) -> np.ndarray:
    """Number (count,) of the part of each node, from 0 in the order of their first nodes, for `pairs` (e, 2) that are joined.

    Each round hangs the first nodes of joined parts on the least of them (Shiloach and Vishkin 1982). scipy.sparse.csgraph has it
    too; to import that takes as long as a check of a small deck.
    """
    first = np.arange(count)
    a, b = np.asarray(pairs, int).reshape(-1, 2).T
    while True:
        one, other = first[a], first[b]
        apart = one != other
        if not apart.any():
            return np.unique(first, return_inverse=True)[1]
        np.minimum.at(first, np.maximum(one, other)[apart], np.minimum(one, other)[apart])
        while True:
            higher = first[first]
            if (higher == first).all():
                break
            first = higher
