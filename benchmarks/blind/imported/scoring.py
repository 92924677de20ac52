"""What an answer is worth: the changed set, support or node is named, something else is, or nothing is."""

import numpy as np

from benchmarks.blind.imported.parts import Concealed, Mesh

NAMED, OPEN, WRONG, CLEAN, ALARM = "named", "open", "wrong", "clean", "alarm"
UNSEEN = "unseen"  # open, where the test does not show the change
_NEAR = 0.1  # of the size of the structure: how far from a node that bears more a mass may be named


def outcome(change: Concealed, document: dict, mesh: Mesh) -> tuple[str, str]:
    """NAMED where every place of the verdict is the changed one; WRONG where one is not; OPEN where nothing is named."""
    if "refused" in document:
        return OPEN, document["refused"][-120:]
    verdict = document["verdict"]
    said = f"{verdict['kind']}: {'; '.join(site['text'] for site in verdict['sites'])}"
    if change.kind == "control":
        return {"nothing-missing": CLEAN, "named": ALARM}.get(verdict["kind"], OPEN), said
    if verdict["kind"] != "named":
        return OPEN, said
    right = all(_right(change, site, mesh) for site in verdict["sites"])
    return (NAMED if right and verdict["sites"] else WRONG), said


def _right(change: Concealed, site: dict, mesh: Mesh) -> bool:
    supports = {"loose": f"the support {change.name},", "two": f"the supports {change.name},", "rubber": "all supports,"}
    if change.kind in supports:
        return site["text"].startswith(supports[change.kind])
    if change.kind != "mass":
        return site["text"] == f"element set {change.name}"
    at = {n: np.array(place) for place, n in mesh.number.items()}
    size = np.ptp(np.array(list(mesh.number)), axis=0).max()
    return bool(site["position"]) and np.linalg.norm(np.array(site["position"]) - at[int(change.name)]) < _NEAR * size
