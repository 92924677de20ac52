"""An elastic foundation under bars, after Winkler."""

import numpy as np

from mouse_cli.diagnosis.effects.beds import Strength, between, partly, with_bed
from mouse_cli.diagnosis.effects.change import Recipe, Unknown, proportional
from mouse_cli.diagnosis.effects.hinges import lines
from mouse_cli.diagnosis.effects.line_mass import LineIntegral, across, deflections
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.lines import elements
from mouse_cli.model.diagnosis import Site
from mouse_cli.terms.elements import _beam as beam

_PART = 0.1  # prior probability that a bed ends where no line does; of both ends of it, its square
_MOST = 12  # lines that may lie on one in part


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + k times the integral of w w along all bars, along those of one plane, and along each line, or parts of it."""
    found = lines(model)
    if not found:
        return []
    bars = model.bars
    whole = [(found, (0, 1))] if len(set(bars.plane.tolist())) > 1 else []
    plane = [int(bars.plane[line.members[0]]) for line in found]
    parts = whole + [(found, (each,)) for each in sorted(set(bars.plane.tolist()))]
    alone = [([line], (each,)) for line, each in zip(found, plane, strict=True) if plane.count(each) > 1]
    share = np.append(np.ones(len(parts)), np.full(len(alone), 1 / max(len(alone), 1)))
    share *= (1 - _PART) / share.sum()
    parts += alone
    along = [
        _recipe(model, candidate, some, planes, float(np.log(one)))
        for (some, planes), one in zip(parts, share, strict=True)
    ]
    ended = [(line, (int(bars.plane[line.members[0]]),)) for line in found]
    ended += [(line, (0, 1)) for line in found if not bars.plane[line.members[0]] and line.both_ways]
    beds = [(LineIntegral(line, across if len(planes) > 1 else deflections), planes) for line, planes in ended[:_MOST]]
    one, both = (float(np.log(part / len(beds))) for part in (_PART * (1 - _PART) / 2, _PART**2))
    under_ends = [partly(candidate, *bed, _found(*bed), back, one) for bed in beds for back in (False, True)]
    return along + under_ends + [between(candidate, *bed, _found(*bed), both) for bed in beds]


def _recipe(model: Reduced, candidate: Candidate, some: list, planes: tuple[int, ...], log_prior: float) -> Recipe:
    bars = model.bars
    members = np.concatenate([line.members for line in some])
    members = members[np.isin(bars.plane[members], planes)]
    w, _, _ = beam.shapes(bars.length[members], np.zeros(len(members)))
    K = bars.added(beam.integral(w, bars.length[members]), members)
    k = _stiffness(bars, max(line.length for line in some))
    ids = tuple(np.unique(bars.ids[members]).tolist())
    site = Site("element", ids, None, f"{elements(ids)}, local {' and '.join('yz'[p] for p in planes)}")
    extend = lambda problem, values: with_bed(
        Edit(problem), [line.ends for line in some], planes, values[0], f"foundation of {elements(ids)}"
    )
    return proportional(candidate, k, 6, site, log_prior, extend, K=K)


def _found(bed: LineIntegral, planes: tuple[int, ...]) -> Strength:
    """Of one that is there, and that the model does not have."""
    return Strength(_stiffness(bed.run.bars, bed.run.length), 1.0, "foundation of {}")


def _stiffness(bars: Bars, length: float) -> Unknown:
    """What a bed under a line of that length may have."""
    scale = bars.stiffness / length**4
    return Unknown("stiffness per length", "N/m2", 0.1 * scale, 1e4 * scale)


CANDIDATE = Candidate(
    "foundation",
    "an elastic foundation",
    "foundation",
    "springs per length under bars (soil, cushion, cable bed) that the model does not have, under all of a line, from an end on or "
    "between two points: under all bars alike all modes rise by the same square of the frequency",
    recipes,
)
