"""What a job changes of its deck: texts at places of the YAML, values and accuracies of the problem, weights of modes and sensors.

Options of a job that hold them: `texts` {place: text}, `values` {name: number}, `drawn` (see `batch.drawn`).
"""

import re
from dataclasses import replace
from typing import Any

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli.formats import is_yaml
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem

_LARGEST = 1e150  # standard deviation, the square of which is a number
CHANGES = ("texts", "values", "drawn")
_FACTORS = 1e-100, 1e100  # of accuracies: the squares of residuals over them are numbers
SCALED = ("frequency_sd*", "shape_sd*")
SD = ".sd"
_ITEM = re.compile(r"([^\[\]]+)((?:\[[0-9]+\])*)")
_PLAIN = re.compile(r"[A-Za-z0-9_.+%-]+( [%A-Za-z0-9_.+-]+)*")


def edited(data: bytes, path: str, options: dict[str, Any]) -> bytes:
    """The deck `data` with the `texts` of `options` at their places, as if written by hand. Raises DeckError (MD932, MD933)."""
    texts = options.get("texts")
    if not texts:
        return data
    if not is_yaml(data, path):
        raise _unknown(
            next(iter(texts)), path, "the deck is of cards: paths such as test.modes.shape_sd exist in YAML decks only"
        )
    from mouse_cli.formats.yaml_deck.nodes import compose

    document, root = compose(data, path)
    spans = []
    for place, text in texts.items():
        if not _PLAIN.fullmatch(str(text)):
            message = f"'{str(text)[:40]}' is no number or word that could stand at {place}"
            raise DeckError.of("MD933", message, help="give a number or a word")
        node = _at(root, place, path)
        spans.append((node.start_mark.index, node.end_mark.index, str(text)))
    found = document.text
    for begin, end, text in sorted(spans, reverse=True):
        found = f"{found[:begin]}{text}{found[end:]}"
    return found.encode()


def _at(root: Any, place: str, path: str) -> Any:
    """The scalar node at `place`: keys joined by points, items of lists by their `name` or as [number], from 1."""
    node = root
    for part in place.split("."):
        match = _ITEM.fullmatch(part)
        node = _below(node, match[1]) if match else None
        for number in re.findall(r"[0-9]+", match[2]) if match else ():
            items = node.value if node is not None and isinstance(node.value, list) else []
            node = items[int(number) - 1] if 0 < int(number) <= len(items) else None
            node = None if isinstance(node, tuple) else node
        if node is None:
            raise _unknown(place, path, f"the deck has no '{part}' there")
    if place.split(".")[-1] == "file":
        raise _unknown(place, path, "answers are kept by the files that the deck itself names")
    if isinstance(node.value, list):
        raise _unknown(place, path, "a list or a mapping stands there, and no value")
    return node


def _below(node: Any, key: str) -> Any:
    """The value of `key` in a mapping, or the item called so in a list of mappings."""
    for each in node.value if isinstance(node.value, list) else ():
        if isinstance(each, tuple):
            if each[0].value == key:
                return each[1]
        elif isinstance(each.value, list) and any(
            isinstance(pair, tuple) and pair[0].value in ("name", "id") and pair[1].value == key for pair in each.value
        ):
            return each
    return None


def changed(problem: Problem, options: dict[str, Any]) -> Problem:
    """`problem` with the `values` and the weights `drawn` of `options`. Raises DeckError (MD932)."""
    if options.get("values"):
        problem = _with_values(problem, options["values"])
    if options.get("drawn"):
        from mouse_cli.batch.drawn import drawn

        problem = drawn(problem, options["drawn"])
    return problem


def kind(name: str, problem: Problem) -> str:
    """Which of CHANGES holds it: `values` of a property, of its sd or of the accuracies, `texts` of a place in the deck."""
    own = {parameter.name for parameter in problem.parameters}
    stated = name in own or name in SCALED or (name.endswith(SD) and name.removesuffix(SD) in own)
    return "values" if stated else "texts"


def _with_values(problem: Problem, values: dict[str, float]) -> Problem:
    """Prior means by the names of parameters, prior sd by NAME.sd, accuracies of the test by factors."""
    from mouse_cli.updating.earlier import moved

    places = {parameter.name: i for i, parameter in enumerate(problem.parameters)}
    mean, factor = problem.prior.mean.copy(), np.ones(len(places))
    for name, value in values.items():
        own = name.removesuffix(SD)
        if name in SCALED and problem.test is not None:
            problem = replace(problem, test=_scaled(problem.test, name, value))
        elif name in places:
            mean[places[name]] = value
        elif own in places and name.endswith(SD):
            sd = problem.prior.sd[places[own]]
            if not (sd > 0 and 0 < value < _LARGEST):
                message = f"{name} is {value:g}, in the deck {sd:g}; both must be above zero and below {_LARGEST:g}"
                raise DeckError.of("MD933", message, help="vary another quantity")
            factor[places[own]] = value / sd
        else:
            raise _unknown(name, problem.source.path, f"the properties of the deck are {', '.join(places)}")
    cov = problem.prior.cov
    cov = cov * factor**2 if cov.ndim == 1 else cov * np.outer(factor, factor)
    return moved(problem, mean, cov)


def _scaled(test: ModalTest, name: str, factor: float) -> ModalTest:
    low, high = _FACTORS
    if not low <= factor <= high:
        message = f"{name} is {factor:g}; a factor of accuracies must be between {low:g} and {high:g}"
        raise DeckError.of("MD933", message, help="give factors such as 0.5,1,2")
    if name == "shape_sd*":
        return replace(test, shape_sd=test.shape_sd * factor)
    return replace(test, frequency_sd_hz=test.frequency_sd_hz * factor)


def _unknown(name: str, path: str, note: str) -> DeckError:
    help = (
        "name an option of `mouse run`, a property, its prior sd as NAME.sd, frequency_sd*, shape_sd*, or the path of a value "
        "in the deck"
    )
    return DeckError.of("MD932", f"'{name}' is nothing that can be varied in {path}: {note}", help=help)
