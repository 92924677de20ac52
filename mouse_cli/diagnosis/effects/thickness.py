"""Element sets of shells that are thinner or thicker than modelled: K and M by powers of their thickness."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.effects.element_sets import has_energy, text
from mouse_cli.diagnosis.extend.matrices import Entries, with_powers
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.sets import sets_in, within
from mouse_cli.model.arrays import Matrix, upper_triangle
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.held import ElementGroup
from mouse_cli.model.problem import Problem
from mouse_cli.model.revision import THICKNESS, TO_THE_POWER

_LOST = Unknown("share of the thickness lost", "1", 0.02, 0.9)
_GAINED = Unknown("share of the thickness gained", "1", 0.02, 2.0)
_KEPT = 3  # coordinates, as of sets


@dataclass(frozen=True)
class _Powers:
    """What a set gives to K or M: by power n stored (n, n) and own (r, r); share (), slopes (p,) of it as parameters move it."""

    stored: dict[float, Matrix]
    own: dict[float, np.ndarray]
    share: float
    slopes: np.ndarray

    def moved(self, size: float) -> np.ndarray | None:
        """What is added at `size` times the thickness."""
        return sum(((size**n - 1) * self.share * each for n, each in self.own.items()), start=0.0) if self.own else None

    def entries(self, n: float) -> tuple[Entries, np.ndarray]:
        """What goes by the power n, and how its share grows with each parameter."""
        none = np.zeros(0, int), np.zeros(0, int), np.zeros(0)
        return (upper_triangle(self.stored[n]) if n in self.stored else none), self.slopes


def of_shells(model: Reduced, candidate, sign: int = -1) -> list[Recipe]:
    """K(t) and M(t) of each set whose powers are known; t below (-1) or above (1) that of the model by `sign`."""
    varied = {each.name for each in model.problem.parameters}
    known = [i for i, group in enumerate(model.problem.groups)
             if group.thickness is not None and THICKNESS.format(group.name) not in varied]  # fmt: skip
    if not known:
        return []
    of = [_projected(model, name) for name in "KM"]
    found = [i for i in known if of[0][i].own and has_energy(model, -of[0][i].moved(0.0))]
    return [_recipe(candidate, model.problem.groups[i], of[0][i], of[1][i], len(found), sign) for i in found]


def _projected(model: Reduced, name: str) -> dict[int, _Powers]:
    """Sets (numbers) by powers; projections are kept for the last coordinates that asked."""
    kept: list = model.built_once.setdefault(("thickness", name), [])
    parts = next((parts for V, parts in kept if V is model.V), None)
    if parts is None:
        by = {i: getattr(group.thickness, name) for i, group in enumerate(model.problem.groups) if group.thickness}
        stored = {i: {n: within(model.problem, each) for n, each in own.items()} for i, own in by.items()}
        parts = {i: (own, {n: model.project(each) for n, each in own.items()}) for i, own in stored.items()}
    kept[:] = [(model.V, parts), *(each for each in kept if each[0] is not model.V)][:_KEPT]
    sets = sets_in(model, name)
    shares = sets.factors(model)
    return {i: _Powers(*each, float(shares[i]), sets.slopes[:, i]) for i, each in parts.items()}


def _recipe(candidate, group: ElementGroup, K: _Powers, M: _Powers, count: int, sign: int) -> Recipe:
    thickness, unknown = group.thickness, _LOST if sign < 0 else _GAINED
    site = Site("dof", (), None, f"{text(group)}{', its thickness' * (sign > 0)}")  # its stiffness may grow alone too

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        name, size = THICKNESS.format(group.name), 1 + sign * values[0]
        by = [
            (n, TO_THE_POWER.format(f"{n:g}") if n != 1 else "", K.entries(n), M.entries(n)) for n in thickness.powers
        ]
        return with_powers(problem, name, thickness.unit, thickness.nominal, size, by)

    return Recipe(
        candidate,
        (unknown,),
        lambda values: Change(K=K.moved(1 + sign * values[0]), M=M.moved(1 + sign * values[0])),
        steps(unknown, 4)[:, None],
        lambda values: site,
        log_prior=-float(np.log(count)),
        extend=extend,
        grows=(K.slopes / K.share, M.slopes / M.share),
    )
