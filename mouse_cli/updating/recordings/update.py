"""A run on recordings: parameters of the deck and of its laws by the output-error fit that a diagnosis begins with."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mouse_cli.model.diagnosis import Site
from mouse_cli.model.local_law import LocalLaw
from mouse_cli.model.problem import Problem
from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.model.result import ChiSquareTest
from mouse_cli.terms.laws import Scale, registry
from mouse_cli.updating.chi_square import upper_tail
from mouse_cli.updating.recordings.acting import Part, Place
from mouse_cli.updating.recordings.adequacy import close, strained, unlikely, with_noise
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.hypothesis import Hypothesis
from mouse_cli.updating.recordings.mistakes import check
from mouse_cli.updating.recordings.noise import noise
from mouse_cli.updating.recordings.polish import Polish, followed
from mouse_cli.updating.recordings.records import named, records
from mouse_cli.updating.recordings.regression import Regression
from mouse_cli.updating.recordings.rotations import spelled
from mouse_cli.updating.recordings.study import Study, begin, spread_over, study
from mouse_cli.updating.recordings.uncertain import Uncertain
from mouse_cli.updating.recordings.validation import scores, surface, trace
from mouse_cli.updating.refusals import not_simulated

Notice = Callable[[str], None]

_RANGE = 30.0  # factor within which a parameter of a law may be revised
_STEP = 1e-4  # of finite differences, in prior sd


def update_records(problem: Problem, notice: Notice) -> RecordUpdate:
    """The model of `problem` revised by its recordings.

    Raises DeckError for records that cannot judge (MD640) or are misread (MD457), NumericalError (MD540) where the model as it is
    cannot be simulated.
    """
    own = study(problem, records(problem))
    found = own.records
    notice("simulation of the records")
    parts = [_part(one, own) for one in problem.laws]
    prior, fit = _fitted(own, parts)
    if fit is not None and own.tune(fit):
        prior, fit = _fitted(own, parts)
    if fit is None:
        raise not_simulated(problem)
    notice("records that no fit has seen")
    left = noise(own.spectrum, fit.hypothesis, own.places, fit.x) if unlikely(fit) else None
    scale = with_noise(fit, left)
    explained = not strained(fit, scale) and (not unlikely(fit) or left is not None)
    if not explained:
        check(own)
    dof = max(int(fit.dof), 1)
    return RecordUpdate(
        problem=problem,
        theta=own.model.theta(fit.x[: own.model.own]),
        covariance=scale * _covariance(own.model, fit),
        laws=tuple(spelled(one, problem) for one in replace(fit, covariance=scale * fit.covariance).causes),
        residual=ChiSquareTest("residual", fit.misfit, dof, upper_tail(fit.misfit, dof)),
        noise_scale=scale,
        explained=explained,
        noise=left,
        scores=scores(own, prior, fit),
        trace=trace(own, prior, fit),
        surface=surface(own, fit),
        remarks=found.remarks + own.model.remarks + fit.calibrated,
        **named(found),
    )


def _part(one: LocalLaw, own: Study) -> tuple[Part, np.ndarray]:
    """A law of the deck with free parameters, and their values."""
    law, structure, basis = registry()[one.law], own.problem.structure, own.model.basis
    names = tuple(structure.labels[i] for i in one.dofs)
    motion, across = np.zeros(structure.n), None
    motion[one.dofs[-1]] = 1.0
    if len(one.dofs) > 1:
        motion[one.dofs[0]] = -1.0
    if law.motions > 1:
        motion, across = np.eye(structure.n)[one.dofs[0]], basis[one.dofs[1]]
    text = f"between {' and '.join((*names, 'the ground') if len(names) == 1 else names)}"
    scale = Scale(1, 1, 1, 1, (1, 1))
    place = Place(Site("dof", names, text=text), basis.T @ motion, len(names) == 1, scale, motion, across=across)
    values = np.array([one.values[size.name] for size in law.parameters])
    sizes = zip(law.parameters, values, strict=True)
    ranges = tuple(replace(size, lower=value / _RANGE, upper=value * _RANGE) for size, value in sizes)
    return Part(place, law, law.words.index(one.variant), ranges), values


def _fitted(own: Study, parts: list[tuple[Part, np.ndarray]]) -> tuple[Fit | None, Fit | None]:
    """The deck as it is, only initial states fitted, and the posterior; None where no simulation stays finite."""
    place = parts[-1][0].place if parts else None
    hypothesis = replace(own.base, known=(), place=place, parts=tuple(part for part, _ in parts))
    sizes = [np.log(values) for _, values in parts]
    x = np.concatenate([np.zeros(hypothesis.nuisances), *sizes])
    looks = own.looks(own.places[0])
    states, internal = begin(hypothesis, x, own.data, looks)
    spread = spread_over(looks)
    as_it_is = Polish(hypothesis.held(x), own.data, spread).fit(np.zeros(0), states, internal)
    if as_it_is is None:
        return None, None
    found = followed(hypothesis, own.data, spread, x, states, internal)
    if found is None or not close(found):  # the parameters of the deck may be too far for a simulation to find the way
        nearer = _begun(own, hypothesis, x)
        again = followed(hypothesis, own.data, spread, nearer, *begin(hypothesis, nearer, own.data, looks))
        found = min((one for one in (found, again) if one is not None), key=lambda one: one.cost, default=None)
    return replace(as_it_is, hypothesis=hypothesis, x=x), found


def _begun(own: Study, hypothesis: Hypothesis, x: np.ndarray) -> np.ndarray:
    """x (k,) moved to where the record has it in closed form, laws along its own motion."""
    look = Regression(own.spectrum, hypothesis.placed(own.places[0]), x)
    return np.clip(look.begin(np.zeros_like(look.y), np.zeros(0))[0], *hypothesis.bounds)


def _covariance(model: Uncertain, fit: Fit) -> np.ndarray:
    """Of the parameters of the deck (p, p): J S J', J the slope of their values by the nuisances that they are."""
    z = fit.x[: model.own]
    J = [(model.theta(z + step) - model.theta(z - step)) / (2 * _STEP) for step in _STEP * np.eye(model.own)]
    J = np.array(J).reshape(model.own, len(model.theta(z))).T
    return J @ fit.covariance[: model.own, : model.own] @ J.T
