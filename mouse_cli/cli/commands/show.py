"""mouse show: a deck as a reader understands it."""

import click

from mouse_cli.cli._options import READING, options, outside, reading


@click.command()
@click.argument("deck")
@options(READING)
def command(deck: str) -> int:
    """Show DECK as read.

    Cards with their fields named, YAML in canonical form. A card deck is shown even when it has errors, as far as it was read.
    """
    from mouse_cli._errors import MouseError
    from mouse_cli.cli._decks import deck_bytes, shown
    from mouse_cli.cli._terminal import say, show_diagnostics
    from mouse_cli.formats import is_yaml, read_draft
    from mouse_cli.formats.assemble import assemble

    data, how = deck_bytes(deck), reading()
    if not is_yaml(data, deck):
        from mouse_cli.formats.cards import show as card_show

        say(card_show.describe(data, **how))
    try:
        problem = assemble(read_draft(data, shown(deck), outside=outside(), **how))
    except MouseError as error:
        show_diagnostics(error.diagnostics)
        return error.exit_code
    show_diagnostics(problem.warnings)
    if problem.source.format == "yaml":
        from mouse_cli.formats import yaml_deck

        say(yaml_deck.write(problem)[0], end="")
    return 0
