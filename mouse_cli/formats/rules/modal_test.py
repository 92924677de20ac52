"""Rules for the measured modes."""

from dataclasses import replace

import numpy as np

from mouse_cli.formats.draft import Draft, TestDraft
from mouse_cli.formats.rules.sensors import Sensing, sensing
from mouse_cli.model.geometry import Geometry
from mouse_cli.model.modal_test import ModalTest

_SLOWEST, _FASTEST = 1e-9, 1e15  # Hz: from a period of 30 years to that of light
_FINEST = 1e-30  # standard deviation by the size of its datum, the square of which is still computed with
_CLOSE = 3.0  # standard deviations of a difference within which two frequencies may have changed places by noise


def modal_test(draft: Draft, geometry: Geometry | None = None) -> ModalTest | None:
    """The measured modes with dofs from 0; None for a deck without a test, or when a rule is broken.

    geometry: nodes of the model, for sensors that are mounted on them.
    """
    test = draft.test
    if test is None:
        return None
    test = _in_order(draft, test)
    _mode_numbers(draft, test)
    _frequencies(draft, test)
    if test.sensors:
        found = sensing(draft, test.sensors, geometry, draft.order)
    else:
        _dofs(draft, test)
        found = Sensing(test.dofs - 1, None, ())
    _accuracies(draft, test)
    if found is None:
        return None
    return ModalTest(
        test.number,
        test.frequency_hz,
        test.frequency_sd_hz,
        found.dofs,
        test.shapes,
        test.shape_sd,
        test.scale,
        found.weights,
        found.names,
        found.held,
    )


def _mode_numbers(draft: Draft, test: TestDraft) -> None:
    previous = 0
    for i, number in enumerate(test.number.tolist()):
        if not previous < number <= draft.order:
            draft.error(
                "MD320",
                f"mode number {number} must be above {previous} and at most {draft.order}, the order of the model",
                test.where_number(i),
                "mode numbers count the rigid-body modes and ascend",
                "give the system mode number of each measured mode, in ascending order",
            )
        previous = max(previous, number)


def _in_order(draft: Draft, test: TestDraft) -> TestDraft:
    """The modes in ascending order of frequency, where noise alone has put close ones out of it; says so."""
    hz, sd = test.frequency_hz, test.frequency_sd_hz
    first, second = np.triu_indices(len(hz), 1)
    with np.errstate(invalid="ignore"):
        fallen = hz[first] > hz[second]
        by_noise = hz[first] - hz[second] <= _CLOSE * np.hypot(sd[first], sd[second])
    if not fallen.any() or not by_noise[fallen].all():
        return test
    order = np.argsort(hz, kind="stable")
    if np.isnan(hz).any():  # modes without a frequency keep their places
        order = np.arange(len(hz))
        order[np.isfinite(hz)] = np.flatnonzero(np.isfinite(hz))[np.argsort(hz[np.isfinite(hz)], kind="stable")]
    i, j = (int(pair[fallen][0]) for pair in (first, second))
    message = f"test frequencies {i + 1} and {j + 1}, {hz[i]:.6g} and {hz[j]:.6g} Hz, were put in ascending order with their shapes"
    draft.warn("MD336", message, test.where_frequency(j), "they differ by less than three of their standard deviations")
    moved = lambda where: lambda k: where(int(order[k]))
    return replace(
        test,
        frequency_hz=hz[order],
        frequency_sd_hz=sd[order],
        shapes=test.shapes[:, order],
        shape_sd=test.shape_sd[:, order],
        where_frequency=moved(test.where_frequency),
        where_frequency_sd=moved(test.where_frequency_sd),
        where_shape=lambda s, m: test.where_shape(s, int(order[m])),
        where_shape_sd=lambda s, m: test.where_shape_sd(s, int(order[m])),
    )


def _frequencies(draft: Draft, test: TestDraft) -> None:
    previous, falling = 0.0, len(test.frequency_hz) > 1 and bool((np.diff(test.frequency_hz) < 0).all())
    help = "give the modes in ascending order of frequency"
    if falling:
        help = f"{help}; or are these periods in s? then give 1 over each, in Hz"
    for i, frequency in enumerate(test.frequency_hz.tolist()):
        if np.isnan(frequency):
            continue
        if not _SLOWEST <= frequency <= _FASTEST:
            range_ = f", {_SLOWEST:g} to {_FASTEST:g} Hz" if 0 < frequency < np.inf else ""
            draft.error(
                "MD321",
                f"test frequency {i + 1} is {frequency:.8g} Hz; it must be positive{range_}",
                test.where_frequency(i),
                help="give natural frequencies in Hz",
            )
            continue
        if frequency < previous:
            draft.error(
                "MD322",
                f"test frequency {i + 1} is {frequency:.8g} Hz, below {previous:.8g} Hz of the mode before",
                test.where_frequency(i),
                help=help,
            )
            if falling:
                break
        previous = max(previous, frequency)


def _dofs(draft: Draft, test: TestDraft) -> None:
    seen: set[int] = set()
    for i, dof in enumerate(test.dofs.tolist()):
        if not 1 <= dof <= draft.order:
            help = f"give numbers from 1 to {draft.order}"
            draft.error(
                "MD323", f"measured degree of freedom {dof} is outside 1 to {draft.order}", test.where_dof(i), help=help
            )
        elif dof in seen:
            draft.error(
                "MD324",
                f"degree of freedom {dof} is measured twice",
                test.where_dof(i),
                help="give each once",
            )
        seen.add(dof)


def _accuracies(draft: Draft, test: TestDraft) -> None:
    """Every datum needs a positive standard deviation: a certain datum has no place in a covariance."""
    of_shapes = np.abs(np.where(np.isfinite(test.shapes), test.shapes, 0.0)).max(axis=0, initial=0.0)
    places: set = set()  # one number for all of them is one mistake

    def refused(code: str, what: str, sd: float, place: object, help: str) -> None:
        if place is None or place not in places:
            finer = f", and above {_FINEST:g} of what it is of" if 0 < sd < np.inf else ""
            draft.error(code, f"standard deviation of {what}; it must be positive{finer}", place, help=help)
        places.add(place)

    for i, (frequency, sd) in enumerate(zip(test.frequency_hz, test.frequency_sd_hz, strict=True)):
        if _SLOWEST <= frequency <= _FASTEST and not _FINEST * frequency < sd < np.inf:
            help = "give the standard deviation in Hz; 0 would make a certain datum"
            refused("MD325", f"test frequency {i + 1} is {sd:.8g} Hz", sd, test.where_frequency_sd(i), help)
    bad = np.isfinite(test.shapes) & ~((test.shape_sd > _FINEST * of_shapes) & (test.shape_sd < np.inf))
    for s, m in np.argwhere(bad)[:20]:
        sd, help = test.shape_sd[s, m], "give the standard deviation in the units of the shape"
        what = f"x({m + 1},{s + 1}), mode {m + 1} at measured point {s + 1}, is {sd:.8g}"
        refused("MD326", what, sd, test.where_shape_sd(int(s), int(m)), help)
    for s, m in np.argwhere(np.isinf(test.shapes))[:20]:
        draft.error("MD302", f"x({m + 1},{s + 1}) is not finite", test.where_shape(int(s), int(m)))
    if not (np.isfinite(test.frequency_hz).any() or np.isfinite(test.shapes).any()):
        draft.error("MD327", "the test holds no datum", test.where_frequency(0), help="give a frequency or a shape")
