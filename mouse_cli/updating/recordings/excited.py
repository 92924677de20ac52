"""What a structure makes of the noise of the excitation of a record, as states that go from sample to sample."""

import numpy as np

from mouse_cli.dynamics.response import Plant, discrete
from mouse_cli.updating.recordings.excitation_noise import Repeated
from mouse_cli.updating.recordings.series import Series

_MIDDLE = 0.25  # of the sample rate: where what modes above the band add to an acceleration is taken


def repeated(series: Series, M: np.ndarray, C: np.ndarray, K: np.ndarray) -> Repeated:
    """What M, C, K (n, n) makes of it, in the units of the outputs, which have no noise of their own.

    Samples excite the modes of their band, up to half the sample rate: impulses would ring those above, folded into it. These
    follow without inertia.
    """
    from scipy.linalg import eigh

    values, shapes = eigh(K, M)
    own = values < (np.pi / series.dt) ** 2
    loads, seen = shapes.T @ (series.loads(M) * series.force_noise), series.sensing @ shapes
    only = lambda matrix: matrix[np.ix_(own, own)][None]
    modal = only(np.eye(len(K))), only(shapes.T @ C @ shapes), only(np.diag(values))
    by = discrete(Plant(*modal, loads[None, own], np.zeros((own.sum(), 0)), seen[:, own], series.order), series.dt)
    count = 2 * int(own.sum())
    given = np.concatenate([np.zeros_like(loads[own]), loads[own] * series.dt])
    read, direct = by.outputs[0, :, :count], by.outputs[0, :, count:]
    middle = (2 * np.pi * _MIDDLE / series.dt) ** 2
    above = (seen[:, ~own] / (values[~own] - middle)) @ loads[~own]
    follows = np.select([series.order == 0, series.order == 2], [1.0, -middle])[:, None] * above
    at_once = direct + follows + series.carried * series.force_noise
    return Repeated(by.next[0, :, :count], given, read, at_once + read @ given / 2, np.zeros(len(seen)))
