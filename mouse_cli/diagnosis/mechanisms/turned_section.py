"""A section that stands where the model has it lying: both of its second moments of area exchanged.

K + K_e(Iz, Iy) - K_e(Iy, Iz) of a member, a row, a section or all beams.
"""

from mouse_cli.diagnosis.effects.turned import of_turned
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import oblong

CANDIDATE = Candidate(
    "turned-section",
    "a section turned by 90 degrees",
    "turned-section",
    "a beam, a straight row of beams, those of one storey, all of one section or all beams whose second moments of area are "
    "exchanged: a mistake of the model's orientation, or a profile mounted on its side; it has no size, "
    "K + K_e(Iz, Iy) - K_e(Iy, Iz)",
    of_turned,
    oblong,
    lasting=True,
)
