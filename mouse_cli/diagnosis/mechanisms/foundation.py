"""An elastic foundation under bars, after Winkler."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, product, proportional, steps
from mouse_cli.diagnosis.effects.hinges import lines
from mouse_cli.diagnosis.effects.line_mass import LineIntegral, across, deflections
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import beams_within, split
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.intervals import Interval, from_end
from mouse_cli.diagnosis.sites.lines import elements
from mouse_cli.diagnosis.sites.stretches import bends_both_ways
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem
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
    parts = whole + [(found, (plane,)) for plane in sorted(set(bars.plane.tolist()))]
    if len(found) > 1:
        parts += [([line], (int(bars.plane[line.members[0]]),)) for line in found]
    share = np.where(np.arange(len(parts)) < len(parts) - len(found), 1.0, 1.0 / len(found))
    share *= (1 - _PART) / share.sum()
    along = [
        _recipe(model, candidate, some, planes, float(np.log(one)))
        for (some, planes), one in zip(parts, share, strict=True)
    ]
    ended = [(line, (int(bars.plane[line.members[0]]),)) for line in found]
    ended += [(line, (0, 1)) for line in found if not bars.plane[line.members[0]] and bends_both_ways(line)]
    beds = [(LineIntegral(line, across if len(planes) > 1 else deflections), planes) for line, planes in ended[:_MOST]]
    one, both = (float(np.log(part / len(beds))) for part in (_PART * (1 - _PART) / 2, _PART**2))
    partly = [_partly(candidate, *bed, back, one) for bed in beds for back in (False, True)]
    return along + partly + [_between(candidate, *bed, both) for bed in beds]


def _recipe(model: Reduced, candidate: Candidate, some: list, planes: tuple[int, ...], log_prior: float) -> Recipe:
    bars = model.bars
    members = np.concatenate([line.members for line in some])
    members = members[np.isin(bars.plane[members], planes)]
    w, _, _ = beam.shapes(bars.length[members], np.zeros(len(members)))
    K = bars.added(beam.integral(w, bars.length[members]), members)
    k = _stiffness(bars, max(line.length for line in some))
    ids = tuple(np.unique(bars.ids[members]).tolist())
    site = Site("element", ids, None, f"{elements(ids)}, local {' and '.join('yz'[p] for p in planes)}")
    extend = lambda problem, values: _with_bed(
        Edit(problem), [line.ends for line in some], planes, values[0], elements(ids)
    )
    return proportional(candidate, k, 6, site, log_prior, extend, K=K)


def _partly(candidate: Candidate, bed: LineIntegral, planes: tuple[int, ...], back: bool, log_prior: float) -> Recipe:
    """Under a part of a line, from its beginning or (`back`) from its end."""
    line = bed.run
    k = _stiffness(line.bars, line.length)
    covered = Unknown("covered share of the length", "1", 0.05, 0.95, log=False)
    L = line.length
    edge = lambda values: L * (1 - values[1] if back else values[1])
    site = lambda values: from_end(line, values[1], back, f", local {' and '.join('yz'[p] for p in planes)}")

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit, middle = Edit(problem), np.array(line.bars.point(*line.at(edge(values))))
        ends = (middle, line.ends[1]) if back else (line.ends[0], middle)
        split(edit, ends)
        return _with_bed(edit, [ends], planes, values[0], site(values).text)

    return Recipe(
        candidate,
        (k, covered),
        lambda values: Change(K=values[0] * bed.part(edge(values), back)),
        product(steps(k, 6), steps(covered, 3)),
        site,
        log_prior=log_prior,
        extend=extend,
        linear=0,
    )


def _between(candidate: Candidate, bed: LineIntegral, planes: tuple[int, ...], log_prior: float) -> Recipe:
    """Between any two places of a line."""
    line = bed.run
    k, interval = _stiffness(line.bars, line.length), Interval(line)
    site = lambda values: interval.site(*values[1:], f", local {' and '.join('yz'[p] for p in planes)}")

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit, ends = Edit(problem), interval.points(*values[1:])
        split(edit, ends)
        return _with_bed(edit, [ends], planes, values[0], site(values).text)

    return Recipe(
        candidate,
        (k, *interval.unknowns),
        lambda values: Change(K=values[0] * bed.between(*interval.ends(*values[1:]))),
        product(steps(k, 4), *interval.grid),
        site,
        log_prior=log_prior,
        extend=extend,
        linear=0,
    )


def _stiffness(bars: Bars, length: float) -> Unknown:
    """What a bed under a line of that length may have."""
    scale = bars.stiffness / length**4
    return Unknown("stiffness per length", "N/m2", 0.1 * scale, 1e4 * scale)


def _with_bed(edit: Edit, segments: list, planes: tuple[int, ...], k: float, where: str) -> Problem:
    """A bed under all beams of the segments (start, end)."""
    new, properties = [], tuple(f"k{'yz'[p]}" for p in planes)
    for s, own in _by_set(beams_within(edit, segments)).items():
        options = {key: edit.sets[s].options[key] for key in ("orientation", "offsets") if key in edit.sets[s].options}
        new += edit.add("foundation", edit.sets[s].nodes[own], dict.fromkeys(properties, k), options)
    edit.bind(f"foundation of {where}", new, properties, unit="N/m2")
    return edit.done()


def _by_set(found: list[tuple[int, int]]) -> dict[int, list[int]]:
    sets: dict[int, list[int]] = {}
    for s, i in found:
        sets.setdefault(s, []).append(i)
    return sets


CANDIDATE = Candidate(
    "foundation",
    "an elastic foundation",
    "foundation",
    "springs per length under bars (soil, cushion, cable bed) that the model does not have, under all of a line, from an end on or "
    "between two points: under all bars alike all modes rise by the same square of the frequency",
    recipes,
)
