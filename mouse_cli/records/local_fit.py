"""Fits of few modes at a time, the others held: many modes over many lines come near the minimum at a fraction of the cost.

A resonance acts on distant lines by a slope alone, so that poles of distant modes hardly depend on one another. A group is fitted
with its neighbours on the lines around it; the neighbours' changes are forgotten. A few steps of the whole fit end it, so that
the minimum is the same.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.records.maximum_likelihood import Fit, fitted, unknowns
from mouse_cli.records.modal_model import Lines, ModalModel, solved, synthesised

MANY = 16  # modes from which on groups pay
_GROUP, _NEIGHBOURS = 6, 4
_REACH = 30.0  # decay rates on either side of a group from where on its lines say little of it
_FEWEST = 40  # lines on either side
_SWEEPS, _STEPS = 3, 6
_FEW = 6  # iterations after a mode was taken out
_GAINED = 0.01  # of chi2, by which another sweep has to lower it


def approached(lines: Lines, model: ModalModel) -> ModalModel:
    """The model nearer to the maximum of the likelihood: poles and participations fitted in groups, by turns."""
    if model.m < MANY:
        return model
    model, chi2 = solved(lines, model)
    for _ in range(_SWEEPS):
        moved = model
        for group in _groups(moved):
            moved = _fitted_group(lines, moved, group, _STEPS)
        moved, lower = solved(lines, moved)
        if not lower < chi2:
            return model
        gain, model, chi2 = chi2 - lower, moved, lower
        if gain < _GAINED * chi2:
            return model
    return model


def without(lines: Lines, fit: Fit, mode: int) -> Fit:
    """The fit without one of its modes: those near it are fitted anew; all, where they are few or that does not make up for it."""
    rest = fit.model.without(mode)
    if rest.m < MANY:
        return fitted(lines, rest, _FEW)
    away = np.abs(rest.poles.imag - fit.model.poles[mode].imag)
    near = np.sort(np.argsort(away)[:_GROUP])
    model, chi2 = solved(lines, _fitted_group(lines, solved(lines, rest)[0], near, _FEW))
    if chi2 - fit.chi2 > _GAINED * fit.chi2:
        return fitted(lines, rest, _FEW)
    return Fit(model, chi2, 2 * lines.values - unknowns(model))


def _groups(model: ModalModel) -> list[np.ndarray]:
    """Modes in groups of neighbours."""
    order = np.argsort(model.poles.imag)
    return np.array_split(order, -(-model.m // _GROUP))


def _fitted_group(lines: Lines, model: ModalModel, group: np.ndarray, steps: int) -> ModalModel:
    """The model with poles and participations of `group` fitted on the lines around it."""
    order = np.argsort(model.poles.imag)
    at = np.flatnonzero(np.isin(order, group))
    both = order[max(at[0] - _NEIGHBOURS, 0) : at[-1] + 1 + _NEIGHBOURS]
    own, others = _part(model, both, False), _part(model, np.setdiff1d(order, both), True)
    window = _window(lines, model.poles[group])
    around = Lines(lines.s[window], lines.H[window], lines.sd[window], lines.kind)
    rest = np.where(np.isfinite(around.sd), around.H - synthesised(around, others), 0)
    found = fitted(replace(around, H=rest), own, steps).model
    poles, participation, kept = model.poles.copy(), model.participation.copy(), np.isin(both, group)
    poles[both[kept]], participation[:, both[kept]] = found.poles[kept], found.participation[:, kept]
    return replace(model, poles=poles, participation=participation)


def _part(model: ModalModel, modes: np.ndarray, residuals: bool) -> ModalModel:
    """Some modes of the model, with or without its residual terms."""
    few = replace(
        model, poles=model.poles[modes], participation=model.participation[:, modes], shapes=model.shapes[:, modes]
    )
    return few if residuals else replace(few, residuals=model.residuals[:0], powers=())


def _window(lines: Lines, poles: np.ndarray) -> slice:
    """The lines around the poles."""
    omega, reach = lines.s.imag, _REACH * np.abs(poles.real)
    first, last = np.searchsorted(omega, [(poles.imag - reach).min(), (poles.imag + reach).max()])
    return slice(max(first - _FEWEST, 0), last + _FEWEST)
