"""FRFs of a test as they judge explanations: each fitted from where modes left it, by few lines or by all, with laws of damping."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.likelihoods.frf.damping import Damping
from mouse_cli.diagnosis.likelihoods.frf.damping import damping as of_model
from mouse_cli.diagnosis.likelihoods.frf.dashpots import DASHPOT, dashpots
from mouse_cli.diagnosis.likelihoods.frf.data import FrfData
from mouse_cli.diagnosis.likelihoods.frf.lossy import GROUPS, LAWS, LOSS, SAME, lossy
from mouse_cli.diagnosis.likelihoods.frf.lossy_parts import LOSSY_PART, lossy_parts
from mouse_cli.diagnosis.likelihoods.frf.model import FrfModel
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.search.fit import MOST, End, Fit, descended, fit
from mouse_cli.diagnosis.search.optima import within
from mouse_cli.updating.frf_start import WIDTHS

_PLACES, _KEPT = 5, 2  # places from which what only damps begins, and how many of its kind go on
THIN, BRIEF = 4, 12  # in a first look: every so manieth line, and steps
_ALIKE = 10.0  # squared distance of what two explanations predict, by the data's sd, up to which they are as one

DAMPERS: dict[str, Callable[[Reduced, float], list[Recipe]]] = {
    DASHPOT.key: lambda base, middle: dashpots(base),
    LOSSY_PART.key: lossy_parts,
}
"""Recipes of what only damps, by its key, in a reduced model; middle (rad/s): of the band."""


@dataclass(frozen=True)
class Judge:
    """FRFs of a test and the damping of the structure as it is held likely.

    known (m,): sd of ln f of modes measured beside them by what theory leaves of both; None: the modes are those of the functions.
    sought: keys of what only damps, and is considered. What was fitted once is kept, and not fitted again in a later ranking.
    """

    data: FrfData
    damping: Damping
    known: np.ndarray | None = None
    sought: tuple[str, ...] = tuple(DAMPERS)
    _kept: dict[tuple, tuple[End, float, Any]] = field(default_factory=dict, init=False, repr=False, compare=False)
    _coarse: dict[int, tuple[np.ndarray, Damping]] = field(default_factory=dict, init=False, repr=False, compare=False)

    def windowed(self, name: str) -> "Judge | None":
        """By functions of blocks of that window, where a deck states none, and no decay rate; None where it states all."""
        blocks = tuple(block.windowed(name) for block in self.data.blocks)
        same = all(new is old for new, old in zip(blocks, self.data.blocks, strict=True))
        return None if same else replace(self, data=replace(self.data, blocks=blocks))

    @property
    def delayed(self) -> "Judge":
        """By functions whose responses may be late."""
        return replace(self, data=self.data.delayed())

    @cached_property
    def thinned(self) -> "Judge":
        """By few lines."""
        return replace(self, data=replace(self.data, blocks=tuple(block.every(THIN) for block in self.data.blocks)))

    @cached_property
    def broadened(self) -> "tuple[Judge, ...]":
        """By functions with broader resonances, ever narrower ones."""
        blocks = (tuple(block.broadened(width) for block in self.data.blocks) for width in WIDTHS[1:])
        return tuple(replace(self, data=replace(self.data, blocks=each)) for each in blocks)

    def model(self, base: Reduced, recipes: tuple = ()) -> FrfModel:
        """The reduced model `base` with causes, as the FRFs see it, and the modes that were measured beside them."""
        modes = base.data
        if isinstance(modes, FrfData):
            modes = modes.modes
        elif self.known is None:
            modes = None
        else:
            modes = modes.sharpened(self.known)
        return FrfModel(base.judged_by(replace(self.data, modes=modes)), self._damping(base), recipes)

    def _damping(self, base: Reduced) -> Damping:
        """That of the structure in the coordinates of `base`, which has few of them in a first look."""
        own = self.damping
        if not len(own.rows) or own.rows.shape[1] == base.r:
            return own
        if id(base.V) not in self._coarse:
            self._coarse[id(base.V)] = base.V, of_model(base)
        _, few = self._coarse[id(base.V)]
        return replace(own, rows=few.rows, own=few.own, viscous=few.viscous)

    def fitted(
        self, one: End, law: str = SAME, most: int = MOST, damping: Damping | None = None, reach: float = np.inf
    ) -> Fit | None:
        """The explanation `one` of modes, or of FRFs, fitted from where it is; law: of its springs, where they have none yet.

        damping: of the structure; None: as `one` has it, of modes as it is held likely. reach: misfit above which no fit matters.
        """
        key = id(one), law, most, None if damping is None else tuple(damping.sd)
        return self.once(key, one, reach, lambda: self._fitted(one, law, most, damping, reach))

    def once(self, key: tuple, one: End, reach: float, do: Callable[[], Any]) -> Any:
        """What `do` finds of `one`, kept beside it, so that no id is used again; found again where it was given up too early."""
        before = self._kept.get(key)
        if before is None or (reach > before[1] and not _ended(before[2], before[1])):
            before = self._kept[key] = one, reach, do()
        return before[2]

    def _fitted(self, one: End, law: str, most: int, damping: Damping | None, reach: float) -> Fit | None:
        """The same, whatever is kept."""
        return fit(*self._begun(one, law, damping), most, reach)

    def _begun(self, one: End, law: str = SAME, damping: Damping | None = None) -> tuple[FrfModel, np.ndarray, np.ndarray]:
        """The model of an explanation, and where a fit of it begins: coordinates of the causes, and the others."""
        recipes = tuple(lossy(recipe, law, self.data.middle) for recipe in one.recipes)
        own = replace(self, damping=damping or getattr(one.model, "damping", self.damping))
        model = own.model(one.model.base, recipes)
        parts = zip(one.recipes, recipes, one.model.own, strict=True)
        c = [np.append(one.c[own], [np.log(LOSS)] * (len(r.unknowns) - len(was.unknowns))) for was, r, own in parts]
        start = np.concatenate([one.point.x[: one.model.k], model.start[one.model.k :]])
        return model, np.concatenate([np.zeros(0), *c]), start

    def all_of(self, fits: list[Fit]) -> list[Fit]:
        """Each fitted to the end from where it is, but for those after the first that come nowhere near the best."""
        found: list[Fit] = []
        for one in fits:
            end = self.fitted(one, reach=within(found) if found else np.inf)
            found += [] if end is None else [end]
        return found

    def uneven(self, fits: list[Fit]) -> list[Fit]:
        """Each with damping of every mode of its own where that is the more probable; before, both are equally likely.

        Of two that predict the same it is the same: where it gains nothing for one, it gains nothing for the other.
        """
        found, reach = [], within(fits)
        idle: list[tuple[Fit, float]] = []
        for one in fits:
            known = next((gain for other, gain in idle if _alike(one, other)), None)
            if known is not None:
                found.append(replace(one, log_evidence=one.log_evidence + known))
                continue
            other = self.fitted(one, damping=one.model.damping.unevenly(), reach=reach) or one
            likelier = max(one, other, key=lambda each: each.log_evidence)
            total = float(np.logaddexp(one.log_evidence, other.log_evidence) - np.log(2))
            idle += [(one, total - one.log_evidence)] if likelier is one else []
            found.append(replace(likelier, log_evidence=total))
        return found

    def near(self, one: End, stages: "tuple[Judge, ...]") -> End | None:
        """`one` where its resonances are near the measured ones: as it is, or fitted with ever narrower resonances, `stages`."""
        return self.once((id(one), len(stages)), one, np.inf, lambda: self._near(one, stages))

    def _near(self, one: End, stages: "tuple[Judge, ...]") -> End | None:
        """The same, whatever is kept."""
        end = one
        for stage in stages:
            end = descended(*stage._begun(end), BRIEF // 2) or end
        starts = [at for each in (one, end) if (at := descended(*self._begun(each), 0)) is not None]
        return min(starts, key=lambda at: at.misfit, default=None)

    def laws(self, one: End, reach: float) -> list[Fit]:
        """A first look at the explanation `one` under each law of damping that its springs may follow; reach: as in `fitted`."""
        may = any(recipe.candidate.group in GROUPS for recipe in one.recipes)
        found = [self.fitted(one, law, BRIEF, reach=reach) for law in (LAWS if may else (SAME,))]
        return [each for each in found if each is not None]

    def damped(self, one: Fit, base: Reduced, reach: float) -> list[Fit]:
        """The same of what only damps, beside the causes of `one`, a fit of FRFs; base: its model with its modes."""
        return self.once((id(one), "damped"), one, reach, lambda: self._damped(one, base, reach))

    def _damped(self, one: Fit, base: Reduced, reach: float) -> list[Fit]:
        found = []
        for key in self.sought:
            recipes = [replace(recipe, number=i) for i, recipe in enumerate(DAMPERS[key](base, self.data.middle))]
            fits = [fit(trial, x[trial.k :], x[: trial.k], BRIEF, reach) for trial, x in self._starts(one, recipes)]
            found += sorted((each for each in fits if each is not None), key=lambda each: -each.log_evidence)[:_KEPT]
        return found

    def _starts(self, one: Fit, recipes: list[Recipe]) -> list[tuple[FrfModel, np.ndarray]]:
        """Where what only damps does most: models and x, at most one for each place of a recipe.

        The damping of the structure is as it is held likely: `one` has made that of the cause.
        """
        x, tried = one.point.x.copy(), []
        elastic = np.concatenate([x[: one.model.of_deck], one.c])  # which nothing that only damps changes
        solved = one.model.elastic.solved(elastic)
        x[one.model.of_deck : one.model.lossy] = 0.0
        for recipe in recipes:
            trial = self.model(one.model.base, (*one.recipes, recipe))
            places: dict[bytes, tuple] = {}
            for values in recipe.grid:
                at = trial.point(np.concatenate([x, recipe.coordinates(values)]), solved)
                place = values[1:].tobytes()
                if at is not None and (place not in places or at.chi2 < places[place][0]):
                    places[place] = at.chi2, trial, at.x
            tried += places.values()
        return [(trial, x) for _, trial, x in sorted(tried, key=lambda item: item[0])[:_PLACES]]


def _ended(found: Fit | list[Fit] | None, reach: float) -> bool:
    """Whether fits that were given up where they cannot come as low as `reach` came to their end."""
    return found is None or (isinstance(found, Fit) and found.misfit <= reach)


def _alike(one: Fit, other: Fit) -> bool:
    """Whether two explanations predict the same of the functions."""
    return float(np.sum((one.point.residual - other.point.residual) ** 2)) < _ALIKE
