"""The `modal_damping:` of a YAML deck, and its way back."""

import numpy as np

from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.formats.yaml_deck.text import flow, real
from mouse_cli.model.modal_damping import ModalDamping


def modal_damping(deck: Section) -> ModalDamping | None:
    """What the deck gives; None where it gives none, or after an error."""
    section = deck.section("modal_damping")
    if section is None or "ratio" not in section:
        return None
    ratio = _shares(section, "ratio", 1.0)
    sd = _shares(section, "sd", np.inf) if "sd" in section else np.zeros(1)
    return None if ratio is None or sd is None else ModalDamping(ratio, float(sd[0]))


def _shares(section: Section, key: str, below: float) -> np.ndarray | None:
    """Positive numbers or one percentage, each less than `below`."""
    reader = yaml_values.numbers if yaml_values.is_list(section.nodes[key]) else yaml_values.share
    found = section.read(key, reader, KINDS[section.definition.keys[key].kind].words)
    if found is None:
        return None
    found = np.atleast_1d(found)
    bad = found[~((found > 0) & (found < below))] if len(found) else np.zeros(1)
    if len(bad):
        limits = "positive" if below == np.inf else f"between 0 and {below:g}"
        return section.wrong(key, "MD215", f"is {bad[0]:g}; it must be {limits}", "write for instance 1 %")
    return found


def modal_damping_lines(damping: ModalDamping | None) -> list[str]:
    """The section as a deck has it; nothing where there is none."""
    if damping is None:
        return []
    ratio = real(damping.ratio[0]) if len(damping.ratio) == 1 else flow(map(real, damping.ratio))
    sd = f", sd: {real(damping.sd)}" if damping.sd else ""
    return ["", f"modal_damping: {{ratio: {ratio}{sd}}}"]
