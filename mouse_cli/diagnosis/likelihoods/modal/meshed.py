"""The reduced model of a deck corrected for its mesh, and whether its elements are too long for its test."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.extend.halves import beyond, halved
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.numerics import numerics
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.problem import Problem

HALVINGS = 2  # of elements at most
_SWINGING = 0.5  # share of the misfit that half as long elements leave, below which the test has modes of members by themselves


@dataclass(frozen=True)
class Meshed:
    """model: at the prior mean, its data allowed what the correction leaves; remarks: on that; coarse: what a mesh does that is too
    coarse; "": it is not.
    """

    model: Reduced
    remarks: tuple[str, ...] = ()
    coarse: str = ""

    def said(self, problem: Problem) -> str:
        """What to say where the elements of the deck are halved for it."""
        return (
            f"numerics: the mesh is too coarse for this test, {self.coarse}: every beam is taken in two halves (cables in four), "
            f"the second of which, and the node between, are called {beyond(problem)} more than the element"
        )


def meshed(problem: Problem, solver: EigenSolver | None = None) -> Meshed:
    """The model of a deck with what its mesh does. solver: that may have its modes.

    Functions are of the matrices as they are, so that a model of these is not corrected, and is too coarse sooner.
    """
    model = reduced(problem, problem.prior.mean, solver)
    bare = Model(model).point(model.z)
    if bare is None:
        return Meshed(model)
    found = numerics(problem, problem.prior.mean, *_looked_at(model, bare))
    found = replace(found, finer=None) if problem.frf else found
    mesh, still = found.allowed(model, bare), np.zeros(model.data.has_shape.shape)
    there = replace(model, finer=found.finer, mesh=mesh, data=model.data.loosened(mesh[bare.modes], still))
    return Meshed(there, found.remarks, found.coarse(mesh) or (_swinging(problem, bare) if found.loose else ""))


def _swinging(problem: Problem, bare: Point) -> str:
    """Whether members swing by themselves in modes that were measured: half as long elements leave less of the misfit."""
    finer = reduced(halved(problem), problem.prior.mean)
    at = Model(finer).point(finer.z)
    if at is None or not finer.data.by_shape or at.chi2 > _SWINGING * bare.chi2:
        return ""
    return f"half as long elements have modes of members by themselves, and misfit it by {at.chi2:.3g} instead of {bare.chi2:.3g}"


def _looked_at(model: Reduced, bare: Point) -> tuple[np.ndarray, np.ndarray]:
    """Numbers (n,) from 0 of the modes that were fitted or are held out, and the least sd (n,) of their ln f."""
    least = dict(zip(bare.modes.tolist(), model.data.sd_log.tolist(), strict=True))
    held = model.problem.hold_out
    for test in [] if held is None else [each for each in (held.test, *held.altered) if each is not None]:
        sd = (test.frequency_sd_hz / test.frequency_hz).tolist()
        for number, own in zip((test.number - 1).tolist(), sd, strict=True):
            if number < model.r and own == own:
                least[number] = min(own, least.get(number, own))
    return np.array(sorted(least), int), np.array([least[number] for number in sorted(least)])
