"""What processes of one search hand to one another: fits and models, without what all of them have.

What a recipe does is made of closures, which cannot be handed over: they are made again, from the same model, when first asked for.
"""

import io
import pickle
from dataclasses import dataclass, fields, replace
from functools import partial
from typing import Any

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.likelihoods.modal.given import Given

_MADE = ("change", "site", "extend", "limit", "title")  # functions of a recipe
_OF_PARTS = ("problem", "assembly", "static", "finer", "data", "built_once")  # what stays the same of a part of a model


@dataclass(frozen=True)
class Again:
    """Function `name` of recipe `number` of a candidate for a model, made when it is called."""

    home: Any
    candidate: Any
    number: int
    name: str

    def __call__(self, *given: Any) -> Any:
        made = vars(self.home).setdefault("made again", {})
        if self.candidate.key not in made:
            made[self.candidate.key] = self.home.recipes(self.candidate)
        recipe = made[self.candidate.key][self.number]
        return getattr(recipe.carried if self.name == "across" else recipe, self.name)(*given)


def known_to_all(study) -> dict[str, Any]:
    """What every process of a pool has, by name: the model, all arrangements of which it is made, and what theory errs in them."""
    model, shared = study.model, {}
    for i, part in enumerate(parts(model)):
        shared |= {f"{name} of {i}": getattr(part, name) for name in _OF_PARTS} | {f"part {i}": part}
    shared |= {"errors": getattr(model, "errors", None), "model": model}
    return {name: value for name, value in shared.items() if value is not None}


def parts(model) -> tuple:
    """Reduced models of the arrangements of which a model is made; itself, where it is one structure."""
    return getattr(model, "parts", (model,))


def packed(found: Any, shared: dict[str, Any]) -> bytes:
    """`found` as bytes."""
    into = io.BytesIO()
    _Pickler(into, shared).dump(found)
    return into.getvalue()


def unpacked(given: bytes, shared: dict[str, Any]) -> Any:
    """What `packed` was given."""
    reader = pickle.Unpickler(io.BytesIO(given))
    reader.persistent_load = shared.__getitem__
    return reader.load()


class _Pickler(pickle.Pickler):
    """Names what all have; functions of recipes are made again, and nothing is handed over that a model computes when asked."""

    def __init__(self, into: io.BytesIO, shared: dict[str, Any]):
        super().__init__(into, protocol=5)
        self._names = {id(value): name for name, value in shared.items()}

    def persistent_id(self, one: Any) -> str | None:
        return self._names.get(id(one))

    def reducer_override(self, one: Any) -> Any:
        if isinstance(one, Recipe):
            return _recipe, (type(one), _state(one))
        if isinstance(one, Given):
            return type(one), one.given
        return NotImplemented


def _recipe(kind: type[Recipe], state: dict[str, Any]) -> Recipe:
    return kind(**state)


def _state(recipe: Recipe) -> dict[str, Any]:
    """Fields of a recipe that can be handed over."""
    found = {each.name: getattr(recipe, each.name) for each in fields(recipe) if each.init}
    defaults = {each.name: each.default for each in fields(recipe)}
    again = partial(Again, recipe.home, recipe.candidate, recipe.number)
    for name in _MADE:
        if found[name] is defaults[name]:
            del found[name]
        elif not isinstance(found[name], Again):
            found[name] = again(name)
    if recipe.carried is not None and not isinstance(recipe.carried.across, Again):
        found["carried"] = replace(recipe.carried, across=again("across"))
    return found
