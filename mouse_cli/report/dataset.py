"""Answers and decks as datasets of xarray, which is optional."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli.report.frames import plain_document, required
from mouse_cli.report.reading import rejected

_SHAPES = {  # columns of `shapes`, and what they are called here
    "test": "test_shape", "test_sd": "test_shape_sd", "prior": "prior_shape", "revised": "revised_shape", "sd": "revised_shape_sd",
}  # fmt: skip
_ATTRIBUTES = (
    "schema",
    "version",
    "title",
    "source",
    "units",
    "status",
    "model_form",
    "exit_code",
    "estimator",
    "recursion",
)
_OTHER = "other_parameter"  # dimension of the columns of a covariance

Part = dict[str, Any]
Variable = tuple[str, tuple[tuple[str, ...], np.ndarray, dict[str, str]]]  # name, and dimensions, values, attributes


def dataset(answer: Any) -> Any:
    """A dataset of xarray: of what `run` or `diagnose` found, of a deck, of a document or of the name of its file.

    Dimensions `parameter`, `mode`, `dof` and `cycle`, with names and numbers as coordinates. Variables: prior, prior_sd, posterior,
    posterior_sd (parameter), whose coordinate `unit` tells their units; covariance (parameter, other_parameter); frequencies
    and MAC (mode); test_shape, prior_shape, revised_shape and their sd (dof, mode); theta (cycle, parameter) and chi2 (cycle); of
    functions H (response, force, line), complex. Of a diagnosis: the extended model where there is one, else the model as it is.
    What is unknown is NaN. Raises MouseError (MD960) where xarray is not installed, DeckError (MD961) where an answer has none of
    these, or (MD922) where a document is not what its schema says, else as `document`.

    >>> import mouse_cli
    >>> found = mouse_cli.dataset(mouse_cli.run(mouse_cli.read_deck("decks/sound_chain.yaml")))
    >>> round(float(found.posterior.sel(parameter="k1")), 1), found.test_hz.attrs["units"], dict(found.revised_shape.sizes)
    (1105.4, 'Hz', {'dof': 4, 'mode': 4})
    """
    xarray = required("xarray", "datasets")
    document = plain_document(answer)
    try:
        coordinates: dict[str, Any] = {}
        variables = dict(_variables(_model(document), coordinates))
        found = xarray.Dataset(variables, coordinates, _attributes(document))
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        message = f"the document does not follow its schema: {type(error).__name__} {error}"
        raise rejected("MD922", message[:200]) from error
    if not variables:
        message = f"{document.get('schema', 'the answer')} has nothing by parameter, mode, degree of freedom or line"
        raise DeckError.of("MD961", message, help="mouse_cli.frames makes frames of it")
    return found


def _attributes(document: Part) -> Part:
    """Words and numbers that concern the whole."""
    verdict = document.get("verdict") or {}
    found = {key: document.get(key) for key in _ATTRIBUTES} | {key: verdict.get(key) for key in ("kind", "physics")}
    return {key: value for key, value in found.items() if value is not None}


def _model(document: Part) -> Part:
    """The part with parameters and modes."""
    if "baseline" not in document:
        return document
    return document.get("extended") or document["baseline"]


def _variables(model: Part, coordinates: dict[str, Any]) -> Iterator[Variable]:
    """All variables; the coordinates that they need are put into `coordinates`."""
    parameters, modes = _entries(model.get("parameters")), _entries(model.get("modes"))
    if parameters:
        coordinates["parameter"] = [each["name"] for each in parameters]
        coordinates["unit"] = ("parameter", [each.get("unit") or "" for each in parameters])
        yield from _columns(parameters, "parameter", {"name", "unit"})
    for name in ("covariance", "prior_covariance"):
        if parameters and model.get(name):
            coordinates[_OTHER] = coordinates["parameter"]
            yield name, (("parameter", _OTHER), _floats(model[name]), {"units": "product of those of both parameters"})
    if modes and "mode" in modes[0]:
        coordinates["mode"] = [each["mode"] for each in modes]
        yield from _columns(modes, "mode", {"mode", "shape", "shape_sd"})
        yield from _whole_shapes(modes, model.get("dofs") or [], coordinates)
    yield from _measured_shapes(_entries(model.get("shapes")), coordinates)
    yield from _cycles(_entries(model.get("cycles")), coordinates)
    yield from _matrices(model)
    yield from _functions(model.get("functions"), coordinates)


def _entries(value: Any) -> list[Part]:
    return value if isinstance(value, list) and all(isinstance(each, dict) for each in value) else []


def _floats(values: Any) -> np.ndarray:
    return np.array(values, dtype=float)  # None becomes NaN


def _columns(entries: list[Part], dimension: str, without: set[str]) -> Iterator[Variable]:
    """One variable for each number or truth value that entries hold, and for words where all have one."""
    for key in entries[0]:
        values = [each.get(key) for each in entries]
        if key in without or any(isinstance(value, list | dict) for value in values):
            continue
        if all(isinstance(value, bool) for value in values) or all(isinstance(value, str) for value in values):
            yield key, ((dimension,), np.array(values), {})
        elif not any(isinstance(value, str) for value in values):
            whole = all(isinstance(value, int) for value in values)
            yield key, ((dimension,), np.array(values) if whole else _floats(values), _unit(key))


def _unit(key: str) -> dict[str, str]:
    """Hz where the name of a variable says so."""
    return {"units": "Hz"} if key == "hz" or key.endswith("_hz") else {}


def _whole_shapes(modes: list[Part], dofs: list[Any], coordinates: dict[str, Any]) -> Iterator[Variable]:
    """Shapes at all degrees of freedom, where each mode has its own."""
    for key in ("shape", "shape_sd"):
        if dofs and all(isinstance(each.get(key), list) for each in modes):
            coordinates["dof"] = _names(dofs)
            yield key, (("dof", "mode"), _floats([each[key] for each in modes]).T, {})


def _measured_shapes(entries: list[Part], coordinates: dict[str, Any]) -> Iterator[Variable]:
    """Components (dof, mode), NaN where none was measured."""
    if not entries or "mode" not in coordinates:
        return
    dofs = list(dict.fromkeys(each["dof"] for each in entries))
    dofs = sorted(dofs) if all(isinstance(dof, int) for dof in dofs) else dofs
    row, column = {dof: i for i, dof in enumerate(dofs)}, {mode: i for i, mode in enumerate(coordinates["mode"])}
    coordinates["dof"] = _names(dofs)
    for key, name in _SHAPES.items():
        if key not in entries[0]:
            continue
        values = np.full((len(dofs), len(column)), np.nan)
        for each in entries:
            values[row[each["dof"]], column[each["mode"]]] = np.nan if each[key] is None else each[key]
        yield name, (("dof", "mode"), values, {})


def _names(dofs: list[Any]) -> list[Any]:
    """Numbers where all are, else texts: a coordinate has one type."""
    return dofs if all(isinstance(dof, int) for dof in dofs) else [str(dof) for dof in dofs]


def _cycles(entries: list[Part], coordinates: dict[str, Any]) -> Iterator[Variable]:
    if not entries:
        return
    coordinates["cycle"] = [each["cycle"] for each in entries]
    for name, variable in _columns(entries, "cycle", {"cycle"}):
        yield (f"cycle_{name}" if name in coordinates else name), variable
    if "parameter" in coordinates:
        yield "theta", (("cycle", "parameter"), _floats([each["theta"] for each in entries]), {})


def _matrices(model: Part) -> Iterator[Variable]:
    """K and M revised, and of a correlation the MAC of measured (rows) with model modes."""
    for key in ("stiffness", "mass"):
        if model.get(key):
            yield key, (("row", "column"), _floats(model[key]), {})
    if model.get("mac") and model.get("model_hz"):
        yield "mac_matrix", (("mode", "model_mode"), _floats(model["mac"]), {})
        yield "model_hz_all", (("model_mode",), _floats(model["model_hz"]), {"units": "Hz"})


def _functions(functions: Any, coordinates: dict[str, Any]) -> Iterator[Variable]:
    """Frequency response functions of a coupled structure, or of a modified one as it is afterwards."""
    part = (functions or {}).get("after") or functions or {}
    each = _entries(part.get("each"))
    if not each:
        return
    responses, forces = (list(dict.fromkeys(one[key] for one in each)) for key in ("response", "force"))
    H = np.full((len(responses), len(forces), len(part["hz"])), np.nan + 0j)
    for one in each:
        H[responses.index(one["response"]), forces.index(one["force"])] = _floats(one["real"]) + 1j * _floats(
            one["imag"]
        )
    coordinates |= {"response": responses, "force": forces, "line": part["hz"]}
    yield "H", (("response", "force", "line"), H, {"kind": str(part.get("kind"))})
