"""The map of energy: where the stiffness of the model and the measured shapes part, for physics that is distributed."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import place
from mouse_cli.report.sections._wording import LEFT

_MOST = 10  # places listed


def energy(found: Diagnosis, options: Options) -> Iterator[Block]:
    """The places with the largest shares; nothing where none was computed."""
    energy = found.energy
    if energy is None:
        return
    shown = energy.order[:_MOST]
    columns = (Column("site", align=LEFT), Column("share", "per cent"))
    yield Table(columns, tuple((place(energy.sites[i]), f"{100 * energy.share[i]:.3g}") for i in shown))
    errors = ", ".join(
        f"{100 * error:.2g} % in mode {mode}" for mode, error in zip(energy.mode, energy.error, strict=True)
    )
    holds = "site" + (" holds" if energy.half == 1 else "s hold")
    yield Text(
        f"Of the energy by which stresses and strains disagree when the measured shapes are imposed on the model as it is, "
        f"{energy.half} {holds} half, of {len(energy.sites)}: few for a local mechanism, many for a distributed one. It "
        f"shows all that is missing as if it were stiffness. Relative to the strain energy: {errors}."
    )


SECTION = Section("diagnosis-energy", 65, "Energy of the disagreement", energy, (Diagnosis,))
