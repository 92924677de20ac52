"""mouse couple: substructures put together or taken apart."""

from dataclasses import replace

import click

from mouse_cli.cli._options import QUIET, answer, options


@click.command()
@click.argument("deck")
@click.option(
    "--functions", "written_to", metavar="FILE", help="Write the functions of the whole to FILE: .npz, .unv or .uff."
)
@click.option(
    "--truncate",
    type=click.FloatRange(min=0, max=1),
    help="Leave out singular values of the interface below this share of the largest.",
)
@click.option("--plot", metavar="PATH", help="Write figures: to a folder, or to one file (.pdf, .png, .svg).")
@options(answer("mouse.coupling/1"))
@options(QUIET)
def command(
    deck: str, written_to: str | None, truncate: float | None, plot: str | None, quiet: bool, **how: str | None
) -> int:
    """Couple the substructures of DECK, a YAML deck that holds `couple:`.

    Functions of the whole from models and measured functions, rigid or elastic connections; natural frequencies by modal coupling.

    Exit 1: noise decides the interface at more than a few lines.
    """
    from mouse_cli.cli._decks import deck_bytes, shown
    from mouse_cli.cli._terminal import deliver, json_text, progress, show_diagnostics
    from mouse_cli.coupling import couple
    from mouse_cli.formats.frf_files import write_frf
    from mouse_cli.formats.yaml_deck import coupled
    from mouse_cli.report import document, written

    _require_plots(plot)
    coupling = coupled.read(deck_bytes(deck), shown(deck))
    if truncate is not None:
        coupling = replace(coupling, truncate=truncate)
    if written_to and not coupling.responses:
        raise click.UsageError("--functions: the deck asks for none; give it responses and forces")
    with progress() as (_, say):
        found = couple(coupling, say)
    if not quiet:
        show_diagnostics(found.warnings)
    if written_to:
        write_frf(found.functions, written_to, coupling.units)
    _draw(found, plot)
    form, numbers = how["form"] or "printout", how["numbers"] or "modern"
    deliver(json_text(document(found)) if form == "json" else written(found, form, numbers), how["output"], deck)
    return int(any(d.code == "MD713" for d in found.warnings))


def _require_plots(plot: str | None) -> None:
    if plot:
        from mouse_cli.plots import require

        require(plot)


def _draw(found: object, plot: str | None) -> None:
    if plot:
        from mouse_cli.plots import draw

        draw(found, plot)
