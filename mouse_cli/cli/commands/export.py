"""mouse export: a revised deck as cards of finite-element programs, and its mode shapes."""

import click

from mouse_cli.cli._options import OUTSIDE, QUIET, options, outside

_WHOLE = ("abaqus", "calculix")  # programs whose jobs are read


@click.command()
@click.argument("deck")
@click.option(
    "--for", "program", type=click.Choice(["abaqus", "ansys", "calculix", "nastran"]), help="Whose cards to write."
)
@click.option("--result", metavar="RESULT", help="What `mouse run --json` found: its values instead of the deck's.")
@click.option(
    "--job", metavar="FILE", help="The input file that the deck was imported from, for constants of materials."
)
@click.option(
    "--complete",
    is_flag=True,
    help="With --job, of Abaqus or CalculiX: write the whole job, revised, not an include file.",
)
@click.option("--first", default=900001, show_default=True, help="Number from which new elements count.")
@click.option("--shapes", metavar="FILE", help="Write mode shapes to FILE, .unv (data sets 15, 82, 55) or .vtk.")
@click.option("--modes", default=12, show_default=True, type=click.IntRange(1), help="With --shapes: how many modes.")
@click.option("-o", "--output", metavar="FILE", help="Write the cards to FILE instead of standard output.")
@options(QUIET, OUTSIDE)
def command(
    deck: str,
    program: str | None,
    result: str | None,
    job: str | None,
    complete: bool,
    first: int,
    shapes: str | None,
    modes: int,
    output: str | None,
) -> int:
    """Write DECK as cards of a finite-element program.

    Materials, sections, springs and masses go to an include file. Every value has a comment with its standard deviation, and
    whether it is the posterior (--result) or the deck's prior; what has no card is listed in a comment. --complete writes the
    job itself, with element sets and supports as they are now.
    """
    from mouse_cli.cli._decks import after_result, read_problem
    from mouse_cli.cli._terminal import deliver, warn

    if not program and not shapes:
        raise click.UsageError("give --for PROGRAM, or --shapes FILE")
    if complete and (job is None or program not in _WHOLE):
        raise click.UsageError(f"--complete needs --job FILE and --for {' or '.join(_WHOLE)}")
    before = read_problem(deck)
    problem = after_result(before, result, {})
    warn(before.warnings)
    if shapes:
        _shapes(problem, shapes, modes)
    if program:
        deliver(_cards(problem, before, program, job, first, complete), output, deck)
    return 0


def _cards(problem, before, program: str, job: str | None, first: int, complete: bool) -> str:
    """The include file, or the complete job. Raises DeckError."""
    from dataclasses import replace

    from mouse_cli._errors import DeckError
    from mouse_cli.formats.solver_cards import programs
    from mouse_cli.importing.bars.read import bars_of, numbers
    from mouse_cli.importing.read import read
    from mouse_cli.importing.revised import revised_job
    from mouse_cli.terms.revision import revision

    bars = bars_of(job, outside()) if job is not None else None
    model = read(job, outside()) if job is not None and bars is None else None
    found, form = revision(problem, before, _constants(model), first), programs()[program]
    if bars is not None:
        found = replace(found, job=numbers(bars))
    if not any((found.materials, found.sections, found.springs, found.masses, found.sets, found.supports)):
        message = f"no parameter of the deck has cards of {program}"
        raise DeckError.of("MD481", message, problem.place("order"), help="see `mouse explain MD481`")
    if complete and model is None:
        message, help = "a complete job of bars is not written", "leave --complete out: the cards have the job's numbers"
        raise DeckError.of("MD483", message, problem.place("order"), help=help)
    if complete:
        return revised_job(model, problem, found, inertia=program == "abaqus")
    for material in found.materials:
        if form.whole and None in (material.E, material.nu):
            lacking = "E" if material.E is None else "nu"
            message = f"the deck does not know {lacking} of the material {material.name}"
            help = "give --job, the input file that it was imported from"
            raise DeckError.of("MD480", message, problem.place("order"), help=help)
    return form.write(found)


def _constants(model) -> dict:
    """E, nu and density of the materials of an input file."""
    found = {}
    for name, material in model.materials.items() if model is not None else ():
        if material.isotropic:
            words = material.elastic.lines[0].words
            found[name] = (material.E, float(words[1]) if len(words) > 1 and words[1] else 0.0, material.rho or None)
    return found


def _shapes(problem, path: str, count: int) -> None:
    """Write the lowest modes to the file `path`. Raises DeckError, WrittenError."""
    import numpy as np

    from mouse_cli._atomic import write_text_atomically
    from mouse_cli._errors import DeckError
    from mouse_cli.formats import shape_files
    from mouse_cli.updating import forecast

    if not path.endswith((".unv", ".uff", ".vtk")):
        raise click.UsageError(f"--shapes {path}: expected .unv, .uff or .vtk")
    geometry = problem.structure.geometry
    if geometry is None:
        help = "give the model `nodes` and `dofs`"
        raise DeckError.of("MD482", "the deck has no nodes to show shapes at", problem.place("order"), help=help)
    found = forecast(problem, min(count, problem.structure.n))
    hz, shapes = np.asarray(found.frequencies_hz), np.asarray(found.shapes)
    write = shape_files.vtk if path.endswith(".vtk") else shape_files.universal
    write_text_atomically(path, write(problem.title.strip(), geometry, hz, shapes))
