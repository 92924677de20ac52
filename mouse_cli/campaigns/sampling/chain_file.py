"""Samples as a file of numpy, without pickles."""

import io

import numpy as np

from mouse_cli._atomic import write_bytes_atomically
from mouse_cli.model.sampled import Sampled


def write(path: str, found: Sampled) -> None:
    """Write the chain to `path`: theta (s, w, p), log_posterior (s, w), hz (s, w, m), names (p,), units (p,), modes (m,).

    Raises WrittenError.
    """
    stream = io.BytesIO()
    parameters = found.parameters
    np.savez_compressed(
        stream,
        theta=found.chain.theta,
        log_posterior=found.chain.log_posterior,
        hz=found.chain.hz,
        names=np.array([each.name for each in parameters], str),
        units=np.array([each.unit for each in parameters], str),
        modes=np.array([int(each.name) for each in found.frequencies], int),
    )
    write_bytes_atomically(path if path.endswith(".npz") else f"{path}.npz", stream.getvalue())
