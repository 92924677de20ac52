"""A whole run against what a user would write: scipy.optimize.least_squares with finite differences around eigsh.

One problem, 10,000 degrees of freedom and 50 parameters. The user's program runs to its end around a fast factorisation, for
its answer and the number of its eigensolutions; around `eigsh(K, k, M, sigma=0)`, as a user calls it, some eigensolutions are
timed and the total is that number times their median: extrapolated, and said so. Both times and both ratios are printed, and
how far the answers lie apart in posterior standard deviations. Forward differences over steps of 1e-5: those that
least_squares takes by itself, 1.5e-8, are smaller than the accuracy of an eigensolution. CPU seconds, one thread.
"""

import argparse
import statistics
import time

import _threads  # noqa: F401 - sets the number of threads before numpy is there
import numpy as np
from _user_model import UserModel

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--kind", default="frame", choices=("solid", "plate", "frame"))
parser.add_argument("--dofs", type=float, default=11_000, help="degrees of freedom (default 11000)")
parser.add_argument("--parameters", type=int, default=50)
parser.add_argument("--timed", type=int, default=3, help="eigensolutions by eigsh to be timed (default 3)")

MODES, SENSORS, AIM, STEP = 10, 20, 100, 1e-5


class Scaled(UserModel):
    """The user's program around the same assembly as mouse's; with the fast factorisation or with eigsh as it comes."""

    def __init__(self, problem, assembly, fast: bool):
        test = problem.test
        measured = (test.frequency_hz, test.frequency_sd_hz, test.shapes, test.shape_sd)
        super().__init__(None, None, test.dofs, *measured, problem.prior.sd)
        self.matrices, self.fast, self.symbolic = (lambda theta: assembly.matrices(theta)), fast, None

    def eigensolution(self, theta: np.ndarray):
        """As the base class, or by ARPACK around the fast factorisation, analysed once."""
        if not self.fast:
            return super().eigensolution(theta)
        from fast_factor import Symbolic, arpack, factorise, shift

        self.solutions += 1
        K, M = self.matrices(theta)
        if self.symbolic is None:
            self.symbolic = Symbolic(K, M)
            self.sigma = shift(K, M, self.symbolic)
        return arpack(K, M, self.sigma, factorise(K, M, self.sigma, self.symbolic), self.modes + 3)


def timed(action):
    """CPU seconds of a call, and its answer."""
    start = time.process_time()
    answer = action()
    return time.process_time() - start, answer


def main() -> None:
    """Compare the two."""
    from scale_models import problem

    from mouse_cli.terms.assembly import assembly
    from mouse_cli.updating import run

    options = parser.parse_args()
    case = problem(options.kind, options.dofs, options.parameters, MODES, SENSORS)
    run(case)  # for its imports
    ours, result = timed(lambda: run(case))
    fast, slow = (Scaled(case, assembly(case), is_fast) for is_fast in (True, False))
    theirs, theta = timed(lambda: fast.least_squares(diff_step=STEP))
    once = statistics.median(timed(lambda: slow.predicted(theta))[0] for _ in range(options.timed))
    total, apart = once * fast.solutions, np.abs((theta - result.revised.theta) / result.sd_theta).max()
    print(f"{case.title}, {options.parameters} parameters, {MODES} modes, {SENSORS} sensors")
    print(f"  mouse: {ours:.2f} s, {len(result.cycles) + 1} eigensolutions, ended {result.status.key}")
    print(
        f"  finite differences around a fast factorisation: {theirs:.1f} s, {fast.solutions} of them: {theirs / ours:.0f} times"
    )
    print(
        f"  around eigsh as it comes: {once:.2f} s each, {total:.0f} s in all, extrapolated: {total / ours:.0f} times (aim {AIM})"
    )
    print(f"  answers at most {apart:.1e} posterior standard deviations apart")


if __name__ == "__main__":
    main()
