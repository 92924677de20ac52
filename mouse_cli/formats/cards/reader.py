"""Card decks of 1972: text in, Draft out. The order of the groups is here, their fields in `layout`."""

from collections.abc import Iterator
from contextlib import suppress

from mouse_cli._errors import DeckError
from mouse_cli.formats.cards import layout
from mouse_cli.formats.cards.control import Control, read_control
from mouse_cli.formats.cards.cursor import Cursor
from mouse_cli.formats.cards.findings import Findings
from mouse_cli.formats.cards.images import check, images
from mouse_cli.formats.cards.input import Matrix, read_input, refuse_empty, slot_span
from mouse_cli.formats.cards.lists import read_indic, read_lamtst, read_mode, read_rs, read_var
from mouse_cli.formats.cards.modal_test import test_draft
from mouse_cli.formats.draft import Draft
from mouse_cli.model.parameter import Parameter
from mouse_cli.model.problem import RunOptions, Source

DATA_OF_1972 = 140  # more were never run, as far as the storage tells


def read(
    text: str | bytes,
    path: str,
    *,
    legacy: bool = False,
    strip_73_80: bool = False,
    overrides: dict | None = None,
) -> Draft:
    """The deck as read, with everything found wrong in `draft.diagnostics`.

    legacy: the limits of the 1972 program are errors. strip_73_80: columns 73-80 hold card numbers; blank
    them.
    overrides: values by field name, e.g. `{"NPARD": 5}`, in place of what is punched.
    Raises DeckError when reading cannot go on, e.g. after an unreadable control card.
    """
    return next(read_all(text, path, legacy=legacy, strip_73_80=strip_73_80, overrides=overrides))


def read_all(
    text: str | bytes,
    path: str,
    *,
    stacked: bool = False,
    legacy: bool = False,
    strip_73_80: bool = False,
    overrides: dict | None = None,
) -> Iterator[Draft]:
    """One Draft for each case of a deck; without `stacked`, cards after the first case are an error."""
    findings = Findings()
    deck = images(text, path, strip_73_80=strip_73_80)
    check(deck, findings)
    at = 0
    while True:
        cursor = Cursor(deck, findings, legacy, dict(overrides or {}), at=at)
        draft = _read_case(cursor, stacked)
        yield draft
        at = _next_case(deck.cards, cursor.at)
        if not stacked or at >= len(deck.cards):
            return
        findings = Findings()


def trace(text: str | bytes, *, strip_73_80: bool = False, **options: object) -> Cursor:
    """The cursor after reading, which knows what each card was taken for, however far reading got."""
    cursor = Cursor(images(text, "<deck>", strip_73_80=strip_73_80), Findings(), **options)
    with suppress(DeckError):
        _read_case(cursor, stacked=False)
    return cursor


def _read_case(cursor: Cursor, stacked: bool) -> Draft:
    """The twelve groups, in order."""
    start = cursor.at
    heading = cursor.take(layout.HEADING)
    control = read_control(cursor)
    n = control.N
    modes = read_mode(cursor, control)
    elements = read_rs(cursor, control)
    indic = read_indic(cursor, control)
    cov = read_input(cursor, Matrix(layout.COV, control.INTR, control.INTR, next_shape=(control.NRS, control.INTR)))
    _refuse_correlation(cursor, cov)
    partials = read_input(cursor, Matrix(layout.A, control.NRS, control.INTR))
    refuse_empty(cursor, partials)
    lamtst = read_lamtst(cursor, control)
    shapes = read_input(cursor, Matrix(layout.X, n, n))
    var = read_var(cursor, control)
    mass = read_input(cursor, Matrix(layout.M, n, n, symmetric=True))
    refuse_empty(cursor, mass)
    _refuse_coupled_mass(cursor, mass)
    stiffness = read_input(cursor, Matrix(layout.K, n, n, symmetric=True))
    refuse_empty(cursor, stiffness)
    test = test_draft(cursor, control, modes, indic, lamtst, shapes, var)
    _finish(cursor, control, stacked)
    return Draft(
        title=cursor.images.cards[heading].rstrip(" "),
        order=n,
        K=stiffness.entries(cursor),
        M=mass.entries(cursor),
        elements=elements,
        A=partials.entries(cursor),
        parameters=_parameters(cursor, control, cov),
        run=_run_options(control, cursor.legacy),
        source=Source(cursor.images.path, "cards", tuple(cursor.images.lines[start : cursor.at])),
        test=test,
        where_order=control.where["N"],
        where_covariance=cursor.images.span(cov.end),
        diagnostics=cursor.findings.finished(),
    )


def _parameters(cursor: Cursor, control: Control, cov: Matrix) -> list[Parameter]:
    """The properties p1, p2, ...: cards give no names and no values, only standard deviations."""
    end = cursor.images.span(cov.end)
    found = []
    for r in range(1, control.INTR + 1):
        sd, *place = cov.elements.get((r, r), (0.0,))
        found.append(Parameter(f"p{r}", float(sd), span=slot_span(cursor, layout.COV, *place) if place else end))
    return found


def _run_options(control: Control, legacy: bool) -> RunOptions:
    """What the 1972 program did, with the switches of the control card."""
    return RunOptions(
        estimator="bayes",
        recursion="replaced",
        confidence=layout.CONFIDENCE[control.KONF],
        partials=control.NPARD,
        passes=control.ITERMX,
        convergence="ratio",
        pairing="number",
        print_partials=control.JFLAG == 1,
        legacy=legacy,
    )


def _refuse_correlation(cursor: Cursor, cov: Matrix) -> None:
    for (i, j), (value, card, slot) in cov.elements.items():
        if i != j:
            cursor.findings.error(
                "MD122",
                f"COV({i},{j}) = {value:.8g} is off the diagonal (card {card + 1}, {layout.COV.title})",
                slot_span(cursor, layout.COV, card, slot),
                "the group holds standard deviations of uncorrelated properties; no form for correlations is known",
                "delete the element (or is the blank card before group 7 missing?)",
            )


def _refuse_coupled_mass(cursor: Cursor, mass: Matrix) -> None:
    """The 1972 program took a diagonal mass matrix; any symmetric one is taken now, but for `legacy`."""
    for (i, j), (value, card, slot) in mass.elements.items() if cursor.legacy else ():
        if i != j and value:
            cursor.findings.error(
                "MD123",
                f"M({i},{j}) = {value:.8g} is off the diagonal (card {card + 1}, {layout.M.title})",
                slot_span(cursor, layout.M, card, slot),
                "the 1972 program was restricted to a diagonal mass matrix",
                "read the deck without --legacy",
            )


def _finish(cursor: Cursor, control: Control, stacked: bool) -> None:
    """What can be said only at the end: cards left over, overrides that name nothing, very many data."""
    at = _next_case(cursor.images.cards, cursor.at)
    if at < len(cursor.images.cards) and not stacked:
        cursor.findings.error(
            "MD129",
            f"there are cards after the end of group 12 (card {at + 1})",
            cursor.images.span(at),
            "after group 12 only blank cards may follow",
            "delete them, look for a blank card too many before group 12, or read stacked cases with --stacked",
        )
    for name in sorted(cursor.overrides.keys() - cursor.overridden):
        cursor.findings.error("MD130", f"'{name}' is given, but no field of this deck is called so")
    if control.data > DATA_OF_1972:
        cursor.findings.warn("MD121", f"the test has {control.data} data; the 1972 program hardly held more than 140")


def _next_case(cards: list[str], at: int) -> int:
    """Index of the next card that is not blank."""
    while at < len(cards) and not cards[at].strip(" "):
        at += 1
    return at
