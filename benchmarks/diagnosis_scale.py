"""Processor time of a diagnosis of a large model, in units of its eigensolution, with its parts.

The truth has a point mass that the model lacks: modes of the whole matrices by ARPACK. The eigensolution: that of the model, as
`mouse modes` does it, with its factorisation. One thread.
"""

import argparse
import time
from dataclasses import replace

import _threads  # noqa: F401  one thread, before numpy is loaded

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("kinds", nargs="*", default=["plate", "frame"], help="plate, frame, solid")
parser.add_argument("--size", type=int, default=100_000, help="degrees of freedom (default 100000)")
parser.add_argument("--parameters", type=int, default=10)
parser.add_argument("--modes", type=int, default=10)
parser.add_argument("--sensors", type=int, default=20)
parser.add_argument("--share", type=float, default=0.05, help="the mass, of the modal mass of mode 1 at its place")
parser.add_argument(
    "--whole",
    action="store_true",
    help="the whole of `diagnose` in place of its parts, the extended model and its update included",
)
parser.add_argument("--sd", type=float, default=0.25, help="of the parameters, of what scale_models has")


def concealed(kind: str, size: int, p: int, modes: int, sensors: int, share: float, factor: float):
    """The problem, and the degree of freedom of the mass."""
    import numpy as np
    from scale_models import Assembly, model, reference_modes, simulated, spread, with_factors
    from scipy.sparse import coo_array

    structure, term, sd, translations = model(kind, size, p)
    sd, rng = factor * sd, np.random.default_rng(5)
    K, M = Assembly(structure, (term,), p).matrices(1 + sd * rng.standard_normal(p))
    at = int(translations[int(0.7 * len(translations))])
    _, X = reference_modes(K, M, modes)
    mass = share / np.square(X[at]).max()
    eigenvalues, X = reference_modes(K, (M + coo_array(([mass], ([at], [at])), shape=M.shape)).tocsr(), modes)
    dofs = spread(translations, sensors)
    return with_factors(kind, structure, term, sd, simulated(eigenvalues, X[dofs], dofs, rng)), at


def timed(label: str, work, unit: float | None = None):
    """Result and seconds of `work`, printed."""
    start = time.process_time()
    found = work()
    seconds = time.process_time() - start
    print(f"  {label:28s} {seconds:8.2f} s" + (f" {seconds / unit:8.1f}" if unit else ""))
    return found, seconds


def _said(found) -> str:
    return f"{found.kind}, {found.best.physics if found.best else 'no cause'}, P {found.probability:.3f}"


def main() -> None:
    """Print the parts for each kind of model."""
    arguments = parser.parse_args()
    import numpy as np

    from mouse_cli.diagnosis import diagnose
    from mouse_cli.diagnosis.diagnose import ENOUGH
    from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
    from mouse_cli.diagnosis.likelihoods.modal.model import Model
    from mouse_cli.diagnosis.localise.energy_map import energy_map
    from mouse_cli.diagnosis.localise.force import locate
    from mouse_cli.diagnosis.search.fit import fit
    from mouse_cli.diagnosis.search.rank import rank
    from mouse_cli.dynamics.solver import EigenSolver
    from mouse_cli.terms.assembly import assembly
    from mouse_cli.updating.loop import run
    from mouse_cli.updating.state import solve

    for kind in arguments.kinds:
        own = (arguments.size, arguments.parameters, arguments.modes, arguments.sensors, arguments.share, arguments.sd)
        problem, at = concealed(kind, *own)
        problem = replace(problem, run=replace(problem.run, recursion="anchored", estimator="bayes"))
        print(f"{kind}: {problem.structure.n} degrees of freedom, mass at {problem.structure.labels[at]}")
        K, M = assembly(problem).matrices(problem.prior.mean)
        solver = EigenSolver(sensors=problem.test.s)
        _, unit = timed("eigensolution", lambda: solve(problem, K, M, solver=solver))
        if arguments.whole:
            found, seconds = timed("the whole diagnosis", lambda: diagnose(problem), unit)
            print(f"  {'':28s} {seconds:8.2f} s {seconds / unit:8.1f}   (aim 30)   {_said(found)}")
            continue
        model, first = timed("reduced model and places", lambda: reduced(problem, problem.prior.mean, solver), unit)
        near, second = timed("update in few coordinates", lambda: fit(Model(model), np.zeros(0)), unit)
        guess = model.parameters(near.point.x)
        _, third = timed("update", lambda: run(problem, guess=guess, enough=ENOUGH, solver=solver), unit)
        ranking, fourth = timed("candidates", lambda: rank(model), unit)
        here = ranking.baseline
        location, fifth = timed("location", lambda: locate(here.model.base), unit)
        _, sixth = timed("map of energy", lambda: energy_map(here), unit)
        total = first + second + third + fourth + fifth + sixth
        print(f"  {'sum of these':28s} {total:8.2f} s {total / unit:8.1f}   (aim 30)")
        print(
            f"  places: {[(p.channel, p.site.ids, round(p.probability, 2)) for p in location.places[:3]]}, p {location.p:.2g}"
        )
        print(f"  groups: {ranking.groups[:3]}")


if __name__ == "__main__":
    main()
