"""The `prior:` of a YAML deck: how the parameters are correlated before the test."""

import numpy as np

from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.model import square
from mouse_cli.formats.yaml_deck.nodes import Document, Node
from mouse_cli.formats.yaml_deck.sections import Section

_ROUNDING = 1e-9  # what normalising a covariance leaves on the diagonal


def covariance(section: Section | None, form: str | None, p: int) -> np.ndarray | None:
    """The covariance (p, p) of `prior: {covariance: ...}`; None in any other case."""
    if section is None or form != "covariance":
        return None
    return square(section.document, section.nodes[form], section.what(form), p)


def correlated(section: Section | None, form: str | None, names: list[str], sd: np.ndarray) -> np.ndarray | None:
    """The covariance (p, p) that correlations and standard deviations make; None in any other case."""
    if section is None or form not in _CORRELATIONS:
        return None
    found = _CORRELATIONS[form](section, section.nodes[form], names)
    with np.errstate(
        over="ignore", invalid="ignore"
    ):  # standard deviations must be finite, and are told of where they stand
        return None if found is None else found * np.outer(sd, sd)


def _whole(section: Section, node: Node, names: list[str]) -> np.ndarray | None:
    what = section.what("correlation")
    found = square(section.document, node, what, len(names))
    if found is None:
        return None
    diagonal = np.eye(len(names), dtype=bool)
    found[diagonal & (np.abs(found - 1) < _ROUNDING)] = 1.0
    for i, j in np.argwhere(~(np.abs(found) <= 1 + _ROUNDING) | (diagonal & (found != 1)))[:20]:
        message = f"{what}({i + 1},{j + 1}) is {found[i, j]:.8g}; it must be {'1' if i == j else 'within -1 to 1'}"
        section.document.error("MD230", node.value[i].value[j], message, "give correlations, not covariances")
    return found


def _pairs(section: Section, node: Node, names: list[str]) -> np.ndarray | None:
    document, what = section.document, section.what("correlations")
    found = np.eye(len(names))
    seen: set[tuple[int, int]] = set()
    for item in yaml_values.items(document, node, what, KINDS["links"].words) or []:
        link = _link(document, item, what, names)
        if link is None:
            continue
        i, j, value = link
        if (min(i, j), max(i, j)) in seen:
            document.error("MD230", item, f"{names[i]} and {names[j]} are correlated twice", "delete one of the two")
        seen.add((min(i, j), max(i, j)))
        found[i, j] = found[j, i] = value
    return found


_CORRELATIONS = {"correlation": _whole, "correlations": _pairs}


def _link(document: Document, item: Node, what: str, names: list[str]) -> tuple[int, int, float] | None:
    if not yaml_values.is_list(item) or len(item.value) != 3:
        return yaml_values.mistyped(document, item, f"an item of {what}", "[parameter, parameter, correlation]")
    i, j = (_index(document, node, what, names) for node in item.value[:2])
    value = yaml_values.number(document, item.value[2], f"a correlation in {what}")
    if i is None or j is None or value is None:
        return None
    if i == j:
        return document.error("MD230", item, f"{names[i]} is correlated with itself", "name two parameters")
    if not abs(value) <= 1:
        message = f"the correlation of {names[i]} and {names[j]} is {value:.8g}; it must be within -1 to 1"
        return document.error("MD230", item.value[2], message, "give a correlation, not a covariance")
    return i, j, value


def _index(document: Document, node: Node, what: str, names: list[str]) -> int | None:
    name = yaml_values.text(document, node, f"a name in {what}", "the name of a parameter")
    if name is None or name in names:
        return None if name is None else names.index(name)
    message = f"{what} names '{name[:40]}', which is no parameter"
    return document.error("MD229", node, message, f"give two of {', '.join(names[:12])}")
