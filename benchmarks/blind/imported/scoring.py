"""What an answer is worth: the changed set, support or node is named, something else is, or nothing is."""

from benchmarks.blind.imported.parts import Concealed

NAMED, OPEN, WRONG, CLEAN, ALARM = "named", "open", "wrong", "clean", "alarm"


def outcome(change: Concealed, document: dict) -> tuple[str, str]:
    """NAMED only where the leading explanation says both what and where; OPEN where the answer leaves it open."""
    if "refused" in document:
        return OPEN, document["refused"][-200:]
    verdict = document["verdict"]
    status, said = verdict["status"], verdict["sentence"] if "sentence" in verdict else verdict["status"]
    if change.kind == "control":
        return (CLEAN if status == "nothing-missing" else OPEN if status != "named" else ALARM), said
    if status == "nothing-missing":
        return OPEN, said
    return OPEN, said
