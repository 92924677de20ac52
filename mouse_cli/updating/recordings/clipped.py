"""Outputs that are clipped: what they should have read beyond their range nobody knows, and no fit may ask it of the model."""

from mouse_cli.model.recording import Recording
from mouse_cli.records.faults import faults

_SAID = "left out of every fit: {what}, {which} clipped; measure again with a wider range, or use a stretch without it (segment)"


def unclipped(
    fitted: list[Recording], held: list[Recording], outputs: list[int]
) -> tuple[list[Recording], list[Recording], list[int], list[str]]:
    """Recordings that are fitted and held out, the columns of outputs that are used, and what to say: without recordings of which
    an output is clipped, where others are whole, else without those outputs. All stay where nothing else would.
    """
    lost = {id(one): [j for j in outputs if _clipped(one, j)] for one in [*fitted, *held]}
    whole = lambda every: [one for one in every if not lost[id(one)]]
    if whole(fitted) and (whole(held) or not held):
        gone = [one.title for one in [*fitted, *held] if lost[id(one)]]
        what = f"recordings {', '.join(gone)}" if len(gone) > 1 else "".join(f"recording '{title}'" for title in gone)
        return whole(fitted), whole(held), outputs, [_SAID.format(what=what, which="of which outputs are")] if gone else []
    every = sorted({j for own in lost.values() for j in own})
    if not fitted or len(every) == len(outputs):
        return fitted, held, outputs, []
    names = ", ".join(fitted[0].channels[j].name for j in every)
    what, which = (f"channels {names}", "which are") if len(every) > 1 else (f"channel {names}", "which is")
    return fitted, held, [j for j in outputs if j not in every], [_SAID.format(what=what, which=which)]


def _clipped(one: Recording, j: int) -> bool:
    return any(fault.kind == "clipped" for fault in faults(one.samples[:, j]))
