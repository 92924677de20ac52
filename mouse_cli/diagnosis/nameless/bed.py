"""A bed of springs to the ground whose stiffness varies smoothly along the structure."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.matrices import of_matrices, with_shares
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._cells import FEWEST, Cells, of_rows
from mouse_cli.diagnosis.nameless._groups import places
from mouse_cli.diagnosis.nameless._motions import translations
from mouse_cli.diagnosis.sites.points import named_dof
from mouse_cli.model.diagnosis import BED
from mouse_cli.model.problem import Problem
from mouse_cli.terms.elements import _beam as beam

_FIRST = 12.36  # (beta L)^4 of the first mode of a cantilever: w^2 m = 12.36 EI / L^4


def cells(model: Reduced) -> Cells | None:
    """K + sum v_e k w'w, k = EI / L^4 along the bars of a mesh; of a model of matrices at each degree of freedom."""
    return _at_dofs(model) if of_matrices(model.problem) else _under_bars(model)


def _under_bars(model: Reduced) -> Cells | None:
    bars = model.bars
    if bars is None or len(bars) < FEWEST:
        return None
    w, _, _ = beam.shapes(bars.length, np.zeros(len(bars)))
    unit = bars.stiffness / bars.span**4
    parts = beam.integral(w, bars.length) * unit
    at = bars.start + 0.5 * bars.length[:, None] * bars.axis
    sites = tuple(bars.site(i, 0.5) for i in range(len(bars)))

    def extend(problem: Problem, values: np.ndarray, spread: float) -> Problem:
        edit = Edit(problem)
        for i, value in enumerate(values):
            element = edit.element(int(bars.ids[i]))
            own, name = edit.sets[element[0]], f"k{'yz'[bars.plane[i]]}"
            options = {k: own.options[k] for k in ("orientation", "offsets") if k in own.options}
            new = edit.add("foundation", own.nodes[[element[1]]], {name: value * unit}, options)
            edit.bind(f"bed of {sites[i].text}", new, (name,), unit="N/m2")
            edit.parameters[-1] = replace(edit.parameters[-1], sd=spread * unit, transform="identity")
        return edit.done()

    on_bed = any(own.type == "foundation" for own in model.problem.mesh.elements)
    blocks, added = tuple(zip(bars.ends, parts, strict=True)), None if on_bed else bars.length
    return Cells(sites, at, "m", blocks, "K", extend, positive=added)


def _at_dofs(model: Reduced) -> Cells | None:
    structure, own = model.problem.structure, translations(model)
    sites = [named_dof(structure, int(i)) for i in own]
    unit = lowest(model) * total_mass(model) / max(len(own), 1) / _FIRST

    def extend(problem: Problem, kept: np.ndarray, values: np.ndarray, spread: float) -> Problem:
        shares = [
            (sites[k].text, float(v), (own[[k]], own[[k]], sizes[[k]])) for k, v in zip(kept, values, strict=True)
        ]
        return with_shares(problem, "bed", shares, spread)

    (at, metres), sizes = places(structure), np.full(len(own), unit)
    return of_rows(model, sites, at[own], metres, model.V[own], sizes, "K", extend)


NAMELESS = Nameless(
    "field-bed",
    "a bed of springs to the ground that varies along the structure",
    BED,
    "springs per length to the ground, neighbours alike: a smooth random field whose spread and correlation length are integrated "
    "out, in units of EI / L^4; together stiffer than nothing where the model has no bed that could be softer",
    (10.0, 100.0, 1000.0),
    cells,
    even="foundation",
)
