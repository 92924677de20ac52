"""What a method hands back, before anybody has judged it."""

from dataclasses import dataclass

from mouse_cli.model.arrays import Matrix
from mouse_cli.model.conditioning import Conditioning
from mouse_cli.model.updated import Moved


@dataclass(frozen=True)
class Found:
    """K, M (n, n) and how they were reached; the same fields of Updated hold them. moved: in the order that `conditioning` counts.

    against: what the method's own tests say against the answer, as a sentence without its full stop.
    """

    K: Matrix
    M: Matrix
    iterations: int = 1
    change: float = 0.0
    converged: bool = True
    moved: tuple[Moved, ...] = ()
    conditioning: Conditioning | None = None
    against: str = ""
