"""Beds under a part of a line of bars: from an end on, or between any two places."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.effects.line_mass import LineIntegral
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import beams_within, split
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.intervals import Interval, from_end
from mouse_cli.model.problem import Problem


@dataclass(frozen=True)
class Strength:
    """The unknown `size`, by how much of N/m2 one of it is, and how the parameter is called in a deck."""

    size: Unknown
    by: float
    named: str


def partly(
    candidate: Candidate, bed: LineIntegral, planes: tuple[int, ...], strength: Strength, back: bool, log_prior: float
) -> Recipe:
    """Under a part of a line, from its beginning or (`back`) from its end."""
    line = bed.run
    covered = Unknown("covered share of the length", "1", 0.05, 0.95, log=False)
    L = line.length
    edge = lambda values: L * (1 - values[1] if back else values[1])
    site = lambda values: from_end(line, values[1], back, f", local {' and '.join('yz'[p] for p in planes)}")

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit, middle = Edit(problem), np.array(line.bars.point(*line.at(edge(values))))
        ends = (middle, line.ends[1]) if back else (line.ends[0], middle)
        split(edit, ends)
        return with_bed(edit, [ends], planes, strength.by * values[0], strength.named.format(site(values).text))

    return Recipe(
        candidate,
        (strength.size, covered),
        lambda values: Change(K=strength.by * values[0] * bed.part(edge(values), back)),
        product(steps(strength.size, 6), steps(covered, 3)),
        site,
        log_prior=log_prior,
        extend=extend,
        linear=0,
    )


def between(candidate: Candidate, bed: LineIntegral, planes: tuple[int, ...], strength: Strength, log_prior: float) -> Recipe:
    """Between any two places of a line."""
    line = bed.run
    interval = Interval(line)
    site = lambda values: interval.site(*values[1:], f", local {' and '.join('yz'[p] for p in planes)}")

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit, ends = Edit(problem), interval.points(*values[1:])
        split(edit, ends)
        return with_bed(edit, [ends], planes, strength.by * values[0], strength.named.format(site(values).text))

    return Recipe(
        candidate,
        (strength.size, *interval.unknowns),
        lambda values: Change(K=strength.by * values[0] * bed.between(*interval.ends(*values[1:]))),
        product(steps(strength.size, 4), *interval.grid),
        site,
        log_prior=log_prior,
        extend=extend,
        linear=0,
    )


def with_bed(edit: Edit, segments: list, planes: tuple[int, ...], k: float, named: str) -> Problem:
    """A bed of k (N/m2) under all beams of the segments (start, end); one that is lost is less than none."""
    new, properties = [], tuple(f"k{'yz'[p]}" for p in planes)
    for s, own in _by_set(beams_within(edit, segments)).items():
        options = {key: edit.sets[s].options[key] for key in ("orientation", "offsets") if key in edit.sets[s].options}
        new += edit.add("foundation", edit.sets[s].nodes[own], dict.fromkeys(properties, k), options)
    edit.bind(named, new, properties, unit="N/m2")
    return edit.done()


def _by_set(found: list[tuple[int, int]]) -> dict[int, list[int]]:
    sets: dict[int, list[int]] = {}
    for s, i in found:
        sets.setdefault(s, []).append(i)
    return sets
