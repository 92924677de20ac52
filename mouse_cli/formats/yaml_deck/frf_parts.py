"""The values of a frequency response function in a YAML deck: channels of a file or lists, put together to complex numbers."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.formats.channels import column
from mouse_cli.formats.recording_files import Contents
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.nodes import Node
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.frf_test import FORMS

_FORMS = (
    {"value"},
    {"real", "imag"},
    {"magnitude", "phase"},
    {"magnitude", "phase_rad"},
    {"magnitude_db", "phase"},
    {"magnitude_db", "phase_rad"},
)


_HALF_TURN = 3.15  # rad, as rounded
_PEAK = 3.0  # of a resonance over what is on either side of it
_FLAT = 0.1  # median over maximum, below which a function has peaks on a linear scale


@dataclass
class Parts:
    """values (f,), complex; coherence (f,) or None."""

    values: np.ndarray
    coherence: np.ndarray | None = None


def parts(section: Section, item: Node | Section, held: Contents) -> Parts | None:
    """The function that a plain name or a section describes; None after an error."""
    if not isinstance(item, Section):
        found = column(held, item.value, section.document, section.document.span(item))
        if found is None or not _phased(section, item, found.values):
            return None
        return Parts(np.asarray(found.values, complex))
    given = {key: item.nodes[key] for key in set().union(*_FORMS) if key in item}
    if set(given) not in _FORMS:
        message = f"{item.called} gives {', '.join(given) or 'no values'}; expected one of their forms"
        return item.document.error(
            "MD217", item.node, message, "give value; or real and imag; or magnitude or magnitude_db, and phase"
        )
    found = {
        key: listed(item, node, held, item.what(key), complex if key == "value" else float)
        for key, node in given.items()
    }
    coherence = listed(item, item.nodes["coherence"], held, item.what("coherence")) if "coherence" in item else None
    if any(each is None for each in found.values()) or ("coherence" in item and coherence is None):
        return None
    lengths = {len(each) for each in [*found.values(), *([] if coherence is None else [coherence])]}
    if len(lengths) > 1:
        message = f"the parts of {item.called} have {' and '.join(map(str, sorted(lengths)))} values"
        return item.document.error("MD608", item.node, message, "give equally many of each")
    if not _meant(item, given, found) or (coherence is not None and not _possible(item, coherence)):
        return None
    return Parts(_complex(found), coherence)


def _phased(section: Section, item: Node, values: np.ndarray) -> bool:
    """Whether a channel that is named alone may be complex: one of magnitudes is none, unless magnitudes alone are fitted."""
    real = np.real(values)
    alone = not np.iscomplexobj(values) or not np.imag(values).any()
    if not alone or section.value("form", FORMS[0]) == "log" or (real < 0).any() or not _resonates(real):
        return True
    message = f"channel '{item.value}' has resonances and is nowhere negative or imaginary: magnitudes without phases"
    help = "give magnitude and phase, or real and imag, of each response; or form: log, which fits magnitudes alone"
    return bool(section.document.error("MD456", item, message, help))


def _meant(item: Section, given: dict[str, Node], found: dict[str, np.ndarray]) -> bool:
    """Whether magnitudes and phases can be what they are said to be: no decibels, no radians for degrees."""
    size = next((found[key] for key in ("magnitude", "magnitude_db") if key in found), None)
    if size is None:
        return True
    known, wrong = size[np.isfinite(size)], None
    if "magnitude" in found and (known < 0).any():
        wrong = "magnitude", "is negative, as decibels are", "name it magnitude_db"
    elif "magnitude_db" in found and len(known) and known.min() >= 0 and np.median(known) < _FLAT * known.max():
        said = "has peaks above a level near 0 and is nowhere negative, as magnitudes are"
        wrong = "magnitude_db", said, "name it magnitude"
    elif "phase" in found and np.nanmax(np.abs(found["phase"]), initial=0) <= _HALF_TURN and _resonates(size):
        wrong = "phase", "stays within 3.15 degrees at a resonance, as radians do", "name it phase_rad"
    elif "phase_rad" in found and np.nanmax(np.abs(np.diff(found["phase_rad"])), initial=0) > 2 * _HALF_TURN:
        wrong = "phase_rad", "jumps by more than a turn from line to line, as degrees do", "name it phase"
    if wrong is not None:
        key, said, help = wrong
        item.document.error("MD456", given[key], f"{item.what(key)} {said}", help)
    return wrong is None


def _resonates(size: np.ndarray) -> bool:
    """Whether a largest value stands between values that are several times smaller: there phases turn by half a turn."""
    size = size[np.isfinite(size)]
    k = int(np.argmax(size)) if len(size) else 0
    return 0 < k < len(size) - 1 and size[k] > _PEAK * max(size[:k].min(), size[k + 1 :].min())


def _complex(found: dict[str, np.ndarray]) -> np.ndarray:
    """One complex number of each pair of parts."""
    if "value" in found:
        return np.asarray(found["value"], complex)
    if "real" in found:
        return found["real"] + 1j * found["imag"]
    size = found["magnitude"] if "magnitude" in found else 10 ** (np.asarray(found["magnitude_db"], float) / 20)
    angle = found["phase_rad"] if "phase_rad" in found else np.deg2rad(np.asarray(found["phase"], float))
    return size * np.exp(1j * angle)


def _possible(item: Section, coherence: np.ndarray) -> bool:
    bad = np.flatnonzero(~((coherence >= 0) & (coherence <= 1 + 1e-6)))
    if len(bad):
        message = f"{item.what('coherence')} is {coherence[bad[0]]:g} at line {bad[0] + 1}; coherences are from 0 to 1"
        item.document.error("MD215", item.nodes["coherence"], message, "name the channel of the coherence")
    return not len(bad)


def gain_sd(section: Section) -> float | None:
    """Standard deviation of gains near 1, as a share; None where they are known, or after an error."""
    return share(section, "gain_sd", "write the share by which calibrations differ, such as 2 %")


def share(section: Section, key: str, help: str) -> float | None:
    """A standard deviation that is a share; None where there is none, or after an error."""
    value = section.read(key, yaml_values.share)
    if value is None or 0 < value < 1:
        return value
    return section.wrong(key, "MD215", f"is {value:g}; it must be between 0 and 1", help)


def listed(section: Section, node: Node, held: Contents, what: str, kind: type = float) -> np.ndarray | None:
    """The numbers of a channel that is named, or of a list."""
    document = section.document
    if yaml_values.is_list(node):
        return (
            _texts(section, node, what)
            if kind is complex
            else yaml_values.numbers(document, node, what, KINDS["numbers"].words, missing=True)
        )
    name = yaml_values.text(document, node, what, KINDS["text or numbers"].words)
    found = None if name is None else column(held, name, document, document.span(node))
    if found is None:
        return None
    if kind is float and np.iscomplexobj(found.values) and found.values.imag.any():
        return document.error(
            "MD615", node, f"channel '{found.name}' holds complex numbers; {what} is real", "name it as value"
        )
    return found.values if kind is complex else np.asarray(found.values.real, float)


def _texts(section: Section, node: Node, what: str) -> np.ndarray | None:
    """A list of complex numbers, written 0.1+0.2j."""
    values = []
    for item in node.value:
        text = item.value if yaml_values.is_scalar(item) else ""
        try:
            values.append(complex(text.replace(" ", "").replace("i", "j")))
        except ValueError:
            return yaml_values.mistyped(section.document, item, f"a value in {what}", "a number such as 0.1+0.2j")
    return np.array(values, complex)
