"""Frequency response functions that differ from those of the model alike in all modes: in another unit, of another kind or sign.

Near a resonance H = A / (i omega - lambda) + smooth, with A = lambda^k phi_o phi_i / (2 i omega_r) of a model with unit modal
masses, k = 0, 1, 2 of receptance, mobility and accelerance (D. J. Ewins, Modal Testing, 2nd ed. 2000, section 2.4). One that is
misread has A times one factor, of one power of i omega_r, in every mode, whatever frequencies and damping are.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import ERROR, DeckError, Diagnostic
from mouse_cli.dynamics.eigen import EigenSolution
from mouse_cli.model.frf_test import KINDS, FrfTest
from mouse_cli.model.materials import GRAVITY
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import assembly
from mouse_cli.updating.state import paired

_FEWEST = 2  # modes: one alone is any factor away
_LIKE = 0.7  # squared correlation of residues of test and model over the responses, of a mode that tells
_AT_NODE = 0.1  # of the largest component at the force, below which a mode is hardly excited
_FAR = 0.3  # median over the modes of |ln| of the factor, above which a reading is thought of
_NEAR = 0.15  # |ln| that a reading must leave at most
_MOST = 0.7  # in this share of the modes: what a model lacks moves some
_LARGE = 1.2  # median |ln| of the factors as read, which no lack in a model reaches: then
_ROUGH = 0.4  # as median is enough
_MANY = 4  # modes of which so many must tell before a small factor, or another place of the force, is thought of
_SAME = 0.1  # median |ln| of measured over predicted frequency: else frequencies tell of other mistakes
_ADMITTED = 3.0  # prior standard deviations of modal masses and gains that explain a factor themselves
_GAIN = 0.02  # standard deviation of gains where the deck states none
_WIDTH, _LINES = 0.05, 6  # half width about a resonance, and lines on either side, that are looked at
_DAMPING = np.append(np.geomspace(1e-4, 0.1, 25), -np.geomspace(1e-4, 0.1, 25))  # negative: the other sign of time
_SEARCHED = 16  # functions by which a damping ratio is sought
_FINER = np.geomspace(0.75, 1.33, 15)  # of the best of these


@dataclass(frozen=True)
class Reading:
    """What is measured over what it should be: factor (i omega)^power; column: of the model's input, where it is another."""

    said: str
    remedy: str
    factor: float = 1.0
    power: int = 0
    column: np.ndarray | None = None


def check(problem: Problem, solution: EigenSolution) -> None:
    """Raise DeckError (MD456) where the functions of a measurement agree with the model in one other reading alone."""
    if problem.test is None or problem.test.m < _FEWEST or not problem.test.s:
        return
    modes = paired(problem, solution)
    hz, predicted = problem.test.frequency_hz, solution.frequencies_hz[modes]
    known = np.isfinite(hz) & (predicted > 0)
    if known.sum() < _FEWEST or np.median(np.abs(np.log(hz[known] / predicted[known]))) > _SAME:
        return
    for test in problem.frf:
        finding = _finding(problem, test, hz[known], solution.shapes[:, modes[known]])
        if finding is not None:
            raise DeckError(finding)


def _finding(problem: Problem, test: FrfTest, hz: np.ndarray, phi: np.ndarray) -> Diagnostic | None:
    """hz (m,): frequencies of modes that were measured; phi (n, m): those of the model that they are."""
    within = (hz > test.frequency_hz[0]) & (hz < test.frequency_hz[-1])
    if within.sum() < _FEWEST:
        return None
    hz, phi, place = hz[within], phi[:, within], problem.place("frf")
    A, damping = residues(test, hz)
    if (damping < 0).mean() > 0.5:
        return other_sign(problem)
    for i, force in enumerate(test.input_names or range(A.shape[2])):
        own = _read(test.inputs, phi)[i]
        z = _factors(A[:, :, i], test, hz, phi, own)
        if z is None or (middle := float(np.nanmedian(np.abs(z)))) < _FAR:
            continue
        admitted = _ADMITTED * np.hypot(_of_masses(problem, phi), max(test.gain_sd, _GAIN))
        found = []
        for each in (*_of_units(test), *_of_input(problem, test, i, phi)):
            left = z if each.column is None else _factors(A[:, :, i], test, hz, phi, each.column)
            plain = each.column is None and not each.power and each.factor > 0
            if left is None or (plain and abs(np.log(each.factor)) < admitted):
                continue
            near, rough = _left(left, hz, each)
            large = middle > _LARGE and each.column is None
            if (large and rough < _ROUGH) or (near < _NEAR and (large or np.isfinite(left).sum() >= _MANY)):
                found.append((rough, each))
        if found:
            return _reported(test, str(force), z, found, place)
    return None


def other_sign(problem: Problem) -> Diagnostic:
    """The finding where functions have negative damping, and with phases of the other sign do not."""
    message = "the phases of the functions turn at resonances as those of negative damping do"
    help = "give the phases, or the imaginary parts, with the other sign: as for e^{+i omega t}"
    return Diagnostic("MD456", ERROR, message, problem.place("frf"), help=help)


def _reported(test: FrfTest, force: str, z: np.ndarray, found: list[tuple[float, Reading]], place) -> Diagnostic:
    (_, first), *rest = sorted(found, key=lambda pair: pair[0])
    ratio = np.exp(np.nanmedian(z.real))
    message = (
        f"at their resonances the functions of '{test.title}' for a force at {force} are {ratio:.4g} times those "
        f"of the model; {first.said}, they would agree in {np.isfinite(z).sum()} modes"
    )
    note = "; ".join(f"{each.said}: {each.remedy}" for _, each in rest[:3])
    return Diagnostic("MD456", ERROR, message, place, f"as well fits: {note}" if note else "", first.remedy)


def _left(z: np.ndarray, hz: np.ndarray, each: Reading) -> tuple[float, float]:
    """|ln| of the factors that a reading leaves of z (m,), phases to the nearest turn: in most modes, and its median."""
    left = z - np.log(complex(each.factor)) - each.power * np.log(2j * np.pi * hz)
    left = left.real + 1j * np.angle(np.exp(1j * left.imag))
    return float(np.nanquantile(np.abs(left), _MOST)), float(np.nanmedian(np.abs(left)))


def _factors(A: np.ndarray, test: FrfTest, hz: np.ndarray, phi: np.ndarray, at_force: np.ndarray) -> np.ndarray | None:
    """ln of measured over predicted residue (m,), phases between -pi and pi, NaN of modes that do not tell; None: too few do.

    A (m, o); phi (n, m); at_force (m,): components of the model's modes where the force acts.
    """
    omega = 2 * np.pi * hz
    model = (_read(test.outputs, phi) * at_force).T * ((1j * omega) ** (KINDS[test.kind] - 1) / 2)[:, None]
    size = np.abs(model) ** 2
    with np.errstate(divide="ignore", invalid="ignore"):  # a mode that no response sees tells nothing
        c = (model.conj() * A).sum(axis=1) / size.sum(axis=1)
        like = np.abs((model.conj() * A).sum(axis=1)) ** 2 / (size.sum(axis=1) * (np.abs(A) ** 2).sum(axis=1))
        z = np.log(c)
    excited = np.abs(at_force) > _AT_NODE * np.abs(at_force).max(initial=0.0)
    if excited.sum() < _FEWEST or (like[excited] > _LIKE).sum() < max(_FEWEST, excited.sum() / 2):
        return None
    return np.where(excited & (like > _LIKE), z, np.nan)


def residues(test: FrfTest, hz: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A (m, o, i) and damping ratio (m,) of the modes at hz (m,), by least squares over the lines near each."""
    H = test.H[np.isfinite(test.H).all(axis=(1, 2))]
    omega = test.omega[np.isfinite(test.H).all(axis=(1, 2))]
    A, damping = np.zeros((len(hz), *H.shape[1:]), complex), np.zeros(len(hz))
    for r, own in enumerate(2 * np.pi * hz):
        nearest = np.sort(np.abs(omega - own))[min(2 * _LINES, len(omega) - 1)]
        near = np.abs(omega - own) <= max(_WIDTH * own, nearest)
        w = omega[near]
        others = [2 * np.pi * f for f in hz if w[0] <= 2 * np.pi * f <= w[-1] and 2 * np.pi * f != own]
        values = H[near].reshape(len(w), -1)
        strongest = values[:, np.argsort(-np.abs(values).max(axis=0))[:_SEARCHED]]
        best = _best(w, strongest, own, others, _DAMPING)
        damping[r] = _best(w, strongest, own, others, best * _FINER)
        A[r] = _near(w, values, own, others, float(damping[r]))[1].reshape(H.shape[1:])
    return A, damping


def _best(omega: np.ndarray, values: np.ndarray, own: float, others: list[float], tried: np.ndarray) -> float:
    """The damping ratio of those `tried` that leaves least."""
    return min(tried.tolist(), key=lambda zeta: _near(omega, values, own, others, zeta)[0])


def _near(
    omega: np.ndarray, values: np.ndarray, own: float, others: list[float], zeta: float
) -> tuple[float, np.ndarray]:
    """What is left, and residues (k,), of values (f, k) near the mode at `own`, rad/s, others beside it."""
    poles = np.array([own, *others]) * (1j - zeta)
    basis = np.column_stack([1 / (1j * omega[:, None] - poles), np.ones(len(omega)), omega / own - 1])
    x = np.linalg.lstsq(basis, values, rcond=None)[0]
    return float(np.linalg.norm(values - basis @ x)), x[0]


def _read(weights: np.ndarray, phi: np.ndarray) -> np.ndarray:
    """What responses read, or forces act on (k, m), of modes (n, m): by weights (k, n) or by degrees of freedom (k,)."""
    return phi[np.asarray(weights, int)] if weights.ndim == 1 else weights @ phi


def _of_masses(problem: Problem, phi: np.ndarray) -> float:
    """Standard deviation of ln of modal masses that the prior of the parameters allows, the largest of the modes phi (n, m)."""
    model, mean, sd = assembly(problem), problem.prior.mean, problem.prior.sd
    mass = lambda theta: np.einsum("ij,ij->j", phi, model.matrices(theta)[1] @ phi)
    moved = np.log(np.maximum(mass(mean + sd), 1e-300) / np.maximum(mass(mean), 1e-300))
    return float(np.abs(moved).max(initial=0.0))


_FACTORS = (  # measured over what it should be
    (1e3, "in mm beside m, or per kN", "divide the functions by 1000, or state their unit"),
    (1e-3, "in m beside mm, or per N beside kN", "multiply the functions by 1000, or state their unit"),
    (1 / 0.0254, "in inches beside m", "multiply the functions by 0.0254, or state their unit"),
    (25.4, "in mm beside inches", "divide the functions by 25.4, or state their unit"),
    (4.4482216, "per lbf of force beside N", "divide the functions by 4.4482, or state their unit"),
    (1 / 4.4482216, "per N of force beside lbf", "multiply the functions by 4.4482, or state their unit"),
    (2.0, "with the force as half of what it is", "halve the functions: their force is two-sided, their response one-sided"),
    (0.5, "with the response as half of what it is", "double the functions: their response is two-sided, their force one-sided"),
    (2**0.5, "with the force as rms beside peaks", "divide the functions by sqrt(2): force and response as peaks"),
    (0.5**0.5, "with the response as rms beside peaks", "multiply the functions by sqrt(2): force and response as peaks"),
    (-1.0, "with the force in the opposite direction", "turn the signs of the functions, or write input: with the other sign"),
)  # fmt: skip


def _of_units(test: FrfTest) -> Iterator[Reading]:
    for factor, said, remedy in _FACTORS:
        yield Reading(said, remedy, factor)
    if test.kind == "accelerance":
        yield Reading("in g beside m/s2", "write unit: g/N, or multiply the functions by 9.80665", 1 / GRAVITY)
        yield Reading("in m/s2 beside g", "write unit: (m/s2)/N, or divide the functions by 9.80665", GRAVITY)
    yield Reading("per kgf of force beside N", "divide the functions by 9.80665, or state their unit", GRAVITY)
    for kind, k in KINDS.items():
        if kind == test.kind:
            continue
        for factor, unit in ((1.0, ""), (1e3, " in mm"), (1e-3, " in m beside mm")):
            yield Reading(f"read as {kind}{unit}", f"write kind: {kind}, and its unit", factor, k - KINDS[test.kind])


def _of_input(problem: Problem, test: FrfTest, i: int, phi: np.ndarray) -> Iterator[Reading]:
    """The force in another direction at its node, and at the nodes whose numbers are next to it."""
    at, force = problem.structure.geometry, int(test.inputs[i]) if test.inputs.ndim == 1 else None
    if at is None or force is None:
        return
    for j, (node, direction) in enumerate(zip(at.node.tolist(), at.direction.tolist(), strict=True)):
        same_node, same_way = node == at.node[force], direction == at.direction[force]
        if j != force and (same_node or (same_way and abs(node - at.node[force]) == 1)):
            name = problem.structure.labels[j]
            yield Reading(f"with the force at {name}", f"write input: {name}, if the force acted there", column=phi[j])
