"""What can still be measured: further modes, another sensor, a mass more, a point held, a support let go, a reading repeated.

A measurement knows how the model is altered for it and what it reads, for any fit of the same deck.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe
from mouse_cli.diagnosis.effects.sensors import name
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import highest, total_mass
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.sites.members import upward
from mouse_cli.diagnosis.sites.points import Points, all_motions, directions
from mouse_cli.model.diagnosis import Effort
from mouse_cli.model.geometry import DIRECTIONS

_MORE = 3  # modes above the highest measured one
_MASS = 0.05  # of the total mass, added
_HELD = 1e2  # of total mass times the highest measured eigenvalue: the stiffness of what holds a point
_PLACES = 12
_STANDS = 0.25  # of the lowest eigenvalue, that one has without a support that is let go for a test, at least
_SUPPORTS = 6  # supports that may be let go
_BAND = 1.2  # of the highest measured frequency, up to which a test of the altered structure has modes
SHAPE_SD = 0.02  # of the largest component: accuracy of shapes that were not measured yet

Altered = Callable[[Fit], tuple[Recipe, ...] | None]
Read = Callable[[Point, Fit, np.ndarray], np.ndarray | None]
Yielding = dict[int, tuple[Reduced, list[Recipe]]]  # models by id, and recipes of their flexible supports, made once


@dataclass(frozen=True)
class Measurement:
    """kind: of those alike the best are told; text: in words; effort: what it takes; sd: of what is read.

    altered(fit): what is changed in the model for it, None where that is not possible. read(point, fit, modes): what it reads (h,),
    with the modes of the model (m,) that are the measured ones; None where it cannot be.
    """

    kind: str
    text: str
    effort: Effort
    altered: Altered
    read: Read
    sd: float


def measurements(one: Fit, *others: Fit) -> Iterator[Measurement]:
    """All that is considered, for the deck of a fit; `others` are fits of the same deck whose supports may move too."""
    base = one.model.base
    test = base.data.test
    sd = float(np.nanmedian(base.data.sd_log[base.data.has_frequency])) if base.data.has_frequency.any() else 0.01
    yield from _further_modes(base, sd)
    own = f"the frequencies of modes {listed(test.number)} with"
    mass, units = _MASS * total_mass(base), base.problem.units
    for place in places(base, all_motions):
        text = f"{own} {mass:.3g} {units.of('kg')} more at {place.text}"
        yield Measurement("mass", text, Effort.MASS, place.altered(M=mass), _in_band, sd)
    holding = _HELD * highest(base) * total_mass(base)
    for place in places(base, directions):
        text = f"{own} {place.text} held fixed"
        yield Measurement("held", text, Effort.SUPPORT, place.altered(K=holding), _in_band, sd)
    known: Yielding = {}
    for i, text in _supports(base, known):
        yield Measurement("released", f"{own} {text} let go", Effort.SUPPORT, _released(i, known), _in_band, sd)
    if base.data.has_shape.any():
        noise = float(np.nanmedian(test.shape_sd / np.nanmax(np.abs(test.shapes), axis=0)))
        measured = {base.problem.structure.labels[dof] for dof in test.dofs}
        for place in places(base, directions):
            if measured.issuperset(place.ids):
                continue
            text = f"the shapes at {place.text} too"
            yield Measurement("sensor", text, Effort.SENSOR, unaltered, place.seen, noise)
        for node, labels in _moving_supports((one, *others)).items():
            text = f"the shapes at the support of node {node} too"
            yield Measurement("support", text, Effort.SENSOR, unaltered, _of_support(labels), noise)
        for k in range(test.s):
            text = f"the shapes at {name(base.problem, k)} again, by another sensor"
            yield Measurement("repeated", text, Effort.SENSOR, unaltered, _true_reading(k), noise)


def _further_modes(base: Reduced, sd: float) -> Iterator[Measurement]:
    """Frequencies of modes above all that the deck has, held out or not."""
    held, last = base.problem.hold_out, int(base.data.test.number.max())
    known = last if held is None or held.test is None or not held.test.m else max(last, int(held.test.number.max()))
    for more in range(1, _MORE + 1):
        words = f"frequencies of modes {known + 1} to {known + more}" if more > 1 else f"frequency of mode {known + 1}"
        yield Measurement("modes", f"the {words}", Effort.MODES, unaltered, _above(known - last, more), sd)


@dataclass(frozen=True)
class Spot:
    """A place, as each of two models knows it: number `which` of what `among` finds in it, at `values`."""

    among: Callable[[Reduced], list[Points]]
    which: int
    values: np.ndarray
    text: str
    ids: tuple[int | str, ...]

    def motion(self, base: Reduced) -> np.ndarray:
        """Rows (d, r)."""
        return self.among(base)[self.which].motion(self.values)

    def altered(self, K: float = 0.0, M: float = 0.0) -> Altered:
        """The model with a spring to the ground or a mass there."""

        def made(fitted: Fit) -> tuple[Recipe, ...]:
            B = self.motion(fitted.model.base)
            change = Change(K=K * B.T @ B, M=M * B.T @ B)
            return (Recipe(None, (), lambda values: change, np.zeros((1, 0))),)

        return made

    def shape(self, at: Point, fitted: Fit, modes: np.ndarray) -> np.ndarray:
        """The motion there in each mode, mass-normalised."""
        return self.motion(fitted.model.base)[0] @ fitted.model.moved(at.X[:, modes])

    def seen(self, at: Point, fitted: Fit, modes: np.ndarray) -> np.ndarray:
        """Shapes of the measured modes there, in units of their largest component."""
        return at.a * self.shape(at, fitted, modes) / _largest(fitted)


def places(base: Reduced, among: Callable[[Reduced], list[Points]]) -> list[Spot]:
    """Some places all over the structure."""
    points = among(base)
    found = [(i, values) for i, point in enumerate(points) for values in point.starts]
    chosen = found[:: max(1, -(-len(found) // _PLACES))]
    sites = [points[i].site(values) for i, values in chosen]
    return [Spot(among, i, values, site.text, site.ids) for (i, values), site in zip(chosen, sites, strict=True)]


def listed(numbers: np.ndarray) -> str:
    """Numbers of modes in words.

    >>> listed(np.array([1, 2, 3])), listed(np.array([2, 5])), listed(np.array([4]))
    ('1 to 3', '2, 5', '4')
    """
    if len(numbers) > 2 and (np.diff(numbers) == 1).all():
        return f"{numbers[0]} to {numbers[-1]}"
    return ", ".join(str(number) for number in numbers)


def unaltered(fitted: Fit) -> tuple[Recipe, ...]:
    """The structure as it was tested."""
    return ()


def logarithms(at: Point, fitted: Fit, modes: np.ndarray) -> np.ndarray:
    """ln of the frequencies of the measured modes."""
    return 0.5 * np.log(np.maximum(at.eigenvalues[modes], 1e-300))


def _in_band(at: Point, fitted: Fit, modes: np.ndarray) -> np.ndarray:
    """The same, those above the band as its end: all that a test reads of a mode beyond it is that it has none."""
    return np.minimum(logarithms(at, fitted, modes), 0.5 * np.log(_BAND**2 * highest(fitted.model.base)))


def _above(skipped: int, more: int) -> Read:
    """ln of the frequencies of so many modes above the highest one that the deck has."""

    def read(at: Point, fitted: Fit, modes: np.ndarray) -> np.ndarray | None:
        first = int(modes.max()) + skipped + 1
        wanted = np.arange(first, first + more)
        return logarithms(at, fitted, wanted) if first + more <= len(at.eigenvalues) else None

    return read


def _largest(fitted: Fit) -> np.ndarray:
    return np.nanmax(np.abs(fitted.model.base.data.test.shapes), axis=0)


def _true_reading(k: int) -> Read:
    """What a sound sensor reads where sensor k (from 0) is."""
    read = lambda at, fitted, modes: (
        at.a * (fitted.model.base.sensing[k] @ fitted.model.moved(at.X[:, modes])) / _largest(fitted)
    )
    return read


def _moving_supports(fits: tuple[Fit, ...]) -> dict[int, tuple[str, ...]]:
    """Supports that a cause of some fit lets move, by their node: labels of their directions of translation."""
    mesh = fits[0].model.base.problem.mesh
    found: dict[int, tuple[str, ...]] = {}
    for node, d in [] if mesh is None else mesh.supports.tolist():
        text = f"{mesh.node_ids[node]}{DIRECTIONS[d]}"
        if d < 3 and any(_support_motion(one, one.point, (text,)).any() for one in fits):
            number = int(mesh.node_ids[node])
            found[number] = (*found.get(number, ()), text)
    return found


def _support_motion(fitted: Fit, at: Point, labels: tuple[str, ...]) -> np.ndarray:
    """Motion (l, size) of degrees of freedom that the deck holds, in each mode of a point; 0 where no cause lets them move."""
    found = np.zeros((len(labels), at.X.shape[1]))
    for i, recipe in enumerate(fitted.recipes):
        if recipe.carried is not None and all(text in recipe.carried.place for text in labels):
            rows = [recipe.carried.place[text] for text in labels]
            found += recipe.carried.whole[rows] @ at.X[fitted.model.places[i][fitted.model.base.r :]]
    return found


def _of_support(labels: tuple[str, ...]) -> Read:
    """What sensors on a support read, in units of the largest component of each shape."""
    return lambda at, fitted, modes: (at.a * _support_motion(fitted, at, labels)[:, modes] / _largest(fitted)).ravel()


def _supports(base: Reduced, known: Yielding) -> list[tuple[int, str]]:
    """Numbers, among all recipes of flexible supports, of those of one support alone that nobody would mind to let go, and what
    each is called.
    """
    found = [(i, each, each.site(np.ones(1))) for i, each in enumerate(_yielding(base, known)) if len(each.unknowns) == 1]
    single = [(i, each, site.text) for i, each, site in found if len(site.ids) == 1]
    return [(i, text) for i, each, text in single if _stands(base, each)][:_SUPPORTS]


def _stands(base: Reduced, recipe: Recipe) -> bool:
    """Whether the structure stands without a support much as it does with it, which does not bear its weight: no tower slides off
    its base for a test, and no column is lifted.
    """
    if any(dof.endswith(DIRECTIONS[upward(base.problem.mesh)]) for dof in recipe.dofs):
        return False
    own = recipe.change(np.zeros(1))
    found = Model(base, (replace(recipe, unknowns=(), change=lambda values: own),)).solved(base.z)
    return found is not None and found[0][0] > _STANDS * base.least_elastic


def _yielding(base: Reduced, known: Yielding) -> list[Recipe]:
    if id(base) not in known:
        of = [registry()[key] for key in ("support-translation", "support-rotation")]
        known[id(base)] = base, [recipe for each in of for recipe in each.recipes(base, each)]
    return known[id(base)][1]


def _released(which: int, known: Yielding) -> Altered:
    """The model without a support; None where a cause lets supports go already."""

    def made(fitted: Fit) -> tuple[Recipe, ...] | None:
        if any(recipe.carried is not None for recipe in fitted.recipes):
            return None
        recipe = _yielding(fitted.model.base, known)[which]
        loose = recipe.change(np.zeros(1))
        return (replace(recipe, unknowns=(), change=lambda values: loose, grid=np.zeros((1, 0))),)

    return made
