"""Large arrays that one cycle after the other uses again: fresh pages cost more than what is computed in them."""

import numpy as np


class Workspace:
    """Arrays by name; whoever asks again for a name has what is in it overwritten."""

    def __init__(self) -> None:
        self._held: dict[str, np.ndarray] = {}

    def array(self, name: str, shape: tuple[int, ...]) -> np.ndarray:
        """An array of that shape with anything in it."""
        size = int(np.prod(shape))
        held = self._held.get(name)
        if held is None or len(held) < size:
            self._held.pop(name, None)
            del held
            held = self._held[name] = np.empty(size)
        return held[:size].reshape(shape)
