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
H, LONG = np.longdouble(1e-30), np.longdouble  # complex step; extended precision where the machine has it


def complex_step(K, M, dK, dM, eigenvalue: float, x: np.ndarray) -> tuple[list[float], list[np.ndarray]]:
    """Derivatives of an eigenvalue and its mode shape (n,) by each of the parameters that move K by dK[j] and M by dM[j]."""
    from scipy.sparse import block_array, csc_array
    from scipy.sparse.linalg import splu

    n, border = K.shape[0], csc_array((M @ x)[:, None])
    factor = splu(block_array([[K - eigenvalue * M, -border], [-border.T, None]], format="csc"))

    def improved(K, M, eigenvalue, x, steps: int):
        """Newton with the Jacobian of the real mode, which is exact to h; residuals in extended precision."""
        for _ in range(steps):
            rest = np.append(K @ x - eigenvalue * (M @ x), 0.5 - 0.5 * (x @ (M @ x)))
            real, imaginary = (factor.solve(part.astype(float)) for part in (rest.real, rest.imag / H))
            step = real + 1j * H * imaginary.astype(LONG)
            x, eigenvalue = x - step[:n], eigenvalue - step[n]
        return eigenvalue, x

    K, M, x = K.astype(LONG), M.astype(LONG), x.astype(LONG)
    eigenvalue, x = (part.real for part in improved(K, M, LONG(eigenvalue), x, 5))
    one = LONG(1) * 1j * H
    moved = [
        improved(K + one * a, M + one * b, eigenvalue + 0 * one, x + 0 * one, 5) for a, b in zip(dK, dM, strict=True)
    ]
    return [float(e.imag / H) for e, _ in moved], [(y.imag / H).astype(float) for _, y in moved]


class Case:
    """A model at nominal values: K, M and their derivatives by some parameters, sensors, modes to be tested."""

    def __init__(self, kind: str, dofs: float, modes: int, sensors: int):
        from scale_models import model, spread

        from mouse_cli.dynamics.forces import forces
        from mouse_cli.terms.assembly import Assembly

        structure, term, _, translations = model(kind, dofs, PARAMETERS)
        self.n, self.modes = structure.n, np.arange(modes)
        self.dofs = spread(translations, sensors)
        assembly, nominal = Assembly(structure, (term,), PARAMETERS), np.ones(PARAMETERS)
        self.K, self.M = assembly.matrices(nominal)
        self.pattern = forces(self.n, PARAMETERS, assembly.slopes(nominal))
        self.parameters = np.linspace(0, PARAMETERS - 1, TESTED_PARAMETERS).astype(int)
        self.tested = np.linspace(0, modes - 1, TESTED_MODES).astype(int)
        self.dK, self.dM = zip(*(assembly.matrices(row) for row in np.eye(PARAMETERS)[self.parameters]), strict=True)

    def partials(self, residual: float, accuracy: float):
        """The eigensolution of mouse to `residual`, and its partial derivatives to `accuracy`."""
        from mouse_cli.dynamics.sensitivity import modal_partials
        from mouse_cli.dynamics.solver import EigenSolver

        solution = EigenSolver().solve(self.K, self.M, len(self.modes) + 6, tolerance=residual)
        return solution, modal_partials(solution, self.K, self.M, self.modes, self.dofs, self.pattern, accuracy)

    def errors(self, solution, partials) -> tuple[np.ndarray, np.ndarray]:
        """Relative errors of the eigenvalues' and of the shapes' derivatives, for every tested mode and parameter."""
        of_values, of_shapes = [], []
        for i in self.tested:
            mode = self.modes[i]
            x = solution.shapes[:, mode]
            values, shapes = complex_step(self.K, self.M, self.dK, self.dM, solution.eigenvalues[mode], x)
            exact = np.array(shapes).T[self.dofs]
            of_values.append(np.abs(partials.d_lambda[i, self.parameters] / values - 1))
            difference = np.abs(partials.d_shape[i][:, self.parameters] - exact).max(axis=0)
            of_shapes.append(difference / np.abs(exact).max(axis=0))
        return np.concatenate(of_values), np.concatenate(of_shapes)


def report(kind: str, dofs: float, modes: int, sensors: int) -> None:
    """Print the errors of one model at both accuracies."""
    from mouse_cli.dynamics import sensitivity, solver

    case = Case(kind, dofs, modes, sensors)
    print(f"{kind}: {case.n} degrees of freedom, {modes} modes, {sensors} sensors, {PARAMETERS} parameters")
    for name, residual, accuracy in (
        ("default", solver.TOLERANCE, sensitivity.FINAL),
        ("--exact", solver.EXACT, sensitivity.EXACT),
    ):
        solution, partials = case.partials(residual, accuracy)
        of_values, of_shapes = case.errors(solution, partials)
        print(
            f"  {name}: shapes, worst {of_shapes.max():.1e} (aim {accuracy:.0e}), median {np.median(of_shapes):.1e};"
            f" mouse states {partials.error:.1e}; eigenvalues, worst {of_values.max():.1e}",
            flush=True,
        )


def main() -> None:
    """Report on the models named on the command line."""
    options = parser.parse_args()
    for kind in options.kinds or ("solid", "plate", "frame"):
        report(kind, options.dofs, options.modes, options.sensors)


if __name__ == "__main__":
    main()
