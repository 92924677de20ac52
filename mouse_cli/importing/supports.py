"""Supports of an input file, by the names of their node sets."""

from collections.abc import Callable, Iterable

from mouse_cli._errors import WARNING, Diagnostic
from mouse_cli.importing.cards import Card, Faults, Line, meant
from mouse_cli.importing.clamps import HELP
from mouse_cli.importing.keywords import WORDS, expanded
from mouse_cli.importing.model import InputModel, Support

_LAST = 6


def supports(model: InputModel, boundary: list[Card], faults: Faults) -> dict[int, Line]:
    """Puts what *BOUNDARY holds into the model; lines that name one set are one support.

    Returns the nodes of shells whose rotations are held, each with a line that holds some.
    """
    by_name: dict[str, Support] = {}
    taken: dict[tuple[int, int], str] = {}
    clamped: dict[int, Line] = {}
    beams = _nodes_of(model, lambda kind: expanded(kind) and not kind.startswith("S"))
    soft, solid = _nodes_of(model, expanded), _nodes_of(model, lambda kind: kind.startswith("C3D"))
    for card in boundary:
        for line in card.lines:
            name, nodes = _held(model, line, faults)
            first, last = _directions(line, faults)
            own = by_name.setdefault(name, Support(name, [], card))
            if last > 3 and not soft & set(nodes) and solid.issuperset(nodes):
                last = 3  # solids have no rotations that could be held
            for node in nodes:
                if last > 3 and node in soft:
                    if node in beams:
                        message = (
                            f"rotations of node {node} are held, which belongs to beams that CalculiX makes solids of"
                        )
                        faults.add("MD273", message, line.span, HELP)
                        break
                    clamped.setdefault(node, line)
                _hold(model, own, [(node, d) for d in range(first, last + 1)], taken, line)
    _turned(model, by_name.values(), set(taken), faults)
    model.supports += [support for support in by_name.values() if support.dofs]
    return clamped


def _turned(model: InputModel, found: Iterable[Support], held: set[tuple[int, int]], faults: Faults) -> None:
    """A node of *TRANSFORM that is held in some of its directions has these in the deck; refused where a shell has it that CalculiX
    holds otherwise. One that is held in all needs no directions.
    """
    quadratic = {node for node, count in model.layers.items() if count > 2}
    for support in found:
        own = []
        for node, d in support.dofs:
            first = 1 if d <= 3 else 4
            if node not in model.turned or {(node, k) for k in range(first, first + 3)} <= held:
                continue
            if d > 3 or node in quadratic:
                what = "rotations" if d > 3 else "a corner of S6, S8 or S8R"
                message = f"node {node} of support {support.name} is held in some directions of *TRANSFORM alone: {what}"
                faults.add("MD273", message, support.card.head.span, "hold it in global directions, or in all three")
                break
            own.append(node)
        if own:
            model.own_axes |= {node: model.turned[node] for node in own}
            message = f"support {support.name} holds node {own[0]} in some directions of *TRANSFORM ({len(set(own))} such nodes)"
            help = "their degrees of freedom in the deck have these directions: give what sensors measure there in them"
            model.remarks.append(Diagnostic("MD273", WARNING, message, support.card.head.span, help=help))


def _hold(model: InputModel, own: Support, dofs: list[tuple[int, int]], taken: dict, line: Line) -> None:
    for dof in dofs:
        other = taken.setdefault(dof, own.name)
        if other == own.name:
            if dof not in own.dofs[-_LAST:]:
                own.dofs.append(dof)
        elif not any(each.span == line.span for each in model.remarks):
            message = f"node {dof[0]} is held by {other} and by {own.name}: it counts as one of {other}"
            help = "give the two supports nodes of their own if one of them may be loose"
            model.remarks.append(Diagnostic("MD273", WARNING, message, line.span, help=help))


def _held(model: InputModel, line: Line, faults: Faults) -> tuple[str, list[int]]:
    """The name of a support and its nodes."""
    word = line.words[0].strip('"')
    if word.isdigit():
        if int(word) not in model.nodes:
            faults.add("MD272", f"node {word} is held, but has no coordinates", line.span, "mend the number")
        return f"NODE_{int(word)}", [int(word)]
    name = word.upper()
    if name not in model.nsets:
        help = meant(name, model.nsets, "define the set, or mend its name")
        faults.add("MD272", f"there is no node set '{word[:40]}'", line.span, help)
    elif not model.nsets[name]:
        faults.add(
            "MD272", f"node set {name} is held, and has no nodes", line.span, "list its nodes, or take the line out"
        )
    return name, list(dict.fromkeys(model.nsets.get(name, [])))


def _directions(line: Line, faults: Faults) -> tuple[int, int]:
    """First and last direction, 1 to 6."""
    words = [*line.words[1:], "", "", ""][:3]
    if words[0].upper() in WORDS:
        held = WORDS[words[0].upper()]
        if held == tuple(range(held[0], held[-1] + 1)):
            return held[0], held[-1]
    if not words[0].isdigit() or not (words[1] or words[0]).isdigit():
        message, help = (
            f"'{words[0][:20]}' is no direction that is read",
            "give directions 1 to 6, a line for each range",
        )
        faults.add("MD273", message, line.span, help)
        return 1, 0
    first, last = int(words[0]), int(words[1] or words[0])
    if not 1 <= first <= last <= _LAST:
        if first != 11:  # temperature
            faults.add("MD273", f"directions {first} to {last} are held", line.span, "give directions 1 to 6")
        return 1, 0
    return first, last


def _nodes_of(model: InputModel, which: Callable[[str], bool]) -> set[int]:
    """Nodes of elements of such types."""
    return {node for kind, nodes in model.elements.values() if which(kind) for node in nodes}
