"""Peaks of frequency response functions, for tables."""

import numpy as np

from mouse_cli.model.coupled import Peak
from mouse_cli.model.frf_test import FrfTest

_PROMINENT = 3.0  # dB by which a peak stands out
_MOST = 10  # of one function, the most prominent


def peaks(frf: FrfTest) -> tuple[Peak, ...]:
    """The peaks of every function, in the order of frequency; sd of the magnitude from half of E|dH|^2, NaN where it is unknown."""
    from scipy.signal import find_peaks

    found = []
    for o, response in enumerate(frf.output_names):
        for i, force in enumerate(frf.input_names):
            H, size = frf.H[:, o, i], np.abs(frf.H[:, o, i])
            with np.errstate(divide="ignore"):
                level = 20 * np.log10(np.maximum(size, np.finfo(float).tiny))
            at, how = find_peaks(level, prominence=_PROMINENT)
            for k in np.sort(at[np.argsort(-how["prominences"], kind="stable")[:_MOST]]):
                sd = float(np.sqrt(frf.variance[k, o, i] / 2))
                found.append(
                    Peak(
                        response,
                        force,
                        float(frf.frequency_hz[k]),
                        float(size[k]),
                        sd,
                        float(np.degrees(np.angle(H[k]))),
                    )
                )
    return tuple(found)
