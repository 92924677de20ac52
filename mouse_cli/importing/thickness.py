"""K and M of a shell section by powers of its thickness t, from exports at several.

K(t) = K_0 + sum_n K_n (t / t_0)^n. Of a shell with rotations n = 1 (membrane, shear) and 3 (bending). CalculiX makes solids of
shells, whose unknowns through the thickness are displacements: those see 1 / t and t, and, where shells meet and turn as one body,
powers up to 3.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import ERROR, DeckError, Diagnostic
from mouse_cli._span import Span
from mouse_cli.importing.calculix import Exported, Solver
from mouse_cli.importing.cards import Card
from mouse_cli.importing.jobs import export
from mouse_cli.importing.model import InputModel
from mouse_cli.importing.separate import difference
from mouse_cli.model.arrays import Matrix

POWERS = (1, 2, 3, -1)
_SIZES = (0.7, 0.85, 1.2, 1.4, 1.6)  # t / t_0 of the exports: one more than powers
_OPEN = 1e-9  # of the largest difference: what the powers may leave of the exports


@dataclass(frozen=True)
class Thickness:
    """Of section `name`, t_0 in the units of the file; K and M (n, n) by power, without those that are nothing."""

    name: str
    nominal: float
    K: dict[int, Matrix]
    M: dict[int, Matrix]
    exports: int = len(_SIZES)

    @property
    def powers(self) -> tuple[int, ...]:
        """Those of K or M, 1 first."""
        return tuple(dict.fromkeys((1, *self.K, *self.M)))


def chosen(model: InputModel, names: tuple[str, ...]) -> list[Card]:
    """Shell sections of those element sets. Raises DeckError (MD272) where there is none."""
    shells = {c.options.get("ELSET", ""): c for c in model.kept if c.keyword == "SHELL SECTION"}
    absent = [name for name in names if name.upper() not in shells]
    if absent:
        message = f"--thickness {absent[0]}: no *SHELL SECTION is for that element set"
        help = f"give one of {', '.join(shells)}" if shells else "only shells have a thickness"
        raise DeckError(Diagnostic("MD272", ERROR, message, Span(model.path, 1), help=help))
    return [shells[name.upper()] for name in dict.fromkeys(names)]


def thicknesses(model: InputModel, sections: list[Card], whole: Exported, solver: Solver) -> list[Thickness]:
    """Each section by its powers. Raises DeckError (MD274, MD275)."""
    own, found = set(model.nodes), []
    for card in sections:
        jobs = [(export(model, thick=(card, size)), f"{_name(card)} {size:g} times as thick") for size in _SIZES]
        solver.begin(jobs)
        exports = [solver.matrices(*job, own) for job in jobs]
        K, M = (
            _by_power(model, card, [difference(getattr(one, x), getattr(whole, x)) for one in exports]) for x in "KM"
        )
        found.append(Thickness(_name(card), float(card.lines[0].words[0]), K, M))
    return found


def _by_power(model: InputModel, card: Card, moved: list[Matrix]) -> dict[int, Matrix]:
    """Least squares over K(t) - K(t_0) = sum_n K_n ((t / t_0)^n - 1)."""
    B = np.array(_SIZES)[:, None] ** np.array(POWERS, float) - 1
    solve = np.linalg.pinv(B)
    found = [sum(weight * each for weight, each in zip(row, moved, strict=True)).tocsr() for row in solve]
    largest = max(abs(each).max() for each in moved)
    left = [
        each - sum(b * part for b, part in zip(row, found, strict=True)) for row, each in zip(B, moved, strict=True)
    ]
    error = max(abs(each).max() for each in left)
    if not error <= _OPEN * largest:
        message = f"powers of the thickness of {_name(card)} leave {error / largest:.2g} of what exports differ by"
        help = "its shells are not of constant thickness, or of a type whose stiffness goes otherwise: leave out --thickness"
        raise DeckError(Diagnostic("MD275", ERROR, message, card.head.span, help=help))
    kept = {n: _clean(part, largest) for n, part in zip(POWERS, found, strict=True)}
    return {n: part for n, part in kept.items() if part.nnz}


def _clean(part: Matrix, largest: float) -> Matrix:
    """Without what rounding leaves."""
    part.data[abs(part.data) <= _OPEN * largest] = 0.0
    part.eliminate_zeros()
    return part


def _name(card: Card) -> str:
    return card.options["ELSET"]
