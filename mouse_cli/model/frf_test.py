"""Frequency response functions as measured: response per unit force, line by line, with their accuracy."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.arrays import Matrix, freeze
from mouse_cli.model.block_window import BlockWindow
from mouse_cli.model.held_reading import HeldReading

FORMS = ("complex", "log", "log-phase")  # what of a function is fitted: it, ln of its magnitude, that and its phase
MOST_LINES = 200  # of a measurement that are fitted unless a deck says otherwise
KINDS = {"receptance": 0, "mobility": 1, "accelerance": 2}  # the power of i omega that receptance is multiplied by


@dataclass(frozen=True)
class FrfTest:
    """H at f lines, o responses and i forces.

    frequency_hz (f,), ascending, Hz. H (f, o, i), complex, NaN where not measured: responses in the unit of `kind` (one of KINDS)
    for e^{+i omega t}. variance (f, o, i): E|H - its mean|^2, real and imaginary part each half of it; NaN where unknown.
    outputs (o, n), inputs (i, n): weights of what each response reads and of where each force acts, dense or sparse; or degrees
    of freedom (o,), (i,), from 0, where each is one. output_names, input_names: as the deck writes them.
    coherence (f, o): multiple coherence, None where it was not recorded. title: of the measurement; path: its file.
    form: one of FORMS; lines: at most so many are fitted. decay_rate: a of an exponential window e^{-a t}, 1/s; H is then that of
    the structure at s = a + i omega, see `laplace`. gain_sd: standard deviation of the gain of each response and of each force; 0:
    they are known. window: of the blocks that H1 averaged, whose lag window multiplies the impulse response of the structure in H,
    see `records.leakage`; None: H is that of the structure itself. held: what responses read besides
    where supports hold the model, 0 in it.
    """

    frequency_hz: np.ndarray
    H: np.ndarray
    kind: str
    outputs: Matrix
    inputs: Matrix
    variance: np.ndarray
    output_names: tuple[str, ...] = ()
    input_names: tuple[str, ...] = ()
    coherence: np.ndarray | None = None
    title: str = ""
    path: str = ""
    form: str = FORMS[0]
    lines: int = MOST_LINES
    decay_rate: float = 0.0
    gain_sd: float = 0.0
    window: BlockWindow | None = None
    held: tuple[HeldReading, ...] = ()

    def __post_init__(self) -> None:
        shape = (len(self.frequency_hz), self.outputs.shape[0], self.inputs.shape[0])
        freeze(self, frequency_hz=shape[:1], variance=shape, coherence=shape[:2])
        freeze(self, complex, H=shape)

    @property
    def omega(self) -> np.ndarray:
        """Angular frequencies (f,), rad/s."""
        return 2 * np.pi * self.frequency_hz

    @property
    def laplace(self) -> np.ndarray:
        """Where the functions were measured, s = decay_rate + i omega (f,), rad/s."""
        return self.decay_rate + 1j * self.omega
