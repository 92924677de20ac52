"""What SPC, SPC1 and GRID of Nastran bulk data hold, as cards of CalculiX."""

from mouse_cli.formats import nastran_fields
from mouse_cli.importing.bulk_deck import BulkDeck, text

Held = dict[tuple[str, str], list[tuple[nastran_fields.Card, list[int]]]]


def held(deck: BulkDeck) -> Held:
    """Cards and grid points by the name of a support and its components: one for each SPC1, for all SPC of a set, and for GRID."""
    found: Held = {}
    for card in _chosen(deck):
        number = deck.whole(card, 0)
        if card.name == "SPC":
            for at in (1, 4):
                if text(card, at):
                    found.setdefault((f"SPC_{number}", text(card, at + 1)), []).append((card, [deck.whole(card, at)]))
                    if deck.real(card, at + 2):
                        deck.refuse(card, "this SPC moves its node", "hold it at 0")
        else:
            name = f"SPC1_{number}_{1 + len({n for n, _ in found if n.startswith(f'SPC1_{number}_')})}"
            found[name, text(card, 1)] = [(card, deck.rest(card, 2))]
    for card in deck.of("GRID"):
        if text(card, 6):
            found.setdefault(("GRID", text(card, 6)), []).append((card, [deck.whole(card, 0)]))
    for (_, components), each in found.items():
        if set(components) - set("0123456"):
            deck.refuse(each[0][0], f"'{components[:8]}' are no directions", "give some of 123456", "MD265")
    return {key: each for key, each in found.items() if not set(key[1]) - set("0123456")}


def supports(deck: BulkDeck) -> None:
    """What is held, as sets of nodes and their boundary conditions."""
    for k, ((name, components), each) in enumerate(held(deck).items()):
        known = {card.options.get("NSET") for card in deck.found}
        name = f"{name}_{k}" if name in known else name
        deck.card(each[0][0], "NSET", [deck.line(card, str(n)) for card, nodes in each for n in nodes], NSET=name)
        for card, nodes in each:
            deck.global_directions(card, nodes, components)
        lines = [deck.line(each[0][0], name, run[0], run[-1]) for run in _runs(components)]
        deck.card(each[0][0], "BOUNDARY", lines)


def _chosen(deck: BulkDeck) -> list[nastran_fields.Card]:
    """SPC and SPC1 of the set that case control asks for, or of the only one. Notes several without a choice."""
    every = deck.of("SPC", "SPC1")
    sets = {deck.whole(card, 0) for card in every}
    number = deck.chosen("SPC")
    if number is None and len(sets) > 1:
        listed = ", ".join(map(str, sorted(sets)))
        deck.refuse(
            every[0], f"no case control chooses among the sets {listed} of SPC", "write SPC = and its number", "MD273"
        )
    known = sets | {deck.whole(card, 0) for card in deck.of("SPCADD")}
    if number is not None and number not in known and every:
        listed = ", ".join(map(str, sorted(known)))
        message = f"case control asks for SPC = {number}, and the bulk data have the sets {listed}"
        deck.refuse(every[0], message, "mend the number in the case control, or take the line out to let nothing be held", "MD273")
    wanted: set[int] = {number} if number is not None else sets
    for card in deck.of("SPCADD"):
        if deck.whole(card, 0) in wanted:
            wanted |= set(deck.rest(card, 1))
    return [card for card in every if deck.whole(card, 0) in wanted]


def _runs(components: str) -> list[str]:
    """Directions that follow one another: 12 and 456 of 12456."""
    return "".join(d if d in components else " " for d in "123456").split()
