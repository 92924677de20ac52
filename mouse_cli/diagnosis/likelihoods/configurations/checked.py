"""Whether decks are arrangements of one structure: with modes, the same parameters and prior, and the same errors of theory."""

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli.model.problem import Problem


def checked(problems: tuple[Problem, ...]) -> None:
    """Refuse decks that are no arrangements of one structure (MD690, MD691)."""
    first = problems[0]
    for each in problems:
        if each.test is None or each.hold_out is not None:
            raise DeckError.of(
                "MD691",
                "configurations are diagnosed by their measured modes, and held out as a whole;  "
                + ("this deck has none" if each.test is None else "this deck holds out a part of its test"),
                each.place("test"),
                help="give test.modes without hold_out; name whole decks with --held-out",
            )
        if _parameters(each) != _parameters(first) or not _alike(each, first):
            names = ", ".join(p.name for p in first.parameters) or "none"
            raise DeckError.of(
                "MD690",
                f"its parameters are not those of {first.source.path} ({names}, with their values, sd and transforms)",
                each.place("parameters"),
                help="write the same parameters and prior in every configuration",
            )
        if each.theory != first.theory:
            raise DeckError.of(
                "MD690",
                f"its errors of theory are not those of {first.source.path}",
                each.place("theory"),
                help="write the same theory in every configuration: they are models of one structure",
            )


def _parameters(problem: Problem) -> list[tuple]:
    return [(p.name, p.nominal, p.sd, p.transform) for p in problem.parameters]


def _alike(one: Problem, other: Problem) -> bool:
    """Whether prior means and covariances are the same."""
    return bool(
        np.array_equal(one.prior.mean, other.prior.mean) and np.array_equal(one.prior.dense(), other.prior.dense())
    )
