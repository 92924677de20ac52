"""Bulk data of Nastran being translated: fields of its cards, findings with their places, and what became of them."""

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from mouse_cli.formats import nastran_fields
from mouse_cli.importing.cards import Card, Faults, Line

_HELP = "let Nastran write K and M (DMIG, OUTPUT4), or use what docs/how-to/import-models.md lists: bars, shells, solids, CONM2"


def text(card: nastran_fields.Card, at: int) -> str:
    """A field (from 0); empty beyond the last."""
    return card.fields[at] if at < len(card.fields) else ""


@dataclass
class BulkDeck:
    """Bulk data being translated; by: its cards by their names; found: what they became.

    at: where grid points are, in the basic system; turned: those that move in directions of their own.
    carried: nodes that masses of a rigid body (number of the RBE2) are spread over.
    """

    bulk: nastran_fields.Bulk
    faults: Faults
    by: dict[str, list[nastran_fields.Card]] = field(default_factory=dict)
    found: list[Card] = field(default_factory=list)
    names: dict[tuple[str, int], str] = field(default_factory=dict)
    mass: float = 1.0  # PARAM,WTMASS
    at: dict[int, np.ndarray] = field(default_factory=dict)
    turned: set[int] = field(default_factory=set)
    carried: dict[int, list[int]] = field(default_factory=dict)

    @cached_property
    def grids(self) -> list[int]:
        """Numbers of all grid points."""
        return sorted(self.whole(card, 0) for card in self.of("GRID"))

    @cached_property
    def grid_cards(self) -> dict[int, nastran_fields.Card]:
        """The cards of grid points by their numbers."""
        return {self.whole(card, 0): card for card in self.of("GRID")}

    @cached_property
    def numbers(self) -> set[int]:
        """Numbers of all elements, rigid ones and masses among them."""
        of = (name for name in self.by if name.startswith(("CB", "CE", "CON", "CR", "CT", "RB")))
        return {self.whole(card, 0) for name in of for card in self.by[name]}

    def of(self, *names: str) -> list[nastran_fields.Card]:
        """The cards of these names."""
        return [card for name in names for card in self.by.get(name, [])]

    def parameter(self, name: str, default: float) -> float:
        """The value of PARAM `name`; the last one counts."""
        given = [card for card in self.of("PARAM") if text(card, 0).upper() == name]
        return self.real(given[-1], 1) if given else default

    def chosen(self, name: str) -> int | None:
        """The set that case control asks for, as SPC = 2; None where it asks for none."""
        asked = (
            re.match(rf"\s*{name}\s*=\s*([0-9]+)", line, re.IGNORECASE) for line in self.bulk.lines[: self.bulk.begun]
        )
        return next((int(found[1]) for found in asked if found), None)

    def line(self, card: nastran_fields.Card, *words: object) -> Line:
        """A line of data with the place of the card that it comes from."""
        texts = [word if isinstance(word, str) else repr(word) for word in words]
        text = ", ".join(texts) + ("," if len(texts) == 1 else "")
        return Line(texts, text, *self.bulk.place(card.line), self.bulk.lines[card.line - 1])

    def card(self, of: nastran_fields.Card, keyword: str, lines: Iterable[Line] = (), **options: str) -> None:
        """Adds a card."""
        named = {key.replace("_", " "): value for key, value in options.items()}
        text = f"*{keyword}" + "".join(f", {key}={value}" for key, value in named.items())
        head = Line([], text, *self.bulk.place(of.line), self.bulk.lines[of.line - 1])
        self.found.append(Card(keyword, named, head, list(lines)))

    def single(
        self,
        card: nastran_fields.Card,
        name: str,
        number: int,
        keyword: str,
        nodes: list[int],
        data: list[Line],
        **options: str,
    ) -> None:
        """An element of a set of its own called `name`, a mass or a spring, with its section."""
        kind = "MASS" if keyword == "MASS" else f"SPRING{len(nodes)}"
        self.card(card, "ELEMENT", [self.line(card, number, *nodes)], TYPE=kind, ELSET=name)
        self.card(card, keyword, data, ELSET=name, **options)

    def refuse(self, card: nastran_fields.Card, message: str, help: str = _HELP, code: str = "MD268") -> None:
        """Notes what cannot be read."""
        self.faults.add(code, message, self.bulk.where(card), help)

    def global_directions(self, card: nastran_fields.Card, nodes: Iterable[int], components: str) -> None:
        """Notes a node that a card holds or joins in some directions of a system of its own, not in all of them."""
        whole = all(not part & set(components) or part <= set(components) for part in ({*"123"}, {*"456"}))
        of = [] if whole else [node for node in nodes if node in self.turned]
        if of:
            message = f"this {card.name} acts at grid point {of[0]} in directions of the point's own system"
            self.refuse(card, message, "let the point move in the basic system, or act in all three directions")

    def whole(self, card: nastran_fields.Card, at: int) -> int:
        return self.bulk.whole(card, at)

    def real(self, card: nastran_fields.Card, at: int) -> float:
        return self.bulk.real(card, at)

    def rest(self, card: nastran_fields.Card, at: int) -> list[int]:
        """Whole numbers of the fields from `at` on; 4 THRU 7 is 4, 7 and what grid points there are between."""
        words, numbers = [word.upper() for word in card.fields[at:] if word], []
        for k, word in enumerate(words):
            if word == "THRU" and numbers and k + 1 < len(words) and words[k + 1].isdigit():
                numbers += [n for n in self.grids if numbers[-1] < n < int(words[k + 1])]
            elif word.isdigit():
                numbers.append(int(word))
            else:
                self.bulk.refuse(card, f"'{word[:16]}' of this {card.name} is no whole number")
        return numbers

    def name(self, kind: str, number: int, default: str) -> str:
        """Of a property or a material: as comments give it."""
        return self.names.get((kind, number), default)
