"""Reads an input file of Abaqus, CalculiX or Nastran into an `InputModel`; what may change K or M and is not known is refused."""

from dataclasses import replace

import numpy as np

from mouse_cli.importing import bulk
from mouse_cli.importing.assembly import flat
from mouse_cli.importing.cards import Card, Faults, Line, cards, meant
from mouse_cli.importing.clamps import clamped
from mouse_cli.importing.groups import grouped
from mouse_cli.importing.keywords import NODES, PASSED, READ, RELEVANT, REMEDIES, TIES, WITHOUT_EFFECT
from mouse_cli.importing.local_axes import local_axes
from mouse_cli.importing.model import LAYER_MATERIAL, LAYER_ORIENTATION, InputModel, Material, layered, word_at
from mouse_cli.importing.supports import supports


def read(path: str, outside: bool = False) -> InputModel:
    """The model of an input file; outside: it may include files outside of its folder.

    Raises DeckError (MD231 to MD273) with all that is wrong, by file and line.
    """
    model, faults = InputModel(path), Faults()
    model.every = bulk.cards(bulk.opened(path, faults, outside)) if bulk.is_bulk(path) else flat(cards(path, outside), faults)
    faults.stop()
    known = [card for card in model.every if _understood(card, model, faults)]
    faults.stop()
    _steps(known, model, faults)
    for card in model.kept:
        if card.keyword in _READERS:
            _READERS[card.keyword](model, card, faults)
    if not model.elements and not faults.found:
        faults.add(
            "MD265",
            "the file has no elements",
            model.every[0].head.span if model.every else None,
            "give the job's input file",
        )
    faults.stop()
    clamps = supports(model, [card for card in known if card.keyword == "BOUNDARY"], faults)
    faults.stop()
    _materials(model, faults)
    grouped(model, faults)
    faults.stop()
    model.clamps = clamped(model, clamps, faults)
    faults.stop()
    model.kept = [card for card in model.kept if not _damps(card)]
    return model


def _damps(card: Card) -> bool:
    """Whether a card has dashpots for elements, which give nothing to K and M and whose *DASHPOT is not kept."""
    return card.keyword == "ELEMENT" and card.options.get("TYPE", "").startswith("DASHPOT")


def _understood(card: Card, model: InputModel, faults: Faults) -> bool:
    """Whether a card is read or passed on; others are counted where they have no effect on K and M, and refused where they may."""
    word = card.keyword
    marks = RELEVANT.get(word, ())
    if any(mark in line.text.upper() for line in card.lines for mark in marks):
        message = f"*{word} with {' or '.join(marks)} changes the stiffness with the speed"
        faults.add("MD268", message, card.head.span, "import the structure at rest")
    if word in READ or word in PASSED:
        return True
    if word in WITHOUT_EFFECT:
        model.ignored[word] = model.ignored.get(word, 0) + 1
        return word in ("FREQUENCY", "STATIC")
    help = meant(word, READ | PASSED, "take it out of a copy of the file if K and M do not depend on it")
    help = REMEDIES.get(word, help)
    faults.add("MD268", f"*{word[:40]} is not known, and may change K or M", card.head.span, help)
    return False


def _steps(known: list[Card], model: InputModel, faults: Faults) -> None:
    """Keeps the cards of the model; a step that stiffens the structure before the frequencies are taken is refused."""
    inside, loaded = False, False
    for card in known:
        if card.keyword == "STEP":
            inside, about = (
                True,
                "PERTURBATION" in card.options,
            )  # a perturbation of the model at rest, but after a load
            loaded, before = loaded or not about, loaded
            if (about and before) or card.options.get("NLGEOM", "NO") not in ("NO",):
                message = "the step takes the stresses of earlier loads into the stiffness"
                faults.add("MD268", message, card.head.span, "import the structure without load: take the option out")
        elif card.keyword == "END STEP":
            inside = False
        elif not inside and card.keyword not in ("BOUNDARY", "FREQUENCY", "STATIC"):
            model.kept.append(card)


def number(line: Line, word: str, faults: Faults, what: str, whole: bool = False) -> float | int:
    """A number of a line; 0 with a finding where it is none."""
    try:
        return int(word) if whole else float(word.upper().replace("D", "E"))
    except ValueError:
        faults.add("MD265", f"'{word[:30]}' is no {what}", line.span, "mend the line")
        return 0


def _node(model: InputModel, card: Card, faults: Faults) -> None:
    strange = [name for name in card.options if name not in ("NSET",)]
    if strange:
        message = f"*NODE with {strange[0]} is not read"
        faults.add(
            "MD268", message, card.head.span, "give nodes in the global rectangular system, in this file or by *INCLUDE"
        )
        return
    own = []
    for line in card.lines:
        words = [*line.words, "0", "0", "0"][:4]
        n = number(line, words[0], faults, "number of a node", whole=True)
        model.nodes[n] = np.array([number(line, word or "0", faults, "coordinate") for word in words[1:]])
        own.append(n)
    if "NSET" in card.options:
        model.nsets.setdefault(card.options["NSET"], []).extend(own)


def _element(model: InputModel, card: Card, faults: Faults) -> None:
    kind = card.options.get("TYPE", "")
    if kind not in NODES:
        help = "elements that are read: " + ", ".join(NODES)
        faults.add("MD269", f"elements of type '{kind[:20]}' are not read", card.head.span, help)
        return
    own, words, first = [], [], None
    for line in card.lines:
        first = first or line
        words += [word for word in line.words if word]
        if len(words) < 1 + NODES[kind]:
            continue
        values = [number(first, word, faults, "number of an element or node", whole=True) for word in words]
        if len(values) > 1 + NODES[kind]:
            message = f"an element of type {kind} has {NODES[kind]} nodes; {len(values) - 1} are given"
            faults.add("MD265", message, first.span, "mend the line or the type")
        if values[0] in model.elements:
            faults.add("MD265", f"element {values[0]} is given twice", first.span, "renumber the elements")
        _nodes_known(model, values[1:], first, faults)
        model.elements[values[0]] = (kind, tuple(values[1:]))
        own.append(values[0])
        words, first = [], None
    if words:
        message = f"the last element has {len(words) - 1} of {NODES[kind]} nodes"
        faults.add("MD265", message, first.span, "mend the line or the type")
    if "ELSET" in card.options:
        model.elsets.setdefault(card.options["ELSET"], []).extend(own)


def _nodes_known(model: InputModel, nodes: list[int], line: Line, faults: Faults) -> None:
    absent = [n for n in nodes if n not in model.nodes]
    if absent:
        faults.add(
            "MD272", f"node {absent[0]} has no coordinates", line.span, "give it below *NODE, before the elements"
        )


def _set(name: str):
    """Reader of *NSET or *ELSET."""

    def read_set(model: InputModel, card: Card, faults: Faults) -> None:
        sets, members = (model.nsets, model.nodes) if name == "NSET" else (model.elsets, model.elements)
        if name not in card.options:
            faults.add("MD265", f"*{name} has no name", card.head.span, f"write *{name}, {name}=NAME")
            return
        if name == "NSET" and "ELSET" in card.options:
            _nodes_of_elements(model, card, faults)
        found = sets.setdefault(card.options[name], [])
        for line in card.lines:
            if "GENERATE" in card.options:
                values = [number(line, word, faults, "number", whole=True) for word in line.words[:3]]
                low, high, step = [*values, 1][:3] if len(values) > 1 else (*values, *values, 1)
                found += [n for n in range(low, high + 1, max(step, 1)) if n in members]
                continue
            for word in line.words:
                found += members_of(word, line, sets, members, faults)

    return read_set


def _nodes_of_elements(model: InputModel, card: Card, faults: Faults) -> None:
    """*NSET, ELSET=, which the solver does not know, becomes one with the nodes of these elements."""
    elements = members_of(card.options.pop("ELSET"), card.head, model.elsets, model.elements, faults)
    nodes = sorted({node for e in elements for node in model.elements[e][1]})
    text = f"*NSET, NSET={card.options['NSET']}"
    card.head = replace(card.head, text=text)
    card.lines = [replace(card.head, words=[str(node)], text=f"{node},") for node in nodes]


def members_of(word: str, line: Line, sets: dict, members: dict, faults: Faults) -> list[int]:
    """What a number or the name of a set stands for."""
    if word.lstrip("-").isdigit():
        if int(word) in members:
            return [int(word)]
        faults.add("MD272", f"{int(word)} is no number of the model", line.span, "mend the number")
        return []
    name = word.strip('"').upper()
    if name not in sets:
        help = meant(name, sets, "define the set above, or mend its name")
        faults.add("MD272", f"there is no set '{word[:40]}'", line.span, help)
    return list(sets.get(name, []))


def _transform(model: InputModel, card: Card, faults: Faults) -> None:
    """*TRANSFORM: its directions may be those of supports and of *EQUATION, and of no other constraint."""
    words = [word for line in card.lines for word in line.words if word]
    data = [number(card.lines[0], word, faults, "coordinate") for word in words[:6]]
    ties = [each for each in model.kept if each.keyword in TIES - {"EQUATION"}]
    if ties:
        message = f"*TRANSFORM beside *{ties[0].keyword}, whose directions it may turn"
        faults.add("MD268", message, card.head.span, "give constraints and boundary conditions in global directions")
    for node in members_of(card.options.get("NSET", ""), card.head, model.nsets, model.nodes, faults):
        axes = None if len(data) < 6 else local_axes(card.options.get("TYPE", "R"), np.array(data), model.nodes[node])
        if axes is None:
            message = f"*TRANSFORM gives no directions at node {node}"
            faults.add("MD265", message, card.head.span, "give two points, TYPE=R or TYPE=C, and no node on the axis")
            return
        model.turned[node] = axes


def _material(model: InputModel, card: Card, faults: Faults) -> None:
    name = card.options.get("NAME", "")
    if not name or name in model.materials:
        message = f"material '{name[:40]}' is given twice" if name else "*MATERIAL has no name"
        faults.add("MD265", message, card.head.span, "write *MATERIAL, NAME=..., each once")
    model.materials[name] = Material(name, card)


def _layers(model: InputModel, card: Card, faults: Faults) -> None:
    """Layers of a laminate: one at an angle of zero to the section has no orientation of its own."""
    for k, line in enumerate(card.lines if layered(card) else ()):
        turned = word_at(line, LAYER_ORIENTATION)
        if turned.strip("+-.0123456789"):
            continue
        if turned.strip("+-.0"):
            message = f"the layer is turned by an angle, {turned[:20]} degrees, which CalculiX does not read"
            faults.add("MD268", message, line.span, "name an *ORIENTATION whose first axis is along the fibres")
        words = [word_at(line, 0), "", word_at(line, LAYER_MATERIAL)]
        card.lines[k] = replace(line, words=words, text=", ".join(words))


def _of_material(attribute: str):
    """Reader of a card of the material above."""

    def read_card(model: InputModel, card: Card, faults: Faults) -> None:
        if not model.materials or not card.lines:
            message = f"*{card.keyword} belongs to no material" if card.lines else f"*{card.keyword} has no data"
            faults.add("MD265", message, card.head.span, "write it with its data below its *MATERIAL")
            return
        if attribute == "density" and len(card.lines) > 1:
            faults.add(
                "MD268", "the density varies with temperature", card.lines[1].span, "give the value at test temperature"
            )
        for line in card.lines:
            for word in filter(None, line.words):
                number(line, word, faults, "number")
        setattr(list(model.materials.values())[-1], attribute, card)

    return read_card


def _materials(model: InputModel, faults: Faults) -> None:
    for material in model.materials.values():
        if material.elastic is not None and material.isotropic and len(material.elastic.lines) > 1:
            span = material.elastic.lines[1].span
            faults.add(
                "MD268", f"E of {material.name} varies with temperature", span, "give the value at test temperature"
            )


_READERS = {
    "NODE": _node,
    "ELEMENT": _element,
    "NSET": _set("NSET"),
    "ELSET": _set("ELSET"),
    "TRANSFORM": _transform,
    "MATERIAL": _material,
    "SHELL SECTION": _layers,
    "ELASTIC": _of_material("elastic"),
    "DENSITY": _of_material("density"),
}
