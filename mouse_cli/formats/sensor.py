"""A sensor as a deck describes it, before the model's degrees of freedom are known."""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli._span import Span


@dataclass
class SensorDraft:
    """What a sensor reads: a sum of `weights` over degrees of freedom, named by number (from 1) or label; or motion along
    `direction` (6,), a unit vector over TX, TY, TZ, RX, RY, RZ, at `node` or at the point `at` (3,) in m.

    ground (6,): the motion of the ground along a unit vector, 0 where a model of matrices has none; it carries along what `weights`
    say, without them all that lies in its direction. words: how it was written, for messages; plain: it stands in a list of degrees
    of freedom and has no name of its own.
    """

    name: str
    where: Span | None = None
    weights: dict[int | str, float] = field(default_factory=dict)
    direction: np.ndarray | None = None
    node: int | None = None
    at: np.ndarray | None = None
    words: str = ""
    plain: bool = False
    ground: np.ndarray | None = None
