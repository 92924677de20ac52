"""An axial force that varies smoothly along bars: distributed loads, gradients of temperature, friction."""

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.matrices import of_matrices
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._cells import FEWEST, Cells
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.preload import resistance, tensions
from mouse_cli.model.diagnosis import AXIAL
from mouse_cli.model.problem import Problem
from mouse_cli.terms.elements import _beam as beam


def cells(model: Reduced) -> Cells | None:
    """K + sum v_e T Kg_e over bars that bend, T as in `resistance`, Kg_e the integral of w'w' in each of the planes of one."""
    bars = model.bars
    if of_matrices(model.problem) or bars is None or any(b.property == "preload" for b in model.problem.bindings):
        return None
    own = list(bars.twins.values())
    if len(own) < FEWEST:
        return None
    unit = resistance(bars.EI, tensions(model), bars.span)
    first = np.array([twins[0] for twins in own])
    sites = tuple(bars.site(i, 0.5) for i in first.tolist())
    at = bars.start[first] + 0.5 * bars.length[first, None] * bars.axis[first]

    def extend(problem: Problem, values: np.ndarray, spread: float) -> Problem:
        edit = Edit(problem)
        for site, value in zip(sites, values, strict=True):
            element = edit.element(site.ids[0])
            edit.put([element], "preload", np.array([edit.values(element, "preload") + value * unit]))
            edit.bind(f"axial force of {site.text}", [element], ("preload",), unit="N")
        return edit.done()

    return Cells(sites, at, "m", tuple(_block(bars, twins, unit) for twins in own), "K", extend)


def _block(bars: Bars, twins: list[int], unit: float) -> tuple[np.ndarray, np.ndarray]:
    """Motions of the ends (4 t, r) of the t planes of an element, and the stiffness of a pull of `unit` on them."""
    _, slope, _ = beam.shapes(bars.length[twins], bars.phi[twins])
    planes, size = beam.integral(slope, bars.length[twins]), 4 * len(twins)
    block = np.zeros((size, size))
    for t, plane in enumerate(planes):
        block[4 * t : 4 * t + 4, 4 * t : 4 * t + 4] = unit * plane
    return bars.ends[twins].reshape(size, -1), block


NAMELESS = Nameless(
    "field-axial",
    "an axial force that varies along the structure",
    AXIAL,
    "a pull or a push of each bar, neighbours alike: a smooth random field whose spread and correlation length are integrated out, "
    "in units of EI / L^2, and of what tension there is over pi^2",
    (0.3, 3.0, 30.0),
    cells,
    even="axial",
)
