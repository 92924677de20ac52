"""A support on a block that turns: a rotational spring against the ground, and the rotary inertia of the block."""

from functools import partial

from mouse_cli.diagnosis.effects.blocks import blocks
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.reasons import supports

CANDIDATE = Candidate(
    "block-rotation",
    "a support on a block that turns",
    "support",
    "a clamp on a foundation or a heavy base plate that turns with it and has rotary inertia of its own: a rotationally flexible "
    "support with inertia, which brings a mode of its own",
    partial(blocks, turning=True),
    supports,
    plain="support-rotation",
)
