"""Groups of elements: those that share section, material and named sets, so that every named set is a union of groups."""

from mouse_cli._errors import WARNING, Diagnostic
from mouse_cli.importing.cards import Card, Faults, meant
from mouse_cli.importing.keywords import SECTIONS
from mouse_cli.importing.model import Group, InputModel, materials_of

_MOST = 200  # groups
_OWNERS = (*SECTIONS, "MASS", "SPRING")


def grouped(model: InputModel, faults: Faults) -> None:
    """Divides the elements of each section, *MASS and *SPRING by the named sets that they are in."""
    owner: dict[int, Card] = {}
    for card in model.kept:
        if card.keyword in _OWNERS:
            _owned(model, card, owner, faults)
    _unowned(model, owner, faults)
    if faults.found:
        return
    sets = _named_sets(model)
    for card in dict.fromkeys(map(id, owner.values())):
        own = [e for e, each in owner.items() if id(each) == card]
        _divided(model, owner[own[0]], own, sets)
    used = {group.material.name for group in model.groups if group.material is not None}
    for name, material in model.materials.items():
        if name not in used:
            message, help = f"material {name} is of no section", "name it in a section, or delete it"
            model.remarks.append(Diagnostic("MD271", WARNING, message, material.card.head.span, help=help))
    if len(model.groups) > _MOST:
        message = f"the element sets divide the model into {len(model.groups)} groups; at most {_MOST} are taken"
        faults.add("MD270", message, model.kept[0].head.span, "delete sets that no diagnosis needs")


def _owned(model: InputModel, card: Card, owner: dict[int, Card], faults: Faults) -> None:
    name, place = card.options.get("ELSET", ""), card.head.span
    if name not in model.elsets:
        message = f"*{card.keyword} is for element set '{name[:40]}', which does not exist"
        help = meant(name, model.elsets, "define the set above")
        faults.add("MD272", message, place, help)
        return
    if card.keyword in SECTIONS:
        _material_known(model, card, faults)
    if card.keyword == "SPRING" and "NONLINEAR" in card.options:
        faults.add(
            "MD268", "a nonlinear spring has no one stiffness", place, "give its stiffness at rest, without NONLINEAR"
        )
    kinds = SECTIONS.get(card.keyword, (card.keyword,))
    for e in dict.fromkeys(model.elsets[name]):
        kind = model.elements[e][0]
        if not kind.startswith(kinds):
            message = f"*{card.keyword} is for set {name}, whose element {e} is of type {kind}"
            faults.add("MD270", message, place, "give each type of element its own section")
            return
        if e in owner:
            first = owner[e].head
            message = (
                f"element {e} of set {name} has a section already, at {first.file}:{first.number}, for set "
                f"{owner[e].options.get('ELSET')}: the sets overlap"
            )
            faults.add("MD270", message, place, "let no two sections share an element")
            return
        owner[e] = card


def _material_known(model: InputModel, card: Card, faults: Faults) -> None:
    for name in materials_of(card):
        found = model.materials.get(name)
        if found is None:
            help = meant(name, model.materials, "define it with *MATERIAL, or mend its name")
            faults.add("MD271", f"there is no material '{name[:40]}'", card.head.span, help)
        elif found.elastic is None:
            faults.add("MD271", f"material {name} has no *ELASTIC", found.card.head.span, "give its Young's modulus")
        elif found.density is None:
            help = "give it, in the units of the file"
            faults.add("MD271", f"material {name} has no *DENSITY", found.card.head.span, help)


def _unowned(model: InputModel, owner: dict[int, Card], faults: Faults) -> None:
    left = [e for e, (kind, _) in model.elements.items() if e not in owner and not kind.startswith("DASHPOT")]
    if left:
        of = [name for name, members in model.elsets.items() if left[0] in members]
        inside = f", of set {of[0]}," if of else ""
        place = next(card.head.span for card in model.kept if card.keyword == "ELEMENT")
        message = f"element {left[0]}{inside} has no section ({len(left)} such elements)"
        faults.add("MD271", message, place, "give its set a section with a material, *MASS or *SPRING")


def _named_sets(model: InputModel) -> dict[int, list[str]]:
    """Names of the sets of each element, the smallest first."""
    found: dict[int, list[str]] = {}
    for name, members in sorted(model.elsets.items(), key=lambda item: len(set(item[1]))):
        for e in dict.fromkeys(members):
            found.setdefault(e, []).append(name)
    return found


def _divided(model: InputModel, card: Card, own: list[int], sets: dict[int, list[str]]) -> None:
    """Groups of one section, named by the smallest set that holds them; by two sets where that one has other elements too."""
    parts: dict[tuple[str, ...], list[int]] = {}
    for e in own:
        parts.setdefault(tuple(sorted(sets.get(e, []))), []).append(e)
    materials = [model.materials[name] for name in materials_of(card)] if card.keyword in SECTIONS else [None]
    for elements in parts.values():
        names = sets[elements[0]]
        whole = next((name for name in names if set(model.elsets[name]) == set(elements)), None)
        name = whole or " in ".join(names[:2])
        for material in materials:
            own = f"{material.name} in {name}" if material is not None and len(materials) > 1 else name
            taken = {group.name for group in model.groups}
            if own in taken:
                own = next(f"{own} ({i})" for i in range(2, len(taken) + 3) if f"{own} ({i})" not in taken)
            model.groups.append(Group(own, elements, card, material))
