"""Nodes at which CalculiX holds the thickness of quadratic shells: where they meet at an angle, or change their thickness."""

from collections.abc import Iterable, Iterator

import numpy as np

from mouse_cli._errors import WARNING, Diagnostic
from mouse_cli.importing.clamps import normal
from mouse_cli.importing.model import InputModel

QUADRATIC = {"S6": "S3", "S8": "S4", "S8R": "S4"}  # each with the type of which a part may be missing without more
_ONE_NORMAL = float(np.cos(np.deg2rad(20.0)))  # between normals that CalculiX makes one
_FEW = 4  # sets that are named


def let_go(model: InputModel) -> dict[int, set[int]]:
    """By group (number) the nodes that the solver holds for it alone: those of quadratic shells that stay without it."""
    found: dict[int, set[int]] = {}
    for node, each in _met(model).items():
        for i in {i for i, *_ in each}:
            rest = [one for one in each if one[0] != i]
            if rest and _differ(each) and not _differ(rest) and not model.groups[i].laminate:
                found.setdefault(i, set()).add(node)
    return dict(sorted(found.items()))


def knots(model: InputModel, unknown: Iterable[int]) -> Iterator[Diagnostic]:
    """A warning where sets meet so: without one of them, what the solver lets go is not in K less K of the set.

    S3 and S4 have no such stretch of the thickness: CalculiX gives them the same K with and without their neighbours. unknown:
    groups (numbers) without which K and M are not known.
    """
    unknown = set(unknown)
    held = [each for each in _met(model).values() if len(of := {i for i, *_ in each}) > 1 and of & unknown and _differ(each)]
    met = sorted({i for each in held for i, *_ in each})
    if not met:
        return
    names = [model.groups[i].name for i in met]
    kinds = sorted({model.elements[e][0] for i in met for e in model.groups[i].elements} & QUADRATIC.keys())
    message = (
        f"{', '.join(kinds)} of {', '.join(names[:_FEW])}{', ...' if len(names) > _FEW else ''} meet at an angle or change their "
        f"thickness: CalculiX holds the thickness at these {len(held)} nodes, and lets it go where a set is missing"
    )
    help = (
        f"where a set may be missing, take {' and '.join(sorted({QUADRATIC[kind] for kind in kinds}))}, which has none of this, "
        "or state `theory`: frequencies without the set are up to some per cents lower than the deck's"
    )
    yield Diagnostic("MD275", WARNING, message, model.groups[met[0]].owner.head.span, help=help)


def _met(model: InputModel) -> dict[int, list[tuple[int, float, np.ndarray]]]:
    """Group, thickness and normal of each quadratic shell at each of its nodes."""
    found: dict[int, list[tuple[int, float, np.ndarray]]] = {}
    for i, group in enumerate(model.groups):
        for e in group.elements if group.shell else ():
            kind, nodes = model.elements[e]
            for node in nodes if kind in QUADRATIC else ():
                found.setdefault(node, []).append((i, float(group.owner.lines[0].words[0]), normal(model, kind, nodes)))
    return found


def _differ(each: list[tuple[int, float, np.ndarray]]) -> bool:
    """Whether shells at a node have other thicknesses or normals than the first."""
    _, thick, first = each[0]
    return any(t != thick or abs(float(other @ first)) < _ONE_NORMAL for _, t, other in each[1:])
