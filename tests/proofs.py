"""Parameters of long proofs, the tests that `pytest -m proof` adds to the command of the README."""

from collections.abc import Iterable

import pytest


def proofs(cases: Iterable, *kept: object) -> list:
    """The cases of a parametrised test, all but those `kept` marked as proofs; a tuple is the values of several parameters."""
    values = [each if isinstance(each, tuple) else (each,) for each in cases]
    keep = [each if isinstance(each, tuple) else (each,) for each in kept]
    assert all(each in values for each in keep)
    return [pytest.param(*each, marks=() if each in keep else pytest.mark.proof) for each in values]
