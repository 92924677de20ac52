"""K and M of the truths in numpy, and what acts on single degrees of freedom: springs, masses, supports, oscillators."""

import numpy as np

_RIGID = 1e-6  # of the highest eigenvalue asked for: below it a mode is one of a rigid body


class Assembly:
    """Symmetric K, M (n, n) of a structure, and terms k b b' and m b b' on it; supports are rows that are left out."""

    def __init__(self, K: np.ndarray, M: np.ndarray) -> None:
        self.base, self.n = (K, M), len(K)
        self.springs: list[tuple[dict[int, float], float]] = []
        self.weights: list[tuple[dict[int, float], float]] = []
        self.held: set[int] = set()

    def new_dof(self) -> int:
        """A further degree of freedom, without stiffness or mass."""
        self.n += 1
        return self.n - 1

    def spring(self, b: dict[int, float], k: float) -> None:
        """K + k b b', b by degree of freedom."""
        self.springs.append((b, k))

    def stiffen(self, springs: list[int], factor: float) -> None:
        """Multiplies the stiffness of springs."""
        for i in springs:
            self.springs[i] = (self.springs[i][0], self.springs[i][1] * factor)

    def weight(self, b: dict[int, float], kg: float) -> None:
        """M + kg b b'."""
        self.weights.append((b, kg))

    def oscillator(self, dof: int, kg: float, k: float) -> None:
        """A mass on a spring that stands on `dof`."""
        own = self.new_dof()
        self.spring({dof: 1.0, own: -1.0}, k)
        self.weight({own: 1.0}, kg)

    def core(self) -> tuple[np.ndarray, np.ndarray]:
        """K and M without the terms."""
        return self.base

    def matrices(self) -> tuple[np.ndarray, np.ndarray]:
        """K and M (n, n) with all terms, supports not yet left out."""
        found = []
        for base, terms in zip(self.core(), (self.springs, self.weights), strict=True):
            whole = np.zeros((self.n, self.n))
            whole[: len(base), : len(base)] = base
            for b, value in terms:
                at, c = list(b), np.array(list(b.values()))
                whole[np.ix_(at, at)] += value * np.outer(c, c)
            found.append(whole)
        return found[0], found[1]

    def modes(self, count: int) -> tuple[np.ndarray, np.ndarray]:
        """Natural frequencies (count,) in Hz and shapes (n, count); rigid-body modes are left out.

        Degrees of freedom without mass are condensed statically, which is exact.
        """
        from scipy.linalg import eigh

        K, M = self.matrices()
        free = [i for i in range(self.n) if i not in self.held]
        heavy = [i for i in free if M[i].any()]
        light = [i for i in free if not M[i].any()]
        G = -np.linalg.solve(K[np.ix_(light, light)], K[np.ix_(light, heavy)])
        reduced = K[np.ix_(heavy, heavy)] + K[np.ix_(heavy, light)] @ G
        last = min(count + 5, len(heavy) - 1)
        values, vectors = eigh((reduced + reduced.T) / 2, M[np.ix_(heavy, heavy)], subset_by_index=[0, last])
        shapes = np.zeros((self.n, len(values)))
        shapes[heavy], shapes[light] = vectors, G @ vectors
        keep = np.flatnonzero(values > _RIGID * values[-1])[:count]
        return np.sqrt(values[keep]) / (2 * np.pi), shapes[:, keep]
