"""Modes from frequency response functions: candidates that stay (p-LSCF), fit (LSFD, maximum likelihood), selection, covariance."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.model.block_window import BlockWindow
from mouse_cli.model.frf_test import KINDS, FrfTest
from mouse_cli.records import identify_noise
from mouse_cli.records.leakage import lags, leakage
from mouse_cli.records.local_fit import approached
from mouse_cli.records.maximum_likelihood import ROUGH, Fit, fitted
from mouse_cli.records.modal_covariance import Correlation, ModalCovariance, correlation, covariance
from mouse_cli.records.modal_model import ABOVE, BELOW, CURVED, Lines, start, synthesised
from mouse_cli.records.mode_selection import Dropped, doubled, known, selected
from mouse_cli.records.pole_search import Search, search
from mouse_cli.records.stabilisation import Track

LEAST_LINES = 16
_REFITS = 2
_UNLEAKED = 6  # times at most
_UNSEEN = 0.1  # change, root mean square over sd, that is not worth another
_TOO_SHARP = "decays more slowly than the exponential window lets anything"


@dataclass(frozen=True)
class Found:
    """What identification of one set of functions gives, before it is judged.

    lines: with the sd that the fit used; stated: whether they were measured; misfit: of the fit with stated sd; raised: share of
    lines whose sd were raised since the fit errs more. leaked: what was taken out as made by a window, over sd.
    """

    lines: Lines
    fit: Fit
    covariance: ModalCovariance
    errors: Correlation
    search: Search
    dropped: list[Dropped]
    stated: bool
    misfit: float
    raised: float
    leaked: float = 0.0


def banded(test: FrfTest, band: tuple[float, float] | None) -> np.ndarray:
    """Which lines (f,) are used: within `band`, never 0 Hz, where inertia has no receptance."""
    hz = test.frequency_hz
    use = hz > 0
    return use if band is None else use & (hz >= band[0]) & (hz <= band[1])


def lines_of(test: FrfTest, use: np.ndarray) -> tuple[Lines, bool]:
    """The lines used, and whether their variance is known."""
    s, H, variance, kind = test.laplace[use], test.H[use], test.variance[use], KINDS[test.kind]
    stated = bool(np.isfinite(variance).any())
    if stated:
        return identify_noise.with_sd(s, H, variance, kind), True
    return identify_noise.without_sd(s, H, kind), False


def identify_lines(lines: Lines, stated: bool, most: int | None, say: Callable[[str], None]) -> Found:
    """Modes of the lines; `most`: highest order of the stabilisation diagram."""
    say("poles")
    seen = search(lines, most)
    say("fit")
    fit, lines, misfit, raised, dropped = _fitted(lines, stated, seen.candidates)
    say("covariance")
    errors = correlation(lines, fit.model)
    found = covariance(lines, fit.model, errors)
    return Found(lines, fit, found, errors, seen, dropped, stated, misfit, raised)


def identify_leaking(
    lines: Lines, stated: bool, most: int | None, say: Callable[[str], None], window: BlockWindow | None
) -> Found:
    """Modes of lines that a window has broadened: what it makes of the modes found is taken out, and so on.

    As long as the fit gets better by it: of a force that is not white around a resonance the leakage is another.
    """
    found, out = identify_lines(lines, stated, most, say), np.zeros(lines.H.shape, complex)
    for _ in range(_UNLEAKED if window is not None else 0):
        before, out = out, leakage(lines, found.fit.model, lags(window), window.seconds)
        known = np.isfinite(lines.sd)
        change, whole = (np.sqrt(np.mean(np.abs(x[known] / found.lines.sd[known]) ** 2)) for x in (out - before, out))
        if not change > _UNSEEN:
            break
        say("leakage")
        after = identify_lines(replace(lines, H=lines.H - out), stated, most, say)
        if after.misfit > found.misfit:
            break
        found = replace(after, leaked=float(whole))
    return found


def _fitted(lines: Lines, stated: bool, candidates: list[Track]) -> tuple[Fit, Lines, float, float, list[Dropped]]:
    """The fit of what is significant, the lines with the sd it stands on, misfit, share of lines raised, what was dropped."""
    centres = [track.centre() for track in candidates]
    # an exponential window adds to the decay rate of every mode: a pole that has less is none of a mode
    added = lines.s[0].real
    dropped = [Dropped(pole + added, _TOO_SHARP) for pole, _ in centres if pole.real + added >= 0]
    centres = [(pole, vector) for pole, vector in centres if pole.real + added < 0]
    poles = np.array([pole for pole, _ in centres], complex) + added
    inputs = lines.H.shape[2]
    participation = np.array([vector for _, vector in centres], complex).reshape(len(poles), inputs).T
    first = approached(lines, start(poles, participation, lines.H.shape[1], (BELOW, ABOVE, CURVED)))
    fit = fitted(lines, first, small=ROUGH)
    given, raised = lines, 0.0
    for choose in (_as_they_are, selected, _second_look, selected, doubled, selected, known):
        before = fit
        fit, gone = choose(lines, fit, poles)
        dropped += gone
        for _ in range(_REFITS if fit is not before or choose is _as_they_are else 0):
            lines, raised = _weighted(given, fit, stated)
            fit = fitted(lines, fit.model, small=ROUGH)
    fit = fitted(lines, fit.model)
    misfit = fitted(given, fit.model, 0).misfit if stated else float("nan")
    return fit, lines, misfit, raised, dropped


def _as_they_are(lines: Lines, fit: Fit, centres: np.ndarray) -> tuple[Fit, list[Dropped]]:
    return fit, []


def _second_look(lines: Lines, fit: Fit, centres: np.ndarray) -> tuple[Fit, list[Dropped]]:
    """The fit with poles that are stable in what it leaves: weak modes beside strong ones show there first.

    Those within a bandwidth of a mode, or narrower than two lines, are none of their own: they mend what is misfitted.
    """
    model, added = fit.model, lines.s[0].real
    left = np.where(np.isfinite(lines.sd), lines.H - synthesised(lines, model), 0)
    seen = [track.centre() for track in search(replace(lines, H=left)).candidates] if model.m else []
    apart = lambda pole: np.abs(pole.imag - model.poles.imag) > -(pole.real + added) - model.poles.real
    least = (lines.s.imag[-1] - lines.s.imag[0]) / (len(lines.s) - 1)  # decay rate of two lines
    new = [(pole + added, vector) for pole, vector in seen if pole.real + added < -least and apart(pole).all()]
    if not new:
        return fit, []
    poles = np.concatenate([model.poles, [pole for pole, _ in new]])
    participation = np.concatenate([model.participation, np.array([vector for _, vector in new]).T], axis=1)
    return fitted(lines, start(poles, participation, len(model.shapes), model.powers), small=ROUGH), []


def _weighted(given: Lines, fit: Fit, stated: bool) -> tuple[Lines, float]:
    """The lines with sd as the fit shows them, and the share of lines where stated ones were raised."""
    return (
        identify_noise.widened(given, fit.model) if stated else (identify_noise.measured_noise(given, fit.model), 0.0)
    )
