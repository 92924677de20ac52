"""Why a model has no site for a candidate, in words that follow its name."""

from typing import Any

from mouse_cli.diagnosis.sites.bases import base

_MATRICES = "the model is one of matrices without elements"


def bars(model: Any) -> str:
    """Without a beam that bends."""
    if model.motion is None or not model.problem.mesh.elements:
        return f"{_MATRICES}, so that beams are not known"
    return (
        "no beam of this model bends in a way that it concerns" if model.bars is not None else "the model has no beams"
    )


def supports(model: Any) -> str:
    """Without a support that bears."""
    if model.motion is None or not model.problem.mesh.elements:
        if model.problem.held is not None:
            return f"{_MATRICES}: of its named supports only that they are flexible or loose is looked at"
        return f"{_MATRICES}, and model.supports names none: a spring to the ground stands for what holds it"
    kept = set(model.problem.mesh.directions)
    if not any(d in kept for _, d in model.problem.mesh.supports.tolist()):
        return "the model has no supports"
    return "no support with mass next to it carries a load in the measured modes"


def translations(model: Any) -> str:
    """Without an end of a member that moves along two axes."""
    if model.motion is None or not model.problem.mesh.elements:
        return f"{_MATRICES}, so that directions are not known"
    return "no end of a member of this model moves along more than one axis"


def turning(model: Any) -> str:
    """Without a support that is free to turn."""
    if model.motion is None or not len(model.problem.mesh.supports):
        return supports(model)
    return "no support of this model turns in the measured modes"


def bases(model: Any) -> str:
    """Without a base that moves as one."""
    if model.motion is None or not len(model.problem.mesh.supports):
        return supports(model)
    mesh = model.problem.mesh
    if {"storey"} & {each.type for each in mesh.elements}:
        if mesh.gravity is not None or any(each.properties.get("preload") is not None for each in mesh.elements):
            return "storeys that turn with their base are not known under axial force (gravity, preload)"
        return "storeys are not alone, or not all above one node that is held"
    if base(model.problem) is None:
        return "its supports are one node, or let it turn"
    return "no motion of all supports together carries a load in the measured modes"


def oblong(model: Any) -> str:
    """Without a section that has a strong and a weak axis."""
    if model.bars is None:
        return bars(model)
    return "no beam has Iy and Iz that differ, or none whose turning the measured modes would feel"


def connections(model: Any) -> str:
    """Without joints of beams and columns, or corners."""
    text = "no two beams meet columns, members that stand on supports, and in space not two corners join two bars alone"
    return bars(model) if model.bars is None else text


def members(model: Any) -> str:
    """Without members, or with one."""
    found = bars(model)
    return "the whole structure is one member" if model.motion is not None and model.bars is not None else found


def line_masses(model: Any) -> str:
    """Where mass along bars is known already."""
    if model.bars is None:
        return bars(model)
    return "a parameter stands for the nonstructural_mass of every beam already"


def twisting(model: Any) -> str:
    """Without a beam that twists."""
    return bars(model) if model.bars is None else "no beam has a torsion constant, or none that the measured modes would feel"
