"""Fewer nodes for drawings: some of them, and lines between the neighbourhoods of those."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Coarsened:
    """nodes (r,): those kept, as indices; lines (l, 2): pairs of places in `nodes`; index (k,): place of a kept node, else -1."""

    nodes: np.ndarray
    lines: np.ndarray
    index: np.ndarray

    @property
    def fewer(self) -> bool:
        """Whether nodes were left out."""
        return len(self.nodes) < len(self.index)


def coarsened(k: int, lines: np.ndarray, most: int, wanted: Sequence[int] = ()) -> Coarsened:
    """About `most` of k nodes, `wanted` among them, evenly by number; all of them where there are no more.

    Every other node joins the kept one that is fewest lines away; a line remains between two kept nodes whose neighbourhoods a
    line (l, 2) joins. Lines come out once each.
    """
    kept = np.zeros(k, bool)
    kept[:: -(-k // most) if k > most else 1] = True
    kept[list(wanted)] = True
    owner = np.where(kept, np.arange(k), -1)
    while len(lines):
        a, b = owner[lines].T
        grows = (a < 0) != (b < 0)
        if not grows.any():
            break
        target = np.where(a < 0, lines[:, 0], lines[:, 1])[grows]
        owner[target] = np.maximum(a, b)[grows]
    nodes = np.flatnonzero(kept)
    index = np.full(k, -1)
    index[nodes] = np.arange(len(nodes))
    pairs = np.sort(index[owner[lines]], axis=1) if len(lines) else np.zeros((0, 2), int)
    joined = pairs[(pairs[:, 0] != pairs[:, 1]) & (owner[lines] >= 0).all(axis=1)] if len(lines) else pairs
    return Coarsened(nodes, np.unique(joined, axis=0), index)
