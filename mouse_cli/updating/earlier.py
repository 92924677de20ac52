"""Sequential updating: what an earlier test left is the prior of the next one."""

import json
from dataclasses import replace

import numpy as np

from mouse_cli._errors import WARNING, DeckError, Diagnostic
from mouse_cli.formats import bounded
from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.parameter import Gaussian
from mouse_cli.model.problem import Problem
from mouse_cli.model.term import Places
from mouse_cli.terms.matrix_entries import MatrixEntries

_SCHEMA = "mouse.result/1"


def after(problem: Problem, path: str, loosened: dict[str, float]) -> Problem:
    """`problem` with the posterior that the file `path` (mouse.result/1) holds as its prior.

    p(theta | y1, y2) ~ p(y2 | theta) p(theta | y1), for errors of y1 and y2 that are independent. Properties of equal names
    take over mean and covariance; to the variance of those in `loosened` sd^2 is added, by which they may have changed
    since. The others keep the deck's prior, uncorrelated with these. Raises DeckError (MD440, MD441, MD442).
    """
    found = _read(path)
    known = {each["name"]: i for i, each in enumerate(found["parameters"])}
    ours = [i for i, parameter in enumerate(problem.parameters) if parameter.name in known]
    theirs = [known[problem.parameters[i].name] for i in ours]
    _require(problem, path, ours, loosened)
    _new_data(problem, found, path)
    _answered(found, theirs, path)
    mean, cov = problem.prior.mean.copy(), problem.prior.dense().copy()
    mean[ours] = [found["parameters"][i]["posterior"] for i in theirs]
    cov[ours, :] = cov[:, ours] = 0.0
    cov[np.ix_(ours, ours)] = found["covariance"][np.ix_(theirs, theirs)]
    for i, parameter in enumerate(problem.parameters):
        cov[i, i] += loosened.get(parameter.name, 0.0) ** 2
    return moved(problem, mean, cov, _doubts(found, path))


def _read(path: str) -> dict:
    """The document, its covariance as an array (p, p); what is used of it has the types that its schema says."""
    try:
        with open(path, "rb") as file:
            found = json.loads(bounded(file, path).decode("utf-8-sig"), parse_constant=_no_number)
    except (OSError, ValueError, RecursionError) as error:
        raise _rejected("MD440", f"{path} is no result of a run: {str(error)[:200]}") from None
    schema = found.get("schema") if isinstance(found, dict) else None
    if schema != _SCHEMA:
        raise _rejected("MD440", f"{path} is no {_SCHEMA} document, but {str(schema or 'another one')[:60]}")
    try:
        return found | _values(found)
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise _rejected("MD440", f"{path} is damaged: {type(error).__name__} {str(error)[:100]}") from None


def _values(found: dict) -> dict:
    """Parameters, modes and covariance of a result. Raises KeyError, TypeError or ValueError where they are not as documented."""
    keys = ("name", "posterior", "at_limit")
    parameters = [{key: each[key] for key in keys} for each in found["parameters"]]
    if not all(isinstance(each["name"], str) for each in parameters):
        raise ValueError("a parameter without name")
    modes = [
        {"test_hz": None if each["test_hz"] is None else float(each["test_hz"])} for each in found.get("modes") or ()
    ]
    if found.get("covariance") is None:
        return {"parameters": parameters, "modes": modes}
    if not all(np.isfinite(float(each["posterior"])) for each in parameters):
        raise ValueError("a parameter without value")
    cov = np.array(found["covariance"], float)
    if cov.shape != 2 * (len(parameters),) or not np.isfinite(cov).all() or (np.diag(cov) < 0).any():
        raise ValueError("no covariance of its parameters")
    return {"parameters": parameters, "modes": modes, "covariance": cov}


def _no_number(name: str) -> None:
    raise ValueError(f"{name} is no number in JSON")


def _require(problem: Problem, path: str, ours: list[int], loosened: dict[str, float]) -> None:
    names = [problem.parameters[i].name for i in ours]
    if not names:
        raise _rejected("MD441", f"no property of {problem.source.path} is among those of {path}")
    for name in loosened:
        if name not in names:
            raise _rejected("MD441", f"--loosen names '{name}'; expected one of {', '.join(names[:12])}")


def _answered(found: dict, theirs: list[int], path: str) -> None:
    if found.get("covariance") is None:
        raise _rejected("MD440", f"{path} holds no covariance: {found.get('message', 'the run had no answer')}")
    for i in theirs:
        if found["parameters"][i]["at_limit"]:
            name = found["parameters"][i]["name"]
            raise _rejected("MD440", f"{path} left {name} at a limit, where it has no standard deviation")


def _new_data(problem: Problem, found: dict, path: str) -> None:
    before = np.array(
        [np.nan if mode["test_hz"] is None else mode["test_hz"] for mode in found.get("modes", ())], float
    )
    if problem.test is None or not np.isfinite(before).any():
        return
    if np.array_equal(before, problem.test.frequency_hz, equal_nan=True):
        raise _rejected("MD442", f"{path} was fitted to the frequencies of {problem.source.path}")


def _doubts(found: dict, path: str) -> tuple[Diagnostic, ...]:
    if not found.get("exit_code"):
        return ()
    message = f"the prior is that of {path}, of which the run reports: {str(found.get('message'))[:300]}"
    return (Diagnostic("MD443", WARNING, message, help="state in --loosen how far its values may be wrong"),)


def moved(problem: Problem, mean: np.ndarray, cov: np.ndarray, warnings: tuple[Diagnostic, ...] = ()) -> Problem:
    """`problem` about another prior mean: K and M of listed elements are those at the nominal values, which move with it."""
    changed = {}
    if len(problem.elements):
        listed = MatrixEntries(problem.elements, problem.A, problem.prior.mean)
        for name, values in listed.values(mean).items():
            changed[name] = _plus(getattr(problem.structure, name), listed.places[name], values)
    prior = Gaussian(mean, cov)
    parameters = tuple(
        replace(each, nominal=float(value), sd=float(sd))
        for each, value, sd in zip(problem.parameters, mean, prior.sd, strict=True)
    )
    return replace(
        problem,
        parameters=parameters,
        prior=prior,
        structure=replace(problem.structure, **changed),
        warnings=(*problem.warnings, *warnings),
    )


def _plus(matrix: Matrix, places: Places, values: np.ndarray) -> Matrix:
    """matrix + values at places, dense or sparse as it was."""
    if is_sparse(matrix):
        from scipy.sparse import coo_array

        return (matrix + coo_array((values, (places.row, places.col)), shape=matrix.shape)).tocsr()
    found = np.array(matrix, float)
    np.add.at(found, (places.row, places.col), values)
    return found


def _rejected(code: str, message: str) -> DeckError:
    help = {
        "MD440": "write it with `mouse run deck.yaml --json -o result.json`",
        "MD441": "give the properties of both decks the same names",
        "MD442": "a posterior is a prior for new data only: leave --prior out",
    }[code]
    return DeckError.of(code, message, help=help)
