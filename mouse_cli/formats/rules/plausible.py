"""Rules for values that can be computed with and hardly can be meant: in another unit, or a number for a percentage."""

import numpy as np

from mouse_cli.dynamics.correlation import mac
from mouse_cli.formats.draft import Draft, TestDraft
from mouse_cli.model.materials import known
from mouse_cli.model.parameter import Parameter
from mouse_cli.model.revision import DENSITY_OF, E_OF
from mouse_cli.terms.elements import registry
from mouse_cli.terms.plausible import odd, systems

_CERTAIN = 1e-7  # sd over value, below which nothing is known so well
_NUMBERS = (0.01, 50.0)  # what a percentage looks like that was written as a number
_COARSE = 0.2  # sd over frequency, above which a frequency says next to nothing
_FINE, _SHARE = 3e-5, 0.05  # sd over frequency, below which no test is; and the largest number that may be a share
_NEAR, _ALIKE = 0.01, 0.95  # relative difference of two frequencies, and MAC, of what may be one mode given twice
_SENSORS = 4
_BLIND = 0.5  # sd of shapes over their largest component


def plausible(draft: Draft) -> None:
    """Warn of what is odd in structure, prior and test; refuse what cannot be."""
    if draft.mesh is not None:
        _structure(draft)
    elif draft.units.declared:
        _materials(draft)
    for parameter in draft.parameters:
        _prior(draft, parameter)
    if draft.test is not None:
        _frequencies(draft, draft.test)
        _shapes(draft, draft.test)
        _twins(draft, draft.test)


def _structure(draft: Draft) -> None:
    given = draft.mesh
    for s, members in enumerate(given.mesh.elements):
        nu = members.properties.get("nu")
        wrong = np.zeros(0, int) if nu is None else np.flatnonzero(~((nu > -1) & (nu <= 0.5)))
        if len(wrong) and "G" not in members.properties and "nu" in registry()[members.type].properties:
            value = float(nu[wrong[0]])
            remedy = f"write {value / 100:g}, as a share" if 5 <= value <= 50 else "give a ratio such as 0.3, or G"
            message = (
                f"Poisson's ratio of element {members.ids[wrong[0]]} is {value:g}; it lies above -1 and is at most 0.5"
            )
            draft.error("MD452", message, given.element_place(s, int(wrong[0])), help=remedy)
    for each in odd(given.mesh, draft.units):
        draft.warn("MD451", each.message, given.element_place(each.set, 0), help=each.help)


def _materials(draft: Draft) -> None:
    """E and density of the materials of imported matrices, by the names of their parameters, in another system than the deck's."""
    by = {parameter.name: parameter for parameter in draft.parameters}
    for name, parameter in by.items():
        material = name.removeprefix(E_OF.format(""))
        other = by.get(DENSITY_OF.format(material)) if material != name else None
        E, density = parameter.nominal, other.nominal if other is not None else 0.0
        if other is None or not (E > 0 and density > 0):
            continue
        own, *rest = ((s, known(E * e, density * d, loose=s == "")) for s, (e, d) in systems(draft.units))
        meant = [(system, solid) for system, solid in rest if solid]
        if own[1] or not meant:
            continue
        said = f"{name} = {E:.6g} {draft.units.of('Pa')} and {other.name} = {density:.6g} {draft.units.of('kg/m3')}"
        message = f"{said} are of no material; in {' or '.join(system for system, _ in meant)} they would be {meant[0][1]}"
        help = f"write units: {meant[0][0]}, as the job is in these; or give job and deck in the units of the deck"
        draft.warn("MD451", message, parameter.span, help=help)


def _prior(draft: Draft, parameter: Parameter) -> None:
    """The 5 of `sd: 5` where `5 %` is meant: far too small for a modulus, far too large for a factor."""
    value, sd = abs(parameter.nominal), parameter.sd
    if not (value > 0 and _NUMBERS[0] <= sd <= _NUMBERS[1]):
        return
    if sd < _CERTAIN * value:
        said = f"{sd:g} of {parameter.nominal:.6g}: nothing is known so well"
    elif sd >= value and value == 1.0 and sd >= 2:
        said = f"{100 * sd:g} % of its value, 1"
    else:
        return
    draft.warn(
        "MD453", f"the standard deviation of {parameter.name} is {said}", parameter.span, help=f"write sd: {sd:g} %"
    )


def _frequencies(draft: Draft, test: TestDraft) -> None:
    sd, hz = test.frequency_sd_hz, test.frequency_hz
    have = np.isfinite(hz) & (hz > 0) & np.isfinite(sd) & (sd > 0)
    if have.sum() < 2 or np.ptp(sd[have]) > 0:
        return
    one, low, high = float(sd[have][0]), float(hz[have].min()), float(hz[have].max())
    place = test.where_frequency_sd(int(np.flatnonzero(have)[0]))
    if one > _COARSE * low and one >= 0.5:
        message = f"frequency_sd is {one:g} Hz, {100 * one / low:.3g} % of the lowest frequency, {low:.5g} Hz"
        draft.warn("MD453", message, place, help=f"write frequency_sd: {one:g} % if a percentage is meant")
    elif one < _FINE * high and 1e-4 <= one <= _SHARE:
        message = (
            f"frequency_sd is {one:g} Hz, {100 * one / high:.2g} % of the highest frequency: no test is so accurate"
        )
        draft.warn("MD453", message, place, help=f"write frequency_sd: {100 * one:g} % if a share is meant")


def _shapes(draft: Draft, test: TestDraft) -> None:
    known = np.isfinite(test.shapes) & np.isfinite(test.shape_sd)
    if not known.any():
        return
    sd, largest = float(test.shape_sd[known].min()), float(np.abs(test.shapes[known]).max())
    if largest > 0 and sd >= _BLIND * largest:
        s, m = np.argwhere(known)[0]
        message = (
            f"shape_sd is {sd:g}, and the largest component of all shapes {largest:.4g}: the shapes would not count"
        )
        help = f"write shape_sd: {sd:g} % if a percentage is meant"
        draft.warn("MD453", message, test.where_shape_sd(int(s), int(m)), help=help)


def _twins(draft: Draft, test: TestDraft) -> None:
    """Warn of two modes with nearly one frequency and one shape: the peak of one mode, taken twice."""
    if len(test.shapes) < _SENSORS:  # fewer see two modes alike
        return
    likeness, hz = mac(test.shapes, test.shapes), test.frequency_hz
    for i, j in zip(*np.triu_indices(len(hz), 1), strict=True):
        if abs(hz[j] - hz[i]) <= _NEAR * abs(hz[i]) and likeness[i, j] > _ALIKE:
            message = (
                f"test frequencies {i + 1} and {j + 1}, {hz[i]:.6g} and {hz[j]:.6g} Hz, have like shapes "
                f"(MAC {likeness[i, j]:.3f}): one mode may be given twice"
            )
            help = "give it once; two modes in two directions need sensors in both"
            draft.warn("MD455", message, test.where_frequency(int(j)), help=help)
