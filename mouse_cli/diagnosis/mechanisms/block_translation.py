"""A support on a block that slides or heaves: a spring against the ground, and the mass of the block."""

from functools import partial

from mouse_cli.diagnosis.effects.blocks import blocks
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import supports

CANDIDATE = Candidate(
    "block-translation",
    "a support on a block that moves",
    "support",
    "a foundation, a pedestal or the table of a test stand that slides or heaves on its soil or mount and has a mass of its own: a "
    "flexible support with inertia, which brings a mode of its own",
    partial(blocks, turning=False),
    supports,
    plain="support-translation",
)
