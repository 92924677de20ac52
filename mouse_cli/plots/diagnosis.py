"""Figures of a diagnosis: evidence, sites, law, and the data before and after."""

from textwrap import fill
from typing import Any

import numpy as np

from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.diagnosis import UNKNOWN, Diagnosis, Place
from mouse_cli.plots import AFTER, BEFORE, Plot, labelled
from mouse_cli.plots._field import TITLE, band
from mouse_cli.plots._line import along, lying
from mouse_cli.plots._pairs import names, pairs
from mouse_cli.report.sections._diagnosis_wording import place, predicting, probable

_EVIDENCE_MOST, _WIDTH = 10, 36  # bars; characters of a line of their names


def evidence(found: Diagnosis, axes: Any) -> bool:
    """Log evidence over none; the leading group is dark, and probabilities stand at the bars where one explains the data."""
    baseline, best = found.baseline, found.best
    shown = [one for one in found.explanations if one.causes][:_EVIDENCE_MOST]
    if baseline is None or not shown:
        return False
    gains = [one.log_evidence - baseline.log_evidence for one in shown]
    colours = [AFTER if best is not None and one.group == best.group else BEFORE for one in shown]
    axes.barh([_name(one) for one in shown], gains, color=colours, height=0.7)
    for i, (one, gain) in enumerate(zip(shown, gains, strict=True)):
        words = "" if found.kind == UNKNOWN else probable(one.probability)
        axes.annotate(words, (max(gain, 0.0), i), (4, 0), textcoords="offset points", va="center", fontsize=8)
    axes.axvline(0, color="black", linewidth=0.8)
    axes.margins(x=0.2)
    axes.invert_yaxis()
    axes.tick_params(axis="y", labelsize=7)
    axes.grid(axis="y", visible=False)
    return labelled(axes, "log evidence over none; at the bars: probability of the hypothesis")


def _name(one: Any) -> str:
    sites = ", ".join(place(c.site) for c in one.causes if c.site.kind != "structure")
    return fill(f"{one.physics}: {sites}" if sites else one.physics, _WIDTH, max_lines=2, placeholder=" ...")


def field(found: Diagnosis, axes: Any) -> bool:
    """Over the longest direction of the structure, or over the number of the site where sites are not in one line."""
    if found.field is None:
        return False
    values = found.field.values
    row = along([each.site for each in values])
    at, name = (np.arange(1.0, len(values) + 1), "number of the site") if row is None else row
    name = name if row is None else f"{name}, {found.problem.units.of('m')}"
    value, sd = (np.array([getattr(each, key) for each in values], dtype=float) for key in ("value", "sd"))
    return band(axes, at, value, sd, name, found.field.property)


_PLACES_MOST = 15  # bars, where places are not in one line
_DEEP, _TIE = -20.0, -3.0  # ln of the probability over that of the best: the least that is shown, and what is a tie
_STYLES = ("-", "--", ":", "-.")


def places(found: Diagnosis, axes: Any) -> bool:
    """ln P over that of the best for each channel along the longest direction; bars of P where it is no line."""
    location = found.location
    if location is None or not location.places:
        return False
    places = location.places
    row = along([p.site for p in places])
    if row is not None:
        _along(places, row[0], axes)
        return labelled(axes, f"{row[1]}, {found.problem.units.of('m')}")
    shown = places[:_PLACES_MOST]
    lying(axes, [f"{place(p.site)}, {p.channel}" for p in shown], [p.probability for p in shown], AFTER)
    return labelled(axes, "probability")


def _along(places: tuple[Place, ...], at: np.ndarray, axes: Any) -> None:
    """at (j,): of each place along the structure."""
    with np.errstate(divide="ignore"):
        relative = np.log([p.probability for p in places]) - np.log(max(p.probability for p in places))
    for i, channel in enumerate(sorted({p.channel for p in places})):
        own: dict[float, float] = {}
        for j, p in enumerate(places):
            if p.channel == channel:
                own[at[j]] = max(own.get(at[j], -np.inf), relative[j])
        if max(own.values()) < _DEEP:
            continue
        x = sorted(own)
        y = np.maximum([own[each] for each in x], 1.5 * _DEEP)
        axes.plot(
            x, y, _STYLES[i % len(_STYLES)], marker=".", markersize=4, linewidth=1.2, label=channel, color=f"C{i}"
        )
    axes.axhspan(_TIE, 0, color="0.88", zorder=0, label="tie")
    axes.set_ylim(_DEEP, 1)
    axes.set_ylabel("ln P over that of the best")
    axes.legend(title="channel", loc="center left", bbox_to_anchor=(1.01, 0.5))


_ENERGY_MOST = 15  # bars, where places are not in one line


def energy(found: Diagnosis, axes: Any) -> bool:
    """Share of each element along the longest direction of the structure; bars of the largest where it is no line."""
    energy = found.energy
    if energy is None:
        return False
    value, share, row = "share of the energy, per cent", 100 * energy.share, along(energy.sites)
    if row is None:
        shown = energy.order[:_ENERGY_MOST]
        lying(axes, [place(energy.sites[i]) for i in shown], share[shown].tolist(), BEFORE)
        return labelled(axes, value)
    at, name = row
    order = np.argsort(at, kind="stable")
    axes.vlines(at[order], 0, share[order], color=BEFORE, linewidth=1.0)
    axes.plot(at[order], share[order], "o", markersize=3, color="black")
    return labelled(axes, f"{name}, {found.problem.units.of('m')}", value)


def law(found: Diagnosis, axes: Any) -> bool:
    """Stiffness over frequency: level for a spring, falling with its square for a mass, a pole for an oscillator."""
    law = found.law
    if law is None:
        return False
    known = np.isfinite(law.stiffness) & np.isfinite(law.sd)
    if not known.any():
        return False
    hz = law.frequency_hz[known]
    axes.errorbar(
        hz, law.stiffness[known], law.sd[known], fmt="o", color="black", capsize=3, label="implied by the data"
    )
    axes.plot(
        hz, law.fitted[known], "_", markersize=24, markeredgewidth=2, color=AFTER, label=f"{found.best.physics}, fitted"
    )
    axes.axhline(0, color="black", linewidth=0.8)
    size = max(np.abs(law.fitted[known]).max(), np.median(np.abs(law.stiffness[known])))
    axes.set_ylim(*_limits(law.stiffness[known], law.fitted[known], 4 * size))
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel(f"dynamic stiffness, {law.unit}")
    axes.legend()
    return True


def _limits(stiffness: np.ndarray, fitted: np.ndarray, most: float) -> tuple[float, float]:
    """A range that shows the laws, and not a single value without worth."""
    both = np.clip(np.concatenate([stiffness, fitted, [0.0]]), -most, most)
    margin = 0.15 * np.ptp(both)
    return float(both.min() - margin), float(both.max() + margin)


def frequencies(found: Diagnosis, axes: Any) -> bool:
    """Two bars a mode, in per cent of the measured frequency, with the sd of its measurement."""
    test, after = found.problem.test, found.extended_result
    if test is None or not np.isfinite(test.frequency_hz).any():
        return False
    errors = [_error(found.result.revised, test.frequency_hz)]
    if after is not None:
        errors.append(_error(after.revised, test.frequency_hz))
    sd = 100 * test.frequency_sd_hz / test.frequency_hz
    pairs(axes, [f"mode {number}" for number in test.number], errors, sd, names(found))
    return True


def _error(model: Any, measured: np.ndarray) -> np.ndarray:
    return 100 * (frequency_hz(model.eigenvalues[model.modes]) / measured - 1)


def held_out(found: Diagnosis, axes: Any) -> bool:
    """Two bars a frequency, in per cent of what was measured, with the sd of the prediction."""
    held = found.held_out
    if held is None or not np.isfinite(held.measured_hz).any():
        return False
    scores = [held.baseline] if held.revised is None else [held.baseline, held.revised]
    errors = [100 * (score.frequencies_hz / held.measured_hz - 1) for score in scores]
    pairs(
        axes, list(held.labels), errors, 100 * scores[-1].sd_hz / held.measured_hz, (names(found)[0], predicting(found))
    )
    return True


PLOTS = (
    Plot("evidence", 10, "Evidence for each candidate", evidence),
    Plot("field", 15, TITLE, field),
    Plot("places", 20, "Where one force could make all measured shapes", places),
    Plot("energy", 25, "Energy by which stresses and strains disagree", energy),
    Plot("law", 30, "Force law at the site of the mechanism", law),
    Plot("frequencies", 40, "Frequencies that were fitted", frequencies),
    Plot("held-out", 50, "Held-out frequencies", held_out),
)
