"""The layout of the report does not change unnoticed. What its numbers must be is tested elsewhere, against the report of 1972.

A number is compared to one unit of its fifth digit and its place on the page by its width: another LAPACK or libm may
round the sixth digit otherwise, but a column may not move. Everything else is compared letter by letter.
`pytest --update-golden` writes the files anew; the diff then shows what a reader will see.
"""

import json
import re
from pathlib import Path

import pytest
import report_examples

import mouse_cli
from mouse_cli import report

HERE = Path(__file__).parent
TOLERANCE = 2e-5
NEGLIGIBLE = 1e-12  # a number this small is rounding

NUMBER = re.compile(r"(?<![\w(.])-?\d+\.\d+(?:[+-]\d\d\b|e[+-]?\d+)?|(?<![\w(.,-])-?\d+(?![\w,)])")
TEXTS = {
    "chain_noisy_legacy.txt": lambda r: report.printout(r, "legacy"),
    "chain_noisy_modern.txt": lambda r: report.printout(r, "modern"),
    "chain_noisy.md": report.markdown,
}


def numbers(text: str) -> list[float]:
    """Every number of `text`, those of 1972 without E included."""
    found = NUMBER.findall(text)
    return [float(re.sub(r"(?<=\d)([+-]\d\d)$", r"e\1", n)) for n in found]


def layout(text: str) -> str:
    """`text` with its numbers masked: in the style of 1972 width for width, where widths are fixed."""
    return NUMBER.sub(lambda m: "#" * len(m[0]) if re.search(r"\d[+-]\d\d$", m[0]) else "#", text)


def squeezed(text: str) -> str:
    """`text` with runs of blanks as one: a number that loses a trailing zero moves its neighbours."""
    return re.sub(r" +", " ", text)


@pytest.fixture
def golden(request: pytest.FixtureRequest):
    """The golden file called so, after `text` was written to it if that was asked for."""

    def read(name: str, text: str) -> str:
        path = HERE / name
        if request.config.getoption("--update-golden"):
            path.write_text(text, encoding="utf-8", newline="\n")
        return path.read_text(encoding="utf-8")

    return read


def without_version(text: str) -> str:
    return text.replace(f"mouse {mouse_cli.__version__}", "mouse VERSION")


@pytest.mark.parametrize("name", TEXTS)
def test_printed_report(name: str, golden) -> None:
    text = without_version(TEXTS[name](report_examples.result("noisy")))
    expected = golden(name, text)
    blanks = str if "legacy" in name else squeezed
    assert blanks(layout(text)).splitlines() == blanks(layout(expected)).splitlines()
    assert numbers(text) == pytest.approx(numbers(expected), rel=TOLERANCE, abs=NEGLIGIBLE)


def test_modes_report(golden) -> None:
    text = without_version(report.printout(report_examples.FORECASTS["free"]()))
    expected = golden("modes_legacy.txt", text)
    assert layout(text).splitlines() == layout(expected).splitlines()
    assert numbers(text) == pytest.approx(numbers(expected), rel=TOLERANCE, abs=NEGLIGIBLE)


def test_spectra_report(golden) -> None:
    text = without_version(report.printout(report_examples.spectra(), "modern"))
    expected = golden("spectra_modern.txt", text)
    assert squeezed(layout(text)).splitlines() == squeezed(layout(expected)).splitlines()
    assert numbers(text) == pytest.approx(numbers(expected), rel=TOLERANCE, abs=NEGLIGIBLE)


def test_document(golden) -> None:
    document = report.document(report_examples.result("noisy"))
    document["versions"], document["version"] = {}, "VERSION"
    text = json.dumps(document, indent=1, allow_nan=False) + "\n"
    same(document, json.loads(golden("chain_noisy.json", text)), "document")


def same(found, expected, where: str) -> None:
    """Equal keys in equal order, equal words, nearly equal numbers; the failure names the place."""
    if isinstance(expected, dict):
        assert list(found) == list(expected), where
        for key in expected:
            same(found[key], expected[key], f"{where}.{key}")
    elif isinstance(expected, list):
        assert len(found) == len(expected), where
        for i, (one, other) in enumerate(zip(found, expected, strict=True)):
            same(one, other, f"{where}[{i}]")
    elif isinstance(expected, float):
        assert found == pytest.approx(expected, rel=TOLERANCE, abs=NEGLIGIBLE), where
    else:
        assert found == expected and type(found) is type(expected), where


def test_a_moved_column_is_noticed() -> None:
    """The comparison has teeth: width, sign, digit and word count, the sixth digit does not."""
    line = "k1   1.00000+05  8.21385+04"
    assert layout(line) != layout(line.replace("  8.2", "   8.2"))
    assert layout(line) != layout(line.replace("  8.2", " -8.2"))
    assert numbers(line) == pytest.approx(numbers(line.replace("8.21385", "8.21386")), rel=TOLERANCE)
    assert numbers(line) != pytest.approx(numbers(line.replace("8.21385", "8.21485")), rel=TOLERANCE)
