"""CBAR, CBEAM, CROD, CONROD and CTUBE of Nastran bulk data as beams and rods.

Nastran's plane 1 is that of the local x and y axes, in which the orientation vector lies; there I1 is Iz, and K1 is kappa_y.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.formats import nastran_fields
from mouse_cli.importing.bars.parts import Bars, named
from mouse_cli.importing.bars.properties import Profile, profiles
from mouse_cli.importing.bulk_deck import text
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.terms.elements import Layout
from mouse_cli.terms.elements._beam import TRANSLATIONAL, span

_SMALL = 1e-9  # lengths and sines that count as zero, of the length of the element
_FLAGS = ("", "1", "GGG", "GGO", "GOG", "GOO", "BGG", "BGO", "BOG", "BOO")  # 1: of older decks, a vector is given
_AXES = "give them along the axes of its points"
_SECTION = ("A", "Iy", "Iz", "J")


def elements(bars: Bars) -> None:
    """All of them, each with the constants of its property and material."""
    deck, known = bars.deck, profiles(bars.deck)
    lumped = deck.parameter("COUPMASS", -1.0) <= 0
    for card in deck.of("CBAR", "CBEAM", "CROD", "CTUBE", "CONROD"):
        profile = (
            _of_its_own(bars, card) if card.name == "CONROD" else known.get(deck.whole(card, 1) or deck.whole(card, 0))
        )
        at = 1 if card.name == "CONROD" else 2
        nodes = deck.whole(card, at), deck.whole(card, at + 1)
        if profile is None:
            if not _noted(bars, deck.whole(card, 1)):
                deck.refuse(
                    card, f"this {card.name} has no property that is read", "give its PBAR, PBEAM or PROD", "MD271"
                )
            continue
        material = _material(bars, profile)
        if material is None or not bars.known(card, nodes):
            continue
        if np.linalg.norm(deck.at[nodes[1]] - deck.at[nodes[0]]) == 0 and card.name not in ("CBAR", "CBEAM"):
            deck.refuse(card, f"this {card.name} has no length", "move one of its points", "MD265")
        elif card.name in ("CBAR", "CBEAM"):
            _beam(bars, card, nodes, profile, material, lumped)
        else:
            _rod(bars, card, nodes, profile, material, lumped)


def _noted(bars: Bars, number: int) -> bool:
    """Whether a property is there, and was refused by itself."""
    names = ("PBAR", "PBARL", "PBEAM", "PBEAML", "PROD", "PTUBE")
    return any(bars.deck.whole(card, 0) == number for card in bars.deck.of(*names))


def _of_its_own(bars: Bars, card: nastran_fields.Card) -> Profile:
    deck = bars.deck
    name = f"CONROD_{deck.whole(card, 0)}"
    mass = deck.real(card, 7) * deck.mass
    return Profile(name, card, deck.whole(card, 3), deck.real(card, 4), J=deck.real(card, 5), mass=mass)


def _material(bars: Bars, profile: Profile) -> str | None:
    """The name of the material of a profile, which becomes one of the deck; None where there is none that is read."""
    deck = bars.deck
    card = next((card for card in deck.of("MAT1") if deck.whole(card, 0) == profile.material), None)
    if card is None:
        message = f"{profile.name} is of material {profile.material}, of which there is no MAT1"
        return deck.refuse(profile.card, message, "give its MAT1", "MD271")
    name = deck.name("MAT", profile.material, f"MAT1_{profile.material}")
    E, G, nu = (deck.real(card, k) for k in (1, 2, 3))
    if not E and not G:
        return deck.refuse(card, "this MAT1 has no modulus", "give E", "MD271")
    E = E or 2 * G * (1 + nu)
    own = {"E": E}
    if text(card, 3):
        own["nu"] = nu
    elif G:
        own["nu"] = E / (2 * G) - 1
    if "nu" in own and G and text(card, 3) and abs(2 * G * (1 + nu) - E) > 0.01 * E:
        own["G"] = G  # a material that is not isotropic in shear
    elif not -1 < own.get("nu", 0.0) < 1:
        own |= {"G": G, "nu": 0.0}
    density = deck.real(card, 4) * deck.mass
    bars.materials[name] = own | ({"density": density} if density else {})
    return name


def _beam(bars: Bars, card, nodes: tuple[int, int], profile: Profile, material: str, lumped: bool) -> None:
    deck, offsets = bars.deck, _offsets(bars, card, nodes)
    across = _across(bars, card, nodes)
    if offsets is None or across is None:
        return
    along = deck.at[nodes[1]] + offsets.get(2, 0.0) - deck.at[nodes[0]] - offsets.get(1, 0.0)
    length = np.linalg.norm(along)
    if not length or np.linalg.norm(np.cross(along, across)) <= _SMALL * length * np.linalg.norm(across):
        wrong = "no length" if not length else "no orientation: its vector is along it, or absent"
        return deck.refuse(card, f"this {card.name} has {wrong}", "give a vector that is not along it", "MD265")
    releases = {end: named(int(d) - 1 for d in text(card, 7 + end)) for end in (1, 2) if text(card, 7 + end).strip("0")}
    across, Iy, Iz = _principal(bars, card, profile, nodes, across, offsets, releases)
    properties, origin = _constants(bars, material, replace(profile, Iy=Iy, Iz=Iz))
    options = {"mass": TRANSLATIONAL} if lumped else {}
    if profile.kappa is not None:
        options |= {"theory": "timoshenko", "rotary_inertia": "omitted"}
        properties |= dict(zip(("kappa_y", "kappa_z"), profile.kappa, strict=True))
        origin |= dict.fromkeys(("kappa_y", "kappa_z"), profile.name)
    options["orientation"] = across.tolist()
    options |= {"offsets": {end: vector.tolist() for end, vector in offsets.items()}} if offsets else {}
    options |= {"releases": releases} if releases else {}
    bars.add(card, "beam", nodes, properties, options=options, origin=origin)


def _constants(bars: Bars, material: str, profile: Profile) -> tuple[dict[str, float], dict[str, str]]:
    """Properties of a beam, and the names of material and section that they are of."""
    own = bars.materials[material]
    section = {name: getattr(profile, name) for name in _SECTION}
    origin = dict.fromkeys(own, material) | dict.fromkeys(section, profile.name)
    if "nu" not in own and "G" not in own:  # Nastran takes both for zero: no stiffness in torsion
        section["J"] = 0.0
        origin.pop("J")
    mass = {"nonstructural_mass": profile.mass} if profile.mass else {}
    return own | section | mass, origin


def _rod(bars: Bars, card, nodes: tuple[int, int], profile: Profile, material: str, lumped: bool) -> None:
    """A rod; its stiffness in torsion, G J / l, is a spring that turns about it."""
    own, deck = bars.materials[material], bars.deck
    properties = {name: value for name, value in own.items() if name in ("E", "density")} | {"A": profile.A}
    origin = {name: material if name in own else profile.name for name in properties}
    mass = {"nonstructural_mass": profile.mass} if profile.mass else {}
    options = {"mass": "lumped"} if lumped else {}
    bars.add(card, "rod", nodes, properties | mass, options=options, origin=origin)
    G = own.get("G", own["E"] / (2 * (1 + own["nu"])) if "nu" in own else 0.0)
    if profile.J and G:
        along = deck.at[nodes[1]] - deck.at[nodes[0]]
        length = float(np.linalg.norm(along))
        axes = [(along / length).tolist(), np.eye(3)[np.argmin(np.abs(along))].tolist()]
        bars.add(card, "spring", nodes, {"RX": G * profile.J / length}, options={"axes": axes})


def _offsets(bars: Bars, card, nodes: tuple[int, int]) -> dict[int, np.ndarray] | None:
    """Vectors from the nodes to the ends, in the basic system; None where they are in another than that of the nodes."""
    found = {}
    for end, node in enumerate(nodes, 1):
        first = 10 + 3 * (end - 1)
        vector = np.array([bars.deck.real(card, first + k) for k in range(3)])
        if vector.any():
            found[end] = bars.axes(node) @ vector
    if found and "O" in text(card, 7).upper():
        return bars.deck.refuse(card, f"the offsets of this {card.name} are along its own axes", _AXES)
    if card.name == "CBEAM" and (text(card, 16) or text(card, 17)):
        return bars.deck.refuse(card, "this CBEAM warps", "leave SA and SB out where warping matters little")
    return found


def _across(bars: Bars, card, nodes: tuple[int, int]) -> np.ndarray | None:
    """The orientation vector (3,), in the basic system: to a grid point, or given in the system of the first one."""
    deck, words = bars.deck, [text(card, k) for k in (4, 5, 6)]
    if words[0].isdigit() and not any(words[1:]):
        towards = deck.whole(card, 4)
        return deck.at[towards] - deck.at[nodes[0]] if bars.known(card, [towards]) else None
    if text(card, 7).upper() not in _FLAGS:
        return deck.refuse(
            card,
            f"this {card.name} has the flag '{text(card, 7)[:8]}'; expected such as GGG",
            "leave it empty",
            "MD265",
        )
    vector = np.array([deck.real(card, k) for k in (4, 5, 6)])
    return (bars.systems.made[0].R if text(card, 7).upper().startswith("B") else bars.axes(nodes[0])) @ vector


def _principal(
    bars: Bars, card, profile: Profile, nodes: tuple[int, int], across: np.ndarray, offsets: dict, releases: dict
) -> tuple[np.ndarray, float, float]:
    """Orientation vector, Iy and Iz of principal axes, where the property has a product of inertia Iyz."""
    if not profile.Iyz or abs(profile.Iyz) <= _SMALL * max(profile.Iy, profile.Iz):
        return across, profile.Iy, profile.Iz
    bent = {DIRECTIONS[k] for k in (1, 2, 4, 5)}
    mixed = any(
        len(bent & set(names)) not in (0, 4) and bent & set(names) != {"RY", "RZ"} for names in releases.values()
    )
    if mixed or (profile.kappa is not None and profile.kappa[0] != profile.kappa[1]):
        what = "pin flags of one plane" if mixed else "shear"
        bars.deck.refuse(
            card, f"this {card.name} has a product of inertia I12 and {what}", "give I1 and I2 of principal axes"
        )
    at = np.array([[bars.deck.at[node] for node in nodes]])
    axes = span(Layout(at, {"orientation": across, "offsets": offsets})).axes[0]
    (Iz, Iy), turned = np.linalg.eigh([[profile.Iz, profile.Iyz], [profile.Iyz, profile.Iy]])
    return turned[:, 0] @ axes[1:], float(Iy), float(Iz)
