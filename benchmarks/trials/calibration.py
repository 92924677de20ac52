"""Stated probabilities beside how often they were right: a table, a plot of text, the expected calibration error."""

import numpy as np

BINS = 10
_WIDTH = 40  # characters of the plot


def calibration_error(p: np.ndarray, true: np.ndarray) -> float:
    """sum over bins of n_b / n |mean p - mean true| (Naeini, Cooper, Hauskrecht 2015).

    >>> calibration_error(np.array([0.95, 0.95, 0.95, 0.95]), np.array([1, 1, 1, 0]))
    0.2
    """
    return (
        float(round(sum(n / len(p) * abs(stated - found) for _, n, stated, found in bins(p, true)), 9))
        if len(p)
        else np.nan
    )


def bins(p: np.ndarray, true: np.ndarray) -> list[tuple[int, int, float, float]]:
    """(bin, count, mean stated probability, share that was true) of each bin that is not empty."""
    at = np.minimum((p * BINS).astype(int), BINS - 1)
    return [
        (b, int((at == b).sum()), float(p[at == b].mean()), float(true[at == b].mean())) for b in np.unique(at).tolist()
    ]


def table(pairs: list[tuple[float, bool]]) -> str:
    """Markdown of the bins, and below it a plot: `o` stated, `#` true."""
    p, true = np.array([x for x, _ in pairs], dtype=float), np.array([y for _, y in pairs], dtype=float)
    if not len(p):
        return "None."
    found = bins(p, true)
    rows = [
        f"| {b / BINS:.1f} to {(b + 1) / BINS:.1f} | {n} | {stated:.3f} | {share:.3f} |"
        for b, n, stated, share in found
    ]
    head = ["| stated | answers | mean stated | true |", "|---|---|---|---|"]
    plot = [f"{b / BINS:.1f} |{_bar(stated, share)}| {n}" for b, n, stated, share in found]
    return "\n".join(
        [*head, *rows, "", "```text", "    0" + " " * (_WIDTH - 2) + "1   o stated, # true, * both", *plot, "```"]
    )


def _bar(stated: float, share: float) -> str:
    cells, at = [" "] * _WIDTH, lambda x: min(int(x * _WIDTH), _WIDTH - 1)
    cells[: at(share)] = "-" * at(share)
    cells[at(share)] = "#"
    cells[at(stated)] = "*" if at(stated) == at(share) else "o"
    return "".join(cells)
