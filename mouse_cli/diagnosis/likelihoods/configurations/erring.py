"""How much theory errs, as tests of the state before ask: what is sought is in none of them, so that all they leave is of theory.

Their evidence, ln N(r; 0, I + T T' + U U') with T slopes by the parameters in prior sd and U those of `shared`, is compared for
a few tau; the one that is stated stands unless another is more probable by what a name takes.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.evidence import marginal
from mouse_cli.diagnosis.gates import GATE, ODDS
from mouse_cli.diagnosis.likelihoods.configurations.model import Arranged
from mouse_cli.diagnosis.likelihoods.configurations.shared import Errors
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.updating.chi_square import upper_tail

_TIMES = (1.0, 1.5, 2.0, 3.0, 5.0, 8.0)  # of the tau that is stated
_STEPS = 6  # times that parameters are found again
_BEYOND = 5.0  # chi-square over degrees of freedom above which a test would have to understate its noise far too much
_FAR = 0.02  # tau from which on that state lacks more than scatter of its members, where no more is stated


@dataclass(frozen=True)
class Before:
    """tau that the state before asks for, the one that is stated, and what is left of its tests with it."""

    tau: float
    stated: float
    chi2: float
    dof: int

    @property
    def explained(self) -> bool:
        """Whether the model explains that state: with no more than scatter, or with noise that is somewhat understated."""
        if self.tau > self.stated and self.tau >= _FAR:
            return False
        return upper_tail(self.chi2, self.dof) > GATE or self.chi2 <= _BEYOND * self.dof

    @property
    def refused(self) -> str:
        """Why no change is sought, in a sentence; empty: one is."""
        if self.explained:
            return ""
        return (
            "No change was sought, for the model does not explain the state before: it would have to err by "
            f"{100 * self.tau:.2g} % of ln f, and leaves a chi-square of {self.chi2:.0f} on {self.dof} then."
        )

    @property
    def remarks(self) -> tuple[str, ...]:
        """What to say of a state that is explained, without ends of sentences."""
        if self.tau == self.stated or not self.explained:
            return ()
        percent = [f"{100 * each:.2g} %" for each in (self.tau, self.stated)]
        return (f"theory errs by {percent[0]} of ln f in the state before, not by {percent[1]} as stated: that is allowed for",)


def before(base: Arranged) -> Before | None:
    """What tests of configurations without what is sought ask of theory; None where they are no model that others are."""
    which = [i for i, has in enumerate(base.having) if not has]
    if not which or not base.errors.alike or not base.common_sd:
        return None
    found = [_evidence(base, which, times * base.common_sd) for times in _TIMES]
    best = max(range(len(found)), key=lambda i: found[i][0])
    best = best if found[best][0] > found[0][0] + ODDS else 0
    dof = sum(base.parts[i].data.dof for i in which)
    return Before(_TIMES[best] * base.common_sd, base.common_sd, found[best][1], dof)


def _evidence(base: Arranged, which: list[int], tau: float) -> tuple[float, float]:
    """ln of the density of the tests of configurations `which`, the parameters and errors of sd tau integrated out, and the
    chi-square of what these leave.
    """
    errors = base.errors if tau == base.errors.sd else Errors(base.errors.modes, tau)  # those of the stated tau are known
    U, models = np.vstack([errors.U[i] for i in which]), [Model(base.parts[i]) for i in which]
    z, found = base.z, (-np.inf, np.inf)
    for _ in range(_STEPS):
        points = [model.point(z) for model in models]
        if None in points:
            break
        T = np.vstack([model.jacobian(at) for model, at in zip(models, points, strict=True)])
        B = np.hstack([T, U])
        residual = np.concatenate([at.residual for at in points]) + T @ z
        chi2, size = marginal(residual, B)
        found = max(found, (-0.5 * (chi2 + size), chi2))
        z = T.T @ np.linalg.solve(np.eye(len(B)) + B @ B.T, residual)
    return found
