"""A bed that is lost under a part of bars: a void below a raft, a free span of a pipeline, ballast that has gone."""

import numpy as np

from mouse_cli.diagnosis.effects.beds import Strength, between, partly
from mouse_cli.diagnosis.effects.change import LOST, Recipe, Unknown
from mouse_cli.diagnosis.effects.hinges import lines
from mouse_cli.diagnosis.effects.line_mass import LineIntegral, deflections
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.lines import Line

_MOST = 12  # lines that may have lost it in part
_EVEN = 1e-6  # of a bed, up to which it is the same all along a line
_BETWEEN = 0.5  # prior probability that neither end of a line has lost it


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K - s k times the integral of w w along a part of each line that has an even bed k."""
    known = _known(model)
    beds = [(line, k) for line in lines(model) if (k := _even(line, known)) > 0][:_MOST] if known else []
    share = -float(np.log(max(len(beds), 1)))
    ended, within = share + float(np.log((1 - _BETWEEN) / 2)), share + float(np.log(_BETWEEN))
    found = []
    for line, k in beds:
        bed, planes = LineIntegral(line, deflections), (int(line.bars.plane[line.members[0]]),)
        lost = Strength(Unknown(LOST, "1", 0.05, 1.0, log=False, at_end=0.5), -k, "bed lost under {}")
        found += [partly(candidate, bed, planes, lost, back, ended) for back in (False, True)]
        found.append(between(candidate, bed, planes, lost, within))
    return found


def _known(model: Reduced) -> list[tuple[np.ndarray, np.ndarray, int, float]]:
    """Both ends (3,), plane and N/m2 of every bed of the deck."""
    mesh, found = model.problem.mesh, []
    for members in () if mesh is None else mesh.elements:
        for plane, name in enumerate(("ky", "kz") if members.type == "foundation" else ()):
            values = np.broadcast_to(members.properties.get(name, 0.0), len(members)).tolist()
            ends = mesh.coordinates[members.nodes[:, :2]]
            found += [(*pair, plane, k) for pair, k in zip(ends, values, strict=True) if k > 0]
    return found


def _even(line: Line, known: list[tuple[np.ndarray, np.ndarray, int, float]]) -> float:
    """The bed all along a line, N/m2; 0 where it has none, or another one here and there. A bed may lie under several bars."""
    bars, own = line.bars, line.members
    middles = bars.start[own] + 0.5 * bars.length[own, None] * bars.axis[own]
    k = np.zeros(len(own))
    for first, last, plane, value in known:
        if plane == bars.plane[own[0]]:
            k += value * (np.linalg.norm(middles - first, axis=1) + np.linalg.norm(middles - last, axis=1)
                          <= (1 + _EVEN) * np.linalg.norm(last - first))  # fmt: skip
    return float(k[0]) if np.ptp(k) <= _EVEN * k.max() else 0.0


CANDIDATE = Candidate(
    "void",
    "a bed that is lost in part",
    "void",
    "springs per length under bars (soil, ballast, cushion) that the model has and that are gone, or softer, from an end of a line "
    "on or between two places: a void, scour, a free span",
    recipes,
)
