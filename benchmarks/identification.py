"""Modal identification beside sdypy-EMA (functions) and pyOMA-2 (outputs alone): time as a ratio, and differences in sd.

The same simulated data for both sides, timed in turn in one run. The peers are not requirements of mouse: install them beside it,
`pip install sdypy-EMA==0.31.0 pyOMA-2==1.4.3`. A peer that is not there is passed over. mouse chooses its poles itself and states
standard deviations; sdypy-EMA is told the frequencies to look for, and pyOMA-2 the order.
"""

import argparse
import contextlib
import io
import os
import sys
from pathlib import Path

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(name, "1")
ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "property")]

import numpy as np
import vibrating
from _paired import paired

from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.recording import OUTPUT, Channel, Recording
from mouse_cli.records.identify import identify_frf, identify_recordings

ORDER = 40
AIM = 1.5  # times the processor time of sdypy-EMA


def functions(rounds: int) -> None:
    """One force, three responses, 1 % noise, 1056 lines."""
    hz = np.arange(0, 70, 0.0625)
    omega, zeta, shapes = vibrating.modes(0.01)
    H, variance = vibrating.disturbed(
        vibrating.accelerance(hz, omega, zeta, shapes, [2]), 0.01, np.random.default_rng(1)
    )
    test = FrfTest(hz, H, "accelerance", np.arange(3), np.array([2]), variance, ("1", "2", "3"), ("3",))
    found = identify_frf([test], (4.0, 69.0)).modes
    _own("functions", omega, found)
    try:
        from sdypy import EMA
    except ImportError:
        print("  sdypy-EMA is not installed")
        return

    def peer():
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            model = EMA.Model(H[:, :, 0].T.copy(), hz, lower=4, upper=69, pol_order_high=ORDER)
            model.get_poles(show_progress=False)
            model.select_closest_poles(list(omega / 2 / np.pi), f_window=5)
            model.get_constants()
        return model

    model = peer()
    _compare("sdypy-EMA", found, np.array(model.nat_freq), np.array(model.nat_xi))
    _ratio(lambda: identify_frf([test], (4.0, 69.0)), peer, "sdypy-EMA", rounds, f", aim {AIM:g}")


def outputs(rounds: int) -> None:
    """Three responses to white forces, 40,000 samples, 1 % noise."""
    samples, rate = vibrating.responses(150.0, 40000, 0.01, 0.01, np.random.default_rng(1)), 150.0
    channels = tuple(Channel(str(k + 1), OUTPUT, "acceleration") for k in range(3))
    recording = Recording("chain", 1 / rate, channels, samples)
    omega, _, _ = vibrating.modes(0.01)
    found = identify_recordings([recording], (4.0, 70.0)).modes
    _own("outputs", omega, found)
    try:
        from pyoma2.algorithms import SSI
        from pyoma2.setup import SingleSetup
    except ImportError:
        print("  pyOMA-2 is not installed")
        return

    def peer():
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            setup = SingleSetup(samples.copy(), fs=rate)
            algorithm = SSI(name="SSIcov", method="cov", br=30, ordmax=ORDER, calc_unc=True, nb=40)
            setup.add_algorithms(algorithm)
            setup.run_by_name("SSIcov")
            setup.mpe("SSIcov", sel_freq=list(omega / 2 / np.pi), order_in=12)
        return algorithm.result

    result = peer()
    _compare("pyOMA-2", found, np.ravel(result.Fn), np.ravel(result.Xi))
    print(f"  pyOMA-2 sd {np.ravel(result.Fn_std) if result.Fn_std is not None else 'none'}")
    _ratio(lambda: identify_recordings([recording], (4.0, 70.0)), peer, "pyOMA-2", rounds)


def _own(what: str, omega: np.ndarray, found) -> None:
    print(f"{what}: truth {omega / 2 / np.pi} Hz")
    print(f"  mouse {found.frequency_hz} sd {found.frequency_sd_hz}, damping {found.damping} sd {found.damping_sd}")


def _compare(peer: str, found, hz: np.ndarray, zeta: np.ndarray) -> None:
    """The peer's answer, and how many standard deviations of ours it is away."""
    order = np.argsort(hz)
    away = (hz[order] - found.frequency_hz) / found.frequency_sd_hz, (zeta[order] - found.damping) / found.damping_sd
    print(f"  {peer} {hz[order]}, damping {zeta[order]}\n  away by {away[0].round(2)} and {away[1].round(2)} sd")


def _ratio(own, peer, name: str, rounds: int, aim: str = "") -> None:
    mine, others, ratio = paired(own, peer, rounds)
    print(f"  mouse {mine:.2f} s, {name} {others:.2f} s, ratio {ratio:.2f}{aim}")


if __name__ == "__main__":
    np.set_printoptions(precision=5, suppress=True)
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=3)
    given = parser.parse_args()
    functions(given.rounds)
    outputs(given.rounds)
