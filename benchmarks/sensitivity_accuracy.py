"""Errors of the sensitivities against complex-step derivatives, at the default accuracy and at `--exact`'s.

The reference shares nothing with mouse but K and M: Newton's method in complex arithmetic on the bordered system
(K - lambda M) x = 0, x'Mx = 1, for K + i h dK with h = 1e-30, around the model's own mode; the derivative is the imaginary
part over h (Squire and Trapp 1998). Errors are relative to the largest component that a parameter moves in a mode: the worst
and the median over some modes, all sensors and some parameters.
"""

import argparse

import _threads  # noqa: F401 - sets the number of threads before numpy is there
import numpy as np

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("kinds", nargs="*", help="solid, plate, frame; none: all of them")
parser.add_argument("--dofs", type=float, default=4000, help="degrees of freedom (default 4000)")
parser.add_argument("--modes", type=int, default=20)
parser.add_argument("--sensors", type=int, default=30)

PARAMETERS, TESTED_MODES, TESTED_PARAMETERS = 40, 5, 6
H, AIM, AIM_EXACT = 1e-30, 1e-6, 1e-9


def complex_step(K, M, dK, dM, eigenvalue: float, x: np.ndarray) -> tuple[list[float], list[np.ndarray]]:
    """Derivatives of an eigenvalue and its mode-shape (n,) by each of the parameters that move K by dK[j] and M by dM[j]."""
    from scipy.sparse import block_array, csc_array
    from scipy.sparse.linalg import splu

    n = K.shape[0]

    def improved(K, M, eigenvalue, x, steps: int):
        """Newton with the Jacobian of the real mode, which is exact to h."""
        for _ in range(steps):
            rest = np.append(K @ x - eigenvalue * (M @ x), 0.5 - 0.5 * (x @ (M @ x)))
            step = factor.solve(rest.real) + 1j * H * factor.solve(rest.imag / H)
            x, eigenvalue = x - step[:n], eigenvalue - step[n]
        return eigenvalue, x

    border = csc_array((M @ x)[:, None])
    factor = splu(block_array([[K - eigenvalue * M, -border], [-border.T, None]], format="csc"))
    eigenvalue, x = (part.real for part in improved(K, M, eigenvalue + 0j, x + 0j, 3))
    moved = [improved(K + 1j * H * a, M + 1j * H * b, eigenvalue + 0j, x + 0j, 4) for a, b in zip(dK, dM, strict=True)]
    return [e.imag / H for e, _ in moved], [y.imag / H for _, y in moved]


def references(state, tested: np.ndarray, parameters: np.ndarray) -> dict[int, np.ndarray]:
    """For some modes i, derivatives (1 + s, parameters) of the eigenvalue and of the shape as the sensors read it."""
    assembly, test = state.setting.assembly, state.setting.problem.test
    unit = np.eye(assembly.p)[parameters]
    dK, dM = zip(*(assembly.matrices(row) for row in unit), strict=True)
    dM = [b if b is not None else 0 * state.M for b in dM]
    answer = {}
    for i in tested:
        mode = state.modes[i]
        x = state.solution.shapes[:, mode]
        slopes, shapes = complex_step(state.K, state.M, dK, dM, state.solution.eigenvalues[mode], x)
        answer[i] = np.vstack([slopes, test.read(np.array(shapes).T) * state.factor[i]])
    return answer


def errors(T: np.ndarray, reference: dict[int, np.ndarray], parameters: np.ndarray, m: int, s: int):
    """Relative errors of eigenvalues and of shapes, for every tested mode and parameter."""
    of_values, of_shapes = [], []
    for i, exact in reference.items():
        rows = m + i * s + np.arange(s)
        of_values.append(np.abs(T[i, parameters] / exact[0] - 1))
        difference = np.abs(T[np.ix_(rows, parameters)] - exact[1:]).max(axis=0)
        of_shapes.append(difference / np.abs(exact[1:]).max(axis=0))
    return np.concatenate(of_values), np.concatenate(of_shapes)


def report(kind: str, dofs: float, modes: int, sensors: int) -> None:
    """Print the errors of one model."""
    from _one_cycle import Cycles
    from scale_models import problem

    run = Cycles(problem(kind, dofs, PARAMETERS, modes, sensors))
    tested = np.linspace(0, modes - 1, TESTED_MODES).astype(int)
    parameters = np.linspace(0, PARAMETERS - 1, TESTED_PARAMETERS).astype(int)
    reference = references(run.state, tested, parameters)
    print(
        f"{kind}: {run.problem.structure.n} degrees of freedom, {modes} modes, {sensors} sensors, {PARAMETERS} parameters"
    )
    of_values, of_shapes = errors(run.state.T, reference, parameters, modes, sensors)
    print(f"  eigenvalues: worst {of_values.max():.1e}, median {np.median(of_values):.1e}")
    print(f"  mode shapes: worst {of_shapes.max():.1e}, median {np.median(of_shapes):.1e} (aim {AIM:.0e})", flush=True)


def main() -> None:
    """Report on the models named on the command line."""
    options = parser.parse_args()
    for kind in options.kinds or ("solid", "plate", "frame"):
        report(kind, options.dofs, options.modes, options.sensors)


if __name__ == "__main__":
    main()
