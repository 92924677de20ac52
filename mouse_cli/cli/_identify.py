"""What `mouse identify` is given, brought to functions or outputs, identified, and written as a test."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import click
import numpy as np

from mouse_cli._errors import Diagnostic, RecordError
from mouse_cli._span import Span
from mouse_cli.cli._spectra import measured_data, spectra_options
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.identification import Identification, measured_test
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem
from mouse_cli.model.recording import Recording


@dataclass(frozen=True)
class Excited:
    """What the options say of the excitation. unused: forces are not to be used; over: records begin where it has ended."""

    unused: bool = False
    over: bool = False


Measured = tuple[list[FrfTest], list[Recording], list[Diagnostic]]


def identified(
    sources: tuple[str, ...], band: tuple[float, float] | None, orders: int | None, excited: Excited,
    given: dict[str, object], say: Callable[[str], None],
) -> tuple[Identification, list[Diagnostic]]:  # fmt: skip
    """The modes of all sources together, and warnings of reading. Raises DeckError, RecordError and click.UsageError."""
    from mouse_cli.records.identify import identify_frf

    output_only = excited.unused or excited.over
    problem, (functions, recordings, warnings) = _read(sources, given | {"output_only": output_only})
    over = excited.over or any(each.free for each in recordings)
    if output_only:
        functions = []
    else:
        forced = [each for each in recordings if len(each.inputs)]
        if forced:
            functions += _functions(forced, problem, given, warnings)
    if functions:
        found = identify_frf(functions, band, orders, say)
        return _of_deck(found, problem, functions[0].outputs), warnings
    if not recordings:
        message = f"{sources[0]} holds no recordings" + ("" if output_only else " and no frequency response functions")
        help = "name a file of functions or of time histories, or a deck with test: frf or recordings"
        raise RecordError.of("MD659", message, Span(sources[0], 1), help=help)
    if over:
        from mouse_cli.records.identify_decays import begun

        recordings = recordings if problem or given["segment"] else [begun(each) for each in recordings]
    return of_outputs(problem, recordings, band, orders, say, over), warnings


def of_outputs(
    problem: Problem | None, recordings: Sequence[Recording], band: tuple[float, float] | None, orders: int | None,
    say: Callable[[str], None], over: bool = False,
) -> Identification:  # fmt: skip
    """The modes that the responses of repeats show without their forces; over: of free decays. Raises RecordError (MD655)."""
    from mouse_cli.records.identify import identify_decaying, identify_recordings
    from mouse_cli.records.spectra import weights

    identify = identify_decaying if over else identify_recordings
    found, first = identify(recordings, band, orders, say), recordings[0]
    n = problem.structure.n if problem else 0
    return _of_deck(found, problem, weights([first.channels[j] for j in first.outputs], n))


def _read(sources: tuple[str, ...], given: dict[str, object]) -> tuple[Problem | None, Measured]:
    """The deck's problem where the source is one, functions and recordings of all sources, and warnings."""
    decks = [s for s in sources if s == "-" or s.lower().endswith((".yaml", ".yml"))]
    if decks and len(sources) > 1:
        raise click.UsageError("a deck stands alone: it names all its files")
    if decks:
        from mouse_cli.cli._decks import read_problem

        problem = read_problem(decks[0])
        titles = given["titles"]
        recordings = [each for each in problem.recordings if not titles or each.title in titles]
        functions = [each for each in problem.frf if not titles]
        return problem, (functions, recordings, list(problem.warnings))
    functions, recordings, warnings = [], [], []
    for source in sources:
        from mouse_cli.formats.frf_source import read_frf

        held = read_frf(source, str(given["kind"] or ""))
        if held is None:
            data = measured_data(source, given["titles"], given)
            recordings += data.recordings
            warnings += data.warnings
        else:
            functions.append(held[0])
            warnings += held[1]
    return None, (functions, recordings, warnings)


def _functions(
    forced: list[Recording], problem: Problem | None, given: dict[str, object], warnings: list[Diagnostic]
) -> list[FrfTest]:
    """Functions of the recordings with forces, those of the same channels averaged."""
    from mouse_cli.records.measurements import measure

    found = measure(forced, spectra_options(given), problem.structure.n if problem else 0)
    warnings += found.warnings
    return [each.frf for each in found.measured]


def _of_deck(found: Identification, problem: Problem | None, outputs) -> Identification:
    """The identification with the deck whose test it becomes."""
    if problem is None or not found.modes.m:
        return found
    return replace(found, problem=problem, test=_numbered(problem, measured_test(found.modes, outputs, found.sensors)))


def _numbered(problem: Problem, test: ModalTest) -> ModalTest:
    """The test with the numbers of the model's modes where every measured one has a partner of its own; else in turn, above the
    rigid-body modes."""
    from mouse_cli.model.correlation import ALONE
    from mouse_cli.updating.correlate import correlate

    found = correlate(replace(problem, test=test, frf=(), recordings=(), hold_out=None, held_records=None))
    own = found.modes != ALONE
    if not own.all() or len(set(found.modes.tolist())) < test.m or (np.diff(found.modes) <= 0).any():
        return replace(test, number=test.number + found.rigid_modes)
    return replace(test, number=found.modes + 1)


def write(found: Identification, output: str | None) -> list[str]:
    """The files of `-o`: a whole deck where there is a model, else the piece `test:`. None without modes."""
    if output is None or not found.modes.m:
        return []
    if found.problem is not None:
        from mouse_cli.formats import write_deck

        whole = replace(found.problem, test=found.test, frf=(), recordings=(), hold_out=None, held_records=None)
        return write_deck(whole, output)
    from mouse_cli._atomic import write_text_atomically
    from mouse_cli.formats.yaml_deck.writer_identified import identified as piece

    write_text_atomically(output, piece(found))
    return [output]
