"""What a manifest expects of an answer: `posterior k1: 83699 +- 20`, `verdict: nothing-missing`, and whether it came so."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite
from typing import Any

from mouse_cli._span import Span

_NUMBER = r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
_NEAR = re.compile(rf"({_NUMBER})\s*(?:\+-|\+/-|±)\s*({_NUMBER})\s*(%?)")
_BOUND = re.compile(rf"(<=|>=|<|>)\s*({_NUMBER})")
_FORMS = "write 83699 +- 20, 83699 +- 1 %, < 5, <= 5, > 0.9 or >= 0.9"
_EXITS = ("0", "1", "4", "5")
VERDICT, EXIT = "verdict", "exit"

Document = dict[str, Any]


def _model(document: Document) -> Document:
    """What is said of the model: by a run all of it; by a diagnosis that of the extended model, or of the model as it is."""
    return document if "verdict" not in document else document.get("extended") or document.get("baseline") or {}


def _entry(key: str, value: str) -> Callable[[Document, str], Any]:
    """Reads `value` of the parameter or mode called so."""

    def read(document: Document, name: str) -> Any:
        label = "name" if key == "parameters" else "mode"
        return next((each.get(value) for each in _model(document).get(key) or [] if str(each.get(label)) == name), None)

    return read


_NUMBERS: dict[str, Callable[[Document, str], Any]] = {  # followed by a name
    "posterior sd": _entry("parameters", "posterior_sd"),
    "posterior": _entry("parameters", "posterior"),
    "frequency": _entry("modes", "revised_hz"),
    "mac": _entry("modes", "mac"),
}
_SINGLE: dict[str, Callable[[Document], Any]] = {  # numbers without a name
    "probability": lambda document: (document.get("verdict") or {}).get("probability"),
    "innovation p": lambda document: (document.get("innovation") or {}).get("p"),
    "residual p": lambda document: (document.get("residual") or {}).get("p"),
}
_WORDS: dict[str, Callable[[Document], Any]] = {
    "status": lambda document: _model(document).get("status"),
    VERDICT: lambda document: (document.get("verdict") or {}).get("kind"),
    "physics": lambda document: (document.get("verdict") or {}).get("physics"),
    "model form": lambda document: _model(document).get("model_form"),
}
KEYS = (EXIT, *_WORDS, *_SINGLE, *(f"{key} NAME" for key in _NUMBERS))


class Unreadable(ValueError):
    """An expectation that says nothing: the message says why, `help` what to write."""

    def __init__(self, message: str, help: str):
        super().__init__(message)
        self.help = help


@dataclass(frozen=True)
class Expectation:
    """`quantity` (a word of KEYS, with its `name`) is one of `words`, or lies from `low` to `high`; `open_ends`: not at these."""

    quantity: str
    written: str
    name: str = ""
    words: tuple[str, ...] = ()
    low: float = float("-inf")
    high: float = float("inf")
    open_ends: bool = False
    span: Span | None = None

    @property
    def title(self) -> str:
        """Quantity and name as the manifest has them."""
        return f"{self.quantity} {self.name}".rstrip()

    def missed(self, document: Document | None, exit_code: int) -> str:
        """How the answer differs, in a sentence; empty when it is as expected."""
        came = self._came(document or {}, exit_code)
        if came is not None and (self._within(came) if not self.words else str(came) in self.words):
            return ""
        return f"{self.title} is {_shown(came)}; expected {self.written}"

    def _within(self, came: Any) -> bool:
        if not isinstance(came, int | float) or not isfinite(came):
            return False
        return self.low < came < self.high if self.open_ends else self.low <= came <= self.high

    def _came(self, document: Document, exit_code: int) -> Any:
        if self.quantity == EXIT:
            return exit_code
        if self.quantity in _WORDS:
            return _WORDS[self.quantity](document)
        return _SINGLE[self.quantity](document) if not self.name else _NUMBERS[self.quantity](document, self.name)


def _shown(came: Any) -> str:
    if came is None:
        return "not in the answer"
    return f"{came:.7g}" if isinstance(came, float) else str(came)


def expectation(key: str, values: tuple[str, ...], span: Span | None = None) -> Expectation:
    """The expectation of a line `key: value` of a manifest. Raises Unreadable."""
    written = " or ".join(values)
    key = " ".join(key.split())
    if key == EXIT and not set(values) <= set(_EXITS):
        raise Unreadable(f"exit is '{written}'; a job ends with one of {', '.join(_EXITS)}", "see `mouse explain exit`")
    if key == EXIT or key in _WORDS:
        return Expectation(key, written, words=values, span=span)
    quantity, name = (key, "") if key in _SINGLE else _named(key)
    low, high, open_ends = _limits(key, values)
    return Expectation(quantity, written, name, (), low, high, open_ends, span)


def _named(key: str) -> tuple[str, str]:
    for quantity in _NUMBERS:  # the longer one stands first
        if key.startswith(f"{quantity} "):
            return quantity, key.removeprefix(f"{quantity} ")
    if key in _NUMBERS:
        raise Unreadable(f"'{key}' names no parameter or mode", f"write '{key} NAME'")
    raise Unreadable(f"'{key[:40]}' is nothing that can be expected", f"expect one of {', '.join(KEYS)}")


def _limits(key: str, values: tuple[str, ...]) -> tuple[float, float, bool]:
    """Lowest and highest value, and whether they are outside."""
    text = values[0].strip() if len(values) == 1 else ""
    near, bound = _NEAR.fullmatch(text), _BOUND.fullmatch(text)
    if near:
        middle, half = float(near[1]), float(near[2])
        half *= abs(middle) / 100 if near[3] else 1
        if half < 0 or not isfinite(middle) or not isfinite(half):
            raise Unreadable(f"{key} is '{text[:40]}'; what follows +- must not be negative, and both finite", _FORMS)
        return middle - half, middle + half, False
    if bound:
        limit, above = float(bound[2]), bound[1][0] == ">"
        ends = (limit, float("inf")) if above else (float("-inf"), limit)
        return *ends, len(bound[1]) == 1
    raise Unreadable(f"{key} is '{' or '.join(values)[:40]}'; expected a number with its tolerance, or a bound", _FORMS)
