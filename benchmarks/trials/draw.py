"""From a seed to trials: which kinds, which numbers. Nothing but the seed, the number of cases and the kinds decides."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from fnmatch import fnmatch

import numpy as np

from benchmarks.blind.case import generator
from benchmarks.trials.case import Blank, Mechanism
from benchmarks.trials.kinds import CLASSES, Kind, kinds
from benchmarks.trials.test_data import QUALITIES, Test, Truth, counts, difference, measured, truth_of

APART = 0.12  # of the span: two mechanisms of one physics or site stand at least so far apart
FELT = 30.0  # chi-square: what changes a test less, once the parameters have made up for it, nobody could find
STEP = 1e-3  # of the logarithm of a parameter, for differences
CYCLES = 5  # of a fit of the parameters
FAR = 5.0  # sd of its prior that a parameter may go in it
ATTEMPTS = 200


@dataclass(frozen=True)
class Trial:
    """One case: its structure, what its deck lacks, its test; felt: chi-square that the least of the mechanisms
    leaves to a model without it whose parameters were fitted."""

    kind: str
    quality: str
    blank: Blank
    mechanisms: list[Mechanism]
    test: Test
    error: str
    felt: float

    def truth(self) -> dict:
        """What scoring needs, as JSON; every number in it was drawn, none computed by an eigensolver."""
        name, family, what = self.kind.split("/", 2)
        return {
            "class": name,
            "family": family,
            "what": what,
            "quality": self.quality,
            "error": self.error,
            "mechanisms": [asdict(one) for one in self.mechanisms],
            "parameters": self.blank.parameters,
            "span": self.blank.span,
            "nodes": self.blank.nodes,
            "elements": self.blank.elements,
            "held": self.test.held,
        }


def trials(seed: int, cases: int, patterns: list[str]) -> Iterator[Trial]:
    """All trials of a seed, in the order in which they are drawn."""
    for index, (kind, quality) in enumerate(_plan(seed, cases, patterns)):
        yield trial(kind, quality, generator("trials", seed, index, kind.name, quality))


def _plan(seed: int, cases: int, patterns: list[str]) -> list[tuple[Kind, str]]:
    """A kind and a quality for each case: shares by class, kinds of a class in turn, in an order drawn once."""
    rng = generator("trials", seed, "plan")
    wanted = [one for one in kinds() if not patterns or any(fnmatch(one.name, p) for p in patterns)]
    if not wanted:
        raise ValueError(f"no kind of trial matches {', '.join(patterns)}")
    classes = {name: [one for one in wanted if one.name.startswith(f"{name}/")] for name in CLASSES}
    share = {name: CLASSES[name] for name, own in classes.items() if own}
    ideal = np.array(list(share.values())) / sum(share.values()) * cases
    number = np.floor(ideal).astype(int)
    for i in np.argsort(number - ideal, kind="stable")[: cases - number.sum()]:
        number[i] += 1
    found = []
    for name, count in zip(share, number.tolist(), strict=True):
        order = [classes[name][i] for i in rng.permutation(len(classes[name]))]
        found += [order[i % len(order)] for i in range(count)]
    qualities = [list(QUALITIES)[i] for i in rng.integers(len(QUALITIES), size=cases)]
    return [(found[i], qualities[i]) for i in rng.permutation(cases)]


def trial(kind: Kind, quality: str, rng: np.random.Generator) -> Trial:
    """The first structure drawn of which the test feels each mechanism, and whose mechanisms stand apart."""
    for _ in range(ATTEMPTS):
        seed = int(rng.integers(2**32))
        blank, mechanisms = kind.made(seed)
        if not kind.near and not _apart(blank, mechanisms):
            continue
        own = np.random.default_rng([seed, 1])
        count, held = counts(own, blank)
        truth = truth_of(blank, count)
        parts = range(1 if kind.several else len(mechanisms))
        felt = [_felt(kind, seed, i, truth, quality) for i in parts]
        if min(felt, default=np.inf) > FELT:
            test = measured(own, blank, truth, QUALITIES[quality], held, kind.error)
            return Trial(kind.name, quality, blank, mechanisms, test, kind.error, min(felt, default=0.0))
    raise RuntimeError(f"{kind.name}: no structure in {ATTEMPTS} attempts whose test feels what is missing")


def _felt(kind: Kind, seed: int, without: int, truth: Truth, quality: str) -> float:
    """chi-square of the test that the parameters, kept by their priors, leave to the model without one mechanism.

    min over d of |r(d)|^2 + |d / sd|^2, r from that model to the truth, d of logarithms; Gauss-Newton with the first derivatives.
    """
    count, noise = len(truth.frequency), QUALITIES[quality]
    at = lambda d: truth_of(_moved(kind.made(seed, without)[0], d), count)
    sd = np.array([prior.sd for prior in kind.made(seed, without)[0].priors.values()])
    d = np.zeros(len(sd))
    before = at(d)
    m = min(count, len(before.frequency))
    J = np.column_stack([difference(before, at(STEP * one), noise, m) / STEP for one in np.eye(len(sd))])
    A = np.vstack([J, np.diag(1 / sd)])
    left = lambda d: np.concatenate([difference(at(d), truth, noise, m), -d / sd])
    for _ in range(CYCLES):
        # A full step may end where a mode has none to be compared with (a stiffness of next to nothing).
        d = np.clip(d + np.linalg.lstsq(A, left(d), rcond=None)[0], -FAR * sd, FAR * sd)
    return float(min(left(one) @ left(one) for one in (d, 0 * d)))


def _moved(blank: Blank, d: np.ndarray) -> Blank:
    """The structure with the logarithms of its parameters changed."""
    for prior, one in zip(blank.priors.values(), d, strict=True):
        prior.scale(float(np.exp(one)))
    return blank


def _apart(blank: Blank, mechanisms: list[Mechanism]) -> bool:
    places = [one.at for one in mechanisms if one.at is not None]
    gaps = [np.hypot(*np.subtract(p, q)) for i, p in enumerate(places) for q in places[:i]]
    return all(gap > APART * blank.span for gap in gaps)
