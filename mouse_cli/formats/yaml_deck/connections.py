"""Masses, springs, dashpots and absorbers of a deck of coupled or modified structures."""

import numpy as np

from mouse_cli.formats.yaml_deck.coupled_places import Places
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.coupling import Connection

_KINDS = ("absorber", "spring", "dashpot", "mass")  # the first of them that is there names a connection


def connections(section: Section, key: str, places: Places) -> list[Connection]:
    """The connections that could be read."""
    read = [_connection(each, places) for each in section.listed(key)]
    return [one for one in read if one is not None]


def _connection(section: Section, places: Places) -> Connection | None:
    document = section.document
    at, to = (places.point(section.nodes[key], section.what(key)) if key in section else None for key in ("at", "to"))
    if at is None or ("to" in section and to is None) or not _sound(section):
        return None
    values = _absorber(section) if "absorber" in section else _direct(section)
    if values is None:
        return None
    if to == at:
        message = f"{section.called} joins a degree of freedom to itself"
        return document.error("MD708", section.nodes["to"], message, "leave to out, for the ground")
    name = section.value("name") or next(kind for kind in _KINDS if kind in section)
    return Connection(name, at, to, where=document.span(section.node), **values)


def _sound(section: Section) -> bool:
    """Whether the keys go together and the numbers are ones."""
    document, before = section.document, len(section.document.diagnostics)
    alone = "absorber" if "absorber" in section else "mass" if "mass" in section else ""
    for key in ("mass", "spring", "dashpot", "loss_factor", "to", "absorber"):
        if alone and key in section and key != alone:
            help = "give each its own item of the list"
            document.error("MD708", section.nodes[key], f"{section.called} holds {alone} and {key}", help)
    if "loss_factor" in section and "spring" not in section and not alone:
        document.error(
            "MD708", section.nodes["loss_factor"], f"{section.called} has a loss factor and no spring", "give spring"
        )
    for key in ("mass", "spring", "dashpot", "loss_factor"):
        value = section.value(key, 1.0) if key in section else 1.0
        if not np.isfinite(value) or (value == 0 and key in ("mass", "spring")):
            section.wrong(key, "MD215", f"is {value:g}", "give a finite number other than 0")
    return len(document.diagnostics) == before and any(kind in section for kind in _KINDS)


def _direct(section: Section) -> dict[str, float]:
    return {
        "mass": section.value("mass", 0.0),
        "stiffness": section.value("spring", 0.0),
        "loss_factor": section.value("loss_factor", 0.0),
        "damping": section.value("dashpot", 0.0),
    }


def _absorber(section: Section) -> dict[str, object] | None:
    document, below = section.document, section.section("absorber")
    mass, hz, mode = below.value("mass"), below.value("frequency"), below.value("tuned_to")
    if mass is None or (hz is None) == (mode is None):
        if hz is not None and mode is not None:
            document.error("MD708", below.node, f"{below.called} gives frequency and tuned_to", "give one of them")
        return None
    ratio = below.value("damping_ratio")
    sound = [0 < value < np.inf for value in (mass, hz) if value is not None] + [ratio is None or np.isfinite(ratio)]
    if not all(sound):
        message = f"{below.called} holds a number that is not positive and finite"
        return document.error("MD215", below.node, message, "give a mass, a frequency and a damping ratio that are")
    return absorber(mass, hz, ratio, mode)


def absorber(mass: float, hz: float | None, ratio: float | None, mode: int | None = None) -> dict[str, object]:
    """Stiffness m (2 pi f)^2 and damping 2 zeta m 2 pi f of an absorber; one that is to be tuned keeps `mode` for later."""
    if hz is None:
        return {"mass": mass, "hung": True, "tuned_to": mode, "ratio": ratio}
    omega = 2 * np.pi * hz
    return {"mass": mass, "stiffness": mass * omega**2, "damping": 2 * (ratio or 0.0) * mass * omega, "hung": True}
