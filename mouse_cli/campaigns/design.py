"""Where a sweep is done: grids of values, or points of a scrambled Sobol sequence or a Latin hypercube."""

from dataclasses import dataclass
from itertools import product

import numpy as np

Value = float | int | str | bool


@dataclass(frozen=True)
class Varied:
    """One quantity: `values` in turn, or from `low` to `high`, evenly by the logarithm where `log`; kind: of a job's options, see
    `batch.changes`, or `run` for an option of the run."""

    name: str
    kind: str
    values: tuple[Value, ...] = ()
    low: float = np.nan
    high: float = np.nan
    log: bool = False

    def at(self, share: float) -> Value:
        """The value at a share of the range, from 0 to 1."""
        if self.values:
            return self.values[min(int(share * len(self.values)), len(self.values) - 1)]
        if self.log:
            return float(np.exp(np.log(self.low) + share * np.log(self.high / self.low)))
        return float(self.low + share * (self.high - self.low))


def spaced(low: float, high: float, count: int, log: bool) -> tuple[float, ...]:
    """`count` values from `low` to `high`, both among them."""
    whole = Varied("", "", low=low, high=high, log=log)
    inner = [float(whole.at(i / (count - 1))) for i in range(1, count - 1)]
    return (low, *inner, high)[:count] if count > 1 else (low,)


def grid(varied: tuple[Varied, ...]) -> list[tuple[Value, ...]]:
    """Every combination of the values."""
    return list(product(*(each.values for each in varied)))


def drawn(varied: tuple[Varied, ...], count: int, design: str, seed: int) -> list[tuple[Value, ...]]:
    """`count` points that fill the space; of a Sobol sequence the first ones, which are best where they are a power of two."""
    import warnings

    from scipy.stats import qmc

    if design == "latin-hypercube":
        shares = qmc.LatinHypercube(len(varied), rng=seed).random(count)
    else:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # of a count that is no power of two
            shares = qmc.Sobol(len(varied), scramble=True, rng=seed).random(count)
    return [tuple(each.at(float(share)) for each, share in zip(varied, row, strict=True)) for row in shares]


def options(varied: tuple[Varied, ...], point: tuple[Value, ...]) -> dict:
    """The options of the job at a point."""
    found: dict = {}
    for each, value in zip(varied, point, strict=True):
        if each.kind == "run":
            found[each.name] = value
        else:
            found.setdefault(each.kind, {})[each.name] = str(value) if each.kind == "texts" else value
    return found
