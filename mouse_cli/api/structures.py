"""Structures from parts, and structures that are changed: decks that hold `couple:` or `modify:`."""

import os

from mouse_cli.coupling import couple as coupled_answer
from mouse_cli.coupling import modify as modified_answer
from mouse_cli.formats import file_bytes
from mouse_cli.model.coupled import Coupled
from mouse_cli.model.modified import Modified


def couple(deck: str | os.PathLike[str], *, outside: bool = False) -> Coupled:
    """Couple or decouple the substructures of a YAML deck that holds `couple:`, as `mouse couple` does.

    outside: the deck may name files outside of its own folder. Raises DeckError with all that is wrong with the deck,
    NumericalError where the interface allows no answer.

    >>> import mouse_cli
    >>> whole = mouse_cli.couple("decks/coupled/portal.yaml")
    >>> whole.functions.H.shape, whole.modes.frequencies_hz[:2].round(2).tolist()
    ((237, 2, 1), [6.45, 22.49])
    """
    from mouse_cli.formats.yaml_deck import coupled

    path = os.fspath(deck)
    return coupled_answer(coupled.read(file_bytes(path), path, outside))


def modify(deck: str | os.PathLike[str], *, outside: bool = False) -> Modified:
    """The effect of added masses, springs, dashpots and absorbers that a YAML deck states under `modify:`, as `mouse modify`.

    outside: the deck may name files outside of its own folder. Raises DeckError with all that is wrong with the deck,
    NumericalError where the modified structure has no modes.

    >>> import mouse_cli
    >>> found = mouse_cli.modify("decks/coupled/portal_calmed.yaml")
    >>> found.before.frequencies_hz[:2].round(2).tolist(), found.after.frequencies_hz[:2].round(2).tolist()
    ([6.45, 22.49], [5.48, 7.11])
    """
    from mouse_cli.formats.yaml_deck import modified

    path = os.fspath(deck)
    return modified_answer(modified.read(file_bytes(path), path, outside=outside))
