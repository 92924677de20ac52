"""`mouse report`: pages that are well formed, need no network, and hold whatever names a deck has."""

import json
import re
from base64 import b64encode
from hashlib import sha256

import pytest
from page_answers import NAMES, Reader, answer, document, made

from mouse_cli._errors import DeckError
from mouse_cli.cli.main import _run
from mouse_cli.page import Part, page, read

HOSTILE = "</script></title><img src=x onerror=alert(1)>\"'&\u202e\x00\ud800=cmd()"
LARGEST = 3_000_000  # bytes of a page
AA = 4.5  # least contrast of text, WCAG 2.1, 1.4.3


@pytest.mark.parametrize("name", NAMES)
def test_structure(name):
    text = made(name)
    found = Reader(text)
    assert len(found.named("h1")) == len(found.named("main")) == 1
    assert found.named("html")[0]["attrs"]["lang"] == "en"
    ids = [e["attrs"]["id"] for e in found.all if "id" in e["attrs"]]
    assert len(ids) == len(set(ids))
    referred = [e["attrs"]["aria-labelledby"].split() for e in found.all if "aria-labelledby" in e["attrs"]]
    assert {one for each in referred for one in each} <= set(ids)
    assert {e["attrs"]["href"][1:] for e in found.named("a")} <= set(ids)
    tables = found.named("table")
    assert tables and len(found.named("caption")) == len(tables)
    assert all(e["attrs"]["scope"] in ("col", "row") for e in found.named("th"))
    assert all("aria-sort" in e["attrs"] for e in found.named("th") if "thead" in e["path"])
    assert (
        len(found.named("svg"))
        == len(found.named("desc"))
        == len([t for t in found.named("title") if "svg" in t["path"]])
    )
    assert found.named("section")[0]["attrs"]["id"] == "verdict"
    assert len(text.encode()) < LARGEST


@pytest.mark.parametrize("name", NAMES)
def test_no_network(name):
    text = made(name)
    assert not re.search(r"https?:|//\w+\.\w|url\(|@import", text.replace("// ", ""))
    found = Reader(text)
    assert not [e for e in found.all if {"src", "srcset", "style", "xlink:href", "action"} & set(e["attrs"])]
    assert not [e for e in found.all if any(key.startswith("on") for key in e["attrs"])]
    policy = next(e["attrs"]["content"] for e in found.named("meta") if "http-equiv" in e["attrs"])
    assert policy.startswith("default-src 'none';")
    for tag in ("style", "script"):
        (element,) = found.named(tag)
        assert f"{tag}-src 'sha256-{b64encode(sha256(element['text'].encode()).digest()).decode()}'" in policy


def test_numbers_of_the_document_are_on_the_page():
    result = document("shapes")
    cells = {e["attrs"].get("data-value") for e in Reader(made("shapes")).all}
    for parameter in result["parameters"]:
        assert {f"{parameter[key]:.12g}" for key in ("prior", "prior_sd", "posterior", "posterior_sd")} <= cells
    for mode in result["modes"]:
        assert {f"{mode[key]:.12g}" for key in ("test_hz", "prior_hz", "revised_hz", "sd_hz")} <= cells
    assert {f"{cycle['chi2']:.12g}" for cycle in result["cycles"]} <= cells


def test_mac_matrix_agrees_with_the_run():
    """Its diagonal is the MAC that the run computed from the same shapes at full length."""
    result = document("shapes")
    (found,) = [e for e in Reader(made("shapes")).named("table") if "the revised model" in e["text"]]
    rows = re.findall(r"mode (\d)((?:[01]\.\d{3})+)", found["text"].replace("↕", ""))
    for i, ((_, values), mode) in enumerate(zip(rows, result["modes"], strict=True)):
        assert float(re.findall(r"[01]\.\d{3}", values)[i]) == pytest.approx(mode["mac"], abs=6e-4)


def test_verdicts_in_words():
    told = {name: Reader(made(name)).named("section")[0]["text"] for name in NAMES}
    assert "The model lacks a spring to the ground: degree of freedom 2 (probability > 0.999)." in told["named"]
    assert "Nothing is missing that this test could show: the model" in told["nothing"]
    assert (
        "The mass of items that the deck has as massless: items 21, 22 (probability > 0.999; log"
        in told["arrangements"]
    )
    assert "A spring to the ground: 6TX" in told["arrangements"]
    rivals = re.search(r"and the test does not settle what: one of {(.*?)}\.", told["one-of"])
    assert {"an added mass", "a local loss of stiffness"} <= set(rivals[1].split("; "))
    assert "Not converged" in told["shapes"] and "do not trust the answer" in told["shapes"]
    assert "Answer found and trusted" in told["frequencies"]


def replaced(value: object) -> object:
    """The document with every text hostile, but those that choose what is shown."""
    if isinstance(value, dict):
        return {k: v if k in ("schema", "kind", "group", "physics") else replaced(v) for k, v in value.items()}
    if isinstance(value, list):
        return [replaced(each) for each in value]
    return HOSTILE if isinstance(value, str) else value


@pytest.mark.parametrize("name", NAMES)
def test_hostile_names_are_text(name):
    text = page(Part(replaced(document(name)), "hostile.json"))
    found = Reader(text)
    assert not found.named("img") and len(found.named("script")) == 1
    assert "&lt;img src=x onerror=alert(1)&gt;" in text
    assert "\x00" not in text and text.encode("utf-8")


@pytest.mark.parametrize(
    ("content", "code"),
    [
        (b"mouse: 1\ntitle: a deck\n", "MD920"),
        (b"\xff\xfe\x00", "MD920"),
        (b"", "MD920"),
        (b"[" * 200_000, "MD920"),
        (b'{"schema": "mouse.result/1", "x": NaN}', "MD920"),
        (b'{"schema": "mouse.result/1", "x": ' + b"9" * 6000 + b"}", "MD920"),
        (b'{"title": "no schema"}', "MD920"),
        (b'{"schema": "other/1"}', "MD920"),
        (b'{"schema": ["mouse.result/1"]}', "MD920"),
        (b"[1, 2]", "MD920"),
        (b'{"schema": "mouse.result/2"}', "MD921"),
        (b'{"schema": "mouse.update/1"}', "MD921"),
        (b'{"schema": "mouse.result/1", "title": 3}', "MD922"),
        (b'{"schema": "mouse.result/1", "modes": "many"}', "MD922"),
        (b'{"schema": "mouse.result/1", "modes": [3]}', "MD922"),
        (b'{"schema": "mouse.result/1", "modes": [{"mode": 1, "test_hz": "3"}]}', "MD922"),
        (b'{"schema": "mouse.result/1", "exit_code": true}', "MD922"),
        (b'{"schema": "mouse.diagnosis/1", "verdict": {"kind": "named", "sites": {}}}', "MD922"),
    ],
)
def test_what_is_refused(tmp_path, capsys, content, code):
    path, out = tmp_path / "given.json", tmp_path / "page.html"
    path.write_bytes(content)
    assert _run(["report", str(path), "-o", str(out)]) == 4
    assert f"error[{code}]" in capsys.readouterr().err
    assert not out.exists()


def test_every_value_of_a_wrong_type_is_told_or_shown():
    """A damaged document ends in a page or a DeckError, never in something else."""
    whole = document("named")
    for key in whole:
        for wrong in (None, 3, -1e308, 10**400, "text", [], [None], [[]], {}, {"parts": 1}, True):
            if key == "schema":
                continue
            try:
                Reader(page(Part({**whole, key: wrong}, "damaged.json")))
            except DeckError as error:
                assert [d.code for d in error.diagnostics] == ["MD922"]


def test_large_documents_stay_small():
    whole = document("named")
    places = whole["location"]["places"]
    whole["location"]["places"] = (places * 200)[:200]
    whole["baseline"]["parameters"] = whole["baseline"]["parameters"] * 500
    whole["baseline"]["modes"] = whole["baseline"]["modes"] * 50
    assert len(page(Part(whole, "large.json")).encode()) < LARGEST


def test_the_answer_of_a_job_has_the_page_of_the_answer():
    job = json.dumps(
        {"schema": "mouse.job/1", "deck": "d.yaml", "exit_code": 1, "document": document("named")}
    ).encode()
    assert page(read(job, "job.json")) == made("named")


def test_the_answer_is_not_overwritten(tmp_path):
    path = tmp_path / "answer.json"
    path.write_bytes(answer("shapes"))
    assert _run(["report", str(path), "-o", str(path)]) == 2
    assert path.read_bytes() == answer("shapes")


def luminance(colour: str) -> float:
    """Relative luminance, WCAG 2.1."""
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(one: str, other: str) -> float:
    """Contrast ratio, WCAG 2.1."""
    high, low = sorted((luminance(one), luminance(other)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def test_contrast():
    style = Reader(made("shapes")).named("style")[0]["text"]
    looks = [dict(re.findall(r"--(\w+): (#\w{6})", block)) for block in re.findall(r":root \{(.*?)\}", style, re.S)]
    assert len(looks) == 3  # light, dark, print
    for colours in looks:
        for name in ("ink", "soft", "link", "good", "doubt", "bad", "after", "before"):
            assert contrast(colours[name], colours["paper"]) >= AA
        assert min(contrast(colours[name], colours["band"]) for name in ("ink", "soft")) >= AA
    shades = re.findall(r"\.shade\d \{ background: (#\w{6})", style)
    assert len(shades) == 6
    (ink,) = re.findall(r'td\[class\*="shade"\] \{ color: (#\w{6})', style)
    assert min(contrast(ink, shade) for shade in shades) >= AA
