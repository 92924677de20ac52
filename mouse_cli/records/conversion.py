"""Receptance, mobility and accelerance: each is s times the one before, s = i omega without an exponential window."""

from dataclasses import replace

import numpy as np

from mouse_cli.model.frf_test import KINDS, FrfTest


def factor(s: np.ndarray, times: int) -> np.ndarray:
    """s^times (f,); NaN where it divides by 0."""
    with np.errstate(divide="ignore", invalid="ignore"):
        found = s**times if times >= 0 else 1 / s**-times
    return np.where(np.isfinite(found), found, np.nan)


def converted(frf: FrfTest, kind: str) -> FrfTest:
    """The functions as `kind`, one of KINDS; H = s^k receptance, its variance times |s|^2k."""
    by = factor(frf.laplace, KINDS[kind] - KINDS[frf.kind])[:, None, None]
    return replace(frf, kind=kind, H=frf.H * by, variance=frf.variance * np.abs(by) ** 2)
