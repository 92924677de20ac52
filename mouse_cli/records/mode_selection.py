"""Which candidates are modes: those without which the fit would be worse than noise can make it.

A mode of p unknowns that is not there lowers chi2 by a chi-square variable of p degrees of freedom, and by the largest of many
such variables where its frequency is free to be anywhere in the band: the limit is that of one false mode in a thousand tests,
shared among the lines (Bonferroni).
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.records.local_fit import without
from mouse_cli.records.lscf import BEYOND
from mouse_cli.records.maximum_likelihood import Fit, reduced
from mouse_cli.records.modal_covariance import correlation
from mouse_cli.records.modal_model import Lines, ModalModel, lsfd
from mouse_cli.records.pole_search import NARROWEST

FALSE_MODES = 1e-3  # in a test without any
HEAVIEST = 0.25  # damping of a mode
ALIKE = 0.9  # MAC of residues from which on two poles have one shape
UNKNOWN = 0.5  # sd of the decay rate over it
UNKNOWN_DAMPING = "has a damping that is not known to half of it"
_STRAYED = 3.0  # decay rates
_CLEAR = 20.0  # a rise of chi2 above this many limits, other poles held, needs no second fit


@dataclass(frozen=True)
class Dropped:
    """A candidate taken out: its pole and why."""

    pole: complex
    reason: str


def limit(lines: Lines, model: ModalModel) -> float:
    """Fall of chi2 that a mode must bring."""
    from scipy.stats import chi2

    outputs, inputs = lines.H.shape[1:]
    return float(chi2.isf(FALSE_MODES / len(lines.s), 2 * (outputs + inputs)))


def selected(lines: Lines, fit: Fit, centres: np.ndarray) -> tuple[Fit, list[Dropped]]:
    """The fit with the significant modes alone, and what was taken out of it; centres (c,): poles of the candidates.

    Errors that lines and channels share make a mode that is not there lower chi2 by more, at most by their largest eigenvalue.
    """
    dropped: list[Dropped] = []
    shared = correlation(lines, fit.model).loudest
    kept: set[complex] = set()
    while True:
        fit, gone = _physical(lines, fit, centres)
        dropped += gone
        rise, least = _rises(lines, fit.model), shared * limit(lines, fit.model)
        doubtful = [r for r in np.argsort(rise) if rise[r] < _CLEAR * least and complex(fit.model.poles[r]) not in kept]
        if not doubtful:
            return fit, dropped
        r = doubtful[0]
        pole, simpler = complex(fit.model.poles[r]), without(lines, fit, r)
        if simpler.chi2 - fit.chi2 >= least:
            kept.add(pole)
            continue
        fall = max(simpler.chi2 - fit.chi2, 0.0)
        dropped.append(
            Dropped(pole, f"improves the fit no more than noise would: chi2 by {fall:.0f}, limit {least:.0f}")
        )
        fit = simpler


def _rises(lines: Lines, model: ModalModel) -> np.ndarray:
    """By how much chi2 grows (m,) without each mode in turn, the other poles held."""
    return sum((found.rises(model.m) for found in lsfd(lines, model)), np.zeros(model.m))


def _physical(lines: Lines, fit: Fit, centres: np.ndarray) -> tuple[Fit, list[Dropped]]:
    """The fit without poles that left the damped side or the band, or are no resonances."""
    dropped = []
    while fit.model.m and (
        bad := [(r, why) for r, pole in enumerate(fit.model.poles) if (why := _fault(lines, pole, centres))]
    ):
        r, why = bad[0]
        dropped.append(Dropped(complex(fit.model.poles[r]), why))
        fit = without(lines, fit, r)
    return fit, dropped


def _fault(lines: Lines, pole: complex, centres: np.ndarray) -> str:
    """Why a fitted pole is none of a mode; empty where it may be one."""
    first, last = lines.s.imag[[0, -1]]
    margin = 2 * BEYOND * (last - first)
    if not first - margin < pole.imag < last + margin:
        return "leaves the band once fitted"
    if pole.real >= 0:
        return "has no positive damping once fitted"
    if -pole.real > HEAVIEST * abs(pole):
        return f"is damped by more than {100 * HEAVIEST:.0f} %: a slope of the functions, no resonance"
    if -2 * pole.real < NARROWEST * (last - first) / (len(lines.s) - 1):
        return f"is narrower than {NARROWEST} lines once fitted"
    # one beyond the edges stands for all that is there; a sharp one has come to a resonance that was missed
    apart, widest = np.abs(pole - centres), np.abs(centres.real)
    if first < pole.imag < last and -pole.real > widest.max() and (apart > _STRAYED * widest).all():
        return "moves away from where it was stable once fitted"
    return ""


def known(lines: Lines, fit: Fit, centres: np.ndarray) -> tuple[Fit, list[Dropped]]:
    """The fit without poles that leave one another unknown: of two at one place neither has a decay rate known to half of it."""
    dropped: list[Dropped] = []
    while fit.model.m > 1:
        sd = np.sqrt(
            np.abs(np.diag(np.linalg.pinv(reduced(lines, fit.model)[0], hermitian=True))[: 2 * fit.model.m : 2])
        )
        unknown = np.flatnonzero(sd > UNKNOWN * np.abs(fit.model.poles.real))
        if not len(unknown):
            break
        r = int(unknown[np.argmin(_rises(lines, fit.model)[unknown])])
        dropped.append(Dropped(complex(fit.model.poles[r]), UNKNOWN_DAMPING))
        fit = without(lines, fit, r)
    return fit, dropped


def doubled(lines: Lines, fit: Fit, centres: np.ndarray) -> tuple[Fit, list[Dropped]]:
    """The fit without poles that fit a resonance a second time: within a half-power bandwidth of another, with its shape.

    Functions that do not agree on a frequency, since the structure changed between them or is not linear, ask for that. One
    channel or two cannot tell: all shapes are alike there.
    """
    dropped: list[Dropped] = []
    while lines.H[0].size > 2 and (pairs := _alike(fit.model)):
        rise = _rises(lines, fit.model)
        gone, stays = min(((r, q) for pair in pairs for r, q in (pair, pair[::-1])), key=lambda pair: rise[pair[0]])
        hz = abs(fit.model.poles[stays]) / 2 / np.pi
        reason = f"has the shape of the mode at {hz:.6g} Hz within its bandwidth: one resonance, fitted twice"
        dropped.append(Dropped(complex(fit.model.poles[gone]), reason))
        fit = without(lines, fit, gone)
    return fit, dropped


def _alike(model: ModalModel) -> list[tuple[int, int]]:
    """Pairs of modes with one shape, one participation, and overlapping half-power bandwidths."""
    if model.m < 2:
        return []
    residues = (model.shapes[:, None, :] * model.participation).reshape(-1, model.m)
    size = np.linalg.norm(residues, axis=0)
    likeness = np.abs(residues.conj().T @ residues) ** 2 / np.outer(size, size) ** 2
    apart = np.abs(model.poles.imag[:, None] - model.poles.imag)
    near = apart < -(model.poles.real[:, None] + model.poles.real)
    return [(r, q) for r, q in np.argwhere(np.triu(near & (likeness > ALIKE), 1))]
