"""Parts and instances, as Abaqus/CAE writes them, made one model: numbers count on from one instance to the next."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from mouse_cli.importing.cards import Card, Faults, Line
from mouse_cli.importing.keywords import NODES, SECTIONS, WITHOUT_EFFECT
from mouse_cli.importing.model import LAYER_ORIENTATION, layered

_BLOCKS = {"PART", "ASSEMBLY", "INSTANCE", "END PART", "END ASSEMBLY", "END INSTANCE"}
_MATERIAL = {"MATERIAL", "ELASTIC", "DENSITY"}
_NAMED = {
    "ELSET",
    "NSET",
    "NAME",
    "ORIENTATION",
    "REF NODE",
    "ROT NODE",
    "SURFACE",
    "CONSTRAINT NAME",
}  # options with names
_DROPPED = {"INSTANCE", "INTERNAL", "UNSORTED"}
_LISTS = {"NSET", "ELSET", "SURFACE", "TIE"}  # keywords whose data are names and numbers
_AS_THEY_ARE = {
    *SECTIONS,
    "MASS",
    "SPRING",
    "DASHPOT",
    "ORIENTATION",
    "COUPLING",
    "KINEMATIC",
    "DISTRIBUTING",
    "RIGID BODY",
}


@dataclass
class _Instance:
    """name; cards in its coordinates, of its part and its own; nodes, elements: what its numbers are raised by.

    R (3, 3), t (3,): where a point x of the part is, R x + t.
    """

    name: str
    cards: list[Card]
    nodes: int = 0
    elements: int = 0
    R: np.ndarray = field(default_factory=lambda: np.eye(3))
    t: np.ndarray = field(default_factory=lambda: np.zeros(3))


def flat(every: list[Card], faults: Faults) -> list[Card]:
    """The cards without parts and instances: nodes where they stand, sets called INSTANCE_SET where a name is not its own."""
    if not any(card.keyword in _BLOCKS for card in every):
        return every
    model, assembly, instances = _blocks(every, faults)
    faults.stop()
    own = _Instance("", assembly)
    for before, after in zip([*instances, own], [*instances[1:], own], strict=False):
        after.nodes = before.nodes + _highest(before.cards, "NODE") if after is not before else after.nodes
        after.elements = before.elements + _highest(before.cards, "ELEMENT") if after is not before else after.elements
    at_top = {card.options.get(key) for card in assembly for key in ("NSET", "ELSET", "NAME")}
    by = {each.name: each for each in instances}

    def called(instance: _Instance, word: str) -> str:
        """A name or a number of an instance, in the model."""
        word = word.strip('"').upper()
        of, dot, rest = word.partition(".")
        if dot and of in by:
            return called(by[of], rest)
        if word.isdigit():
            return str(int(word) + instance.nodes)
        return word if not instance.name or (len(by) == 1 and word not in at_top) else f"{instance.name}_{word}"

    found = [card for card in model if card.keyword in _MATERIAL]
    for instance in [*instances, own]:
        for card in instance.cards:
            of = by.get(card.options.get("INSTANCE", ""), instance)
            names = [lambda word, each=each: called(each, word) for each in (instance, of)]
            found.append(_moved(card, of, *names, instance is own, faults))
    for card in model:
        if card.keyword == "BOUNDARY":
            card.lines = [_line(line, [called(own, line.words[0]), *line.words[1:]]) for line in card.lines]
        if card.keyword not in _MATERIAL:
            found.append(card)
    return found


def _blocks(every: list[Card], faults: Faults) -> tuple[list[Card], list[Card], list[_Instance]]:
    """Cards of the model, those of the assembly, and its instances."""
    model, assembly, parts, instances = [], [], {}, []
    into = model
    for card in every:
        if card.keyword == "PART":
            into = parts.setdefault(card.options.get("NAME", ""), [])
        elif card.keyword == "INSTANCE":
            part = parts.get(card.options.get("PART", ""))
            if part is None:
                name = card.options.get("PART", "")[:40]
                faults.add("MD272", f"there is no part '{name}'", card.head.span, "define it above, or mend its name")
            instances.append(_placed(_Instance(card.options.get("NAME", ""), list(part or [])), card, faults))
            into = instances[-1].cards
        elif card.keyword in ("ASSEMBLY", "END INSTANCE"):
            into = assembly
        elif card.keyword in ("END PART", "END ASSEMBLY"):
            into = model
        else:
            into.append(card)
    return model, assembly, instances


def _placed(instance: _Instance, card: Card, faults: Faults) -> _Instance:
    """Moved by the first line of data, then turned by the second: two points of an axis, and an angle in degrees."""
    try:
        data = [[float(word) for word in line.words] for line in card.lines]
    except ValueError:
        faults.add("MD265", "the place of an instance is no list of numbers", card.lines[0].span, "mend the line")
        return instance
    if data:
        instance.t = np.array((data[0] + [0.0] * 3)[:3])
    if len(data) > 1 and len(data[1]) == 7:
        a, b, angle = np.array(data[1][:3]), np.array(data[1][3:6]), np.deg2rad(data[1][6])
        x, y, z = (b - a) / np.linalg.norm(b - a)
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        instance.R = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
        instance.t = instance.R @ (instance.t - a) + a
        turned = [each for each in instance.cards if each.keyword in ("ORIENTATION", "BEAM SECTION")]
        if turned:
            message = f"*{turned[0].keyword} of an instance that is turned is not read"
            faults.add("MD268", message, turned[0].head.span, "write the input without parts and assemblies")
    return instance


def _highest(cards: list[Card], keyword: str) -> int:
    """A number that no node or element in them exceeds."""
    words = (line.words[0] for card in cards if card.keyword == keyword for line in card.lines if line.words)
    return max((int(word) for word in words if word.isdigit()), default=0)


def _moved(
    card: Card, of: _Instance, named: Callable[[str], str], called: Callable[[str], str], top: bool, faults: Faults
) -> Card:
    """A card with the numbers and names of the model; named: what its options name; called: what its data name, of `of`."""
    options = {key: named(value) if key in _NAMED and value else value for key, value in card.options.items()}
    options = {key: value for key, value in options.items() if key not in _DROPPED}
    head = replace(
        card.head, text=f"*{card.keyword}" + "".join(f", {k}={v}" if v else f", {k}" for k, v in options.items())
    )
    lines = card.lines
    if card.keyword == "NODE":
        lines = [_node(line, of, faults) for line in lines]
    elif card.keyword == "ELEMENT":
        lines = _elements(card, of, called)
    elif card.keyword in _LISTS:
        raised = of.elements if card.keyword in ("ELSET", "SURFACE") else of.nodes
        lines = [_line(line, _members(line, card, raised, called)) for line in lines]
    elif layered(card):
        lines = [_layer(line, named) for line in lines]
    elif card.keyword not in _AS_THEY_ARE | WITHOUT_EFFECT:
        where = "the assembly" if top else "a part"
        help = "write the input without parts and assemblies: in Abaqus/CAE, Model attributes"
        faults.add("MD268", f"*{card.keyword[:40]} of {where} is not read", card.head.span, help)
    return Card(card.keyword, options, head, lines)


def _layer(line: Line, named: Callable[[str], str]) -> Line:
    """A layer with the name that its orientation has in the model."""
    after = [named(word) if word.strip("+-.0123456789") else word for word in line.words[LAYER_ORIENTATION:]]
    return _line(line, [*line.words[:LAYER_ORIENTATION], *after])


def _members(line: Line, card: Card, raised: int, called: Callable[[str], str]) -> list[str]:
    """Numbers and names of a set; the step of a range, and the side of a surface, are neither."""
    count = 2 if "GENERATE" in card.options else 1 if card.keyword == "SURFACE" else len(line.words)
    own = [str(int(word) + raised) if word.isdigit() else called(word) for word in line.words[:count]]
    return own + line.words[count:]


def _node(line: Line, of: _Instance, faults: Faults) -> Line:
    try:
        x = of.R @ np.array([float(word or 0) for word in [*line.words[1:], "0", "0", "0"][:3]]) + of.t
        return _line(line, [str(int(line.words[0]) + of.nodes), *map(repr, x.tolist())])
    except ValueError:
        faults.add("MD265", "a line of *NODE is no list of numbers", line.span, "mend the line")
        return line


def _elements(card: Card, of: _Instance, called: Callable[[str], str]) -> list[Line]:
    """A line for each element, and one for what goes beyond it."""
    found, left = [], 0
    for line in card.lines:
        words = [word for word in line.words if word]
        numbers = [called(word) for word in words]
        if not left:
            left = 1 + NODES.get(card.options.get("TYPE", ""), len(words) - 1)
            numbers[0] = str(int(words[0]) + of.elements) if words[0].isdigit() else words[0]
        left = max(left - len(words), 0)
        found.append(replace(_line(line, numbers), text=", ".join(numbers) + ("," if left else "")))
    return found


def _line(line: Line, words: list[str]) -> Line:
    return replace(line, words=words, text=", ".join(words) + ("," if len(words) == 1 else ""))
