"""Models of a thousand to a million degrees of freedom made of repeated elements in groups, with a simulated modal test.

`problem` makes a `Problem` of one of GRIDS: element groups, one behind the other, whose stiffnesses and masses are scaled
by factors (nominal 1, prior sd 20 % and 10 %), and the test of another such structure, noise included.
"""

from collections.abc import Callable
from dataclasses import dataclass

import element_matrices
import numpy as np
from fast_factor import Symbolic, arpack, factorise, shift

from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem, RunOptions
from mouse_cli.model.structure import ListedElements, Structure
from mouse_cli.model.term import Places, Slopes
from mouse_cli.terms.assembly import Assembly

SD_STIFFNESS, SD_MASS, SD_FREQUENCY, SD_SHAPE = 0.20, 0.10, 0.002, 0.01
BEAMS = 2  # a member of the frame
MASS_SHARE = 5  # one parameter in so many is a mass


@dataclass(frozen=True)
class Block:
    """e equal elements: dofs (e, d), negative at supports; K, M (d, d) of one; rank (e,): where they stand along the structure."""

    dofs: np.ndarray
    K: np.ndarray
    M: np.ndarray
    rank: np.ndarray


@dataclass(frozen=True)
class Grid:
    """A model without parameters: n degrees of freedom, its blocks, and those that a sensor may read."""

    n: int
    blocks: tuple[Block, ...]
    translations: np.ndarray


class ElementGroups:
    """sum_e theta[stiffness_e] K_e and sum_e theta[mass_e] M_e: the term of elements whose matrices groups of factors scale.

    groups[name][b] (e,): parameter of each element of block b; -1: not scaled.
    """

    linear = True

    def __init__(self, blocks: tuple[Block, ...], groups: dict[str, list[np.ndarray]]):
        self.groups, self.parts = {name: [] for name in groups}, []
        row, col = [], []
        for b, block in enumerate(blocks):
            held = (block.dofs < 0).any(axis=1)
            for own in (np.flatnonzero(~held), np.flatnonzero(held)):
                d, dofs = block.dofs.shape[1], block.dofs[own].astype(np.int32)
                rows, cols = np.repeat(dofs, d, axis=1), np.tile(dofs, (1, d))
                keep = (rows >= 0) & (cols >= 0)
                self.parts.append((block, None if keep.all() else keep, keep.sum(axis=1)))
                row.append(rows[keep])
                col.append(cols[keep])
                for name, which in groups.items():
                    self.groups[name].append(which[b][own])
        where = Places(np.concatenate(row), np.concatenate(col))
        self.places = {"K": where, "M": where}
        self._constant = {
            name: self._entries(name, [np.ones(len(g)) for g in own])
            for name, own in self.groups.items()
            if all((g < 0).all() for g in own)
        }

    def values(self, theta: np.ndarray) -> dict[str, np.ndarray]:
        """Entries of all elements at theta (p,), element by element."""
        scaled = np.append(theta, 1.0)
        return self._constant | {
            name: self._entries(name, [scaled[g] for g in self.groups[name]])
            for name in self.places
            if name not in self._constant
        }

    def slopes(self, theta: np.ndarray) -> dict[str, Slopes]:
        """Entries of the elements that are scaled, each by its own parameter."""
        slopes = {}
        for name, place in self.places.items():
            parameter = np.concatenate(
                [np.repeat(g, count) for g, (_, _, count) in zip(self.groups[name], self.parts, strict=True)]
            )
            value = self._entries(name, [np.ones(len(g)) for g in self.groups[name]])
            if (parameter < 0).any():
                own = parameter >= 0
                slopes[name] = Slopes(parameter[own], place.row[own], place.col[own], value[own])
            else:
                slopes[name] = Slopes(parameter, place.row, place.col, value)
        return slopes

    def _entries(self, name: str, factors: list[np.ndarray]) -> np.ndarray:
        entries = []
        for factor, (block, keep, _) in zip(factors, self.parts, strict=True):
            flat = np.multiply.outer(factor, getattr(block, name).ravel())
            entries.append(flat.ravel() if keep is None else flat[keep])
        return np.concatenate(entries)


def solid_grid(n: int) -> Grid:
    """A block of 2.0 x 1.3 x 1.0 m of hexahedra, held at x = 0, of about n degrees of freedom."""
    h = (3 * 2.0 * 1.3 / n) ** (1 / 3)
    return bricks(tuple(max(1, round(length / h)) for length in (2.0, 1.3 - h, 1.0 - h)), (2.0, 1.3, 1.0))


def bricks(number: tuple[int, int, int], size: tuple[float, float, float]) -> Grid:
    """A block of `size` (m) of so many hexahedra in x, y and z, held at x = 0."""
    nx, ny, nz = number
    node = _numbered((nx + 1, ny + 1, nz + 1))
    corners = [node[i : i + nx, j : j + ny, k : k + nz].ravel() for i, j, k in np.ndindex(2, 2, 2)]
    K, M = element_matrices.brick(*(length / count for length, count in zip(size, number, strict=True)))
    count = 3 * nx * (ny + 1) * (nz + 1)
    return Grid(count, (Block(_freedoms(corners, 3), K, M, np.arange(nx * ny * nz)),), np.arange(count))


def plate_grid(n: int) -> Grid:
    """A plate of 1.6 x 1.0 m, 10 mm thick, held at x = 0, of about n degrees of freedom."""
    h = (3 * 1.6 / n) ** 0.5
    nx, ny = max(1, round(1.6 / h)), max(1, round(1.0 / h))
    node = _numbered((nx + 1, ny + 1))
    corners = [node[i : i + nx, j : j + ny].ravel() for i, j in np.ndindex(2, 2)]
    K, M = element_matrices.plate(1.6 / nx, 1.0 / ny, 0.010)
    block = Block(_freedoms(corners, 3), K, M, np.arange(nx * ny))
    count = 3 * nx * (ny + 1)
    return Grid(count, (block,), np.arange(0, count, 3))


def frame_grid(n: int, degrees: float = 20.0) -> Grid:
    """A building of b by b + 1 bays of 6 and 5 m and storeys of 3.5 m, about 4 b of them; two beams a member.

    degrees: by how much its plan is turned against the axes. At 0 four of five entries of the beams' matrices are zero.
    """
    turn = np.deg2rad(degrees)
    R = np.array([[np.cos(turn), -np.sin(turn), 0.0], [np.sin(turn), np.cos(turn), 0.0], [0.0, 0.0, 1.0]])
    T = np.kron(np.eye(4), R)
    b = min(range(1, 60), key=lambda b: abs(_frame_size(b, 4 * b) - n))
    storeys = max(2, round(4 * b * n / _frame_size(b, 4 * b)))
    joint = _numbered((storeys + 1, b + 1, b + 2))
    members = (
        (2, 3.5, 0.45, 0.60, joint[:-1], joint[1:]),
        (0, 6.0, 0.30, 0.55, joint[1:, :-1], joint[1:, 1:]),
        (1, 5.0, 0.25, 0.50, joint[1:, :, :-1], joint[1:, :, 1:]),
    )
    blocks, known = [], joint.max() + 1
    for axis, length, width, height, one, other in members:
        K, M = (T @ matrix @ T.T for matrix in element_matrices.beam(length / BEAMS, axis, width, height))
        inner = known + np.arange(one.size * (BEAMS - 1)).reshape(one.size, BEAMS - 1)
        known += inner.size
        line = np.column_stack([one.ravel(), inner, other.ravel()])
        floor = np.repeat(np.arange(len(one)), BEAMS * one[0].size)
        blocks.append(Block(_freedoms([line[:, :-1].ravel(), line[:, 1:].ravel()], 6), K, M, floor))
    storey = (b + 1) * (b + 2)
    at_joints = np.arange(6 * storeys * storey).reshape(-1, 6)[:, :2].ravel()
    return Grid(6 * int(known), tuple(blocks), at_joints)


def _frame_size(b: int, storeys: int) -> int:
    """Degrees of freedom of the frame: joints, and the nodes within its columns and beams."""
    joints = (b + 1) * (b + 2)
    return 6 * storeys * (joints + (BEAMS - 1) * (joints + b * (b + 2) + (b + 1) ** 2))


def aligned_frame_grid(n: int) -> Grid:
    """The same building with its beams along the axes."""
    return frame_grid(n, 0.0)


GRIDS: dict[str, Callable[[int], Grid]] = {
    "solid": solid_grid,
    "plate": plate_grid,
    "frame": frame_grid,
    "aligned-frame": aligned_frame_grid,
}


def _numbered(shape: tuple[int, ...]) -> np.ndarray:
    """Numbers of the nodes, those of the first layer, which is held, negative."""
    return np.arange(np.prod(shape)).reshape(shape) - int(np.prod(shape[1:]))


def _freedoms(corners: list[np.ndarray], each: int) -> np.ndarray:
    """Degrees of freedom (e, corners x each) of elements with nodes `corners`; negative where a node is held."""
    return (np.stack(corners, axis=1)[:, :, None] * each + np.arange(each)).reshape(len(corners[0]), -1)


def groups(blocks: tuple[Block, ...], p: int) -> tuple[dict[str, list[np.ndarray]], int]:
    """Parameter of every element, elements in order of rank cut into equal groups; and how many of the p are stiffnesses."""
    masses = p // MASS_SHARE
    rank = np.concatenate([block.rank for block in blocks])
    order = np.empty(len(rank), int)
    order[np.argsort(rank, kind="stable")] = np.arange(len(rank))
    cuts = np.cumsum([len(block.rank) for block in blocks])[:-1]
    stiffness = order * (p - masses) // len(rank)
    mass = p - masses + order * masses // len(rank) if masses else np.full(len(rank), -1)
    return {"K": np.split(stiffness, cuts), "M": np.split(mass, cuts)}, p - masses


def model(kind: str, n: int, p: int) -> tuple[Structure, ElementGroups, np.ndarray, np.ndarray]:
    """Structure without constant part, its term, prior sd (p,), and where sensors may be, for about n degrees of freedom."""
    from scipy.sparse import csr_array

    grid = GRIDS[kind](n)
    which, stiffnesses = groups(grid.blocks, p)
    empty = csr_array((grid.n, grid.n))
    sd = np.where(np.arange(p) < stiffnesses, SD_STIFFNESS, SD_MASS)
    return Structure(empty, empty), ElementGroups(grid.blocks, which), sd, grid.translations


def problem(kind: str, n: int, p: int, modes: int = 30, sensors: int = 20, seed: int = 1972, **options) -> Problem:
    """The model `kind` (solid, plate, frame) with p factors, and the test of a structure drawn from its prior.

    modes natural frequencies with 0.2 % noise, mass-normalised shapes at `sensors` points with 1 % of their largest component.
    options: fields of RunOptions.
    """
    structure, term, sd, translations = model(kind, n, p)
    rng = np.random.default_rng(seed)
    truth = np.maximum(1 + sd * rng.standard_normal(p), 0.3)
    dofs = spread(translations, sensors)
    eigenvalues, shapes = reference_modes(*Assembly(structure, (term,), p).matrices(truth), modes)
    test = simulated(eigenvalues, shapes[dofs], dofs, rng)
    return with_factors(f"{kind} of {structure.n} degrees of freedom", structure, term, sd, test, **options)


def spread(translations: np.ndarray, sensors: int) -> np.ndarray:
    """Sensors at random: at even steps they might all look in one direction, and see nothing of the modes in the others."""
    return np.sort(np.random.default_rng(0).choice(translations, sensors, replace=False))


def simulated(eigenvalues: np.ndarray, seen: np.ndarray, dofs: np.ndarray, rng: np.random.Generator) -> ModalTest:
    """What a test reports of eigenvalues (m,) and shapes `seen` (s, m) at `dofs` (s,), with its noise and accuracies."""
    hz, (s, m) = np.sqrt(eigenvalues) / (2 * np.pi), seen.shape
    shape_sd = np.tile(SD_SHAPE * np.abs(seen).max(axis=0), (s, 1))
    noisy_hz = hz * (1 + SD_FREQUENCY * rng.standard_normal(m))
    noisy = seen + shape_sd * rng.standard_normal(seen.shape)
    return ModalTest(np.arange(1, m + 1), noisy_hz, hz * SD_FREQUENCY, dofs, noisy, shape_sd, "none")


def with_factors(title: str, structure: Structure, term, sd: np.ndarray, test: ModalTest, **options) -> Problem:
    """The problem of revising factors of nominal value 1 and prior standard deviations sd (p,), uncorrelated."""
    return Problem(
        title,
        structure,
        ListedElements.none(),
        np.zeros((0, len(sd))),
        tuple(Parameter(f"factor {i + 1}", s, 1.0) for i, s in enumerate(sd)),
        Gaussian(np.ones(len(sd)), sd**2),
        test,
        RunOptions(**options),
        terms=(term,),
    )


def reference_modes(K, M, count: int) -> tuple[np.ndarray, np.ndarray]:
    """The lowest eigenvalues and mass-normalised shapes by ARPACK around a factorisation: for data, and to compare with."""
    symbolic = Symbolic(K, M)
    sigma = shift(K, M, symbolic)
    return arpack(K, M, sigma, factorise(K, M, sigma, symbolic), count)
