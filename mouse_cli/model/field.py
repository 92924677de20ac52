"""Physics that has no name: where it acts, and how much of it."""

from dataclasses import dataclass

from mouse_cli.model.prediction import HeldOut
from mouse_cli.model.site import Site

# Of what kind physics without a name is.
STIFFNESS, MASS, BED, AXIAL = "stiffness", "mass", "bed", "axial"
FORCE, COMPLIANCE, LAW = "force", "compliance", "law"
SHOWN = 2.0  # sd from which on a value differs from 0


@dataclass(frozen=True)
class FieldValue:
    """A field at a site: value and sd, relative to what the model has there; of a bed in EI / L^4, of axial forces in EI / L^2."""

    site: Site
    value: float
    sd: float

    @property
    def shown(self) -> bool:
        """Whether it differs from 0."""
        return abs(self.value) > SHOWN * self.sd


@dataclass(frozen=True)
class Field:
    """Physics that has no name: a smooth change of `property` along the structure, or one spring or joint of it.

    Values of a FORCE are the motion along which one spring acts, of a COMPLIANCE the motion that the structure makes besides, of
    no sign of their own. Those of a LAW are of one place, a value for each mode, in units of the static stiffness there.
    spread: sd of its values; length: over which they are correlated, in m or in steps from site to site (`unit`).
    log_evidence_over_named: by which it leads everything that has a name; held_out: how the model with it predicts what no fit
    has seen. beside: a further one that acts with it; None: it acts alone.
    """

    property: str
    values: tuple[FieldValue, ...]
    spread: float
    length: float
    unit: str
    log_evidence_over_named: float
    held_out: HeldOut | None = None
    beside: "Field | None" = None
