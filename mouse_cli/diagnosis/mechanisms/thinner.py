"""A set of shells that is thinner than modelled."""

from mouse_cli.diagnosis.effects.thickness import of_shells
from mouse_cli.diagnosis.mechanisms import Candidate

CANDIDATE = Candidate(
    "thinner",
    "a thinner shell",
    "local-stiffness",
    "an element set of shells whose thickness is less than modelled: K_1 t / t_0 + K_3 (t / t_0)^3, and mass with it; wear, "
    "corrosion, a sheet of another gauge",
    of_shells,
)
