"""Inputs for CalculiX: the model without supports, chosen groups of elements scaled, and the model as it was with its supports."""

from collections.abc import Iterable

from mouse_cli.importing.cards import Card, Line
from mouse_cli.importing.keywords import NODES, SECTIONS, TIES
from mouse_cli.importing.model import LAYER_MATERIAL, Group, InputModel, Material, word_at

SCALE = 2.0  # of the moduli, densities, springs and masses of a group, in the job that tells its matrices
_MATRICES = ["*STEP", "*FREQUENCY, SOLVER=MATRIXSTORAGE", "1", "*END STEP"]
_PER_LINE, _LONGEST = 8, 20


def export(model: InputModel, scaled: Iterable[int] = (), thick: float = 1.0, gone: Iterable[int] = ()) -> str:
    """The job that writes K and M without supports; every group has a section of its own, those of `scaled` with SCALE.

    thick: thickness of all shells over that of the file. gone: elements that are left out.
    """
    scaled, gone, lines = set(scaled), set(gone), []
    owners = {id(group.owner) for group in model.groups}
    for card in model.kept:
        if id(card) not in owners:
            lines += without(card, model, gone) if gone and card.keyword in ("ELEMENT", "ELSET") else card.text()
    factors = {id(group): (SCALE if i in scaled else 1.0,) * 2 for i, group in enumerate(model.groups)}
    for i, alike in enumerate(of_same_elements(model.groups)):
        if gone and gone.issuperset(alike[0].elements):
            continue
        lines += section(alike, f"MOUSE_{i}", factors, thick if alike[0].shell else 1.0)
    return "\n".join([*lines, *_MATRICES]) + "\n"


def frequencies(model: InputModel, count: int | None) -> str:
    """The job of the model as it was written, with its supports, for its lowest frequencies; None: for its matrices."""
    lines = [text for card in model.kept for text in card.text()]
    held = [f"{node}, {d}, {d}" for support in model.supports for node, d in support.dofs]
    step = _MATRICES if count is None else ["*STEP", "*FREQUENCY", str(count), "*END STEP"]
    return "\n".join([*lines, *(["*BOUNDARY", *held] if held else []), *step]) + "\n"


def probed(model: InputModel, dofs: list[tuple[int, int]]) -> tuple[str, dict[int, int]]:
    """The job of K with a spring of stiffness 1 from each of the (node, direction) to a node of its own; those, by their number."""
    text, first = export(model).removesuffix("\n".join(_MATRICES) + "\n"), max(model.nodes) + 1
    element, lines = max(model.elements) + 1, ["*NODE"]
    lines += [f"{first + k}, {', '.join(map(real, model.nodes[node].tolist()))}" for k, (node, _) in enumerate(dofs)]
    for d in sorted({d for _, d in dofs}):
        lines.append(f"*ELEMENT, TYPE=SPRING2, ELSET=MOUSE_PROBE_{d}")
        lines += [f"{element + k}, {node}, {first + k}" for k, (node, own) in enumerate(dofs) if own == d]
        lines += [f"*SPRING, ELSET=MOUSE_PROBE_{d}", f"{d}, {d}", "1.0"]
    return text + "\n".join([*lines, *_MATRICES]) + "\n", {first + k: k for k in range(len(dofs))}


def colours(model: InputModel) -> list[list[int]]:
    """Groups (numbers) that one job can scale together: no two of them share a node, or are joined by a constraint."""
    touched = [{node for e in group.elements for node in model.elements[e][1]} for group in model.groups]
    joined = _joined(model)
    near = [bool(nodes & joined) for nodes in touched]
    classes: list[list[int]] = []
    order = sorted(range(len(touched)), key=lambda i: -len(touched[i]))
    for i in order:
        apart = lambda j, i=i: not (touched[i] & touched[j]) and not (near[i] and near[j])
        own = next((each for each in classes if all(map(apart, each))), None)
        if own is None:
            classes.append([i])
        else:
            own.append(i)
    return classes


def _joined(model: InputModel) -> set[int]:
    """Nodes that constraints may touch: all of them, where a constraint names surfaces or sets that are not followed."""
    ties = [card for card in model.kept if card.keyword in TIES]
    if not ties:
        return set()
    if any(card.keyword not in ("EQUATION", "MPC") for card in ties):
        return set(model.nodes)
    words = (word for card in ties for line in card.lines for word in line.words)
    return {int(word) for word in words if word.isdigit()} & set(model.nodes)


def of_same_elements(groups: Iterable[Group]) -> list[list[Group]]:
    """Groups together that have the same elements: the materials of a laminate."""
    found: dict[tuple[int, int], list[Group]] = {}
    for group in groups:
        found.setdefault((id(group.owner), group.elements[0]), []).append(group)
    return list(found.values())


def section(
    alike: list[Group], name: str, factors: dict[int, tuple[float, float]], thickness: float = 1.0
) -> list[str]:
    """The cards that give groups of the same elements their properties, in a set and of materials called `name`.

    factors: of stiffness and mass of a group (by id), (1, 1) where there are none.
    """
    group = alike[0]
    stiffness, mass = factors.get(id(group), (1.0, 1.0))
    lines = [f"*ELSET, ELSET={name}", *listed(group.elements)]
    options = {"ELSET": name} | {k: v for k, v in group.owner.options.items() if k not in ("ELSET", "MATERIAL")}
    data = [line.text for line in group.owner.lines]
    if group.laminate:
        called = {each.material.name: f"{name}_{k}" for k, each in enumerate(alike)}
        for each in alike:
            own = constants(each.material, *factors.get(id(each), (1.0, 1.0)))
            lines += [f"*MATERIAL, NAME={called[each.material.name]}", *own]
        data = [_layer(line, called) for line in group.owner.lines]
    elif group.owner.keyword in SECTIONS:
        lines += [f"*MATERIAL, NAME={name}", *constants(group.material, stiffness, mass)]
        options["MATERIAL"] = name
    head = "".join(f", {key}={value}" if value else f", {key}" for key, value in options.items())
    if thickness != 1.0:
        data = [times(group.owner, 0, thickness, of=1), *data[1:]]
    elif group.owner.keyword == "MASS" and data:
        data = [times(group.owner, 0, mass)]
    elif group.owner.keyword == "SPRING" and data:
        at = 0 if len(data) == 1 else 1
        data = [*data[:at], times(group.owner, at, stiffness, of=1)]
    return [*lines, f"*{group.owner.keyword}{head}", *data]


def _layer(line: Line, called: dict[str, str]) -> str:
    """A layer of a laminate with the new name of its material."""
    words = list(line.words)
    words[LAYER_MATERIAL] = called[word_at(line, LAYER_MATERIAL).upper()]
    return ", ".join(words)


def constants(material: Material, stiffness: float, mass: float) -> list[str]:
    """*ELASTIC and *DENSITY of a material, its moduli and its density times these factors."""
    return [*elastic(material, stiffness), "*DENSITY", times(material.density, 0, mass, of=1)]


def elastic(material: Material, factor: float) -> list[str]:
    """*ELASTIC with the moduli times `factor`."""
    card = material.elastic
    kind = card.options.get("TYPE", "ISO")
    if kind in ("ISO", "ISOTROPIC"):
        return [card.head.text, times(card, 0, factor, of=1)]
    if kind == "ENGINEERING CONSTANTS":
        words = [word for line in card.lines for word in line.words if word]
        values = [float(word) * (1.0 if 3 <= k < 6 else factor) for k, word in enumerate(words[:9])]
        return [card.head.text, ", ".join(map(real, values[:8])) + ",", ", ".join(map(real, values[8:]))]
    return [card.head.text, *(times(card, k, factor) for k in range(len(card.lines)))]


def times(card: Card, line: int, factor: float, of: int | None = None) -> str:
    """A line of numbers times `factor`: the first `of` of them, or all."""
    words = [word for word in card.lines[line].words if word]
    count = len(words) if of is None else of
    ended = "," if card.lines[line].text.rstrip().endswith(",") and of is None else ""
    return (
        ", ".join([*(real(float(w.upper().replace("D", "E")) * factor) for w in words[:count]), *words[count:]]) + ended
    )


def real(value: float) -> str:
    """A number with the decimal point that CalculiX needs, within the 20 characters that it reads.

    >>> real(7e10), real(1e-5), real(1 / 3)
    ('70000000000.0', '1.0e-05', '0.3333333333333333')
    """
    text = repr(float(value))
    mantissa, mark, exponent = text.partition("e")
    text = f"{mantissa}.0e{exponent}" if mark and "." not in mantissa else text
    return text if len(text) <= _LONGEST else f"{value:.12e}"


def listed(numbers: list[int]) -> list[str]:
    return [", ".join(map(str, numbers[i : i + _PER_LINE])) + "," for i in range(0, len(numbers), _PER_LINE)]


def without(card: Card, model: InputModel, gone: set[int]) -> list[str]:
    """A card of elements, or of a set of them, without those that are gone."""
    if card.keyword == "ELSET":
        if "GENERATE" in card.options or not gone & set(model.elsets.get(card.options.get("ELSET", ""), ())):
            return card.text()
        left = [e for e in dict.fromkeys(model.elsets[card.options["ELSET"]]) if e not in gone]
        return [card.head.text, *listed(left)] if left else []
    words = [int(word) for line in card.lines for word in line.words if word]
    size = 1 + NODES[card.options["TYPE"]]
    each = [words[i : i + size] for i in range(0, len(words), size)]
    kept = [line for element in each if element[0] not in gone for line in listed(element)]
    return [card.head.text, *(kept if size > 8 else [line.rstrip(",") for line in kept])] if kept else []
