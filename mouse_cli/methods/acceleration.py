"""Fixed points reached sooner: the last few steps combined so that their remaining change is least (Anderson 1965)."""

import numpy as np

_REMEMBERED = 6


class Accelerated:
    """Proposals for the fixed point of z -> g(z), from the pairs (z, g(z)) that were seen."""

    def __init__(self) -> None:
        self._z: list[np.ndarray] = []
        self._g: list[np.ndarray] = []

    def propose(self, z: np.ndarray, g: np.ndarray) -> np.ndarray:
        """The next z (k,) after g(z) was found: g less what the differences of the last steps explain of g - z.

        >>> import numpy as np
        >>> ahead = Accelerated()
        >>> z = ahead.propose(np.array([0.0]), np.array([1.0]))  # g(z) = 1 + 0.9 z
        >>> ahead.propose(z, 1 + 0.9 * z).round(9).tolist()
        [10.0]
        """
        self._z, self._g = [*self._z, z][-_REMEMBERED:], [*self._g, g][-_REMEMBERED:]
        if len(self._z) < 2:
            return g
        left = np.column_stack(self._g) - np.column_stack(self._z)
        weights = np.linalg.lstsq(np.diff(left), left[:, -1], rcond=1e-10)[0]
        return g - np.diff(np.column_stack(self._g)) @ weights

    def forget(self) -> None:
        """Begin anew: what was seen does not lead on."""
        self._z, self._g = [], []
