"""`mouse report --markdown`, read by GitHub's own parser."""

import json
from html.parser import HTMLParser

import pytest
from page_answers import NAMES, answer, document

from mouse_cli.cli.main import _run
from mouse_cli.page import Part, summary
from mouse_cli.page.markdown import escaped

cmarkgfm = pytest.importorskip("cmarkgfm", reason="cmarkgfm is not installed")
HOSTILE = (
    "x|y</summary></details><img src=x onerror=alert(1)>\n\n# head\n- [a](http://b.c) @all #12 GH-7 o/r#3 `code` **b** "
    "https://evil.example www.evil.example a@b.example mailto:c@d.example ![i](j) 1234567890abcdef \u202e ~~s~~ <!-- --> &lt;"
)
TAGS = {"p", "strong", "table", "thead", "tbody", "tr", "th", "td", "code", "details", "summary", "sub", "ul", "li"}


class Tags(HTMLParser):
    def __init__(self, text: str):
        super().__init__()
        self.tags, self.texts, self.open = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if "code" not in self.open:
            self.texts.append(data)


def rendered(text: str) -> Tags:
    options = cmarkgfm.cmark.Options.CMARK_OPT_UNSAFE  # raw HTML passes, so that any would be seen
    return Tags(cmarkgfm.github_flavored_markdown_to_html(text, options))


@pytest.mark.parametrize("name", NAMES)
def test_verdict_first_then_tables(name):
    text = summary(Part(document(name), "answer.json"))
    first = text.partition("\n")[0]
    assert first.startswith("**") and text.count("\n| ---") >= 1
    assert rendered(text).tags <= TAGS
    assert len(text) < 20_000
    assert "<td" in cmarkgfm.github_flavored_markdown_to_html(
        text
    )  # rows of another width than their head are no table


def test_numbers_are_those_of_the_document():
    told = summary(Part(document("named"), "answer.json"))
    assert "The model lacks a spring to the ground: degree of freedom 2" in told
    assert "| mode | test, Hz | as it is, Hz | off | with the mechanism, Hz |" in told
    for key in ("baseline", "extended"):
        assert all(f"| {mode['revised_hz']:.5g} |" in told for mode in document("named")[key]["modes"])
    assert f"stiffness {document('named')['candidates'][0]['parameters'][0]['value']:.4g} `N/m`" in told


def replaced(value: object) -> object:
    if isinstance(value, dict):
        return {k: v if k in ("schema", "kind") else replaced(v) for k, v in value.items()}
    if isinstance(value, list):
        return [replaced(each) for each in value]
    return HOSTILE if isinstance(value, str) else value


@pytest.mark.parametrize("name", NAMES)
def test_no_deck_brings_in_markup_mentions_or_links(name):
    found = rendered(summary(Part(replaced(document(name)), "hostile.json")))
    assert found.tags <= TAGS
    plain = "".join(found.texts)
    for found_by_servers in ("@all", "#12", "#3", "GH-7", "a@b", "1234567890abcdef", "://", "www.", "\u202e"):
        assert found_by_servers not in plain, found_by_servers
    assert "onerror=alert(1)" in plain or name in ("predicted", "correlated")  # whose names stand in code alone


@pytest.mark.parametrize(
    "text", ["# head", "- item", "1. item", "> quote", "    code", "=====", "+ item", "~~~", "|a|"]
)
def test_a_sentence_stays_one(text):
    assert rendered(escaped(text)).tags <= {"p", "pre", "code"} - ({"pre", "code"} if text.strip() == text else set())


def test_long_tables_are_folded():
    whole = document("named")
    whole["extended"]["modes"] *= 30
    text = summary(Part(whole, "long.json"))
    assert "<summary>Frequencies: 120 modes</summary>" in text and "details" in rendered(text).tags


def test_the_command(tmp_path, capsys):
    path = tmp_path / "answer.json"
    path.write_bytes(answer("shapes"))
    assert _run(["report", str(path), "--markdown"]) == 0
    assert capsys.readouterr().out == summary(Part(json.loads(answer("shapes")), "x"))
