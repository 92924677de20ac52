"""Mass along bars: a liquid that moves along, ice, coating, cladding."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.effects.element_sets import heavier
from mouse_cli.diagnosis.effects.line_mass import LineIntegral
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.line_mass import add_line_mass, may_bear_more
from mouse_cli.diagnosis.extend.places import beams_within, every_beam, split
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.intervals import Interval, from_end, widest
from mouse_cli.diagnosis.sites.lines import Line
from mouse_cli.diagnosis.sites.preload import runs
from mouse_cli.diagnosis.sites.reasons import line_masses
from mouse_cli.model.diagnosis import EVERYWHERE, Site
from mouse_cli.model.problem import Problem

_PART, _BETWEEN = 0.5, 0.1  # prior probability that a row is covered in part; of those, that neither end of it is
_MOST = 12  # rows of bars that may be covered in part
_SHORTEST, _AT_END = 0.05, 1.01  # share of a row that is covered at least, and up to which multiple it is a lumped mass
_HEAVIEST = 10.0  # times the mass of the bars: a thin pipe holds several times its own mass of water


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M + m times the integral of u'u over bars without a parameter for it: all, or a row of them in part."""
    covered = [run for run in runs(model) if may_bear_more(model.problem, run)]
    if not covered:
        return heavier(model, candidate)
    wet = {id(run): LineIntegral(run) for run in covered}
    ended = [(run, wet[id(run)]) for run in covered[:_MOST]]
    share = _PART / len(ended)
    one, both = 0.5 * (1 - _BETWEEN) * share, _BETWEEN * share
    m = _per_length(model.bars)
    partly = [_partly(candidate, *each, m, back, one) for each in ended for back in (False, True)]
    return [*_all(model, candidate, wet, m), *partly, *(_between(candidate, *each, m, both) for each in ended)]


def _per_length(bars: Bars) -> Unknown:
    mean = float(np.average(bars.line_mass, weights=bars.length)) or 1.0
    return Unknown("mass per length", "kg/m", 1e-3 * mean, _HEAVIEST * mean)


def _all(model: Reduced, candidate: Candidate, wet: dict[int, LineIntegral], m: Unknown) -> list[Recipe]:
    """On all bars of rows without a parameter for it; none where every row has one, which says as much. wet: by id of the row."""
    found, bars = runs(model, "nonstructural_mass"), model.bars
    if not found:
        return []
    total = sum(wet[id(run)].sums[-1] for run in found)
    ids = tuple(sorted({int(bars.ids[i]) for run in found for i in run.members}))
    known = len(set(bars.ids.tolist())) - len(ids)
    named = "all beams" if not known else f"all beams but {known} whose mass is a parameter"
    pieces = (
        [(bars.start[i], np.array(bars.point(int(i), 1.0))) for run in found for i in run.members] if known else None
    )
    everywhere = Recipe(
        candidate,
        (m,),
        lambda values: Change(M=values[0] * total),
        steps(m, 4)[:, None],
        lambda values: Site("element", ids, None, named) if known else EVERYWHERE,
        log_prior=float(np.log(1 - _PART)),
        extend=lambda problem, values: _with_mass(problem, values[0], pieces, named),
        linear=0,
    )
    return [everywhere]


def _partly(candidate: Candidate, run: Line, wet: LineIntegral, m: Unknown, back: bool, share: float) -> Recipe:
    """Over a part of a row, from its beginning or (`back`) from its end."""
    covered = Unknown("covered share of the length", "1", _SHORTEST, widest(run), log=False)
    L = run.length

    def change(values: np.ndarray) -> Change:
        s = L * (1 - values[1] if back else values[1])
        return Change(M=values[0] * wet.part(s, back))

    site = lambda values: from_end(run, values[1], back)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        s = L * (1 - values[1] if back else values[1])
        middle = np.array(run.bars.point(*run.at(s)))
        ends = (middle, run.ends[1]) if back else (run.ends[0], middle)
        return _with_mass(problem, values[0], [ends], site(values).text)

    grid = product(steps(m, 3), steps(covered, 3))
    limit = lambda values: "mass" if values[1] <= _SHORTEST * _AT_END else ""
    prior = float(np.log(share))
    return Recipe(candidate, (m, covered), change, grid, site, 0, prior, extend, limit=limit, linear=0)


def _between(candidate: Candidate, run: Line, wet: LineIntegral, m: Unknown, share: float) -> Recipe:
    """Over a row between any two places."""
    interval = Interval(run)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        return _with_mass(problem, values[0], [interval.points(*values[1:])], interval.site(*values[1:]).text)

    return Recipe(
        candidate,
        (m, *interval.unknowns),
        lambda values: Change(M=values[0] * wet.between(*interval.ends(*values[1:]))),
        product(steps(m, 3), *interval.grid),
        lambda values: interval.site(*values[1:]),
        log_prior=float(np.log(share)),
        extend=extend,
        linear=0,
    )


def _with_mass(problem: Problem, m: float, pieces: list | None, where: str) -> Problem:
    """m (kg/m) on all beams, or on those along `pieces` (start, end), where they are split."""
    edit = Edit(problem)
    for ends in pieces or ():
        split(edit, ends)
    add_line_mass(edit, every_beam(edit) if pieces is None else beams_within(edit, pieces), f"added mass of {where}", m)
    return edit.done()


CANDIDATE = Candidate(
    "added-mass",
    "a distributed added mass",
    "added-mass",
    "added mass per length (entrained liquid, ice, cladding), on all bars, from an end on or "
    "between two points; on all bars alike it equals a larger density",
    recipes,
    line_masses,
)
