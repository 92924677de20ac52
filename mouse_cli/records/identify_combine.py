"""Sets of frequency response functions as one: repeats are averaged and give the noise, forces in turn become columns."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mouse_cli._errors import RecordError
from mouse_cli.model.arrays import is_sparse
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.records.identify_noise import smoothed


def combined(tests: Sequence[FrfTest]) -> tuple[FrfTest, str]:
    """One set, and where its variances come from. Raises RecordError (MD655) where lines or responses differ."""
    first = tests[0]
    for each in tests[1:]:
        _fits(first, each)
    groups: dict[tuple[str, ...], list[FrfTest]] = {}
    for each in tests:
        groups.setdefault(each.input_names or tuple(f"{each.title}/{k}" for k in range(each.H.shape[2])), []).append(
            each
        )
    taken: set[str] = set()
    for names in groups:
        if taken & set(names):
            again = sorted(taken & set(names))[0]
            _refuse(f"the force at {again} stands in sets with different other forces", "identify them one by one")
        taken |= set(names)
    sets = [_mean(group) for group in groups.values()]
    repeated = max(len(group) for group in groups.values())
    stated = any(np.isfinite(each.variance).any() for each in tests)
    noise = f"scatter of {repeated} repeats" if repeated > 1 else "stated variances" if stated else "errors of the fit"
    return (sets[0] if len(sets) == 1 else _stacked(sets)), noise


def _refuse(message: str, help: str) -> None:
    raise RecordError.of("MD655", message, help=help)


def _fits(first: FrfTest, other: FrfTest) -> None:
    """Both have the same lines, responses and kind."""
    one, two = first.title or first.path, other.title or other.path
    if first.kind != other.kind:
        _refuse(f"'{one}' is {first.kind}, '{two}' {other.kind}", "give functions of one kind")
    if first.output_names != other.output_names:
        _refuse(f"'{one}' and '{two}' have different responses", "identify them one by one")
    if len(first.frequency_hz) != len(other.frequency_hz) or not np.allclose(
        first.frequency_hz, other.frequency_hz, rtol=1e-6, atol=0
    ):
        _refuse(f"'{one}' and '{two}' have different spectral lines", "measure both with one block length")


def _mean(group: list[FrfTest]) -> FrfTest:
    """Repeats of one measurement as their mean; the variance is that of their scatter along lines, or what they state."""
    if len(group) == 1:
        return group[0]
    H, n = np.array([each.H for each in group]), len(group)
    mean = H.mean(axis=0)
    scatter = (np.abs(H - mean) ** 2).sum(axis=0) / (n * (n - 1))
    known = np.isfinite(scatter)
    spread = smoothed(np.where(known, scatter, 0), np.where(known, mean, 0), known)
    return replace(group[0], H=mean, variance=np.where(known, spread, np.nan), coherence=None)


def _stacked(sets: list[FrfTest]) -> FrfTest:
    """Sets of different forces as columns of one."""
    inputs = [each.inputs for each in sets]
    if any(is_sparse(each) for each in inputs):
        from scipy.sparse import csr_array, vstack

        together = (
            vstack([csr_array(each) for each in inputs]).tocsr() if all(each.ndim == 2 for each in inputs) else None
        )
    else:
        together = np.concatenate(inputs) if len({each.ndim for each in inputs}) == 1 else None
    names = tuple(name for each in sets for name in each.input_names)
    if together is None:
        together = np.arange(sum(each.H.shape[2] for each in sets))
    return replace(
        sets[0],
        H=np.concatenate([each.H for each in sets], axis=2),
        variance=np.concatenate([each.variance for each in sets], axis=2),
        inputs=together,
        input_names=names,
        coherence=None,
    )
