"""The values of a frequency response function in a YAML deck: channels of a file or lists, put together to complex numbers."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.formats.channels import column
from mouse_cli.formats.recording_files import Contents
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.nodes import Node
from mouse_cli.formats.yaml_deck.sections import Section

_FORMS = (
    {"value"},
    {"real", "imag"},
    {"magnitude", "phase"},
    {"magnitude", "phase_rad"},
    {"magnitude_db", "phase"},
    {"magnitude_db", "phase_rad"},
)


@dataclass
class Parts:
    """values (f,), complex; coherence (f,) or None."""

    values: np.ndarray
    coherence: np.ndarray | None = None


def parts(section: Section, item: Node | Section, held: Contents) -> Parts | None:
    """The function that a plain name or a section describes; None after an error."""
    if not isinstance(item, Section):
        found = column(held, item.value, section.document, section.document.span(item))
        return None if found is None else Parts(np.asarray(found.values, complex))
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
    return None if coherence is not None and not _possible(item, coherence) else Parts(_complex(found), coherence)


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
