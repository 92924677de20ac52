"""`mouse report`: pages that are well formed, need no network, hold whatever names a deck has, and work in a browser."""

import contextlib
import io
import json
import re
from base64 import b64encode
from hashlib import sha256
from html.parser import HTMLParser
from pathlib import Path

import pytest

from mouse_cli._errors import DeckError
from mouse_cli.cli.main import _run
from mouse_cli.page import Part, page, read

DECKS = Path(__file__).resolve().parents[2] / "decks"
HOSTILE = "</script></title><img src=x onerror=alert(1)>\"'&\u202e\x00\ud800=cmd()"
VOID = {"meta"}
LARGEST = 3_000_000  # bytes of a page
AA = 4.5  # least contrast of text, WCAG 2.1, 1.4.3


class Reader(HTMLParser):
    """Elements of a page as (name, attributes, text so far); fails on an element that another one's end closes."""

    def __init__(self, text: str):
        super().__init__()
        self.open, self.all = [], []
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag, attrs):
        names = [name for name, _ in attrs]
        assert len(names) == len(set(names)), f"an attribute twice: {self.get_starttag_text()}"
        element = {"tag": tag, "attrs": dict(attrs), "text": "", "path": [e["tag"] for e in self.open]}
        self.all.append(element)
        if tag not in VOID:
            self.open.append(element)

    def handle_endtag(self, tag):
        assert self.open.pop()["tag"] == tag

    def handle_data(self, data):
        for element in self.open:
            element["text"] += data

    def named(self, tag):
        return [e for e in self.all if e["tag"] == tag]


@pytest.fixture(scope="module")
def documents(tmp_path_factory):
    """Answers as the commands write them: two runs, diagnoses that name a cause and that find none."""
    folder, found = tmp_path_factory.mktemp("answers"), {}
    for name, deck in (("shapes", "table_5_3"), ("frequencies", "garteur_smag19"), ("functions", "chain_functions")):
        path = folder / f"{name}.json"
        _run(["run", str(DECKS / f"{deck}.yaml"), "--json", "-q", "-o", str(path)])
        found[name] = path
    layouts = [str(path) for path in sorted((DECKS / "arrangements").glob("layout*.yaml"))]
    one = {"named": "ground_spring", "nothing": "table_5_3", "one-of": "three_storey_building"}
    for name, decks in {**{k: [str(DECKS / f"{v}.yaml")] for k, v in one.items()}, "arrangements": layouts}.items():
        with contextlib.redirect_stdout(io.StringIO()) as told:
            _run(["diagnose", *decks, "--json", "-q"])
        found[name] = folder / f"{name}.json"
        found[name].write_text(told.getvalue())
    return found


NAMES = ("shapes", "frequencies", "functions", "named", "nothing", "one-of", "arrangements")


def made(path: Path) -> str:
    return page(read(path.read_bytes(), str(path)))


@pytest.mark.parametrize("name", NAMES)
def test_structure(documents, name):
    text = made(documents[name])
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
def test_no_network(documents, name):
    text = made(documents[name])
    assert not re.search(r"https?:|//\w+\.\w|url\(|@import", text.replace("// ", ""))
    found = Reader(text)
    assert not [e for e in found.all if {"src", "srcset", "style", "xlink:href", "action"} & set(e["attrs"])]
    assert not [e for e in found.all if any(key.startswith("on") for key in e["attrs"])]
    policy = next(e["attrs"]["content"] for e in found.named("meta") if "http-equiv" in e["attrs"])
    assert policy.startswith("default-src 'none';")
    for tag in ("style", "script"):
        (element,) = found.named(tag)
        assert f"{tag}-src 'sha256-{b64encode(sha256(element['text'].encode()).digest()).decode()}'" in policy


def test_numbers_of_the_document_are_on_the_page(documents):
    result = json.loads(documents["shapes"].read_text())
    cells = {e["attrs"].get("data-value") for e in Reader(made(documents["shapes"])).all}
    for parameter in result["parameters"]:
        assert {f"{parameter[key]:.12g}" for key in ("prior", "prior_sd", "posterior", "posterior_sd")} <= cells
    for mode in result["modes"]:
        assert {f"{mode[key]:.12g}" for key in ("test_hz", "prior_hz", "revised_hz", "sd_hz")} <= cells
    assert {f"{cycle['chi2']:.12g}" for cycle in result["cycles"]} <= cells


def test_mac_matrix_agrees_with_the_run(documents):
    """Its diagonal is the MAC that the run computed from the same shapes at full length."""
    result = json.loads(documents["shapes"].read_text())
    (found,) = [e for e in Reader(made(documents["shapes"])).named("table") if "the revised model" in e["text"]]
    rows = re.findall(r"mode (\d)((?:[01]\.\d{3})+)", found["text"].replace("↕", ""))
    for i, ((_, values), mode) in enumerate(zip(rows, result["modes"], strict=True)):
        assert float(re.findall(r"[01]\.\d{3}", values)[i]) == pytest.approx(mode["mac"], abs=6e-4)


def test_verdicts_in_words(documents):
    told = {name: Reader(made(documents[name])).named("section")[0]["text"] for name in NAMES}
    assert "The model lacks a spring to the ground: degree of freedom 2 (probability > 0.999)." in told["named"]
    assert "Nothing is missing that this test could show." in told["nothing"]
    assert "the mass of items that the deck has as massless: items 21, 22 (probability > 0.999)" in told["arrangements"]
    assert "a spring to the ground: 6TX" in told["arrangements"]
    assert "does not settle what: a lumped mass; or a local loss of stiffness" in told["one-of"]
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
def test_hostile_names_are_text(documents, name):
    text = page(Part(replaced(json.loads(documents[name].read_text())), "hostile.json"))
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
        (b'{"schema": "mouse.spectra/1"}', "MD921"),
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


def test_every_value_of_a_wrong_type_is_told_or_shown(documents):
    """A damaged document ends in a page or a DeckError, never in something else."""
    whole = json.loads(documents["named"].read_text())
    for key in whole:
        for wrong in (None, 3, -1e308, 10**400, "text", [], [None], [[]], {}, {"parts": 1}, True):
            if key == "schema":
                continue
            try:
                Reader(page(Part({**whole, key: wrong}, "damaged.json")))
            except DeckError as error:
                assert [d.code for d in error.diagnostics] == ["MD922"]


def test_large_documents_stay_small(documents):
    whole = json.loads(documents["named"].read_text())
    places = whole["location"]["places"]
    whole["location"]["places"] = (places * 200)[:200]
    whole["baseline"]["parameters"] = whole["baseline"]["parameters"] * 500
    whole["baseline"]["modes"] = whole["baseline"]["modes"] * 50
    assert len(page(Part(whole, "large.json")).encode()) < LARGEST


def test_the_answer_is_not_overwritten(documents):
    before = documents["shapes"].read_bytes()
    assert _run(["report", str(documents["shapes"]), "-o", str(documents["shapes"])]) == 2
    assert documents["shapes"].read_bytes() == before


def luminance(colour: str) -> float:
    """Relative luminance, WCAG 2.1."""
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(one: str, other: str) -> float:
    """Contrast ratio, WCAG 2.1."""
    high, low = sorted((luminance(one), luminance(other)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def test_contrast(documents):
    style = Reader(made(documents["shapes"])).named("style")[0]["text"]
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


@pytest.fixture(scope="module")
def browser():
    """Headless Chromium, where there is one."""
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    import shutil

    system = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    with playwright.sync_playwright() as running:
        try:
            found = running.chromium.launch(executable_path=system, args=["--no-sandbox"])
        except playwright.Error as error:
            pytest.skip(f"no Chromium to open pages in: {error.message.splitlines()[0]}")
        yield found
        found.close()


@pytest.fixture
def opened(browser, documents, tmp_path):
    """Opens an answer's page; what it says on the console and what it asks for is collected beside it."""

    def open_page(name: str, **settings):
        path = tmp_path / f"{name}.html"
        path.write_text(made(documents[name]), "utf-8")
        context = browser.new_context(permissions=["clipboard-read", "clipboard-write"], **settings)
        found, said, asked = context.new_page(), [], []
        found.on("console", lambda message: said.append(message.text))
        found.on("pageerror", lambda error: said.append(str(error)))
        found.on("request", lambda request: asked.append(request.url))
        found.goto(path.as_uri())
        return found, said, asked

    return open_page


@pytest.mark.parametrize("name", NAMES)
def test_every_head_and_copy_in_a_browser(opened, name):
    found, said, asked = opened(name)
    for head in found.locator("thead button").all():
        head.click()
    for button in found.locator(".copy").all():
        button.click()
    assert said == [] and len(asked) == 1


def test_sorting_in_a_browser(opened, documents):
    found, _, _ = opened("shapes")
    truth = [mode["revised_hz"] for mode in json.loads(documents["shapes"].read_text())["modes"]]
    table = found.locator("table", has_text="Natural frequencies of test and the model")
    head = table.locator("th", has_text="revised, Hz")
    for order, looks in ((sorted(truth), "ascending"), (sorted(truth, reverse=True), "descending")):
        head.locator("button").click()
        assert head.get_attribute("aria-sort") == looks
        column = table.locator("tbody tr td:nth-child(6)").evaluate_all(
            "cells => cells.map(c => Number(c.dataset.value))"
        )
        assert column == pytest.approx(order, rel=1e-11)


def test_copying_in_a_browser(opened, documents):
    found, _, _ = opened("shapes")
    found.locator("#parameters .copy").click()
    text = found.evaluate("navigator.clipboard.readText()")
    rows = [line.split("\t") for line in text.splitlines()]
    truth = json.loads(documents["shapes"].read_text())["parameters"]
    assert [row[0] for row in rows[1:]] == [parameter["name"] for parameter in truth]
    assert [float(row[4]) for row in rows[1:]] == pytest.approx([p["posterior"] for p in truth], rel=1e-11)


def test_a_phone_shows_it_without_scrolling_sideways(opened):
    for name in NAMES:
        found, _, _ = opened(name, viewport={"width": 360, "height": 640}, color_scheme="dark")
        assert found.evaluate("document.documentElement.scrollWidth <= innerWidth")
        assert found.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(21, 24, 28)"
        found.emulate_media(media="print")
        assert found.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
        assert not found.locator(".copy").first.is_visible()
