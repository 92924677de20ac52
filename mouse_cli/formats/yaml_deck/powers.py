"""Parameters that are powers of another one, such as the cube of a thickness, by which the bending part of a shell goes.

theta_f = theta_j^n: ln theta_f is n ln theta_j, in the prior and ever after, as the covariance of the logarithms has it.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.parameter import Parameter

_OWN = ("nominal", "sd", "lower", "upper", "transform")  # that follow from those of the other
_Found = list[Parameter | None]


def raised(sections: Sequence[Section], read: Callable[[int], Parameter | None]) -> tuple[_Found, np.ndarray | None]:
    """All parameters, read by their number, and what turns the covariance of the others into that of all (p, p); None: nothing."""
    follow = [i for i, section in enumerate(sections) if "power_of" in section]
    found = [None if i in follow else read(i) for i in range(len(sections))]
    names = {one.name: i for i, one in enumerate(found) if one is not None}
    T = np.eye(len(sections))
    for i in follow:
        of = _of(sections[i], names, found)
        name = sections[i].value("name")
        if of is None or name is None:
            continue
        j, n = of
        found[i] = _raised(found[j], n, name, sections[i])
        T[i, i], T[i, j] = 0.0, n * found[i].nominal / found[j].nominal
    return found, T if follow else None


def _raised(base: Parameter, n: float, name: str, section: Section) -> Parameter:
    """The parameter to the power n, its limits and its standard deviation with it."""
    with np.errstate(all="ignore"):  # what is not finite is refused with the parameter
        nominal = float(np.float64(base.nominal) ** n)
        low, high = sorted(float(np.float64(max(limit, 0.0)) ** n) for limit in (base.lower, base.upper))
        low = low if low > 0 else -np.inf
        sd = float(abs(n) * np.float64(base.sd) / base.nominal * nominal)
    unit = f"({base.unit})^{n:g}" if base.unit else ""
    span = section.document.span(section.nodes["name"])
    return replace(base, name=name, nominal=nominal, sd=sd, unit=unit, lower=low, upper=high, span=span)


def _of(section: Section, names: dict[str, int], found: _Found) -> tuple[int, float] | None:
    """Which parameter (from 0), and the power; None after an error."""
    document, node, what = section.document, section.nodes["power_of"], section.what("power_of")
    own = [key for key in _OWN if key in section]
    if own:
        message = f"{section.called} is a power of another parameter and has {own[0]} of its own"
        return document.error("MD232", section.nodes[own[0]], message, f"delete {own[0]}: it follows from the other")
    if not yaml_values.is_list(node) or len(node.value) != 2:
        return yaml_values.mistyped(document, node, what, KINDS["power"].words)
    name = yaml_values.text(document, node.value[0], f"the name in {what}", "the name of a parameter")
    n = yaml_values.number(document, node.value[1], f"the exponent in {what}")
    if name is None or n is None:
        return None
    j = names.get(name)
    if j is None:
        message = f"{what} names '{name[:40]}', which is no parameter with a value of its own"
        return document.error("MD229", node.value[0], message, f"give one of {', '.join(list(names)[:12]) or 'them'}")
    if found[j].transform != "log" or not found[j].nominal > 0:
        message = f"{what} is a power of {name[:40]}, which has no transform log and may be negative"
        return document.error(
            "MD232", node.value[0], message, f"give {name[:40]} transform: log and a positive nominal"
        )
    if not 0 < abs(n) <= 10:
        message = f"{what} has the exponent {n:g}; it must be within -10 to 10, and not 0"
        return document.error(
            "MD232", node.value[1], message, "give the power by which K or M grows with the parameter"
        )
    return j, n
