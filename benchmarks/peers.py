"""mouse against the tools that do its job, on three problems, for several draws of the noise.

P1: chain of 4 masses, 4 stiffnesses, 4 modes at 4 sensors. P2: clamped beam of 140 degrees of freedom, 7 bending stiffnesses,
6 modes at 14 sensors. P3: bar of 94,500 degrees of freedom in hexahedra, 8 stiffness groups, 6 modes at 60 sensors. Noise
0.2 % in frequencies, 1 % of the largest component in shapes; everybody starts at 1.0 and has the same data, accuracies and
weak prior (50 %), except probeye, which maximises the likelihood. The true factors lie within 20 % of 1.0. CPU seconds on
one thread, without imports. Error: the largest relative one of any factor; the group at the free end is hardly observable,
so its posterior standard deviation is printed too.

scipy: `least_squares` around `eigh` or `eigsh` with its finite differences as they come, and (careful) with central
differences over steps of 1e-3. At P3 one Jacobian is measured and taken as often as mouse needed cycles, unless --whole-p3.
"""

import argparse
import statistics
import sys
import time

import _threads  # noqa: F401 - sets the number of threads before numpy is there

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("problems", nargs="*", help="P1, P2, P3; none: all of them")
parser.add_argument("--draws", type=int, default=5, help="draws of the noise (default 5)")
parser.add_argument(
    "--with-peers",
    action="store_true",
    help="OpenTURNS and probeye too, on P1 and P2, in an environment of their own, made in the user's cache folder",
)
parser.add_argument("--whole-p3", action="store_true", help="run scipy's finite differences on P3 to the end, one draw")


def row(tool: str, cpu: list[float], errors: list[float], solutions: list[int], remark: str = "") -> None:
    """Print the medians of one tool, and its largest error."""
    count = f"{statistics.median(solutions):6.0f}"
    print(
        f"  {tool:24}{statistics.median(cpu):10.3f} s {count} eigensolutions"
        f"   error {100 * statistics.median(errors):5.2f} %, at most {100 * max(errors):5.2f} %{remark}",
        flush=True,
    )


def by_mouse(peer, draws: int) -> int:
    """Run mouse on every draw; the number of its eigensolutions."""
    from mouse_cli.updating import run

    cpu, errors, solutions, sds, ends = [], [], [], [], set()
    for seed in range(draws):
        problem, _ = peer.draw(seed)
        start = time.process_time()
        result = run(problem)
        cpu.append(time.process_time() - start)
        errors.append(peer.worst(result.revised.theta))
        solutions.append(len(result.cycles) + 1)
        sds.append(float((result.sd_theta / peer.truth).max()))
        ends.add(result.status.key)
    remark = f"; largest posterior sd {100 * statistics.median(sds):.2f} %; ended: {', '.join(sorted(ends))}"
    row("mouse", cpu, errors, solutions, remark)
    return int(statistics.median(solutions))


def by_scipy(peer, draws: int, title: str, **options) -> None:
    """Run a user's program on every draw."""
    cpu, errors, solutions = [], [], []
    for seed in range(draws):
        _, model = peer.draw(seed)
        start = time.process_time()
        theta = model.least_squares(**options)
        cpu.append(time.process_time() - start)
        errors.append(peer.worst(theta))
        solutions.append(model.solutions)
    row(title, cpu, errors, solutions)


def one_jacobian(peer, cycles: int) -> None:
    """Time one eigensolution of a user's program and say what finite differences would cost."""
    import numpy as np

    _, model = peer.draw(0)
    start = time.process_time()
    model.residual(np.ones(peer.p))
    once = time.process_time() - start
    total = once * (peer.p + 1) * (cycles - 1)
    print(
        f"  scipy: one eigensolution {once:.2f} s; {cycles - 1} Jacobians of {peer.p + 1}: {total:.0f} s, extrapolated"
    )


def by_peers(peer, draws: int) -> None:
    """OpenTURNS and probeye in their own environment."""
    import _peer_environment

    for tool in ("OpenTURNS", "probeye"):
        answers = [_peer_environment.answer(tool, peer.draw(seed)[1]) for seed in range(draws)]
        row(
            tool,
            [a["cpu"] for a in answers],
            [peer.worst(a["theta"]) for a in answers],
            [a["solutions"] for a in answers],
        )


def main() -> None:
    """Compare on the problems named on the command line."""
    options = parser.parse_args()
    from _peer_problems import PRIOR_SD, PROBLEMS, PeerProblem

    if unknown := set(options.problems) - set(PROBLEMS):
        parser.error(f"no problem {unknown.pop()}; there are {', '.join(PROBLEMS)}")
    print(f"{options.draws} draws of the noise; prior sd {100 * PRIOR_SD:.0f} %; CPU seconds on one thread: medians")
    for name in options.problems or PROBLEMS:
        peer = PeerProblem(name)
        print(f"{name}: {peer.structure.n} degrees of freedom, {peer.p} parameters, {peer.dofs.size} sensors")
        cycles = by_mouse(peer, options.draws)
        if name == "P3" and not options.whole_p3:
            one_jacobian(peer, cycles)
            continue
        draws = options.draws if name != "P3" else 1
        by_scipy(peer, draws, "scipy")
        if name != "P3":
            by_scipy(peer, draws, "scipy, careful", jac="3-point", diff_step=1e-3)
        if options.with_peers and name != "P3":
            by_peers(peer, options.draws)


if __name__ == "__main__":
    sys.exit(main())
