"""Is it true? Both models predict data that no fit has seen, with the uncertainty of their own parameters.

Data held out by the deck, an altered configuration among them, are kept from the first fit on. Where a deck holds nothing out,
each measured mode is predicted from the others: both models, of settled form, are fitted without it.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.altered import Model
from mouse_cli.diagnosis.change import Change, Recipe
from mouse_cli.diagnosis.fit import Fit, fit
from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.dynamics.correlation import mac
from mouse_cli.model.diagnosis import BY_DECK, BY_MODE, HeldOut, Score
from mouse_cli.model.hold_out import HoldOut
from mouse_cli.model.modal_test import ModalTest, restricted

_COVERED = 1.6448536269514722  # standard deviations of a 90 % interval


@dataclass(frozen=True)
class Prediction:
    """Of a test that was not fitted: eigenvalues (m,) and sd of ln f (m,) by both model and data, MAC (m,), log density."""

    test: ModalTest
    hz: np.ndarray
    sd_hz: np.ndarray
    mac: np.ndarray
    density: float
    covered: np.ndarray


def predict(one: Fit, base: Reduced, fixed: tuple[Recipe, ...] = ()) -> Prediction | None:
    """What the model of `one` says of the test of `base`; fixed: changes of the structure that are known."""
    model = Model(base, (*one.recipes, *fixed))
    at = model.point(one.point.x)
    if at is None:
        return None
    T, data = model.jacobian(at), base.data
    spread = T @ one.covariance @ T.T
    total = np.eye(len(spread)) + spread
    _, size = np.linalg.slogdet(total)
    density = -0.5 * (at.residual @ np.linalg.solve(total, at.residual) + size) - data.log_sd
    frequencies = int(data.has_frequency.sum())
    off, sd = at.residual[:frequencies], np.sqrt(np.diag(total)[:frequencies])
    hz = np.sqrt(np.maximum(at.eigenvalues[at.modes], 0.0)) / (2 * np.pi)
    sd_hz = np.full(data.m, np.nan)
    sd_hz[data.has_frequency] = hz[data.has_frequency] * data.sd_log[data.has_frequency] * sd
    alike = np.full(data.m, np.nan)
    if data.s:
        alike = mac(data.test.shapes, at.seen[:, at.modes]).diagonal()
    return Prediction(data.test, hz, sd_hz, alike, float(density), np.abs(off) < _COVERED * sd)


def score(parts: list[Prediction]) -> Score:
    """Several predictions as one."""
    measured = np.concatenate([part.test.frequency_hz for part in parts])
    hz, have = np.concatenate([part.hz for part in parts]), np.isfinite(measured)
    error = hz[have] / measured[have] - 1
    return Score(
        rms_frequency_error=float(np.sqrt(np.mean(error**2))) if have.any() else float("nan"),
        log_predictive_density=float(sum(part.density for part in parts)),
        covered=float(np.mean(np.concatenate([part.covered for part in parts]))) if have.any() else float("nan"),
        frequencies_hz=hz,
        sd_hz=np.concatenate([part.sd_hz for part in parts]),
        mac=np.concatenate([part.mac for part in parts]),
    )


def held_out(model: Reduced, baseline: Fit, best: Fit | None) -> HeldOut | None:
    """Both models on what the deck holds out, else on each mode in turn."""
    held = model.problem.hold_out
    if held is None or not (held.altered or (held.test is not None and held.test.m)):
        return cross_validated(model, baseline, best)
    parts = {"baseline": _foreseen(held, baseline), "revised": best and _foreseen(held, best)}
    labels, kept = [], []
    for i, (title, own) in enumerate(parts["baseline"]):
        if own is not None and (best is None or parts["revised"][i][1] is not None):
            labels += [f"{title}mode {number}" for number in own.test.number]
            kept.append(i)
    if not kept:
        return None
    found = {name: part and [part[i][1] for i in kept] for name, part in parts.items()}
    measured = np.concatenate([part.test.frequency_hz for part in found["baseline"]])
    revised = None if best is None else score(found["revised"])
    return HeldOut(BY_DECK, tuple(labels), measured, score(found["baseline"]), revised)


def _foreseen(held: HoldOut, one: Fit) -> list[tuple[str, Prediction | None]]:
    """Title of each case that was held out, and what the model of `one` says of it."""
    base, found = one.model.base, []
    if held.test is not None and held.test.m:
        found.append(("", predict(one, base.with_test(held.test))))
    for altered in held.altered:
        unmeasured = np.full((base.data.s, len(altered.number)), np.nan)
        frequencies = altered.number, altered.frequency_hz, altered.frequency_sd_hz
        test = ModalTest(*frequencies, base.data.test.dofs, unmeasured, unmeasured, "fitted")
        fixed = known(base, altered.masses, altered.springs)
        found.append((f"{altered.title}, ", predict(one, base.with_test(test), (fixed,))))
    return found


def known(model: Reduced, masses: dict[int, float], springs: dict[int, float]) -> Recipe:
    """A change without unknowns: masses in kg and springs to the ground in N/m at degrees of freedom."""
    K, M = np.zeros((2, model.r, model.r))
    for into, values in ((K, springs), (M, masses)):
        for dof, value in values.items():
            into += value * np.outer(model.V[dof], model.V[dof])
    return Recipe(None, (), lambda values: Change(K, M), np.zeros((1, 0)))


def cross_validated(model: Reduced, baseline: Fit, best: Fit | None) -> HeldOut | None:
    """Each mode predicted by both models fitted to the others; None where there are too few."""
    test = model.data.test
    if test.m < 3:
        return None
    found: dict[str, list[Prediction]] = {"baseline": [], "revised": []}
    for i in range(test.m):
        own = np.arange(test.m) == i
        for name, one in (("baseline", baseline), ("revised", best)):
            if one is None:
                continue
            base = one.model.base
            rest, left = base.without(~own), base.with_test(restricted(test, own))
            again = fit(Model(rest, one.recipes), one.c, one.point.x[: one.model.k])
            part = None if again is None else predict(again, left)
            if part is None:
                return None
            found[name].append(part)
    labels = tuple(f"mode {number}" for number in test.number)
    revised = None if best is None else score(found["revised"])
    return HeldOut(BY_MODE, labels, test.frequency_hz, score(found["baseline"]), revised)
