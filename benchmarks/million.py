"""A plate of a million degrees of freedom through a run, within 16 GiB; a solid of that size refused before it starts.

Each runs in a process of its own, whose peak of resident memory the operating system counted (getrusage). The test of the
plate is simulated in another one. The solid would need more for its factors than there is, and mouse must say so, with the
memory it would need, at once rather than after an hour: its test is invented, as nothing is computed.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import _threads  # noqa: F401 - sets the number of threads before numpy is there
import numpy as np

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("models", nargs="*", help="plate, solid; none: both")
parser.add_argument("--dofs", type=float, default=1e6, help="degrees of freedom (default 1e6)")
parser.add_argument("--cycles", type=int, default=1, help="cycles of the run (default 1); 0: until it converges")
parser.add_argument("--threads", type=int, default=1, help="threads for linear algebra (default 1)")
parser.add_argument("--step", nargs=2, help=argparse.SUPPRESS)  # what one of the processes does, and its file

MODES, SENSORS, PARAMETERS = 10, 20, 200
LIMIT = 16.0  # GiB
FIELDS = ("number", "frequency_hz", "frequency_sd_hz", "dofs", "shapes", "shape_sd")


def simulate(kind: str, dofs: float, path: Path) -> None:
    """Write the test of a structure drawn from the prior."""
    from scale_models import problem

    test = problem(kind, dofs, PARAMETERS, MODES, SENSORS).test
    np.savez(path, **{name: getattr(test, name) for name in FIELDS})


def invent(kind: str, dofs: float, path: Path) -> None:
    """Write a test that has the right shape."""
    hz = 100.0 * np.arange(1, MODES + 1)
    shapes = np.random.default_rng(0).standard_normal((SENSORS, MODES))
    np.savez(
        path,
        **dict(
            zip(FIELDS, (np.arange(1, MODES + 1), hz, hz / 500, np.arange(SENSORS), shapes, shapes**2), strict=True)
        ),
    )


def revise(kind: str, dofs: float, path: Path, cycles: int) -> None:
    """Run mouse on the model and the test written."""
    from scale_models import model, with_factors

    from mouse_cli._errors import DeckError, NumericalError
    from mouse_cli.model.modal_test import ModalTest
    from mouse_cli.updating import run

    start = time.perf_counter()
    with np.load(path) as file:
        test = ModalTest(*(file[name] for name in FIELDS), "none")
    structure, term, sd, _ = model(kind, dofs, PARAMETERS)
    problem = with_factors(
        f"{kind} of {structure.n}", structure, term, sd, test, cycles=cycles or None, pairing="number"
    )
    said(f"{structure.n} degrees of freedom, {len(term.places['K'])} element entries", start)
    try:
        result = run(problem, lambda cycle: said(f"cycle {cycle.index}: chi-square {cycle.chi2:.4g}", start))
        said(f"ended {result.status.key}", start)
    except (DeckError, NumericalError) as refusal:
        said(f"refused: {refusal}", start)


def said(what: str, start: float) -> None:
    """Print a line with the time since `start` and the peak of memory so far."""
    print(f"  {time.perf_counter() - start:7.1f} s {peak():5.1f} GiB  {what}", flush=True)


def peak() -> float:
    """Largest resident memory of this process so far, in GiB."""
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit / 2**30


def in_own_process(step: str, kind: str, path: Path, options: argparse.Namespace) -> float:
    """Run one step in a process of its own; its peak of memory in GiB."""
    given = ["--dofs", str(options.dofs), "--cycles", str(options.cycles), "--threads", str(options.threads)]
    child = subprocess.Popen([sys.executable, __file__, kind, "--step", step, str(path), *given])
    _, status, usage = os.wait4(child.pid, 0)
    if status:
        raise SystemExit(f"{step} of the {kind} ended with status {status}")
    return usage.ru_maxrss * (1 if sys.platform == "darwin" else 1024) / 2**30


def main() -> None:
    """Run the models named on the command line, or one step of one of them."""
    options = parser.parse_args()
    if options.step:
        step, path = options.step
        kind = options.models[0]
        if step == "revise":
            revise(kind, options.dofs, Path(path), options.cycles)
        else:
            {"simulate": simulate, "invent": invent}[step](kind, options.dofs, Path(path))
        return
    for kind in options.models or ("plate", "solid"):
        print(
            f"{kind}: {MODES} modes, {SENSORS} sensors, {PARAMETERS} parameters, {options.threads} thread(s)",
            flush=True,
        )
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "test.npz"
            in_own_process("simulate" if kind == "plate" else "invent", kind, path, options)
            memory = in_own_process("revise", kind, path, options)
        print(f"  peak of resident memory {memory:.1f} GiB (aim: below {LIMIT:.0f})", flush=True)


if __name__ == "__main__":
    main()
