"""Nested dissection (George 1973) of a mesh that is known by its graph alone: an ordering with less fill for solids and shells."""

import numpy as np

from mouse_cli.model.arrays import Matrix

_LANDMARKS, _SMOOTH, _LEAF = 16, 10, 40  # distances to begin with, averagings that round them, nodes no longer cut


def dissected(pattern: Matrix) -> np.ndarray:
    """Order (n,) of elimination: halves of the mesh first, then what parts them, again and again.

    Degrees of freedom with the same neighbours are one node. Nodes get coordinates from distances in the graph, smoothed by
    averaging over neighbours, and are cut across their longest extent.
    """
    node, graph = _compressed(pattern)
    order = np.empty(graph.shape[0], int)
    _cut(graph, _coordinates(graph), order)
    place = np.empty(len(order), int)
    place[order] = np.arange(len(order))
    return np.argsort(place[node], kind="stable")


def densely_connected(pattern: Matrix) -> bool:
    """Whether nodes have so many neighbours, as in solids and shells, that dissection is worth its while."""
    graph = _compressed(pattern)[1]
    return graph.shape[0] > 10 * _LEAF and graph.nnz > 7 * graph.shape[0]


def _compressed(pattern: Matrix) -> tuple[np.ndarray, Matrix]:
    """Node (n,) of each degree of freedom, and the graph of the nodes."""
    from scipy.sparse import coo_array

    n = pattern.shape[0]
    mark = np.random.default_rng(0).random(n)
    sums = np.add.reduceat(mark[pattern.indices], pattern.indptr[:-1])
    _, node = np.unique(np.round(sums, 9), return_inverse=True)
    row, col = np.repeat(node, np.diff(pattern.indptr)), node[pattern.indices]
    k = int(node.max()) + 1
    graph = coo_array((np.ones(len(row)), (row, col)), shape=(k, k)).tocsr()
    graph.data[:] = 1.0
    return node, graph


def _coordinates(graph: Matrix) -> np.ndarray:
    """Smooth coordinates (k, 3) that tell near nodes from far ones."""
    from scipy.sparse.csgraph import dijkstra

    k = graph.shape[0]
    far, distances = 0, []
    least = np.full(k, np.inf)
    for _ in range(_LANDMARKS):
        reached = dijkstra(graph, unweighted=True, indices=far)
        reached[np.isinf(reached)] = 2 * k
        distances.append(reached)
        least = np.minimum(least, reached)
        far = int(np.argmax(least))
    x = np.array(distances).T
    degree = graph.sum(axis=1)[:, None]
    for _ in range(_SMOOTH):
        x = (graph @ x) / degree
    x = x - x.mean(axis=0)
    return x @ np.linalg.svd(x.T @ x)[0][:, :3]


def _cut(graph: Matrix, x: np.ndarray, order: np.ndarray) -> None:
    """Fill `order` (k,) from its end: what parts a set of nodes comes after the two parts."""
    part = np.zeros(graph.shape[0], bool)
    sets = [(np.arange(graph.shape[0]), graph.shape[0])]
    while sets:
        nodes, end = sets.pop()
        if len(nodes) <= _LEAF:
            order[end - len(nodes) : end] = nodes
            continue
        own = x[nodes] - x[nodes].mean(axis=0)
        along = own @ np.linalg.eigh(own.T @ own)[1][:, -1]
        low = along < np.median(along)
        part[nodes[low]] = True
        high = nodes[~low]
        touched = _touching(graph, high, part)
        part[nodes[low]] = False
        between, high = high[touched], high[~touched]
        order[end - len(between) : end] = between
        end -= len(between)
        sets += [(high, end), (nodes[low], end - len(high))] if low.any() else [(high[:_LEAF], end)]


def _touching(graph: Matrix, nodes: np.ndarray, part: np.ndarray) -> np.ndarray:
    """Which of `nodes` have a neighbour in `part`."""
    counts = np.diff(graph.indptr)[nodes]
    start = np.cumsum(counts) - counts
    at = np.repeat(graph.indptr[nodes] - start, counts) + np.arange(counts.sum())
    return np.add.reduceat(part[graph.indices[at]].astype(int), start) > 0
