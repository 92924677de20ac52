"""Is what a model leaves of a record noise? Noise has a spectrum of its own, not that of the accuracy of the channels alone.

Disturbing forces, hum and drift leave coloured residuals that are many times the accuracy of a channel. What tells them from
physics: no force that follows from the motion of any place explains them, they are not coherent with the measured force, and
do not grow with the motion.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.model.record_diagnosis import Noise
from mouse_cli.updating.recordings.acting import Place
from mouse_cli.updating.recordings.free_force import Spectrum
from mouse_cli.updating.recordings.hypothesis import Hypothesis
from mouse_cli.updating.recordings.regression import Regression, allowed

EXPLAINED = 0.1  # share of what is left that a law takes, from which on it is no noise
LOUD = 0.2  # rms of what is left by that of the record, from which on a record cannot be said to be explained
_GROWS = 0.5  # exponent of its variance over that of the motion, from which on it grows with the motion
_FOLLOWS = 0.3  # share that is coherent with the measured force, from which on it is a linear cause, or gains or timing of channels
_AVERAGES = 24  # of a coherence
_LEAST, _CHANCE = 40.0, 12.0  # effective samples that can judge; chi2 that the best of many laws explains by chance
_LINES = 1 / 150  # share of the spectrum over which it is averaged, at least
_STRETCHES = 16
_BINS = 8  # of motion and velocity, of a force whose law is free


def noise(
    spectrum: Spectrum, base: Hypothesis, places: list[Place], begun: np.ndarray | None = None, loud: float = LOUD
) -> Noise | None:
    """The noise that is left beside the laws of `base`, at its x (k,); None where it follows from the motion, or is a larger share
    of an output than `loud`.
    """
    look = lambda spectrum, place: Regression(spectrum, base.placed(place), begun)
    at = look(spectrum, places[0])
    left, series = at.left, spectrum.series
    size = np.sqrt((left[at.kept] ** 2).mean(axis=0))
    if (size * series.sd > loud * series.measured.std(axis=0)).any():
        return None
    weights, count, effective = whitening(spectrum, left)
    if count < _LEAST or coherent(series.force[at.kept], left[at.kept]) > _FOLLOWS or _scaled(at) > _FOLLOWS:
        return None
    white = replace(spectrum, weights=weights)
    grows = _growth(look(white, places[0]))
    if grows > _GROWS:
        return None
    most = max(EXPLAINED, _CHANCE / count)
    explained = 0.0
    for share in (freely, _by_laws):  # the quicker one decides most
        for place in places if share is _by_laws else [one for one in places if one.across is None]:
            explained = max(explained, share(look(white, place)))
            if explained > most:
                return None
    return Noise(size * series.sd, explained, effective, grows)


def doubtful(spectrum: Spectrum, base: Hypothesis, places: list[Place], found: Noise) -> bool:
    """Whether a law takes more of what noise was found in, as it is, than chance makes of its independent samples.

    Made white, events too short for a first look to time them (a mass that comes to rest) hide what goes on between them.
    """
    count = found.effective * Regression(spectrum, base.placed(places[0])).y.size
    most = max(EXPLAINED, _CHANCE / max(count, 1.0))
    return any(_by_laws(Regression(spectrum, base.placed(place))) > most for place in places)


def coherent(force: np.ndarray, left: np.ndarray) -> float:
    """Share of the power of `left` (t, s) that is coherent with forces (t, i), less what it would be by chance."""
    from scipy.signal import csd, welch

    length = max(32, 2 * len(left) // (_AVERAGES + 1))
    power = welch(left, nperseg=length, axis=0)[1].sum()
    shared = 0.0
    for f in force.T:
        own = welch(f, nperseg=length)[1]
        driven = own > 1e-9 * own.max()
        cross = np.abs(csd(f[:, None], left, nperseg=length, axis=0)[1]) ** 2
        shared += float((cross[driven] / own[driven, None]).sum() / power)
    return shared - force.shape[1] * 2 / _AVERAGES


def _scaled(at: Regression) -> float:
    """Share of the power of what is left that is coherent with what the model says of the same channel: a channel that is scaled
    or filtered, whose resonances are narrower than the lines of any coherence with the force.
    """
    left, model = at.left[at.kept], predicted(at)
    power = (left**2).sum(axis=0)
    shares = [coherent(model[:, [j]], left[:, [j]]) if model[:, j].any() and power[j] else 0.0 for j in range(left.shape[1])]
    return float(power @ shares) / max(float(power.sum()), 1e-300)


def predicted(at: Regression) -> np.ndarray:
    """What the model with its nuisances makes of the outputs (kept samples, s), in the units of `at.left`."""
    spectrum = at.spectrum
    return (spectrum.whitened(spectrum.read * spectrum.window[:, None]) - at.left)[at.kept]


def whitening(spectrum: Spectrum, left: np.ndarray) -> tuple[np.ndarray, float, float]:
    """Weights (l, s, s) that make `left` (t, s), in sd, white where it exceeds the accuracy of the channels, and leave out the
    rest; how many samples are then independent; and the share of all samples of such a spectrum that count as independent
    ones, (sum p)^2 / (n sum p^2).

    With S = V diag(p) V' the spectrum of what is left, averaged over neighbouring lines: weights max(1 - 1/p, 0) / sqrt p V'.
    A force at one place shows in one direction of V.
    """
    from scipy.ndimage import uniform_filter1d

    s, t = left.shape[1], len(left)
    lines = spectrum.line(left)
    wide = max(8 * s * spectrum.padded // t, int(_LINES * len(lines)), 1)
    power = np.einsum("li,lj->lij", lines, lines.conj()) / t
    S = uniform_filter1d(power.real, wide, axis=0) + 1j * uniform_filter1d(power.imag, wide, axis=0)
    p, V = np.linalg.eigh(S)
    excess = np.maximum(1 - 1 / np.maximum(p, 1e-12), 0)
    weights = (excess / np.sqrt(np.maximum(p, 1e-12)))[:, :, None] * V.conj().transpose(0, 2, 1)
    return weights, float(np.mean(excess**2)) * left.size, float(p.sum() ** 2 / (p.size * (p**2).sum()))


def _growth(at: Regression) -> float:
    """The exponent with which the variance of what is left follows that of the motion, stretch by stretch; nan at one level.

    Its standard error is taken off: only a growth that is sure counts.
    """
    series = at.spectrum.series
    variance = lambda x: np.array([(part**2).mean() for part in np.array_split(x[at.kept], _STRETCHES)])
    V, P = np.log(variance(at.left)), np.log(variance(series.measured / series.sd))
    P -= P.mean()
    spread = float(P @ P)
    if np.sqrt(spread / _STRETCHES) < 0.2:
        return float("nan")
    slope = float(P @ V) / spread
    error = np.sqrt(((V - V.mean() - slope * P) ** 2).sum() / (_STRETCHES - 2) / spread)
    return float(max(slope - 2 * error, 0.0))


def freely(at: Regression) -> float:
    """Share of what is left that forces take which are any function of the motion, and any of the velocity."""
    found = []
    for z in (at.local.x, at.local.v):
        knots = np.quantile(z, np.linspace(0, 1, _BINS))
        found += [np.interp(z, knots, row) for row in np.eye(_BINS)]
    return at.share(found)


def _by_laws(at: Regression) -> float:
    """Largest share of what is left that a law of the library takes."""
    shares = [0.0]
    for law in allowed(at.local.place):
        for variant in law.variants_at(at.local.place.scale):
            start = at.best(law, variant)
            shares.append(0.0 if start is None else 1 - start.left / at.nothing)
    return max(shares)
