"""What a test engineer should know of a comparison: modes without partner, sensors that do not fit, shapes sensors cannot tell."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mouse_cli._errors import WARNING, Diagnostic
from mouse_cli.model.correlation import ALONE, GAIN, REVERSED, SWAPPED, Correlation, SensorFault

_ALIKE = 0.5  # MAC of two different modes of one side from which the sensors can hardly tell them apart
_BLIND = 0.05  # length of a model shape at the sensors, over the largest, below which a test cannot see it
_MOST = 10


def remarks(found: Correlation) -> Correlation:
    """The comparison with all remarks on it."""
    warnings = (*_alone(found), *_unclaimed(found), *_faults(found), *_alike(found))
    return replace(found, warnings=found.warnings + warnings)


def orthogonality_refused(reason: str) -> Diagnostic:
    """The remark for a mass matrix that cannot be reduced statically."""
    return _remark(
        "MD515",
        f"the mass matrix cannot be reduced statically to the sensors: {reason}",
        "measure in all directions in which the structure can move as a rigid body; the reduction by modes needs that not",
    )


def _alone(found: Correlation) -> Iterator[Diagnostic]:
    test = found.problem.test
    for i in np.flatnonzero(found.modes == ALONE)[:_MOST]:
        hz = "of unknown frequency" if np.isnan(test.frequency_hz[i]) else f"at {test.frequency_hz[i]:.5g} Hz"
        near = ""
        if np.isfinite(found.mac[i]).any():
            best = int(np.nanargmax(found.mac[i]))
            near = f"; it looks most like model mode {best + 1} ({found.frequencies_hz[best]:.5g} Hz, MAC {found.mac[i, best]:.2f})"
        yield _remark(
            "MD509",
            f"measured mode {test.number[i]} {hz} has no likely partner among the model's modes{near}",
            "look for missing physics, such as something that vibrates on the structure; or for a mode of the test rig",
        )


def _unclaimed(found: Correlation) -> Iterator[Diagnostic]:
    for j in found.unclaimed[:_MOST]:
        blind = bool(found.visible[j] < _BLIND)
        seen = (
            f"the sensors see it ({found.visible[j]:.2f} of the largest shape)"
            if found.sensors
            else "no shape was measured"
        )
        why = "the sensors hardly see it" if blind else seen
        yield _remark(
            "MD510",
            f"model mode {j + 1} at {found.frequencies_hz[j]:.5g} Hz lies in the band of the test, but no measured mode is it; "
            f"{why}",
            "add a sensor that sees it"
            if blind
            else "look whether the test missed it: an exciter at one of its nodes, or two close modes",
        )


def _faults(found: Correlation) -> Iterator[Diagnostic]:
    for fault in found.faults:
        yield _remark("MD513", f"{_words(fault, found.sensors)}: mean MAC {fault.mac_before:.3f}, then {fault.mac_after:.3f}",
                      "check the sensor and its channel before the model is revised")  # fmt: skip


def _words(fault: SensorFault, sensors: tuple[str, ...]) -> str:
    names = [sensors[k] for k in fault.sensors]
    if fault.kind == SWAPPED:
        return f"sensors {names[0]} and {names[1]} look exchanged"
    if fault.kind == REVERSED:
        return f"sensor {names[0]} looks mounted backwards"
    if fault.kind == GAIN:
        return f"sensor {names[0]} reads {fault.gain:.3g} times the prediction of the model and the other sensors"
    return (
        f"sensor {names[0]} contradicts the model and all other sensors (it reads {fault.gain:.3g} times their prediction); "
        "without it"
    )


def _alike(found: Correlation) -> Iterator[Diagnostic]:
    sides = (
        ("measured", found.auto_test, found.problem.test.number, np.arange(len(found.auto_test))),
        ("model", found.auto_model, np.arange(1, len(found.auto_model) + 1), _of_interest(found)),
    )
    for side, likeness, numbers, kept in sides:
        pairs = [(i, j) for i in kept for j in kept if i < j and likeness[i, j] > _ALIKE]
        for i, j in sorted(pairs, key=lambda pair: -likeness[pair])[:_MOST]:
            yield _remark(
                "MD516",
                f"{side} modes {numbers[i]} and {numbers[j]} look alike at the sensors (MAC {likeness[i, j]:.2f})",
                "add sensors where they differ; until then only the frequencies separate them",
            )


def _of_interest(found: Correlation) -> np.ndarray:
    """Model modes that a measured mode is, or might be."""
    return np.sort(np.concatenate([found.modes[found.modes != ALONE], found.unclaimed])).astype(int)


def _remark(code: str, message: str, help: str) -> Diagnostic:
    return Diagnostic(code, WARNING, message, help=help)
