"""What speaks against identified modes: edges of the band, narrow resonances, poor fits, driving points that cannot be."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import ERROR, WARNING, Diagnostic
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.identification import Modes, Rejected
from mouse_cli.records.identify_frf import Found
from mouse_cli.records.identify_modes import Drive, from_fit, from_subspace
from mouse_cli.records.identify_output_only import FoundOutputs
from mouse_cli.records.modal_model import ModalModel, partial_fractions, synthesised
from mouse_cli.records.mode_selection import UNKNOWN, UNKNOWN_DAMPING
from mouse_cli.records.pole_search import NARROWEST
from mouse_cli.records.sweep import Sweep, swept

_NARROW = 2.0  # lines in a half-power bandwidth
_POOR = 1 / 3
_MISFIT = 2.0  # mean square of errors over stated variances that is worth a remark
_RISE = 3.0  # of the level at an edge over the largest a twentieth to a sixth of the band within
_TURNED = (60.0, 120.0)  # degrees between residues and those of a structure


@dataclass(frozen=True)
class Review:
    """The modes that stay, what was rejected, and what to say."""

    modes: Modes
    rejected: tuple[Rejected, ...]
    doubts: tuple[Diagnostic, ...]
    remarks: tuple[Diagnostic, ...]


def drive_points(test: FrfTest) -> list[Drive]:
    """Where a response is at a force, by name: 12TY at 12TY, or 12-TY, which looks backwards."""
    plain = lambda name: name.replace("-", "").replace("+", "")
    return [
        Drive(o, i, 1 if output == force else -1)
        for i, force in enumerate(test.input_names)
        for o, output in enumerate(test.output_names)
        if plain(output) == plain(force)
    ]


def reviewed(found: Found, drives: list[Drive]) -> Review:
    """The modes of a fit that lie within the band and are known."""
    model = found.fit.model
    first, last = found.lines.s.imag[[0, -1]] / (2 * np.pi)
    rejected, doubts, kept = [], [], []
    for r in np.argsort(np.abs(model.poles)):
        pole = model.poles[r]
        hz, zeta = abs(pole) / (2 * np.pi), -pole.real / abs(pole)
        reason = _at_edge(hz, zeta, first, last)
        if reason:
            message = f"a mode at {hz:.6g} Hz, {100 * zeta:.3g} % {reason}"
            doubts.append(
                Diagnostic("MD652", ERROR, message, help="move the edge away from the resonance: --band LOW HIGH")
            )
        elif np.sqrt(found.covariance.poles[2 * r, 2 * r]) > UNKNOWN * abs(pole.real):
            reason = UNKNOWN_DAMPING
        if reason:
            rejected.append(Rejected(hz, zeta, reason))
        else:
            kept.append(int(r))
    stable = np.array([_stable_orders(found, model.poles[r]) for r in kept], int)
    doubts += [] if doubts else _flanks(found)
    modes, angles = from_fit(found, np.array(kept, int), drives, stable)
    more, remarks = _of_modes(modes, angles)
    more += _close(found, kept)
    spikes = [track.centre()[0] for track in found.search.spikes]
    rejected += [Rejected(abs(p) / 2 / np.pi, -p.real / abs(p), f"is narrower than {NARROWEST} lines") for p in spikes]
    if not modes.m:
        more += [_none(len(rejected) + len(found.dropped)), *_narrow(spikes)]
    remarks += _misfit(found) + _kind(found.fit.model, kept)
    return Review(modes, tuple(rejected), (*doubts, *more), tuple(remarks))


def _close(found: Found, kept: list[int]) -> list[Diagnostic]:
    """Doubts where what the fit leaves is that of two modes in one bandwidth."""
    said = "what the fit leaves near the mode at {:.6g} Hz has its resonance and another shape: two modes in one bandwidth?"
    help = "measure with a force at another point too, or with finer lines; compare two levels of force"
    another = unresolved(found)
    poles = [found.fit.model.poles[r] for r in kept if another[r]]
    return [Diagnostic("MD681", ERROR, said.format(abs(pole) / 2 / np.pi), help=help) for pole in poles]


def _none(others: int) -> Diagnostic:
    message = (
        f"no mode was found in the band; {others} candidates were rejected"
        if others
        else "no stable pole was found in the band"
    )
    return Diagnostic(
        "MD650", ERROR, message, help="check the stabilisation diagram: --plot FOLDER; try another --band"
    )


def _narrow(spikes: list[complex]) -> list[Diagnostic]:
    """A doubt where all that is stable is narrower than the lines can show."""
    if not spikes:
        return []
    hz = ", ".join(f"{abs(pole) / 2 / np.pi:.6g}" for pole in spikes[:5])
    message = f"what is stable at {hz} Hz has half-power bandwidths below {NARROWEST} lines"
    return [Diagnostic("MD653", ERROR, message, help="measure with finer lines")]


def _at_edge(hz: float, zeta: float, first: float, last: float) -> str:
    if not first <= hz <= last:
        return f"lies outside of the band of {first:.6g} to {last:.6g} Hz"
    if hz * (1 - zeta) < first or hz * (1 + zeta) > last:
        return f"is cut by the edge of the band of {first:.6g} to {last:.6g} Hz"
    return ""


def _flanks(found: Found) -> list[Diagnostic]:
    """Doubts where the functions rise towards an edge as on the flank of a resonance that lies beyond it."""
    level = np.sqrt((np.abs(found.lines.H) ** 2).mean(axis=(1, 2)))
    hz, count, doubts = found.lines.s.imag / (2 * np.pi), len(level), []
    for edge, inwards in ((hz[0], level), (hz[-1], level[::-1])):
        within = inwards[max(3, count // 20) : max(6, count // 6)]
        if np.median(inwards[:3]) > _RISE * within.max():
            message = f"the functions rise steeply towards {edge:.6g} Hz: a mode lies just outside of the band"
            doubts.append(
                Diagnostic("MD652", ERROR, message, help="move the edge away from the resonance: --band LOW HIGH")
            )
    return doubts


def _stable_orders(found: Found, pole: complex) -> int:
    """In how many orders the candidate that became the mode was stable."""
    nearest = min(found.search.candidates, key=lambda track: abs(track.centre()[0] - pole))
    return nearest.stable_orders


def _of_modes(modes: Modes, angles: list[float]) -> tuple[list[Diagnostic], list[Diagnostic]]:
    """Doubts and remarks on single modes."""
    doubts, remarks = [], []
    for r in range(modes.m):
        name = f"the mode at {modes.frequency_hz[r]:.6g} Hz"
        if modes.lines[r] < _NARROW:
            message = (
                f"{name} has {modes.lines[r]:.2g} lines in its half-power bandwidth; at least {_NARROW:.0f} are needed"
            )
            doubts.append(Diagnostic("MD653", ERROR, message, help="measure with finer lines"))
        if modes.error[r] > _POOR:
            message = f"near {name} the fit differs from the functions by {100 * modes.error[r]:.0f} % of their size"
            doubts.append(Diagnostic("MD654", ERROR, message, help="check the fit: --plot FOLDER"))
        if np.isfinite(angles[r]) and modes.scale[r] != "unit modal mass":
            message = f"the driving point of {name} is {angles[r]:.0f} degrees from that of a structure; its shape has no scale"
            remarks.append(Diagnostic("MD657", WARNING, message, help="check the signs of force cell and sensor"))
    return doubts, remarks


def _misfit(found: Found) -> list[Diagnostic]:
    if not found.stated or not found.misfit > _MISFIT:
        return []
    message = (
        f"the errors of the fit are {np.sqrt(found.misfit):.3g} times the stated variances; "
        f"standard deviations were raised to them at {100 * found.raised:.0f} % of the lines"
    )
    return [Diagnostic("MD658", WARNING, message, help="look for modes that are missing, and for nonlinearity")]


def _kind(model: ModalModel, kept: list[int]) -> list[Diagnostic]:
    """A remark where the residues of the modes together are turned as those of functions of another kind."""
    if not kept:
        return []
    residues = 2j * model.poles[kept].imag * model.shapes[:, None, kept] * model.participation[:, kept]
    angle = np.degrees(np.angle((residues**2).sum())) / 2 % 180  # signs do not matter
    if not _TURNED[0] < angle < _TURNED[1]:
        return []
    message = f"the residues of the modes are {angle:.0f} degrees from those of a structure: the functions are of another kind"
    return [Diagnostic("MD656", WARNING, message, help="correct kind: receptance, mobility or accelerance")]


def reviewed_outputs(found: FoundOutputs, band_hz: tuple[float, float], sweeps: Sequence[Sweep | None] = ()) -> Review:
    """The modes of records of outputs that lie within the band, and not where records that are sweeps begin."""
    rejected, doubts, kept, begins = [], [], [], []
    for k, mode in enumerate(found.modes):
        hz, zeta = abs(mode.pole) / (2 * np.pi), -mode.pole.real / abs(mode.pole)
        reason = _at_edge(hz, zeta, *band_hz)
        if reason:
            message = f"a mode at {hz:.6g} Hz, {100 * zeta:.3g} % {reason}"
            doubts.append(
                Diagnostic("MD652", ERROR, message, help="move the edge away from the resonance: --band LOW HIGH")
            )
            rejected.append(Rejected(hz, zeta, reason))
        elif any(one is not None and one.begins_at(hz) for one in sweeps):
            begins.append(hz)
            rejected.append(Rejected(hz, zeta, "lies where a sweep begins or ends"))
        else:
            kept.append(k)
    kept.sort(key=lambda k: abs(found.modes[k].pole))
    stable = np.array([found.tracks[k].stable_orders for k in kept], int)
    modes = from_subspace([found.modes[k] for k in kept], stable)
    if not modes.m:
        doubts.append(_none(len(rejected) + len(found.dropped)))
    return Review(modes, tuple(rejected), tuple(doubts), swept(sweeps, begins))


_REACH = 3.0  # half-power bandwidths to either side
_LEAST = 10  # lines there
_CHANCE = 1e-4  # at most, that noise alone makes it


def unresolved(found: Found) -> np.ndarray:
    """Mask (m,) of the modes of a fit beside which another one seems to be, within its bandwidth.

    Two poles much closer than a bandwidth have, but for terms of second order, R_1 / (s - lambda) + R_2 / (s - lambda)^2. A fit
    with one pole finds R_1, and of R_2 only what has the shape of the mode. Errors that 1 / (s - lambda)^2 explains, each channel
    by a number of its own, are a second shape; where the structure is not linear, or drifted during the test, they look alike.
    F, the mean square that the term explains over that which is left, is compared with that of a single independent channel (errors
    of a force are common to all), P(F) = e^-F, and with neighbouring lines correlated as the fit shows them.
    """
    model, lines = found.fit.model, found.lines
    errors = np.where(np.isfinite(lines.sd), (lines.H - synthesised(lines, model)) / lines.sd, 0)
    alike = max(1.0, 1 + 2 * float(np.real(found.errors.rho[1:]).sum()))
    limit = np.log(max(model.m, 1) / _CHANCE) * alike
    return np.array([_ratio(found, errors, pole) > limit for pole in model.poles], bool)


def _ratio(found: Found, errors: np.ndarray, pole: complex) -> float:
    """F near one pole, for errors (f, o, i) over their sd; 0 for too few lines."""
    lines = found.lines
    near = np.abs(lines.s.imag - pole.imag) < _REACH * 2 * -pole.real
    if near.sum() < _LEAST:
        return 0.0
    s, one = lines.s[near], np.array([pole])
    once, twice = (partial_fractions(s, lines.kind, one, power)[0][:, 0] for power in (1, 2))
    away = (s - s.mean()) / np.abs(s - s.mean()).max()
    explained, left = 0.0, 0.0
    for o, i in np.ndindex(errors.shape[1:]):
        weight = 1 / lines.sd[near, o, i]
        columns = np.stack([once, np.ones(len(s)), away, twice], axis=1) * weight[:, None]
        columns = columns[:, np.abs(columns).max(axis=0) > 0]
        if columns.shape[1] < 4:
            continue
        Q, _ = np.linalg.qr(columns / np.linalg.norm(columns, axis=0))
        parts = Q.conj().T @ errors[near, o, i]
        explained += abs(parts[-1]) ** 2
        left += (np.linalg.norm(errors[near, o, i]) ** 2 - np.linalg.norm(parts) ** 2) / (len(s) - 4)
    return explained / left if left > 0 else 0.0
