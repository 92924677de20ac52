"""Values as JSON holds them: plain Python, and nothing that is not finite."""

from collections.abc import Iterable
from math import isfinite
from typing import Any

import numpy as np

from mouse_cli._errors import Diagnostic
from mouse_cli.model.problem import Problem


def plain(value: Any) -> Any:
    """`value` with numpy arrays as lists, numpy scalars as Python's, NaN and infinity as None.

    >>> import numpy as np
    >>> plain({"a": np.array([1.0, np.nan]), "b": np.int64(3), "c": (True, -np.inf)})
    {'a': [1.0, None], 'b': 3, 'c': [True, None]}
    """
    if isinstance(value, np.ndarray | np.generic):
        if np.issubdtype(value.dtype, np.floating) and np.isfinite(value).all():
            return value.tolist()
        return plain(value.tolist())
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float) and not isfinite(value):
        return None
    return value


def heading(schema: str, problem: Problem) -> dict[str, Any]:
    """What a document of the answer to a deck begins with."""
    return {"schema": schema, "title": problem.title.strip(), "source": problem.source.path}


def fields(of: Any, *names: str) -> dict[str, Any]:
    """Attributes under their own names."""
    return {name: getattr(of, name) for name in names}


def rows(**columns: Iterable[Any]) -> list[dict[str, Any]]:
    """One object for each entry of columns that are equally long.

    >>> rows(mode=[1, 2], hz=[3.5, 7.0])
    [{'mode': 1, 'hz': 3.5}, {'mode': 2, 'hz': 7.0}]
    """
    return [dict(zip(columns, values, strict=True)) for values in zip(*columns.values(), strict=True)]


def coded(diagnostics: Iterable[Diagnostic]) -> list[str]:
    """Diagnostics with their codes, one text each."""
    return [f"{each.code}: {each.message}" for each in diagnostics]


def dof_name(label: str) -> int | str:
    """A degree of freedom as a deck writes it: the number of a matrix model's, else its label.

    >>> dof_name("3"), dof_name("12TY")
    (3, '12TY')
    """
    return int(label) if label.isascii() and label.isdecimal() else label
