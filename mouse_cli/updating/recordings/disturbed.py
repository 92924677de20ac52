"""Hum and drift that nobody stated: the model explains the records but for sinusoids of the mains, or for what is slower than it.

Noise of such lines is no law, and too little of a spectrum to be judged as noise.
"""

from copy import copy
from dataclasses import replace

import numpy as np

from mouse_cli.updating.recordings.adequacy import adequate
from mouse_cli.updating.recordings.disturbance import Disturbance
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.noise import noise
from mouse_cli.updating.recordings.study import Study, fitted, resonances

_MAINS = (50.0, 60.0, 50.0 / 3)  # Hz: the grids, and railways of central Europe
_SLOW = 0.25  # of the lowest mode, below which a structure follows its force without a resonance
_SHARE = 0.1  # of what is left, that lines of hum or drift are thought of for
_UNEVEN = 100.0  # ratio of the variances that are left of stretches, above which what leaves them is not there all the time
_BESIDE = 1.5  # lines of a stretch on either side of one of the mains


def disturbed(own: Study, baseline: Fit) -> str:
    """What to state of hum and drift where the model explains the records but for them; empty: it does not, or they are stated."""
    stated = own.data[0].series.disturbance
    if own.look.free or own.data[0].series.slow or stated.mains or stated.drift:
        return ""
    for each in _likely(own, baseline):
        alone = copy(own)
        alone.data = [replace(part, series=replace(part.series, disturbance=each)) for part in own.data]
        found = fitted(alone, None)
        if found is not None and adequate(found):
            return _said(each)
    return ""


def unmeasured(own: Study, baseline: Fit) -> str:
    """What to do about what the model leaves, where it is too much for noise of a record and yet has all that noise has; empty: it
    has not.
    """
    left = (baseline.residual**2).mean(axis=(0, 1))
    found = noise(own.spectrum, baseline.hypothesis, own.places, baseline.x, loud=np.inf)
    if found is None or left.max() > _UNEVEN * left.min():
        return ""
    share = 100 * found.size / own.spectrum.series.measured.std(axis=0)
    grows = "" if found.grows != found.grows else "does not grow with the motion, "
    return (
        f"What the model leaves ({share.min():.2g} to {share.max():.2g} % of an output) is coherent with no measured force, {grows}"
        f"and no law at any site takes more than {100 * found.explained:.2g} % of it: a force that nobody measured leaves that "
        "(traffic, wind, a machine), and so may a law that is in no library. Measure that force, stop it, or excite more; nothing "
        "can be said of the structure before."
    )


def _likely(own: Study, baseline: Fit) -> list[Disturbance]:
    """Hum, drift, or both, by what the model leaves; those that have a share of it."""
    left, dt = baseline.residual, own.look.dt
    power = (np.abs(np.fft.rfft(left * np.hanning(left.shape[1])[:, None], axis=1)) ** 2).sum(axis=(0, 2))
    hz = np.fft.rfftfreq(left.shape[1], dt)
    share = lambda lines: float(power[lines].sum() / power.sum())
    mains = [(share(np.abs(hz - one) <= _BESIDE * hz[1]), one) for one in _MAINS if one < 0.4 / dt]
    best, hum = max(mains, default=(0.0, 0.0))
    slow = _SLOW * float(resonances(own.model)[0])
    hums, drifts = best > _SHARE, share(hz < max(slow, _BESIDE * hz[1])) > _SHARE
    found = [(hum, 0.0)] * hums + [(0.0, slow)] * drifts + [(hum, slow)] * (hums and drifts)
    return [Disturbance(a, b) for a, b in found]


def _said(each: Disturbance) -> str:
    hum = f"{each.mains:.4g} Hz and its multiples"
    what = [hum] * bool(each.mains) + [f"what is slower than {each.drift:.2g} Hz"] * bool(each.drift)
    keys = [f"mains: {each.mains:.4g}"] * bool(each.mains) + [f"drift: {each.drift:.2g}"] * bool(each.drift)
    return (
        f"The model explains the records but for {' and '.join(what)}, which no law makes: hum or drift of channels. Write "
        f"{', '.join(keys)} for the recordings, if the channels have it, and diagnose again."
    )
