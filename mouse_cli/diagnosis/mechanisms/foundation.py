"""An elastic foundation under bars, after Winkler."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.effects.hinges import lines
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import beams_within
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.lines import elements
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem
from mouse_cli.terms.elements import _beam as beam


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + k times the integral of w w along all bars, along those of one plane, and along each line."""
    found = lines(model)
    if not found:
        return []
    bars = model.bars
    whole = [(found, (0, 1))] if len(set(bars.plane.tolist())) > 1 else []
    parts = whole + [(found, (plane,)) for plane in sorted(set(bars.plane.tolist()))]
    if len(found) > 1:
        parts += [([line], (int(bars.plane[line.members[0]]),)) for line in found]
    share = np.where(np.arange(len(parts)) < len(parts) - len(found), 1.0, 1.0 / len(found))
    return [
        _recipe(model, candidate, some, planes, float(np.log(one / share.sum())))
        for (some, planes), one in zip(parts, share, strict=True)
    ]


def _recipe(model: Reduced, candidate: Candidate, some: list, planes: tuple[int, ...], log_prior: float) -> Recipe:
    bars = model.bars
    members = np.concatenate([line.members for line in some])
    members = members[np.isin(bars.plane[members], planes)]
    w, _, _ = beam.shapes(bars.length[members], np.zeros(len(members)))
    K = bars.added(beam.integral(w, bars.length[members]), members)
    scale = bars.stiffness / max(line.length for line in some) ** 4
    k = Unknown("stiffness per length", "N/m2", 0.1 * scale, 1e4 * scale)
    ids = tuple(np.unique(bars.ids[members]).tolist())
    site = Site("element", ids, None, f"{elements(ids)}, local {' and '.join('yz'[p] for p in planes)}")
    properties = tuple(f"k{'yz'[p]}" for p in planes)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        new = []
        for s, own in _by_set(beams_within(edit, [line.ends for line in some])).items():
            options = {
                key: edit.sets[s].options[key] for key in ("orientation", "offsets") if key in edit.sets[s].options
            }
            new += edit.add("foundation", edit.sets[s].nodes[own], dict.fromkeys(properties, values[0]), options)
        edit.bind(f"foundation of {elements(ids)}", new, properties, unit="N/m2")
        return edit.done()

    return Recipe(
        candidate,
        (k,),
        lambda values: Change(K=values[0] * K),
        steps(k, 6)[:, None],
        lambda values: site,
        log_prior=log_prior,
        extend=extend,
    )


def _by_set(found: list[tuple[int, int]]) -> dict[int, list[int]]:
    sets: dict[int, list[int]] = {}
    for s, i in found:
        sets.setdefault(s, []).append(i)
    return sets


CANDIDATE = Candidate(
    "foundation",
    "an elastic foundation",
    "foundation",
    "springs per length under bars (soil, cushion, cable bed) that the model does not have: all modes rise by the same square "
    "of the frequency",
    recipes,
)
