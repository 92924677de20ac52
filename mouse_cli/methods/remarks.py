"""What an engineer must know before an updated model is used; each remark makes the answer one that is not to be trusted."""

from collections.abc import Iterator

import numpy as np

from mouse_cli._errors import WARNING, Diagnostic
from mouse_cli.model.updated import Predicted, Updated

_SDS, _PERCENT = 3.0, 1.0


def remarks(found: Updated) -> Iterator[Diagnostic]:
    """Warnings, the gravest first."""
    about, checked = found.about, found.checked
    if not about.physical:
        text = f"'{about.key}' reproduces the data without a physical model"
        yield _warning("MD562", text, "trust it for the fitted modes alone; `mouse compare` shows its predictive error")
    if checked.negative:
        text = (
            f"the updated stiffness has {checked.negative} negative eigenvalue(s), down to {-checked.lowest_hz:.5g}i Hz"
        )
        yield _warning("MD563", text, "no structure has such a stiffness: take another method")
    if checked.rigid < checked.rigid_before:
        text = f"of {checked.rigid_before} rigid-body modes {checked.rigid} are left after the update"
        yield _warning(
            "MD564", text, "the method has tied the structure to the ground: take one that keeps rigid-body modes"
        )
    if not found.converged:
        text = f"the update still changes by {found.change:.2g} after {found.iterations} iterations"
        yield _warning("MD565", text, "tie like elements together, or give better shapes")
    if found.against:
        yield _warning("MD568", found.against, "`mouse diagnose` looks for missing physics")
    for one in found.configurations:
        yield from _missed(one)


def _missed(one: Predicted) -> Iterator[Diagnostic]:
    """Frequencies that are off by more than their accuracy."""
    with np.errstate(invalid="ignore"):
        off = one.revised_hz / one.test_hz - 1
        large = np.abs(one.revised_hz - one.test_hz) > _SDS * one.test_sd_hz
        if not one.fitted:
            large &= np.abs(off) > _PERCENT / 100
    large = (large | np.isnan(one.revised_hz)) & np.isfinite(one.test_hz)
    if not large.any():
        return
    worst = int(np.nanargmax(np.where(large, np.nan_to_num(np.abs(off), nan=np.inf), -1.0)))
    there = f"{one.revised_hz[worst]:.5g} Hz" if np.isfinite(one.revised_hz[worst]) else "no such mode"
    text = f"mode {one.number[worst]} ({one.title}) was measured at {one.test_hz[worst]:.5g} Hz, the updated model has {there}"
    if one.fitted:
        yield _warning("MD568", text, "what the method may move does not explain the data")
    else:
        yield _warning("MD569", text, "do not use the model beyond the fitted modes")


def _warning(code: str, text: str, help: str) -> Diagnostic:
    return Diagnostic(code, WARNING, text, help=help)
