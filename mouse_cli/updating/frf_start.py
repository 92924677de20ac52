"""Where the search for parameters begins with FRFs: a model whose resonances are near the measured ones.

The misfit of FRFs line by line has as many minima as resonances can be mistaken for one another, and each is as narrow as a
resonance. Measurement and model are therefore first compared with much more damping (`frf_smoothing`), then with less and less; at
last by ln|H| as measured. Each answer is where the next search begins; the prior stays the same in all of them.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.estimators import estimator
from mouse_cli.observables.frf import observe
from mouse_cli.observables.frf_smoothing import smoothed
from mouse_cli.updating import anchored
from mouse_cli.updating.convergence import ExceedanceTest
from mouse_cli.updating.state import Setting, State
from mouse_cli.updating.trace import Trace

WIDTHS = (0.2, 0.1, 0.05, 0.02)  # damping ratios by which resonances are widened
_CYCLES = 8  # of each search


def start(setting: Setting, guess: np.ndarray | None) -> np.ndarray:
    """Values (p,) of the parameters from which the FRFs themselves can be fitted."""
    observables = setting.frf.observables
    stages = [tuple(smoothed(o.test, width) for o in observables) for width in WIDTHS]
    if any(o.form != "log" for o in observables):
        stages.append(tuple(observe(o.test, "log", o.lines) for o in observables))
    for stage in stages:
        if any(len(o) for o in stage):
            guess = _searched(_staged(setting, stage), guess)
    return setting.coordinates.value(setting.coordinates.mean) if guess is None else guess


def _staged(setting: Setting, observables: tuple) -> Setting:
    """The setting with other observables of its FRFs."""
    frf = replace(setting.frf, observables=observables)
    run = replace(setting.problem.run, partials=_CYCLES, cycles=None, step="first-order")
    modal, (y, sd) = setting.observable.measured(), frf.data()
    return replace(
        setting,
        problem=replace(setting.problem, run=run),
        frf=frf,
        y=np.concatenate([modal[0], y]),
        sd=np.concatenate([modal[1], sd]),
    )


def _searched(setting: Setting, guess: np.ndarray | None) -> np.ndarray:
    """Values (p,) at the end of a search from `guess` on, or from the prior."""
    options = setting.problem.run
    trace = Trace(
        setting,
        ExceedanceTest(options.confidence, options.convergence),
        lambda cycle: None,
        State(setting, setting.coordinates.mean),
        guess=guess,
    )
    anchored.recur(trace, estimator("bayes"))
    return trace.state.theta
