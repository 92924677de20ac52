"""A Problem as a deck of 80-column cards: the twin of the reader, from the same layout."""

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from mouse_cli._errors import Diagnostic
from mouse_cli.formats.cards import layout
from mouse_cli.formats.cards.cursor import BLANK
from mouse_cli.formats.cards.layout import Field, Group
from mouse_cli.formats.cards.losses import Losses, losses
from mouse_cli.formats.edit import FieldError, read_field, write_field
from mouse_cli.model.arrays import Matrix, dense, upper_triangle
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem

Element = tuple[int, int, float]


def write(problem: Problem, lossy: bool = False) -> tuple[str, list[Diagnostic]]:
    """The deck, and warnings of what is lost but does not change the answer (names) or can be given
    otherwise (options).

    lossy: values and limits of properties are left out and numbers rounded, with a warning for each.
    Raises DeckError with every loss that would change the problem.
    """
    found = losses(problem, lossy)
    found.stop_if_any()
    text = "".join(f"{card}\n" for card in _cards(problem, found))
    found.stop_if_any()
    return text, found.warnings


def _cards(problem: Problem, found: Losses) -> Iterator[str]:
    """The twelve groups, in order."""
    test = problem.test
    yield problem.title.ljust(layout.COLUMNS)
    yield from _list(layout.CONTROLS, control_integers(problem), found)
    yield from _list(layout.MODE, test.number.tolist(), found)
    yield from _list(layout.RS, [index for pair in _random_elements(problem) for index in pair], found)
    yield from _indic(test, found)
    yield from _matrix(layout.COV, ((i, i, p.sd) for i, p in enumerate(problem.parameters, 1) if p.sd), found)
    yield from _matrix(layout.A, _partials(problem.A), found)
    yield from _list(layout.LAMTST, test.frequency_hz.tolist(), found)
    yield from _matrix(layout.X, _components(test), found)
    yield from _list(layout.VAR, [*test.frequency_sd_hz.tolist(), *test.shape_sd.T.ravel().tolist()], found)
    yield from _matrix(layout.M, _upper(problem.structure.M), found)
    yield from _matrix(layout.K, _upper(problem.structure.K), found)


def control_integers(problem: Problem) -> list[int]:
    """The ten integers of group 2, in the order of the layout."""
    test, run = problem.test, problem.run
    konf = {confidence: code for code, confidence in layout.CONFIDENCE.items()}
    values = {
        "N": problem.structure.n,
        "NM": test.m,
        "NVEC": int(test.number[-1]),
        "JFLAG": int(run.print_partials),
        "KONF": konf[run.confidence],
        "IROW": test.s,
        "ITERMX": run.passes,
        "INTR": len(problem.parameters),
        "NRS": len(problem.elements),
        "NPARD": run.partials,
    }
    return [values[row.name] for row in layout.CONTROL]


def _random_elements(problem: Problem) -> list[tuple[int, int]]:
    """Stiffness pairs, the pair 0 0, mass pairs."""
    elements = problem.elements
    pairs = list(zip((elements.row + 1).tolist(), (elements.col + 1).tolist(), strict=True))
    stiff = int(np.count_nonzero(~elements.is_mass))
    return [*pairs[:stiff], (0, 0), *pairs[stiff:]]


def _indic(test: ModalTest, found: Losses) -> Iterator[str]:
    """Positions; a blank card after a full one, unless it is the seventh or later."""
    cards = list(_list(layout.INDIC, (test.dofs + 1).tolist(), found))
    full = test.s % len(layout.INDIC.fields) == 0
    yield from cards
    if full and len(cards) < layout.MOST_INDIC_CARDS:
        yield BLANK


def _components(test: ModalTest) -> Iterator[Element]:
    """Elements of X, mode by mode; zeros are punched, so that the reader need not warn of them."""
    for j in range(test.m):
        for i, dof in enumerate((test.dofs + 1).tolist()):
            yield dof, j + 1, float(test.shapes[i, j])


def _partials(A: Matrix) -> Iterator[Element]:
    """Nonzero elements of A, row by row."""
    whole = dense(A)
    for i, j in np.argwhere(whole):
        yield int(i) + 1, int(j) + 1, float(whole[i, j])


def _upper(matrix: Matrix) -> Iterator[Element]:
    """Diagonal and upper triangle without zeros, row by row."""
    row, col, values = upper_triangle(matrix)
    return zip((row + 1).tolist(), (col + 1).tolist(), values.tolist(), strict=True)


def _list(group: Group, values: Sequence[float], found: Losses) -> Iterator[str]:
    """Values one after the other, as many a card as the FORMAT says."""
    fields = group.fields
    for start in range(0, len(values), len(fields)):
        chunk = zip(fields, values[start : start + len(fields)], strict=False)
        yield _card(_punch(f, v, f.label(k), found) for k, (f, v) in enumerate(chunk, start // len(group.rows) + 1))


def _matrix(group: Group, elements: Iterable[Element], found: Losses) -> Iterator[str]:
    """Elements four a card, then the blank card."""
    texts = [_element(group, element, found) for element in elements]
    for start in range(0, len(texts), len(group.items)):
        yield _card(texts[start : start + len(group.items)])
    yield BLANK


def _element(group: Group, element: Element, found: Losses) -> str:
    name = f"{group.symbol}({element[0]},{element[1]})"
    return "".join(_punch(f, v, name, found) for f, v in zip(group.items[0], element, strict=True))


def _card(texts: Iterable[str]) -> str:
    return "".join(texts).ljust(layout.COLUMNS)


def _punch(field: Field, value: float, name: str, found: Losses) -> str:
    """One field; a value that does not read back as itself is a loss."""
    format = str(field.format)
    try:
        text = write_field(value, format)
    except FieldError as error:
        found.refused(name, value, format, error.reason)
        return " " * field.width
    if read_field(text, format) != value:
        found.rounded(name, value, format, text.strip())
    return text
