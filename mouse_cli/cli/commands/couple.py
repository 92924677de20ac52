"""mouse couple: substructures put together or taken apart."""

from dataclasses import replace

import click

from mouse_cli.cli._answers import deliver_answer
from mouse_cli.cli._options import OUTSIDE, QUIET, answer, options, outside, plotting
from mouse_cli.model.coupling import Coupling


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
@click.option(
    "--prior",
    "priors",
    multiple=True,
    metavar="PART=RESULT",
    help="What `mouse run --json` found of the model of a part.",
)
@options(plotting(), answer("mouse.coupling/1"), OUTSIDE, QUIET)
def command(deck: str, written_to: str | None, truncate: float | None, priors: tuple[str, ...]) -> int:
    """Couple or decouple the substructures of DECK.

    DECK is a YAML deck that holds `couple:`. FRFs of the assembly from models and measured FRFs, rigid or elastic
    connections; natural frequencies by modal coupling.

    Exit 1: noise decides the interface at more than a few lines.
    """
    from mouse_cli.cli._decks import deck_bytes, shown
    from mouse_cli.cli._terminal import check_figures, progress, warn
    from mouse_cli.coupling import couple
    from mouse_cli.formats.frf_files import write_frf
    from mouse_cli.formats.yaml_deck import coupled

    check_figures()
    coupling = _with_results(coupled.read(deck_bytes(deck), shown(deck), outside()), priors)
    if truncate is not None:
        coupling = replace(coupling, truncate=truncate)
    if written_to and not coupling.responses:
        raise click.UsageError("--functions: the deck asks for none; give it responses and forces")
    with progress() as (_, say):
        found = couple(coupling, say)
    warn((*found.warnings, *_laws(coupling)))
    if written_to:
        write_frf(found.functions, written_to, coupling.units)
    deliver_answer(found, deck)
    return int(any(d.code == "MD713" for d in found.warnings))


def _with_results(coupling: Coupling, priors: tuple[str, ...]) -> Coupling:
    """The parts with what earlier runs left of their properties. Raises click.BadParameter."""
    from mouse_cli.cli._decks import after_result

    parts = {part.name: part for part in coupling.substructures}
    for text in priors:
        name, equals, path = text.partition("=")
        if not equals or name not in parts or parts[name].measured:
            known = ", ".join(name for name, part in parts.items() if not part.measured)
            raise click.BadParameter(
                f"'{text}' is not PART=RESULT for a model among the parts: {known}", param_hint="--prior"
            )
        parts[name] = replace(parts[name], problem=after_result(parts[name].problem, path, {}))
    own = (w for part in parts.values() if part.problem is not None for w in part.problem.warnings)
    warnings = tuple(dict.fromkeys((*coupling.warnings, *own)))
    return replace(coupling, substructures=tuple(parts.values()), warnings=warnings)


def _laws(coupling: Coupling) -> tuple:
    """That local laws of models are left out."""
    from mouse_cli.cli._decks import without_laws

    models = [part.problem for part in coupling.substructures if not part.measured]
    return tuple(remark for problem in models for remark in without_laws(problem, modes=True))
