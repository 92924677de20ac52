"""How often 90 % intervals hold the depth and the place of a crack that is known to be there: fits alone, no search, no rivals.

Begun at the true place and depth; `python -m benchmarks.blind --cases 'crack-*'` asks whether it is found at all. `--sharp` states
no errors of theory, which these decks have not: what the sd of sizes are then is what noise alone makes of them.
"""

import argparse
from itertools import islice

import numpy as np

from benchmarks.blind import cracks
from benchmarks.blind.case import Case
from benchmarks.blind.decks import as_text
from benchmarks.blind.scoring import Z90
from benchmarks.blind.test_data import CONFIGS, measured
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search.descents import idealised, settled
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

SHARP = "theory: {frequency: 1.0e-9, shape: 1.0e-9, mechanism: 1.0e-9}\n"


def errors(case: Case, config: str, seed: int, sharp: bool = False) -> np.ndarray:
    """Errors (2,) of ln depth and of the place over their sd, and (2,) sd of ln depth and of the place over the span."""
    truth = case.make(case.inputs)
    text = as_text("crack", case, measured(case, truth, CONFIGS[config], (config, seed)), CONFIGS[config])
    problem = assemble(yaml_deck.read(text + (SHARP if sharp else ""), "crack.yaml"))
    model = reduced(problem, problem.prior.mean)
    candidate = registry()["crack"]
    recipe = model.recipes(candidate)[0]
    true = recipe.coordinates(np.array([case.inputs["depth"], case.inputs["place"]]))
    one = fit(Model(model, (recipe,)), true)
    one = idealised(settled(one, Study(model, {"crack": candidate})))
    sd = np.sqrt(np.diag(one.covariance))[one.model.k :]
    return np.array([(one.c - true) / sd, sd / [1.0, case.span]])


def table(found: np.ndarray) -> str:
    """Coverage, and the spread of errors over their sd, from `errors` (c, 2, 2)."""
    lines = [f"{'size':8}{'in 90 %':>10}{'of':>6}{'mean z':>9}{'rms z':>8}{'median sd':>11}"]
    for i, name in enumerate(("depth", "place")):
        z, sd = found[:, 0, i], found[:, 1, i]
        held = int((np.abs(z) <= Z90).sum())
        lines.append(
            f"{name:8}{held:>10}{len(z):>6}{z.mean():>9.2f}{np.sqrt(np.mean(z**2)):>8.2f}{np.median(sd):>11.5f}"
        )
    return "\n".join(lines)


def main() -> None:
    """Parse the options and print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.blind.crack_sizes", description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1, help="bars, cracks and noise")
    parser.add_argument("--count", type=int, default=200, help="cracks")
    parser.add_argument("--config", choices=CONFIGS, default="P", help="sensors and noise")
    parser.add_argument("--sharp", action="store_true", help="state no errors of theory")
    given = parser.parse_args()
    cases = islice(cracks.cases("development", given.seed, given.count), given.count)
    print(table(np.array([errors(case, given.config, given.seed, given.sharp) for case in cases])))


if __name__ == "__main__":
    main()
