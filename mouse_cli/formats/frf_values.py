"""Frequency response functions of files brought to the units of a deck, with the variance that is known of them."""

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.record_drafts import Findings
from mouse_cli.model.channel_units import Unit, ratio, target
from mouse_cli.model.frf_test import KINDS
from mouse_cli.model.recording import FORCES
from mouse_cli.model.units import Units

MOTION = {"displacement": "receptance", "velocity": "mobility", "acceleration": "accelerance"}
_OF = {kind: motion for motion, kind in MOTION.items()} | {"angle": "rotation"}
_TURNED = {"rotation": "receptance", "angular velocity": "mobility", "angular acceleration": "accelerance"}


def scaled(
    kind: str, spelled: str, stated: str, file_kind: str, units: Units, say: Findings, where: Span | None
) -> tuple[str, float] | None:
    """Kind of the functions and the factor to the units of the deck; None after an error.

    kind, spelled: by the deck; file_kind, stated: by the file; empty where they are silent.
    """
    parts = [_parts(text, say, where) if text else None for text in (spelled, stated if not spelled else "")]
    if (spelled and parts[0] is None) or (spelled and stated and not _agree(spelled, stated, say, where)):
        return None
    found = parts[0] or parts[1]
    quantity = found and {**MOTION, **_TURNED}.get(found[0].quantity)
    known = {name for name in (kind, quantity, file_kind) if name}
    if len(known) > 1:
        message = f"the FRFs are declared as {' and '.join(sorted(known))} at once"
        return say.error("MD610", where, message, "correct kind or unit", f"unit: {spelled or stated}" if found else "")
    if not known:
        message = "neither deck nor file states whether the FRFs are receptance, mobility or accelerance"
        return say.error("MD611", where, message, f"give kind: {', '.join(KINDS)}; or unit, as (m/s2)/N")
    if found is None:
        return known.pop(), 1.0
    (_, above), (_, below) = (target(each.quantity, units) for each in found)
    return known.pop(), found[0].factor / above / (found[1].factor / below)


def _parts(text: str, say: Findings, where: Span | None) -> tuple[Unit, Unit] | None:
    found = ratio(text)
    response = found is not None and found[0].quantity in {**MOTION, **_TURNED}
    if found is None or not response or found[1].quantity not in FORCES:
        message = f"the unit '{text[:40]}' is no motion per force that is known"
        return say.error("MD611", where, message, "write it as (m/s2)/N, (m/s)/N, m/N, g/N, g/lbf, ...")
    return found


def _agree(spelled: str, stated: str, say: Findings, where: Span | None) -> bool:
    said, file = ratio(spelled), ratio(stated)
    if said is None or file is None:
        return True
    factors = [above.factor / below.factor for above, below in (said, file)]
    if said[0].quantity == file[0].quantity and abs(factors[0] / factors[1] - 1) < 0.01:
        return True
    message = f"the deck states that the FRFs are in {spelled}; their file states {stated}"
    say.error("MD610", where, message, "delete unit, if the file is right; else correct the file")
    return False


def response_unit(kind: str, units: Units) -> str:
    """The unit of functions of a kind in a deck of such units, as (m/s2)/N."""
    above, below = target(_OF[kind], units)[0], target("force", units)[0]
    return f"({above})/{below}" if "/" in above else f"{above}/{below}"


def variance(H: np.ndarray, coherence: np.ndarray | None, averages: float | None) -> np.ndarray:
    """E|H - mean|^2 = |H|^2 (1 - g2) / (g2 n) of coherences g2 and n averages; NaN where they are not known.

    Bendat & Piersol, Random Data, 4th ed. (2010), ch. 9: the normalized random error of |H| is sqrt(1 - g2) / (sqrt(2 n) |g|),
    which is that of one of the two parts.
    """
    if coherence is None or averages is None:
        return np.full(H.shape, np.nan)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.abs(H) ** 2 * (1 - coherence) / (coherence * averages)
