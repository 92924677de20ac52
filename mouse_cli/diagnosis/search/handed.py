"""What processes of one search hand to one another: fits and models, without what all of them have.

What a recipe does is made of closures, which cannot be handed over: they are made again, from the same model, when first asked for.
"""

import io
import pickle
from dataclasses import dataclass, fields, replace
from functools import partial
from typing import Any

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced

_MADE = ("change", "site", "extend", "limit", "title")  # functions of a recipe


@dataclass(frozen=True)
class Again:
    """Function `name` of recipe `number` of a candidate for a model, made when it is called."""

    home: Reduced
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
    """What every process of a pool has, by name."""
    model = study.model
    shared = {name: getattr(model, name) for name in ("problem", "assembly", "static", "finer", "data")}
    return {name: value for name, value in shared.items() if value is not None} | {
        "model": model,
        "once": model.built_once,
    }


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
            return _recipe, (_state(one),)
        if isinstance(one, Model):
            return type(one), (one.base, one.recipes), {"_slopes": one._slopes}
        if isinstance(one, Reduced):
            return type(one), tuple(getattr(one, each.name) for each in fields(one))
        return NotImplemented


def _recipe(state: dict[str, Any]) -> Recipe:
    return Recipe(**state)


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
