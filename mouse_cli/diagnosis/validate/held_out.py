"""Is it true? Both models predict data that no fit has seen, with the uncertainty of their own parameters.

Data held out by the deck, an altered configuration among them, are kept from the first fit on. Where a deck holds nothing out,
each measured mode is predicted from the others: both models, of settled form, are fitted without it.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe
from mouse_cli.diagnosis.evidence import marginal
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.noise import log_density as noisy_density
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.validate.joint import beyond_linear
from mouse_cli.dynamics.correlation import mac
from mouse_cli.dynamics.sensing import read
from mouse_cli.model.diagnosis import BY_DECK, BY_MODE, HeldOut, Score
from mouse_cli.model.hold_out import HoldOut
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.updating.chi_square import upper_tail

_STEP = 1e-4  # of a prior standard deviation, or of the range of an unknown, for derivatives
COVERED = 1.6448536269514722  # standard deviations of a 90 % interval


@dataclass(frozen=True)
class Prediction:
    """Of a test that was not fitted: frequencies (m,) and their sd by both model and data, MAC (m,), log density.

    covered (f,): frequencies within their intervals; shape_error (c,): of components, over the largest of their mode. misfit:
    chi-square of all that was measured, on dof.
    """

    test: ModalTest
    hz: np.ndarray
    sd_hz: np.ndarray
    mac: np.ndarray
    density: float
    covered: np.ndarray
    misfit: float
    dof: int
    shape_error: np.ndarray = field(default_factory=lambda: np.zeros(0))


def predict(one: Fit, base: Reduced, fixed: tuple[Recipe, ...] = (), noise: float = 1.0) -> Prediction | None:
    """What the model of `one` says of the test of `base`; fixed: changes of the structure that are known.

    Where it is not linear in what the fit leaves open, the density is that of `joint.py`. noise:
    s^2, by which variances are larger than stated, of the test that was fitted and so of the unknowns too; the density is then
    that of the linear prediction.
    """
    model = type(one.model)(base, (*one.recipes, *fixed))
    at = model.point(one.point.x)
    if at is None:
        return None
    T, data = model.jacobian(at), base.data
    spread = T @ one.root
    misfit, size = marginal(at.residual, spread)
    misfit, size = misfit / noise, size + len(spread) * np.log(noise)
    density = -0.5 * (misfit + size) - at.nats
    if noise == 1.0 and (beyond := beyond_linear(one, model, at, T, misfit)):
        misfit, density = beyond
    frequencies = int(data.has_frequency.sum())
    off, sd = at.residual[:frequencies], np.sqrt(noise * (1 + (spread[:frequencies] ** 2).sum(axis=1)))
    hz = np.sqrt(np.maximum(at.eigenvalues[at.modes], 0.0)) / (2 * np.pi)
    sd_hz = np.full(data.m, np.nan)
    sd_hz[data.has_frequency] = hz[data.has_frequency] * data.sd_log[data.has_frequency] * sd
    alike = np.full(data.m, np.nan)
    if data.s:
        alike = mac(data.test.shapes, at.measured(at.seen)).diagonal()
    return Prediction(
        data.test, hz, sd_hz, alike, float(density - data.log_sd), np.abs(off) < COVERED * sd, misfit, len(spread)
    )


def readings(one: Fit, test: ModalTest) -> Prediction | None:
    """What the model of `one` says of the modes that it was fitted to, at the sensors of `test`, which it was not.

    Lengths and signs of the shapes are those of the sensors that were fitted, with the uncertainty that these leave.
    """
    base, at = one.model.base, one.point
    sensing = np.asarray(read(test.measured_at, base.V))
    known, scale = np.isfinite(test.shapes), np.abs(np.nan_to_num(base.data.test.shapes)).max(axis=0)
    reading = lambda point: (point.a * (sensing @ point.measured(point.X[: base.r])))[known]
    sd = np.hypot(test.shape_sd, base.problem.theory.shape * scale)[known]
    J = _sensitivity(one, reading)
    if J is None or not known.any():
        return None
    own = base.data.scale_sd(at.measured(at.seen)) / np.where(at.a == 0, 1.0, at.a)
    of_mode = np.nonzero(known)[1][:, None] == np.arange(test.m)
    J = np.hstack([J @ one.root, of_mode * (reading(at)[:, None] * own)]) / sd[:, None]
    off = (test.shapes[known] - reading(at)) / sd
    misfit, size = marginal(off, J)
    density = -0.5 * (misfit + size + len(off) * np.log(2 * np.pi)) - np.log(sd).sum()
    unmeasured = np.full(test.m, np.nan)
    alike = mac(test.shapes, sensing @ at.measured(at.X[: base.r])).diagonal() if len(sensing) > 1 else unmeasured
    left = off * sd / scale[np.nonzero(known)[1]]
    blind = replace(test, frequency_hz=unmeasured)
    none = np.zeros(0, bool)
    return Prediction(blind, unmeasured, unmeasured, alike, float(density), none, misfit, len(off), left)


def _sensitivity(one: Fit, reading: Callable[[Point], np.ndarray]) -> np.ndarray | None:
    """d told / dx (q, k + t) at the end of a fit, by central differences."""
    model, columns = one.model, []
    low, high = np.vstack([np.tile([-np.inf, np.inf], (model.k, 1)), model.bounds]).T
    for j, step in enumerate(_STEP * np.concatenate([np.ones(model.k), model.width])):
        sides = [one.point.x.copy() for _ in range(2)]
        for x, way in zip(sides, (step, -step), strict=True):
            x[j] = np.clip(x[j] + way, low[j], high[j])
        ends = [model.point(x) for x in sides]
        if None in ends:
            return None
        columns.append((reading(ends[0]) - reading(ends[1])) / (sides[0][j] - sides[1][j]))
    return np.column_stack([np.zeros((len(reading(one.point)), 0)), *columns])


def score(parts: list[Prediction]) -> Score:
    """Several predictions as one."""
    measured = np.concatenate([part.test.frequency_hz for part in parts])
    hz, have = np.concatenate([part.hz for part in parts]), np.isfinite(measured)
    error, left = hz[have] / measured[have] - 1, np.concatenate([part.shape_error for part in parts])
    return Score(
        rms_frequency_error=float(np.sqrt(np.mean(error**2))) if have.any() else float("nan"),
        log_predictive_density=float(sum(part.density for part in parts)),
        covered=float(np.mean(np.concatenate([part.covered for part in parts]))) if have.any() else float("nan"),
        frequencies_hz=hz,
        sd_hz=np.concatenate([part.sd_hz for part in parts]),
        mac=np.concatenate([part.mac for part in parts]),
        rms_shape_error=float(np.sqrt(np.mean(left**2))) if len(left) else float("nan"),
        p=upper_tail(sum(part.misfit for part in parts), sum(part.dof for part in parts)),
    )


def held_out(model: Reduced, baseline: Fit, best: Fit | None) -> HeldOut | None:
    """Both models on what the deck holds out, else on each mode in turn."""
    if not by_deck(model):
        return cross_validated(model, baseline, best)
    held = model.problem.hold_out
    parts = {"baseline": of_cases(held, baseline), "revised": best and of_cases(held, best)}
    labels, kept = [], []
    for i, (title, own) in enumerate(parts["baseline"]):
        if own is not None and (best is None or parts["revised"][i][1] is not None):
            labels += [title.format(number) for number in own.test.number]
            kept.append(i)
    if not kept:
        return None
    found = {name: part and [part[i][1] for i in kept] for name, part in parts.items()}
    measured = np.concatenate([part.test.frequency_hz for part in found["baseline"]])
    revised = None if best is None else score(found["revised"])
    return HeldOut(BY_DECK, tuple(labels), measured, score(found["baseline"]), revised)


def by_deck(model: Reduced) -> bool:
    """Whether the deck holds anything out."""
    held = model.problem.hold_out
    return held is not None and bool(held.altered or len(held.modes) or len(held.sensors))


@dataclass(frozen=True)
class HeldOutDensity:
    """All that a deck holds out, as a fit predicts it: ln of its density, and its chi-square on dof."""

    density: float
    misfit: float
    dof: int

    @property
    def p(self) -> float:
        """How probable as much misfit is when the model is right."""
        return upper_tail(self.misfit, self.dof)

    @property
    def over_noise(self) -> float:
        """ln of the density, noise larger than stated integrated out: a theory that errs adds to what it leaves open."""
        return self.density + 0.5 * self.misfit + float(noisy_density(np.array(self.misfit), self.dof))


def held_out_density(one: Fit) -> HeldOutDensity | None:
    """Of all that the deck of a fit holds out; None where that is nothing, or a part is unphysical."""
    held = one.model.base.problem.hold_out
    parts = [] if held is None else [part for _, part in of_cases(held, one)]
    if not parts or None in parts:
        return None
    return HeldOutDensity(*(sum(getattr(part, name) for part in parts) for name in ("density", "misfit", "dof")))


def of_cases(held: HoldOut, one: Fit, noise: float = 1.0) -> list[tuple[str, Prediction | None]]:
    """Title of each case that was held out, and what the model of `one` says of it; noise: as in `predict`."""
    base, found = one.model.base, []
    if held.test is not None and held.test.m:
        found.append(("mode {}", predict(one, base.with_test(held.test, base.data.test), noise=noise)))
    if held.readings is not None and base.data.by_shape:
        found.append(("mode {} at sensors held out", readings(one, held.readings)))
    for altered in held.altered:
        unmeasured = np.full((base.data.s, len(altered.number)), np.nan)
        frequencies = altered.number, altered.frequency_hz, altered.frequency_sd_hz
        test = ModalTest(*frequencies, base.data.test.dofs, unmeasured, unmeasured, "fitted")
        fixed = known(base, altered.masses, altered.springs)
        title = altered.title.replace("{", "{{").replace("}", "}}")
        found.append((title + ", mode {}", predict(one, base.with_test(test), (fixed,), noise)))
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
        for name, one in (("baseline", baseline), ("revised", best)):
            part = None if one is None else left_out(one, i)
            if one is not None and part is None:
                return None
            found[name] += [] if part is None else [part]
    labels = tuple(f"mode {number}" for number in test.number)
    revised = None if best is None else score(found["revised"])
    return HeldOut(BY_MODE, labels, test.frequency_hz, score(found["baseline"]), revised)


def left_out(one: Fit, i: int) -> Prediction | None:
    """What the model of `one`, fitted without measured mode i, says of it."""
    again = refitted(one, i)
    return None if again is None else predict(again, one.model.base.left_out(i))


def refitted(one: Fit, without: int | None = None) -> Fit | None:
    """The same hypothesis fitted to the test as it is stated, or without one of its modes."""
    base = one.model.base
    keep = np.arange(base.data.m) != (-1 if without is None else without)
    return fit(type(one.model)(base.without(keep), one.recipes), one.c, one.point.x[: one.model.k])
