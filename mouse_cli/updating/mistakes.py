"""Frequencies of model and test that differ by a unit: what in the deck, read in another unit, makes them agree."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli._errors import ERROR, DeckError, Diagnostic
from mouse_cli.dynamics.correlation import mac
from mouse_cli.dynamics.eigen import EigenSolution, IndefiniteError
from mouse_cli.model.materials import GRAVITY
from mouse_cli.model.mesh import Mesh
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import assembly
from mouse_cli.terms.build import LARGEST_DENSE, build
from mouse_cli.terms.faults import MeshFault
from mouse_cli.terms.plausible import strange
from mouse_cli.updating.state import paired, reference_eigenvalue, solve

_FAR = 0.45  # |ln| of measured over predicted frequency, which every mode must exceed for a unit to be thought of
_NEAR, _GAIN = 0.2, 0.2  # rms of that ln which a unit must leave at most, and as a share of what it was
_FEWEST = 2  # frequencies: one alone agrees with some reading or with another mode by chance (6.27 of a cantilever is near 2 pi)
_EQUAL = 0.05  # misfit (rms of that ln, and what the mean MAC lacks of 1) by which two readings fit alike
_LIKER = 0.05  # mean MAC that a reading must add where the modes as paired are near to one another in frequency
_ADMITTED = 3.0  # prior standard deviations of the mean ln within which the parameters explain it themselves
_MOST = 60  # parameters whose prior is looked at one by one


@dataclass(frozen=True)
class Reading:
    """A deck read otherwise: what is taken to be so, and what to do. hz: frequencies of the test in Hz; or else factor of K
    over M; or else the mesh with values changed, and the theta of its parameters.
    """

    said: str
    remedy: str
    hz: np.ndarray | None = None
    factor: float = 1.0
    mesh: Mesh | None = None
    theta: np.ndarray | None = None


def check(problem: Problem, solution: EigenSolution) -> None:
    """Raise DeckError (MD450) where the test is far from the model in all modes alike, and one reading brings them together."""
    test = problem.test
    if test is None or np.isfinite(test.frequency_hz).sum() < _FEWEST:
        return
    before, by_number = _distances(problem, solution), _distances(problem, solution, test.number - 1)
    apart = next((d for d in (by_number, before) if (np.abs(d) > _FAR).all()), None)
    if apart is None or _admitted(problem, solution, apart):
        return
    limit = min(_NEAR, _GAIN * _rms(apart))
    liker = 0.0 if (np.abs(before) > _FAR).all() else _likeness(problem, solution) + _LIKER
    found = []
    for each in _readings(problem):
        read = _read(problem, solution, each)
        misfit = np.inf if read is None or _rigid(*read) else _rms(_distances(*read))
        if misfit < limit and (likeness := _likeness(*read)) > liker:
            found.append((misfit + 1 - likeness, each))
    if found:
        raise DeckError(_finding(problem, apart, found))


def _rigid(problem: Problem, solution: EigenSolution) -> bool:
    """Whether a measured mode is by its number one of zero frequency: of that another finding tells."""
    return solution.rigid(reference_eigenvalue(problem, solution.eigenvalues)) >= problem.test.number.min()


def _finding(problem: Problem, apart: np.ndarray, found: list[tuple[float, Reading]]) -> Diagnostic:
    """The finding: what fits best, of several that fit alike the one that leaves no strange value."""
    best = min(misfit for misfit, _ in found)
    alike = [(_oddness(problem, each), each) for misfit, each in found if misfit < best + _EQUAL]
    least = min(oddness for oddness, _ in alike)
    first, *rest = [each for oddness, each in alike if oddness == least]
    ratio = float(np.exp(np.median(apart)))
    message = f"the measured frequencies are {ratio:.4g} times those of the model; {first.said}, they would agree"
    note = "; ".join(f"{each.said}: {each.remedy}" for each in rest[:3])
    place = problem.place(f"mode {problem.test.number[0]}")
    return Diagnostic("MD450", ERROR, message, place, f"as well fits: {note}" if note else "", first.remedy)


def _oddness(problem: Problem, each: Reading) -> int:
    """How many element sets are strange if the deck is read so."""
    mesh = each.mesh or problem.mesh
    return 0 if mesh is None else strange(mesh, problem.units)


def _distances(problem: Problem, solution: EigenSolution, modes: np.ndarray | None = None) -> np.ndarray:
    """ln of measured over predicted frequency, of each mode with a frequency (k,); modes (m,): partners, else as a run pairs."""
    have = np.isfinite(problem.test.frequency_hz)
    modes = paired(problem, solution) if modes is None else np.minimum(modes, len(solution.eigenvalues) - 1)
    predicted = solution.frequencies_hz[modes][have]
    return np.log(problem.test.frequency_hz[have] / np.maximum(predicted, 1e-12))


def _likeness(problem: Problem, solution: EigenSolution) -> float:
    """Mean MAC of the measured shapes and their partners; 1 without shapes."""
    known = np.isfinite(problem.test.shapes).sum(axis=0) > 1
    if not known.any():
        return 1.0
    values = mac(problem.test.shapes, problem.test.read(solution.shapes[:, paired(problem, solution)])).diagonal()
    return float(np.nanmean(values[known]))


def _rms(distances: np.ndarray) -> float:
    return float(np.sqrt(np.mean(distances**2)))


def _read(problem: Problem, solution: EigenSolution, each: Reading) -> tuple[Problem, EigenSolution] | None:
    """Deck and eigensolution, if the deck is read so; None where it is no model then."""
    if each.mesh is None:
        if each.hz is not None:
            problem = replace(problem, test=replace(problem.test, frequency_hz=each.hz))
        return problem, replace(solution, eigenvalues=solution.eigenvalues * each.factor)
    try:
        structure, terms = build(each.mesh, problem.bindings)
        if structure.n != problem.structure.n:
            return None
        changed = replace(problem, structure=structure, terms=terms)
        return changed, solve(changed, *assembly(changed).matrices(each.theta))
    except (MeshFault, IndefiniteError, np.linalg.LinAlgError):
        return None


def _admitted(problem: Problem, solution: EigenSolution, before: np.ndarray) -> bool:
    """Whether the prior of the parameters allows for the common distance, by Rayleigh quotients of the modes as they are."""
    have = np.isfinite(problem.test.frequency_hz)
    modes = paired(problem, solution)[have]
    x, model, mean = solution.shapes[:, modes], assembly(problem), problem.prior.mean
    here, squares = _rayleigh(*model.matrices(mean), x), 0.0
    sd = problem.prior.sd
    steps = [np.where(np.arange(len(sd)) == j, sd, 0.0) for j in range(len(sd))] if len(sd) <= _MOST else [sd]
    for step in steps:
        there = _rayleigh(*model.matrices(mean + step), x)
        moved = 0.5 * np.log(np.maximum(there, 1e-300) / np.maximum(here, 1e-300))
        squares += float(np.abs(moved).max(initial=0.0)) ** 2
    return abs(float(np.median(before))) < _ADMITTED * squares**0.5


def _rayleigh(K, M, x: np.ndarray) -> np.ndarray:
    return np.einsum("ij,ij->j", x, K @ x) / np.einsum("ij,ij->j", x, M @ x)


def _readings(problem: Problem) -> Iterator[Reading]:
    """All that a deck is likely to be meant as: the test first, then matrices or the structure."""
    yield from _of_test(problem.test.frequency_hz)
    for factor, said in ((0.5, "half as far apart"), (2.0, "twice as far apart")) if problem.frf else ():
        help = "mend the frequencies of the functions: lines are 1 / T apart, T the length of a block"
        yield Reading(f"with spectral lines {said}", help, problem.test.frequency_hz * factor)
    plain = problem.mesh is None or not problem.terms or len(problem.elements) or abs(problem.structure.K).max() > 0
    if plain:
        yield from _of_matrices(problem)
    elif problem.structure.n <= LARGEST_DENSE:
        yield from _of_structure(problem)


def _of_test(given: np.ndarray) -> Iterator[Reading]:
    with np.errstate(all="ignore"):
        yield Reading("read in rad/s", "divide the frequencies by 2 pi, for they are to be in Hz", given / (2 * np.pi))
        yield Reading("read in rpm", "divide the frequencies by 60, for they are to be in Hz", given / 60)
        yield Reading("read in kHz", "multiply the frequencies by 1000, for they are to be in Hz", given * 1000)
        yield Reading(
            "read as eigenvalues in (rad/s)^2",
            "give the roots of the frequencies over 2 pi, in Hz",
            given**0.5 / (2 * np.pi),
        )
        yield Reading("read as periods in s", "give 1 over the frequencies, in Hz", 1 / given)


_MATRICES = (
    (1e3, "with K read in N/mm (kN/m) beside masses in kg, or M in g", "multiply K by 1000, or divide M by 1000"),
    (1e6, "with K read in kN/mm, or from E in MPa", "multiply K by 1e6"),
    (1e9, "with K read from E in GPa", "multiply K by 1e9"),
    (1e-3, "with M read in t beside K in N/m", "multiply M by 1000"),
    (1e-6, "with K read from E in Pa beside lengths in mm", "divide K by 1e6"),
    (GRAVITY, "with M read as weights in N, or K in kgf/m", "divide M by 9.80665, or multiply K by it"),
    (1e3 * GRAVITY, "with K read in kgf/mm", "multiply K by 9806.65"),
    (1e-3 * GRAVITY, "with M read as weights in kN beside K in N/m", "multiply M by 1000 / 9.80665"),
    (1 / GRAVITY, "with M read in kgf s2/m", "multiply M by 9.80665"),
    (386.0886, "with M read as weights in lbf beside K in lbf/in", "divide M by 386.09 in/s2"),
    (32.17405, "with M read as weights in lbf beside K in lbf/ft", "divide M by 32.174 ft/s2"),
    (175.126835, "with K read in lbf/in beside M in kg", "multiply K by 175.127"),
    (14.593903, "with K read in lbf/ft beside M in kg", "multiply K by 14.594"),
    (4 * np.pi**2, "with K over M in 1/s2 of revolutions", "multiply K by 4 pi^2"),
)


_WEIGHTS = {  # factors of masses that are weights, with the units of length beside which they may be
    386.0886: ("in",), 32.17405: ("ft",), GRAVITY: ("m", "mm"), 1e-3 * GRAVITY: ("m", "mm"),
}  # fmt: skip


def _of_matrices(problem: Problem) -> Iterator[Reading]:
    """K and M in another unit, but as weights in units of force that the deck says it is not in."""
    declared = problem.units.length if problem.units.declared else None
    for factor, said, remedy in _MATRICES:
        if declared is None or declared in _WEIGHTS.get(factor, (declared,)):
            yield Reading(said, remedy, factor=factor)


_VALUES = (  # properties that are mended together, their name, and units with factors
    (("E", "G"), "E", (("MPa", 1e6), ("GPa", 1e9), ("kPa", 1e3), ("psi", 6894.757), ("ksi", 6.894757e6),
                       ("Pa where MPa are the unit", 1e-6), ("kgf/cm2", 1e4 * GRAVITY))),
    (("density",), "density", (("g/cm3", 1e3), ("t/mm3", 1e12), ("kg/mm3", 1e9), ("N/m3, a weight", 1 / GRAVITY),
                               ("kN/m3, a weight", 1e3 / GRAVITY), ("kg/m3 where t/mm3 are the unit", 1e-12),
                               ("lb/in3", 27679.905), ("lb/ft3", 16.018463))),
    (("Iy", "Iz", "J"), "I", (("mm4", 1e-12), ("cm4", 1e-8), ("in4", 0.0254**4))),
    (("A",), "A", (("mm2", 1e-6), ("cm2", 1e-4), ("in2", 0.0254**2))),
    (("mass",), "mass", (("g", 1e-3), ("t", 1e3), ("N, a weight", 1 / GRAVITY), ("kN, a weight", 1e3 / GRAVITY))),
    (("nonstructural_mass",), "nonstructural_mass", (("g/m", 1e-3), ("t/m", 1e3), ("N/m, a weight", 1 / GRAVITY))),
    (("TX", "TY", "TZ", "kx", "ky", "kz"), "stiffness", (("N/mm", 1e3), ("kN/mm", 1e6), ("MN/m", 1e6), ("kgf/mm", 1e3 * GRAVITY))),
    (("RX", "RY", "RZ"), "stiffness in turning", (("kN m/rad", 1e3), ("N mm/rad", 1e-3), ("N m per degree", 180 / np.pi))),
)  # fmt: skip
_LENGTHS = (("mm", 1e-3), ("cm", 1e-2), ("in", 0.0254), ("ft", 0.3048), ("m where mm are the unit", 1e3))


def _of_structure(problem: Problem) -> Iterator[Reading]:
    mesh, mean = problem.mesh, problem.prior.mean
    for names, called, units in _VALUES:
        for where, sets in _groups(mesh, names):
            for unit, factor in units:
                changed, theta = _scaled(problem, names, sets, factor)
                yield Reading(f"with {called}{where} in {unit}", f"multiply {called}{where} by {factor:.6g}", None,
                              1.0, changed, theta)  # fmt: skip
    for unit, f in _LENGTHS:
        nodes = replace(mesh, coordinates=mesh.coordinates * f)
        yield Reading(
            f"with coordinates in {unit}", f"multiply the coordinates of the nodes by {f:g}", mesh=nodes, theta=mean
        )
        sections = problem
        for names, power in ((("A",), 2), (("Iy", "Iz", "J"), 4)):
            changed, theta = _scaled(sections, names, range(len(mesh.elements)), f**power)
            sections = replace(sections, mesh=changed, prior=replace(sections.prior, mean=theta))
        yield Reading(f"with all sections in {unit}", f"multiply areas by {f**2:g} and second moments by {f**4:g}",
                      mesh=sections.mesh, theta=sections.prior.mean)  # fmt: skip
        whole = replace(sections.mesh, coordinates=mesh.coordinates * f)
        yield Reading(f"with nodes and sections in {unit}", f"multiply lengths by {f:g}, areas by {f**2:g} and second moments by "
                      f"{f**4:g}; or declare the units of the whole deck", mesh=whole, theta=sections.prior.mean)  # fmt: skip


def _groups(mesh: Mesh, names: tuple[str, ...]) -> Iterator[tuple[str, list[int]]]:
    """Element sets that have one of the properties: all of them, then by the material or section that gave it."""
    having = [
        s
        for s, members in enumerate(mesh.elements)
        if any((members.properties.get(n, np.zeros(1)) != 0).any() for n in names)
    ]
    if not having:
        return
    yield "", having
    origins: dict[str, list[int]] = {}
    for s in having:
        members = mesh.elements[s]
        origin = next((members.origin[n] for n in names if n in members.origin), "")
        origins.setdefault(f" of {origin}" if origin else f" of element {members.ids[0]}", []).append(s)
    if len(origins) > 1:
        yield from origins.items()


def _scaled(problem: Problem, names: tuple[str, ...], sets, factor: float) -> tuple[Mesh, np.ndarray]:
    """The mesh with those properties of those sets times `factor`, and theta (p,) for it: values of parameters change with them."""
    elements, theta = list(problem.mesh.elements), problem.prior.mean.copy()
    for s in sets:
        members = elements[s]
        changed = {n: v * factor if n in names else v for n, v in members.properties.items()}
        elements[s] = replace(members, properties=changed)
    for parameter in {b.parameter for b in problem.bindings if b.set in sets and b.property in names and not b.factor}:
        theta[parameter] *= factor
    return replace(problem.mesh, elements=tuple(elements)), theta
