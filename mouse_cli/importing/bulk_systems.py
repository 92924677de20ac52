"""Local systems of coordinates of Nastran bulk data: where their points are, and which nodes move in directions of their own."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.formats import nastran_fields
from mouse_cli.importing.bulk_deck import BulkDeck

_SMALL = 1e-9  # of the length of an axis: points of a system that are on one line


@dataclass(frozen=True)
class System:
    """origin (3,) and axes R (3, 3), as columns, in the basic system; kind: R rectangular, C cylindrical, S spherical."""

    origin: np.ndarray
    R: np.ndarray
    kind: str

    def place(self, x: np.ndarray) -> np.ndarray:
        """A point (3,) of this system, angles in degrees, in the basic one."""
        if self.kind == "C":
            r, angle = x[0], np.deg2rad(x[1])
            x = np.array([r * np.cos(angle), r * np.sin(angle), x[2]])
        elif self.kind == "S":
            r, down, round = x[0], np.deg2rad(x[1]), np.deg2rad(x[2])
            x = r * np.array([np.sin(down) * np.cos(round), np.sin(down) * np.sin(round), np.cos(down)])
        return self.origin + self.R @ x


class Systems:
    """The systems of the bulk data by their numbers, each made when it is asked for; 0: the basic one."""

    def __init__(self, deck: BulkDeck, basic: np.ndarray | None = None):
        """basic: axes (3, 3) of the basic system, as columns, in the one that everything is to be stated in; None: its own."""
        self.deck = deck
        self.made = {0: System(np.zeros(3), np.eye(3) if basic is None else basic, "R")}
        self.cards: dict[int, tuple[nastran_fields.Card, int]] = {}
        for card in deck.of(*(f"CORD{n}{kind}" for n in "12" for kind in "RCS")):
            for at in (0, 4) if card.name[4] == "1" else (0,):
                if deck.whole(card, at):
                    self.cards[deck.whole(card, at)] = card, at

    def system(self, number: int, of: nastran_fields.Card, above: tuple[int, ...] = ()) -> System:
        """Raises nothing: what is wrong is noted, and the basic system stands for it."""
        if number in self.made:
            return self.made[number]
        wrong = "is defined by itself" if number in above else "is not defined" if number not in self.cards else ""
        if not wrong:
            card, at = self.cards[number]
            points = self._points(card, at, (*above, number))
            z, x = points[1] - points[0], points[2] - points[0]
            y = np.cross(z, x)
            if np.linalg.norm(y) > _SMALL * np.linalg.norm(z) * np.linalg.norm(x):
                axes = [each / np.linalg.norm(each) for each in (np.cross(y, z), y, z)]
                self.made[number] = System(points[0], np.column_stack(axes), card.name[5])
                return self.made[number]
            of, wrong = card, "has its three points on one line"
        self.deck.refuse(of, f"the system of coordinates {number} {wrong}", "mend its number or its points", "MD272")
        self.made[number] = self.made[0]
        return self.made[0]

    def _points(self, card: nastran_fields.Card, at: int, above: tuple[int, ...]) -> list[np.ndarray]:
        """Origin, a point of the z axis and one of the plane of x and z, in the basic system."""
        deck = self.deck
        if card.name[4] == "1":
            grids = [deck.whole(card, at + k) for k in (1, 2, 3)]
            return [self.grid(n, card, above) for n in grids]
        of = self.system(deck.whole(card, 1), card, above)
        return [of.place(np.array([deck.real(card, 2 + 3 * p + k) for k in range(3)])) for p in range(3)]

    def grid(self, number: int, of: nastran_fields.Card, above: tuple[int, ...] = ()) -> np.ndarray:
        """Where a grid point is, in the basic system."""
        card = self.deck.grid_cards.get(number)
        if card is None:
            self.deck.refuse(of, f"grid point {number} is not defined", "mend the number", "MD272")
            return np.zeros(3)
        system = self.system(self.deck.whole(card, 1), card, above)
        return system.place(np.array([self.deck.real(card, k) for k in (2, 3, 4)]))

    def directions(self, number: int) -> np.ndarray:
        """Directions (3, 3) that a grid point moves in, as columns, in the basic system: radial and so on in round systems."""
        card = self.deck.grid_cards[number]
        system = self.system(self.deck.whole(card, 5), card)
        if system.kind == "R":
            return system.R
        x, y, z = system.R.T @ (self.deck.at[number] - system.origin)
        round, down = np.arctan2(y, x), np.arctan2(np.hypot(x, y), z)
        about = np.array([-np.sin(round), np.cos(round), 0.0])
        out = np.array([np.cos(round), np.sin(round), 0.0])
        up = np.array([0.0, 0.0, 1.0])
        if system.kind == "C":
            return system.R @ np.column_stack([out, about, up])
        radial, fallen = np.sin(down) * out + np.cos(down) * up, np.cos(down) * out - np.sin(down) * up
        return system.R @ np.column_stack([radial, fallen, about])

    def turned(self, card: nastran_fields.Card) -> bool:
        """Whether a GRID moves in directions of its own."""
        number = self.deck.whole(card, 5)
        if not number:
            return False
        system = self.system(number, card)
        return system.kind != "R" or not np.allclose(system.R, np.eye(3), rtol=0, atol=_SMALL)
