"""Identified modes as the `test:` of a deck: a piece for any deck."""

import re

import numpy as np

from mouse_cli.formats.yaml_deck.text import flow, maybe, real, word, wrapped
from mouse_cli.model.identification import UNIT_MASS, Identification, deck_shapes

_OWN = re.compile(r"\d+(-?[TR][XYZ])?", re.ASCII)


def identified(found: Identification) -> str:
    """A YAML piece `test: {modes: ...}`; sensors whose names are no degrees of freedom are listed for the reader to place."""
    modes, (low, high) = found.modes, found.band_hz
    number = flow(str(r + 1) for r in range(modes.m))
    damping, sd = (flow(f"{100 * z:.4g}" for z in each) for each in (modes.damping, modes.damping_sd))
    lines = [
        f"# Identified by mouse from {', '.join(found.sources)}: {found.method}, {low:.6g} to {high:.6g} Hz.",
        *(f"# {d.code}: {d.message}" for d in found.doubts),
        f"# Damping, per cent: {damping}, sd {sd}.",
        "test:",
        *_placed(found.sensors),
        "  modes:",
        f"    number: {number}  # state which modes of the model they are, or run with pairing: mac",
        f"    frequency: {wrapped(map(maybe, modes.frequency_hz), 4)}  # Hz",
        f"    frequency_sd: {wrapped(map(maybe, modes.frequency_sd_hz), 4)}  # Hz",
    ]
    if len(found.sensors) > 1 or all(scale == UNIT_MASS for scale in modes.scale):
        shapes, sd = deck_shapes(modes)
        lines.append(f"    dofs: {wrapped(map(_item, found.sensors), 4)}")
        lines += _grid("shapes", shapes, f"real parts, {', '.join(sorted(set(modes.scale)))}; a row for each of dofs")
        lines += _grid("shape_sd", sd, "standard deviations of shapes, with the scatter of their phases")
    return "\n".join([*lines, "    scale: fitted"]) + "\n"


def _placed(sensors: tuple[str, ...]) -> list[str]:
    """A note for sensors that a model cannot know."""
    strange = [name for name in sensors if not _OWN.fullmatch(name)]
    return [f"  # describe these under `sensors:`: {', '.join(strange)}"] if strange else []


def _item(name: str) -> str:
    return name if _OWN.fullmatch(name) else word(name)


def _grid(key: str, values: np.ndarray, comment: str) -> list[str]:
    return [f"    {key}:  # {comment}", *(f"      - {flow(real(float(f'{x:.8g}')) for x in row)}" for row in values)]
