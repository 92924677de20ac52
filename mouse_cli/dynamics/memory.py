"""How much memory a large model needs, as against what there is: said before it is taken."""

import os

import numpy as np

from mouse_cli._errors import ERROR, Diagnostic, NumericalError
from mouse_cli.model.arrays import Matrix

_LIMITS = ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes")
# Entries of L by squares of the separator, and by n log2 n: fitted to plates and solids of 1e5
_FRONTS, _LEAVES = 14.0, 8.0


def available() -> int:
    """Bytes of this machine, or of the control group or the `ulimit -v` that the process is confined to."""
    bounds = [os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"), *_ulimit()]
    for path in _LIMITS:
        try:
            with open(path) as file:
                bounds.append(int(file.read()))
        except (OSError, ValueError):  # no such group, or `max`
            continue
    return min(bounds)


def _ulimit() -> list[int]:
    try:
        import resource
    except ImportError:  # pragma: no cover - Windows
        return []
    soft, _ = resource.getrlimit(resource.RLIMIT_AS)
    return [] if soft == resource.RLIM_INFINITY else [soft]


def needed(n: int, entries: int, factor: int, vectors: int) -> int:
    """Bytes at the peak: K, M, A and the pencil over a pattern of so many `entries`, the `factor`, and `vectors` of length n."""
    return factor + 60 * entries + 8 * n * vectors


def check(bytes_needed: int, n: int) -> None:
    """Raise NumericalError (MD517) when so much memory is not there."""
    have = available()
    if bytes_needed <= have:
        return
    raise NumericalError(
        Diagnostic(
            "MD517",
            ERROR,
            f"a model of {n:,} degrees of freedom needs about {shown(bytes_needed)}, and there are {shown(have)}",
            help="take a machine with more memory, a coarser mesh, or shells and beams instead of solids",
        )
    )


def shown(count: int) -> str:
    """Bytes as one reads them.

    >>> shown(1_500_000_000), shown(20_000_000)
    ('1.5 GB', '0.1 GB')
    """
    return f"{max(count / 1e9, 0.1):.1f} GB" if count < 1e10 else f"{count / 1e9:.0f} GB"


def nonzeros(pattern: Matrix) -> int:
    """Entries that the Cholesky factor of a symmetric pattern will have, roughly, ordered by nested dissection.

    From the width w of its level structure (George and Liu 1981, ch. 8), which is about the size of a separator: fronts of w
    rows, and n log n beneath them.
    """
    n = pattern.shape[0]
    width = n / _levels(pattern)
    return int(_FRONTS * width**2 + _LEAVES * n * np.log2(max(n, 2)))


def _levels(pattern: Matrix) -> int:
    """Levels of a breadth-first search from a node far from the first one."""
    from scipy.sparse.csgraph import breadth_first_order

    far = breadth_first_order(pattern, 0, return_predecessors=False)[-1]
    order, before = breadth_first_order(pattern, far)
    place = np.empty(pattern.shape[0], int)
    place[order] = np.arange(len(order))
    parent = place[before[order[1:]]]  # ascending: nodes are met in the order of their parents
    levels, start = 1, 0
    while True:
        following = int(np.searchsorted(parent, start)) + 1
        if following >= len(order):
            return levels
        levels, start = levels + 1, following
