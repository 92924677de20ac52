"""Card decks: the three check decks, every damaged deck of the rules' section 10, and each reading that the
manual leaves open.

The damaged decks are made here from `chain_noisy.dat`; the decks are not copied into the repository.
"""

from pathlib import Path

import numpy as np
import pytest

from mouse_cli._errors import ERROR, WARNING, DeckError
from mouse_cli.codes import catalogue
from mouse_cli.formats import cards
from mouse_cli.formats.assemble import assemble
from mouse_cli.formats.cards import layout as card_layout
from mouse_cli.formats.cards import writer as card_writer
from mouse_cli.formats.cards.manual import manual
from mouse_cli.formats.cards.show import describe

FOLDER = Path(__file__).resolve().parents[2].parent / "shared" / "fortran"
if not FOLDER.exists():
    pytest.skip("the check decks (shared/fortran) are not beside the repository", allow_module_level=True)

CHAIN = (FOLDER / "chain_noisy.dat").read_text()
LINES = CHAIN.splitlines()
CONTROL = [int(LINES[1][k : k + 8]) for k in range(0, 80, 8)]
NAMES = [row.name for row in card_layout.CONTROL]


def deck(*changes, lines=LINES):
    """The chain with cards replaced: (number, text); None drops a card, a list puts several in its place."""
    cards_ = list(lines)
    for number, text in sorted(changes, key=lambda change: -change[0]):
        cards_[number - 1 : number] = [] if text is None else text if isinstance(text, list) else [text]
    return "".join(f"{card}\n" for card in cards_)


def control(**values):
    """The control card with some integers changed."""
    return 2, "".join(f"{values.get(name, old):8d}" for name, old in zip(NAMES, CONTROL, strict=True))


def element(row, col, value):
    return f"{row:3d}{col:3d}{value:>14}"


def findings(text, **options):
    """Everything found, by the reader and by the rules of all formats."""
    try:
        draft = cards.read(text, "deck.dat", **options)
        return list(assemble(draft).warnings)
    except DeckError as error:
        return list(error.diagnostics)


def errors(text, **options):
    return [d for d in findings(text, **options) if d.severity == ERROR]


def codes(text, **options):
    return {d.code for d in findings(text, **options)}


def content(draft):
    """What a draft says, without the places."""
    entries = lambda e: sorted(zip(e.rows.tolist(), e.cols.tolist(), e.values.tolist(), strict=True))
    test = draft.test
    arrays = (test.number, test.frequency_hz, test.frequency_sd_hz, test.dofs, test.shapes, test.shape_sd)
    return (
        (draft.title, draft.order, draft.run, [(p.name, p.sd, p.nominal) for p in draft.parameters]),
        [entries(e) for e in (draft.K, draft.M, draft.A)],
        list(zip(draft.elements.rows, draft.elements.cols, draft.elements.values, strict=True)),
        [array.tolist() for array in arrays],
    )


# The check decks.


def test_chain():
    draft = cards.read(CHAIN, "chain_noisy.dat")
    assert draft.diagnostics == [] and draft.source.lines == tuple(LINES)
    problem = assemble(draft)
    k = 1e3 * np.array([[250, -150, 0, 0], [-150, 265, -115, 0], [0, -115, 315, -200], [0, 0, -200, 200]])
    assert np.array_equal(problem.structure.K, k) and np.array_equal(problem.structure.M, np.eye(4))
    assert problem.A.tolist() == [[1, 1], [0, -1], [0, 1]]
    assert [p.sd for p in problem.parameters] == [8485.2814, 10000.0]
    assert problem.test.frequency_hz.tolist() == [17.9415, 54.6245, 95.5183, 115.25]
    assert problem.test.shapes[:, 0].tolist() == [0.320877, 0.483715, 0.558403, 0.652936]
    assert (problem.test.shape_sd == 0.05).all() and problem.test.frequency_sd_hz[3] == 1.12660245
    run = problem.run
    assert (run.estimator, run.recursion, run.pairing, run.convergence) == (
        "bayes",
        "replaced",
        "number",
        "ratio",
    )
    assert (run.partials, run.passes, run.confidence, run.print_partials) == (5, 1, 95, False)
    assert problem.test.scale == "least-squares" and draft.source.format == "cards"


def test_beam():
    problem = assemble(cards.read((FOLDER / "beam58.dat").read_bytes(), "beam58.dat"))
    assert problem.structure.n == 58 and problem.A.shape == (101, 14) and problem.warnings == ()
    assert problem.test.number.tolist() == [3, 4] and problem.test.s == 19 and problem.test.dofs[-1] == 54
    rigid = np.linalg.eigvalsh(problem.structure.K)[:2]
    assert abs(rigid).max() < 1e-3 * np.trace(problem.structure.K)


@pytest.mark.parametrize("name", ["chain_noisy.dat", "chain_perfect.dat", "beam58.dat"])
def test_a_deck_comes_back_from_the_writer(name):
    draft = cards.read((FOLDER / name).read_text(), name)
    text, warnings = card_writer.write(assemble(draft))
    assert warnings == [] and all(len(line) == 80 for line in text.splitlines())
    again = cards.read(text, name)
    assert again.diagnostics == [] and content(again) == content(draft)


def test_every_value_knows_its_columns():
    draft = cards.read(CHAIN, "c.dat")
    places = [
        (draft.K.where(1), (22, 21, 20)),
        (draft.elements.where(2), (4, 17, 8)),
        (draft.parameters[1].span, (6, 21, 20)),
        (draft.test.where_frequency(3), (10, 61, 20)),
        (draft.test.where_shape(2, 1), (12, 41, 20)),
        (draft.test.where_shape_sd(0, 0), (16, 65, 16)),
        (draft.test.where_dof(3), (5, 13, 4)),
        (draft.where_order, (2, 1, 8)),
    ]
    for span, (line, column, width) in places:
        assert (span.line, span.column, span.width, span.text) == (line, column, width, LINES[line - 1])


# Damaged decks, section 10.


@pytest.mark.parametrize(
    "text",
    [
        "".join(line.rstrip() + "\n" for line in LINES),
        CHAIN.replace("\n", "\r\n"),
        CHAIN.replace("\n", "\r\n").encode(),
        CHAIN.rstrip("\n"),
        CHAIN + "\n\n   \n",
    ],
    ids=["stripped", "crlf", "bytes", "no last LF", "blank lines after"],
)
def test_harmless_changes(text):
    draft = cards.read(text, "c.dat")
    assert draft.diagnostics == [] and content(draft) == content(cards.read(CHAIN, "c.dat"))


def test_lower_case():
    draft = cards.read(CHAIN.lower(), "lower.dat")
    assert draft.diagnostics == []
    assert content(draft)[1:] == content(cards.read(CHAIN, "c.dat"))[1:]


@pytest.mark.parametrize("prefix", ["", "AB"])
def test_sequence_numbers(prefix):
    numbers = [f"{prefix}{10 * k:0{8 - len(prefix)}d}" for k in range(1, 25)]
    numbered = "".join(f"{line[:72]:72}{number}\n" for line, number in zip(LINES, numbers, strict=True))
    found = errors(numbered)
    assert [d.code for d in found] == ["MD105"] and "73-80" in found[0].message


def test_stripped_numbers_take_what_stood_there():
    wide = [f"{line[:72]:72}{10 * k:8d}" for k, line in enumerate(LINES, 1)]
    found = errors("\n".join(wide), strip_73_80=True)
    assert any("NPARD was lost" in d.message for d in found)
    named = errors("\n".join(wide), strip_73_80=True, overrides={"NPARD": 5})
    assert not any("NPARD" in d.message for d in named) and {d.code for d in named} == {"MD127"}


def test_a_deck_that_keeps_clear_of_73_80_reads_with_numbers():
    """Three elements a card leave columns 61-80 free; VAR(5) and LAMTST(4) are given."""
    lines = [
        *LINES[:5],
        *_three_a_card(LINES[5:9]),
        LINES[9][:60],
        *_three_a_card(LINES[10:15]),
        *_var(),
        *_three_a_card(LINES[19:]),
    ]
    numbered = "\n".join(f"{line[:72]:72}{10 * k:08d}" for k, line in enumerate(lines, 1))
    given = {"NPARD": 5, "LAMTST(4)": 115.25, **{f"VAR({k})": 0.05 for k in (5, 10, 15, 20)}}
    draft = cards.read(numbered, "c.dat", strip_73_80=True, overrides=given)
    assert draft.diagnostics == [] and content(draft) == content(cards.read(CHAIN, "c.dat"))


def _three_a_card(lines):
    """INPUT cards set again with three elements each."""
    slots = [[line[k : k + 20] for k in range(0, 80, 20) if line[k : k + 20].strip()] for line in lines]
    for group in " ".join("x" * len(s) or "|" for s in slots).split("|")[:-1]:
        held = [slots.pop(0) for _ in group.split()]
        slots.pop(0)
        flat = [slot for card in held for slot in card]
        yield from ("".join(flat[k : k + 3]) for k in range(0, len(flat), 3))
        yield ""


def _var():
    return [line[:64] for line in LINES[15:19]]


@pytest.mark.parametrize(
    ("text", "code", "line", "column", "words"),
    [
        (deck((6, LINES[5] + "  remark")), "MD102", 6, 83, "column 83"),
        (deck((2, "4,4,4,0,2,4,1,2,3,5")), "MD101", 2, 1, "comma"),
        (deck((6, "1  1  8.4852814E+03 2  2  1.0000000E+04 ")), "MD110", 6, 1, "COV(100,100) is outside 2"),
        (deck((7, None)), "MD110", 7, 61, "COV(3,2) is outside 2 x 2"),
        (deck((5, "  1    2   3   4")), "MD323", 5, 1, "10"),
        (deck((11, "\t1.79415+01")), "MD103", 11, 1, "a tab in column 1"),
        (deck((4, LINES[3][:40] + "é")), "MD103", 4, 41, "'\\xe9'"),
        (deck(control(IROW=40000)), "MD104", 2, 41, "IROW reads 40000, but the model has N = 4"),
        (deck(control(N=40000000)), "MD104", 2, 1, "N reads 40000000"),
        (deck(control(KONF=4)), "MD104", 2, 33, "expected 1, 2 or 3"),
        (deck(control(ITERMX=0)), "MD104", 2, 49, "ITERMX reads 0"),
        (deck(control(NPARD=-1)), "MD104", 2, 73, "NPARD reads -1"),
        (deck(control(NVEC=3)), "MD104", 2, 17, "MODE(4) = 4"),
        (deck((4, "   1   1   1   2   2   2   3   3")), "MD108", 4, 25, "none"),
        (deck((4, "   1   1   0   0   2   2   0   0")), "MD108", 4, 25, "2 of the NRS+1 = 4"),
        (deck((4, LINES[3][:40] + "   4   4")), "MD107", 4, 41, "not blank"),
        (deck((3, LINES[2][:32] + "       5")), "MD107", 3, 33, "not blank"),
        (deck((5, "   1   2       4")), "MD109", 5, 9, "3 positions"),
        (deck((9, None)), "MD111", 9, 1, "no indices"),
        (deck((15, None)), "MD111", 15, 1, "no indices"),
        (deck((21, None)), "MD112", 21, 1, "M(1,1) is given twice"),
        (deck((24, None)), "MD100", 23, 1, "the deck ends"),
        (deck((7, ["", ""])), "MD116", 8, 1, "A has no elements"),
        (deck((6, element(1, 1, "1.") + element(1, 2, "1."))), "MD122", 6, 21, "off the diagonal"),
        (deck((24, ["", "ANOTHER CASE"])), "MD129", 25, 1, "after the end of group 12"),
        (deck((20, LINES[19][:70] + "    1.0E5 ")), "MD101", 20, 67, "blank after the exponent"),
        (deck((20, LINES[19][:66] + "*" * 14)), "MD101", 20, 67, "overflow mark"),
        (deck((22, LINES[21][:20] + element(1, 1, "7.") + LINES[21][40:])), "MD112", 22, 21, "K(1,1)"),
        (deck((22, LINES[21][:20] + element(0, 1, "7.") + LINES[21][40:])), "MD111", 22, 21, "K(0,1)"),
        (deck((16, [LINES[15][:64], LINES[15][64:]])), "MD120", 20, 1, "run on"),
        ("", "MD100", 1, 1, "group 1"),
    ],
)  # fmt: skip
def test_damage_is_refused_where_it_stands(text, code, line, column, words):
    found = [d for d in errors(text) if d.code == code]
    assert found, findings(text)
    first = found[0]
    assert (first.span.line, first.span.column) == (line, column)
    assert words in first.message
    assert first.help


def test_hints():
    assert "missing blank card before group 7?" in errors(deck((7, None)))[0].help
    assert "missing blank card before group 8?" in errors(deck((9, None)))[0].help
    assert "missing blank card before group 10?" in errors(deck((15, None)))[0].help
    assert "missing blank card before group 12?" in errors(deck((21, None)))[0].help
    left = next(d for d in errors(deck((6, "1  1  8.4852814E+03 "))) if d.code == "MD110")
    assert "trailing blanks are zeros" in left.note and left.help == "move the 1 to column 3"
    early = errors(deck((2, LINES[1][:40] + "   4    " + LINES[1][48:])))[0]
    assert '"   4    " is 40000' in early.note and early.help == "move the 4 to column 48"


def test_one_card_early_is_one_error():
    assert len(errors(deck((7, None)))) == 1 and len(errors(deck((2, "4,4,4,0,2,4,1,2,3,5")))) == 1


def test_messages_name_card_group_columns_and_text():
    message = errors(deck((22, "  1  1     2.500Q+05")))[0].message
    for part in ("card 22", "group 12, stiffness matrix", "columns 7-20", '"     2.500Q+05"'):
        assert part in message


def test_suspicious_fields_are_warnings():
    found = findings(deck((22, element(1, 1, "250000") + element(1, 2, "-1 50000.") + LINES[21][40:])))
    assert [d.code for d in found if d.severity == WARNING] == ["MD124", "MD126"]
    assert codes(deck((5, "   1   2   3  4 "), (2, LINES[1]))) >= {"MD125"}


def test_the_heading_may_hold_anything_but_a_tab():
    draft = cards.read(deck((1, "Träger")).encode(), "c.dat")
    assert draft.title == "Tr?ger" and [d.code for d in draft.diagnostics] == ["MD106"]
    assert "MD103" in codes(deck((1, "A\tB")))


# Readings that the manual leaves open, section 9.


def test_rows_of_x_are_degrees_of_freedom():
    """9.1 (a): every row is in INDIC."""
    x = cards.read(deck((5, "   2   1   3   4")), "c.dat")
    assert x.test.shapes[:2, 0].tolist() == [0.483715, 0.320877]
    assert [d.code for d in x.diagnostics] == ["MD117"]  # they could be positions, too


def _two_positions(first, second, *, rows):
    """The chain measured at two degrees of freedom."""
    x = [
        element(rows[0], 1, ".3") + element(rows[1], 1, ".4"),
        element(rows[0], 2, ".5") + element(rows[1], 2, ".6"),
    ]
    x += [
        element(rows[0], 3, ".5") + element(rows[1], 3, ".6"),
        element(rows[0], 4, ".5") + element(rows[1], 4, ".6"),
        "",
    ]
    var = [*LINES[15:17], "".join(["          5.0-02"] * 2)]
    return deck(control(IROW=2), (5, f"{first:4d}{second:4d}"), lines=[*LINES[:10], *x, *var, *LINES[19:]])


def test_rows_of_x_are_positions_when_nothing_else_is_possible():
    """9.1 (b)."""
    draft = cards.read(_two_positions(3, 4, rows=(1, 2)), "c.dat")
    assert draft.test.shapes[:, 0].tolist() == [0.3, 0.4] and [d.code for d in draft.diagnostics] == ["MD117"]
    sound = cards.read(_two_positions(3, 4, rows=(3, 4)), "c.dat")
    assert sound.diagnostics == [] and sound.test.shapes.tolist() == draft.test.shapes.tolist()


def test_a_row_outside_indic():
    assert "MD119" in codes(_two_positions(3, 4, rows=(3, 1)))


def _two_modes(x, mode="       2       3"):
    """The chain with two measured modes, system modes 2 and 3."""
    lines = [*LINES[:9], LINES[9][:40], *x, "", *LINES[15:17], *LINES[19:]]
    return deck(control(NM=2, NVEC=3), (3, mode), lines=lines)


def test_columns_of_x_are_positions_in_mode():
    """9.2 (a)."""
    draft = cards.read(_two_modes([LINES[10], LINES[11]]), "c.dat")
    assert draft.diagnostics == [] and draft.test.shapes[0].tolist() == [0.320877, -0.597509]


def test_columns_of_x_are_mode_numbers_when_all_are_in_mode():
    """9.2 (b)."""
    draft = cards.read(_two_modes([LINES[11], LINES[12]]), "c.dat")
    assert [d.code for d in draft.diagnostics] == ["MD118"]
    assert draft.test.shapes[0].tolist() == [-0.597509, 0.655247]


def test_transposed_x():
    found = errors(
        _two_modes(
            [
                "".join(element(1, j, ".5") for j in range(1, 5)),
                "".join(element(2, j, ".5") for j in range(1, 5)),
            ]
        )
    )
    assert [d.code for d in found] == ["MD118"] and "transposed" in found[0].note


def test_unpunched_component_is_a_measured_zero():
    draft = cards.read(deck((11, LINES[10][:60])), "c.dat")
    assert draft.test.shapes[3, 0] == 0 and [d.code for d in draft.diagnostics] == ["MD113"]


def test_only_a_blank_card_ends_input():
    """9.3 and 9.19: an empty first slot goes on, a card of zeros ends the group."""
    moved = deck((23, [LINES[22][:20], " " * 20 + LINES[22][20:]]))
    draft = cards.read(moved, "c.dat")
    assert [d.code for d in draft.diagnostics] == ["MD114"] and len(draft.K) == 7
    zeros = cards.read(deck((24, element(0, 0, "0."))), "c.dat")
    assert [d.code for d in zeros.diagnostics] == ["MD115"] and len(zeros.K) == 7


def test_mass_matrix_may_be_full_but_for_legacy():
    """9.12."""
    full = deck((21, [element(1, 2, ".1"), ""]))
    assert cards.read(full, "c.dat").diagnostics == []
    assert codes(full, legacy=True) == {"MD123"}
    assert cards.read(CHAIN, "c.dat", legacy=True).run.legacy


def test_frequencies_alone():
    """9.14: IROW = 0; INDIC still has a card, and group 9 is a lone blank card."""
    lines = [*LINES[:4], "", *LINES[5:10], "", LINES[15][:64], *LINES[19:]]
    draft = cards.read(deck(control(IROW=0), lines=lines), "c.dat")
    assert draft.diagnostics == [] and draft.test.shapes.shape == (0, 4)
    text, _ = card_writer.write(assemble(draft))
    assert content(cards.read(text, "c.dat")) == content(draft)


def test_duplicates():
    """9.16: equal values warn, unequal ones do not pass; (i,j) and (j,i) of K are one place."""
    same = deck((23, LINES[22][:60] + element(2, 1, "-1.500D+05")))
    assert [d.code for d in findings(same)][:1] == ["MD112"] and all(d.severity == WARNING for d in findings(same)[:1])
    assert "MD112" in {d.code for d in errors(deck((23, LINES[22][:60] + element(2, 1, "-1.400D+05"))))}


def test_loops_of_zero_run_once_under_legacy():
    draft = cards.read(deck(control(ITERMX=0)), "c.dat", legacy=True)
    assert draft.run.passes == 1 and [(d.code, d.severity) for d in draft.diagnostics] == [("MD104", WARNING)]


@pytest.mark.parametrize("legacy", [False, True])
def test_limits_of_1972(legacy):
    found = [d for d in findings(big_deck(150, 30), legacy=legacy) if d.code == "MD121"]
    assert [d.severity for d in found] == [ERROR if legacy else WARNING]


@pytest.mark.parametrize("irow", [0, 1, 19, 20, 21, 40, 120, 139, 140, 160])
def test_indic_cards(irow):
    """A blank card follows 20, 40, ... 120 positions; the seventh card ends the list of 140."""
    draft = cards.read(big_deck(160, irow), "c.dat")
    assert {d.code for d in draft.diagnostics} <= {"MD121"} and draft.test.dofs.tolist() == list(range(1, irow + 1))


@pytest.mark.parametrize("irow", [20, 40, 140, 160])
def test_indic_comes_back_from_the_writer(irow):
    draft = cards.read(big_deck(160, irow), "c.dat")
    text, _ = card_writer.write(assemble(draft))
    assert content(cards.read(text, "c.dat")) == content(draft)


def test_indic_without_its_blank_card():
    lines = big_deck(30, 20).splitlines()
    del lines[5]
    found = errors("\n".join(lines))
    assert [d.code for d in found] == ["MD109"] and "a blank card" in found[0].message


@pytest.mark.parametrize("nrs", [9, 10, 29, 30, 31])
def test_rs_cards(nrs):
    """NRS+1 pairs, ten a card; the pair 0 0 alone on the last card may be blank."""
    draft = cards.read(big_deck(40, 3, nrs=nrs), "c.dat")
    assert draft.diagnostics == [] and len(draft.elements) == nrs


def big_deck(n, irow, nrs=2):
    """A diagonal system with one measured mode: masses from listed element 2 on, one property."""
    cut = lambda texts, size: ["".join(texts[k : k + size]) for k in range(0, len(texts), size)]
    pairs = ["   1   1", "   0   0", *(f"{k:4d}{k:4d}" for k in range(1, nrs))]
    indic = cut([f"{k:4d}" for k in range(1, irow + 1)], 20)
    if irow % 20 == 0 and len(indic) < 7:
        indic.append("")
    head = "".join(f"{k:8d}" for k in (n, 1, 1, 0, 2, irow, 1, 1, nrs, 1))
    x = cut([element(k, 1, ".5") for k in range(1, irow + 1)], 4)
    diagonal = cut([element(k, k, f"{k}.") for k in range(1, n + 1)], 4)
    a = cut([element(k, 1, "1.") for k in range(1, nrs + 1)], 4)
    var = cut(["             .01"] * (1 + irow), 5)
    lines = ["BIG", head, "       1", *cut(pairs, 10), *indic, element(1, 1, "1."), "", *a, "", f"{'1.':>20}"]
    return "\n".join([*lines, *x, "", *var, *diagonal, "", *diagonal, ""]) + "\n"


def test_stacked_cases():
    drafts = list(cards.read_all(CHAIN + "\n\n" + CHAIN.replace("MOUSE", "SECOND"), "c.dat", stacked=True))
    assert [d.title.split()[0] for d in drafts] == ["MOUSE", "SECOND"]
    assert content(drafts[0])[1:] == content(drafts[1])[1:]
    assert drafts[1].where_order.line == 28 and drafts[1].source.lines[0].startswith("SECOND")


def test_overrides_replace_what_is_punched():
    draft = cards.read(CHAIN, "c.dat", overrides={"NPARD": 9, "LAMTST(1)": 18.0})
    assert draft.run.partials == 9 and draft.test.frequency_hz[0] == 18.0
    assert "MD130" in codes(CHAIN, overrides={"NPART": 9})


# What the writer refuses.


def _problem(**changes):
    import dataclasses

    problem = assemble(cards.read(CHAIN, "c.dat"))
    return dataclasses.replace(problem, **changes)


def _first(problem, **changes):
    import dataclasses

    return (dataclasses.replace(problem.parameters[0], **changes), *problem.parameters[1:])


def test_what_cards_cannot_hold():
    import dataclasses

    sound = _problem()
    shapes = sound.test.shapes.copy()
    shapes[0, 0] = np.nan
    k = sound.structure.K.copy()
    k[0, 0] = -1 / 3e20
    cases = {
        "MD140": {"test": None},
        "MD141": {"parameters": _first(sound, nominal=1.0)},
        "MD142": {"parameters": _first(sound, lower=-1.0)},
        "MD143": {"parameters": _first(sound, transform="log")},
        "MD144": {"prior": dataclasses.replace(sound.prior, cov=np.array([[2.0, 1.0], [1.0, 2.0]]))},
        "MD145": {"test": dataclasses.replace(sound.test, shapes=shapes)},
        "MD147": {"structure": dataclasses.replace(sound.structure, K=k)},
        "MD148": {"run": dataclasses.replace(sound.run, fix_total_mass=True)},
        "MD149": {"title": "x" * 81},
    }
    for code, change in cases.items():
        with pytest.raises(DeckError) as raised:
            card_writer.write(_problem(**change))
        assert [d.code for d in raised.value.diagnostics] == [code], code
        assert raised.value.diagnostics[0].help


def test_names_and_options_are_lost_with_a_warning():
    import dataclasses

    sound = _problem()
    _, warnings = card_writer.write(
        _problem(parameters=_first(sound, name="k1"), run=dataclasses.replace(sound.run, recursion="anchored"))
    )
    assert {d.code for d in warnings} == {"MD150", "MD151"} and all(d.severity == WARNING for d in warnings)


def test_held_out_data_are_lost_with_a_warning():
    from mouse_cli.formats import read_deck

    problem = read_deck(Path(__file__).parents[2] / "decks" / "ground_spring_proved.yaml")
    with pytest.raises(DeckError):  # its prior values
        card_writer.write(problem)
    _, warnings = card_writer.write(problem, lossy=True)
    assert any(d.code == "MD150" and "holds out" in d.message for d in warnings)


# The manual, and what `mouse show` prints.


def test_every_card_is_eighty_columns_wide():
    assert [group.number for group in card_layout.GROUPS] == list(range(1, 13))
    for group in card_layout.GROUPS:
        assert sum(field.width for field in group.fields) == 80


def test_the_columns_are_those_of_the_manual():
    """Appendix A: the control card, and the elements of routine INPUT."""
    assert [f.columns for f in card_layout.CONTROLS.fields][5] == "41-48"
    assert [f.columns for f in card_layout.K.fields[3:6]] == ["21-23", "24-26", "27-40"]


def test_show_names_and_values_every_field():
    text = describe(cards.read(CHAIN, "c.dat"))
    for part in (
        "IROW               4",
        "COV(1,1)           8485.2814",
        "LAMTST(4)          115.25 Hz",
        "VAR(5)             0.05",
        "K(3,4)             -200000",
    ):
        assert part in text, part
    assert all(f"{k:>4} | {line.rstrip()}" in text for k, line in enumerate(LINES, 1))


def test_show_stops_where_reading_stops():
    assert "Cards 9 to 22 were not read" in describe(deck((7, None)))


def test_manual_draws_every_group():
    text = manual()
    for group in card_layout.GROUPS:
        assert f"## Group {group.number}: {group.name}" in text and group.text in text
    assert "| 41-48 | IROW | I8 |" in text


def test_every_code_is_explained():
    source = "".join(path.read_text() for path in Path(cards.__file__).parent.glob("*.py"))
    used = {source[k + 1 : k + 6] for k in range(len(source)) if source.startswith('"MD1', k)}
    explained = {code for code in catalogue() if code.startswith("MD1")}
    assert used == explained
