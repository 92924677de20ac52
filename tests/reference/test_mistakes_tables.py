"""Tables of modes as laboratories export them, and mistakes in them: read rightly, or refused with line, column and remedy.

Truth: the cantilever of test_mistakes (closed form), whose table is rewritten.
"""

import re

import numpy as np
import pytest
from test_mistakes import BEAM, HZ, NODES, SHAPES

from mouse_cli import DeckError, read_deck
from mouse_cli.updating.prior_model import examine

DECK = BEAM[: BEAM.index("test:")] + "test: {modes: {file: modes.csv, frequency_sd: 0.5 %, shape_sd: 2 %}}\n"
ROWS = tuple(range(len(NODES)))


def number(value: float) -> str:
    return f"{value:.6f}"


def table(
    mark=",",
    form=number,
    nodes=NODES,
    directions=("TY",) * 4,
    hz=HZ,
    shapes=SHAPES,
    names=None,
    first="frequency",
    more="",
) -> str:
    """A row for each sensor; form: how a number is written."""
    names = names or [f"mode {r + 1}" for r in range(shapes.shape[1])]
    rows = [["node", "direction", *names]] + ([[first, "", *map(form, hz)]] if first else [])
    rows += [[str(n), d, *map(form, x)] for n, d, x in zip(nodes, directions, shapes, strict=True)]
    return "\n".join(mark.join(row) for row in rows) + f"\n{more}"


def by_mode(head="frequency", factor=1.0, extra=(), names=tuple(f"{n}TY" for n in NODES)) -> str:
    """A row for each mode."""
    rows = [["mode", head, *names, *extra[:1]]]
    rows += [
        [str(r + 1), number(f * factor), *map(number, x), *extra[1:]]
        for r, (f, x) in enumerate(zip(HZ, SHAPES.T, strict=True))
    ]
    return "\n".join(",".join(row) for row in rows) + "\n"


def parts(one: str, other: str, a, b) -> str:
    """Two columns for each mode."""
    names = [f"mode {r + 1} {each}" for r in range(4) for each in (one, other)]
    return table(hz=np.repeat(HZ, 2), shapes=np.stack([a, b], axis=2).reshape(4, -1), names=names)


def lines(*changed: tuple[int, str]) -> str:
    """The plain table with some lines (from 1) changed."""
    found = table().splitlines()
    for at, text in changed:
        found[at - 1] = text
    return "\n".join(found) + "\n"


LINE = table().splitlines()
COMPLEX = "{0},TY,{1:.6f}{5:+.6f}i,{2:.6f}{6:+.6f}i,{3:.6f}{7:+.6f}j,{4:.6f} {8:+.6f}*i"
PHASE = np.where(SHAPES < 0, 180.0, 0.0)
EUROPEAN = lambda v: f"{v:.6f}".replace(".", ",")
READ = {
    "semicolons and decimal commas": table(";", EUROPEAN),
    "decimal commas in quotes": table(",", lambda v: f'"{EUROPEAN(v)}"'),
    "a byte order mark": table().encode("utf-8-sig"),
    "UTF-16, as spreadsheets save Unicode text": table("\t").encode("utf-16"),
    "Windows-1252 with a degree sign": ("Pr\u00fcfling bei 20 \u00b0C\n" + table()).encode("cp1252"),
    "ends of lines of old Macintosh": table().replace("\n", "\r"),
    "the separator on a line of its own": "sep=;\n" + table(";"),
    "quotes around all": "\n".join(",".join(f'"{c}"' for c in line.split(",")) for line in LINE),
    "separators at the ends": "\n".join(line + "," for line in LINE),
    "a typographical minus": table().replace("-", "\u2212"),
    "blanks that do not break": table().replace(",", ",\u00a0"),
    "FORTRAN exponents": table(form=lambda v: f"{v:.6E}".replace("E", "D")),
    "thousands with apostrophes": table(form=lambda v: f"{v * 1e4:,.3f}".replace(",", "'"), hz=HZ / 100),
    "thousands with blanks": table(form=lambda v: f"{v * 1e4:,.3f}".replace(",", " "), hz=HZ / 100),
    "thousands with commas in quotes": table(form=lambda v: f'"{v * 1e4:,.2f}"', hz=HZ / 100),
    "thousands with points, decimal commas": table(
        ";", lambda v: f"{v * 1e4:,.3f}".translate(str.maketrans(",.", ".,")), hz=HZ / 100),
    "a row of units": lines((1, f"{LINE[0]}\n-,-,m/s2,m/s2,m/s2,m/s2")),
    "a row of units in brackets": lines((1, f"{LINE[0]}\n,,[m/s2],[m/s2],[m/s2],[m/s2]")),
    "frequencies in rad/s": table(hz=HZ * 2 * np.pi, first="frequency [rad/s]"),
    "circular frequencies": table(hz=HZ * 2 * np.pi, first="omega"),
    "frequencies in rpm": table(hz=HZ * 60, first="frequency (rpm)"),
    "frequencies in kHz": table(form=lambda v: f"{v:.9f}", hz=HZ / 1000, first="frequency [kHz]"),
    "periods": table(form=lambda v: f"{v:.9f}", hz=1 / HZ, first="period [s]"),
    "frequencies alone in the head": table(names=[f"{f:.5f} Hz" for f in HZ], first=""),
    "rows of modes in rad/s": by_mode("frequency [rad/s]", 2 * np.pi),
    "rows of modes with a row of units": by_mode(factor=2 * np.pi).replace("\n", "\n-,rad/s,-,-,-,-\n", 1),
    "directions by number": table(directions=("2", "+2", "2", "2")),
    "amplitude and phase in degrees": parts("amplitude", "phase [deg]", abs(SHAPES), PHASE),
    "amplitude and phase in radians": parts("mag", "phase (rad)", abs(SHAPES), np.deg2rad(PHASE)),
    "phases beyond radians": parts("amplitude", "phase", abs(SHAPES), PHASE),
    "real and imaginary parts": parts("real", "imag", SHAPES, 0.01 * SHAPES),
    "complex numbers": lines(*((3 + s, COMPLEX.format(NODES[s], *SHAPES[s], *(0.01 * SHAPES[s]))) for s in ROWS)),
    "modes in falling order": table(hz=HZ[::-1], shapes=SHAPES[:, ::-1]),
    "sd in percent": lines((2, f"{LINE[1]}\nsd [%],,0.5,0.5,0.5,0.5")),
    "a loss factor": lines((2, f"{LINE[1]}\nloss factor,,0.01,0.01,0.02,0.02")),
}  # fmt: skip
REFUSED = {  # the table, line and column of the finding, and what it says
    "decimal commas beside commas": (table(",", EUROPEAN), 2, 1, "10 cells.*semicolons"),
    "a cell that is lost": (lines((4, LINE[3].rsplit(",", 1)[0])), 4, 1, "5 cells and the head 6.*empty cell"),
    "a cell too many": (lines((4, f"{LINE[3]},0.5")), 4, 1, "7 cells"),
    "marks that are thousands or decimals": (table(";", lambda v: f"{v * 1e3:,.0f}".replace(",", ".")), 2, 12, "thousands"),
    "two decimal marks": (table(";").replace("0.", "0,", 1), 0, 0, "other decimal marks"),
    "a sensor given twice": (table(more=LINE[3] + "\n"), 7, 1, "line 4.*once"),
    "a mode given twice": (table(names=["mode 1", "mode 2", "mode 2", "mode 4"]), 1, 23, "two columns are of mode 2"),
    "node and direction exchanged": (lines((3, LINE[2].replace("6,TY", "TY,6"))), 3, 1, "exchange the heads"),
    "a direction in words": (table(directions=("up",) * 4), 3, 3, "'up' is no direction"),
    "a row of MAC": (table(more="MAC,,0.99,0.98,0.99,0.97\n"), 7, 1, "'MAC' has no direction"),
    "infinity": (lines((3, LINE[2].replace(LINE[2].split(",")[3], "Inf"))), 3, 15, "not finite"),
    "units behind numbers": (table(form=lambda v: f"{v:.3f} Hz"), 2, 12, "is no number"),
    "amplitudes alone": (table(names=[f"mode {r} amplitude" for r in range(1, 5)], shapes=abs(SHAPES)), 1, 16, "no signs"),
    "a phase without unit": (parts("amplitude", "phase", abs(SHAPES), np.deg2rad(PHASE)), 1, 63, "phase \\[deg\\]"),
    "two frequencies of one mode": (table(names=[f"mode {r + 1} ({1.2 * f:.3f} Hz)" for r, f in enumerate(HZ)]), 1, 16, "once"),
    "no head": ("\n".join(LINE[2:]), 1, 1, "begin with"),
    "the head of modes without `mode`": (by_mode().replace("mode,", ",", 1), 1, 1, "`mode, frequency"),
    "blanks between the cells": (table(" "), 1, 1, "no separator"),
}  # fmt: skip
OF_THE_DECK = {  # the table, code, and what the finding says with its remedy
    "frequencies in rad/s without a word": (table(hz=HZ * 2 * np.pi), "MD450", "2 pi"),
    "amplitudes without a word": (table(shapes=abs(SHAPES)), "MD454", "without signs.*amplitude and phase"),
    "directions exchanged": (table(directions=("TX",) * 4), "MD454", "X and Y exchanged"),
    "a sensor in mm": (table(shapes=SHAPES * np.array([[1], [1], [1e3], [1]])), "MD454", "16TY divided by 1000.*one unit"),
    "nodes without directions": (by_mode(names=tuple(map(str, NODES))), "MD329", "sensor 6 .*12TY"),
    "a column that is no sensor": (by_mode(extra=("MPC [%]", "99.1")), "MD329", r"MPC \[%\] .*take its column out"),
    "a node that is not there": (table(nodes=(6, 11, 16, 22)), "MD329", "node 22"),
    "a direction that is held": (table(directions=("TZ",) * 4), "MD328", "cannot move"),
}  # fmt: skip


def said(found) -> str:
    return f"{found.message} {found.note} {found.help}"


def problem(folder, text: str | bytes):
    (folder / "modes.csv").write_bytes(text if isinstance(text, bytes) else text.encode())
    (folder / "deck.yaml").write_text(DECK)
    return read_deck(folder / "deck.yaml")


@pytest.mark.parametrize("name", READ)
def test_a_table_of_a_laboratory_is_read_rightly(name, tmp_path):
    test = problem(tmp_path, READ[name]).test
    np.testing.assert_allclose(test.frequency_hz / (100 if "thousands" in name else 1), HZ, rtol=1e-4)
    signs = np.sign(test.shapes[-1] * SHAPES[-1]) * np.abs(test.shapes).max() / np.abs(SHAPES).max()
    np.testing.assert_allclose(test.shapes / signs, SHAPES, atol=2e-3)


@pytest.mark.parametrize("mark", ["", "-", "---", "NaN", "n.a.", "#N/A", "n/m", "?", "*"])
def test_what_was_not_measured(mark, tmp_path):
    test = problem(tmp_path, lines((4, LINE[3].replace(LINE[3].split(",")[3], mark)))).test
    assert np.isnan(test.shapes[1, 1]) and np.isfinite(test.shapes).sum() == 15


@pytest.mark.parametrize("name", REFUSED)
def test_a_mistake_in_a_table_is_refused_by_line_and_column(name, tmp_path):
    text, line, column, words = REFUSED[name]
    with pytest.raises(DeckError) as told:
        problem(tmp_path, text)
    (found,) = told.value.diagnostics
    assert (
        re.search(words, said(found)) and found.code == "MD252" and found.help and found.span.file.endswith("modes.csv")
    )
    assert not line or (found.span.line, found.span.column) == (line, column)


@pytest.mark.parametrize("name", OF_THE_DECK)
def test_a_mistake_that_the_model_shows_is_told_with_its_remedy(name, tmp_path):
    text, code, words = OF_THE_DECK[name]
    with pytest.raises(DeckError) as told:
        examine(problem(tmp_path, text))
    assert {each.code for each in told.value.diagnostics} == {code}
    assert re.search(words, said(told.value.diagnostics[0])), said(told.value.diagnostics[0])


def test_a_mode_given_twice_under_two_numbers(tmp_path):
    found = problem(tmp_path, table(hz=[*HZ, HZ[3] * 1.0005], shapes=SHAPES[:, [0, 1, 2, 3, 3]]))
    assert [each.code for each in found.warnings] == ["MD455"] and "4 and 5" in found.warnings[0].message


def test_one_sensor_that_is_reversed_stays_for_the_diagnosis(tmp_path):
    examine(problem(tmp_path, table(shapes=SHAPES * np.array([[1], [1], [-1], [1]]))))
