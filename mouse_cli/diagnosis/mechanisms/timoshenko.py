"""Both that Euler and Bernoulli leave out: shear flexibility, and the inertia of sections that turn.

Timoshenko's bar with rotary inertia from the section itself.
"""

from functools import partial

from mouse_cli.diagnosis.effects.shearing import sheared
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import bars

CANDIDATE = Candidate(
    "timoshenko",
    "shear flexibility and rotary inertia",
    "shear",
    "Timoshenko's bar: shear flexibility together with the inertia of turning sections, which always come together",
    partial(sheared, turning=True),
    bars,
    lasting=True,
)
