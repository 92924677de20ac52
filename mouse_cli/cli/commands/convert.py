"""mouse convert: card decks to YAML and back."""

import click

from mouse_cli.cli._options import PRIOR, READING, earlier, options


@click.command()
@click.argument("deck")
@click.option(
    "-o", "--output", metavar="FILE", help="Write to FILE (.dat: cards, .yaml: YAML) instead of standard output."
)
@click.option("--to", type=click.Choice(["cards", "yaml"]), help="The format to write; by default the other one.")
@click.option("--lossy", is_flag=True, help="Write cards even when they cannot hold everything; losses are reported.")
@options(PRIOR, READING)
def command(deck: str, output: str | None, to: str | None, lossy: bool) -> int:
    """Convert DECK to the other format, cards to YAML or back.

    With --prior the YAML deck has the posterior of an earlier test as its prior. Exit 4 when cards cannot hold the deck.
    """
    from mouse_cli.cli._decks import read_problem
    from mouse_cli.cli._terminal import deliver, show_diagnostics

    problem = read_problem(deck, **earlier())
    show_diagnostics(problem.warnings)
    if (to or _format(output, problem.source.format)) == "cards":
        from mouse_cli.formats.cards import writer as card_writer

        text, findings = card_writer.write(problem, lossy=lossy)
        show_diagnostics(findings)
        deliver(text, output, deck)
    elif output in (None, "-"):
        from mouse_cli.formats import yaml_deck

        text, attachments = yaml_deck.write(problem)
        if attachments:
            raise click.UsageError("the deck has matrices that go to files of their own: name the deck with -o")
        deliver(text, output, deck)
    else:
        from mouse_cli.formats import write_deck

        write_deck(problem, output)
    return 0


def _format(output: str | None, source: str) -> str:
    """The format of the file `output` by its suffix; without one, the format that `source` is not."""
    if output and output.endswith((".yaml", ".yml")):
        return "yaml"
    if output and output.endswith(".dat"):
        return "cards"
    return "yaml" if source == "cards" else "cards"
