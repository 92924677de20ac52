"""The documentation as a site of mkdocs: it builds without a warning, has the pages of the index, and fetches nothing."""

import os
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest
from pages import DOCS, PAGES, TOP

ASIDE = DOCS / "example-repository" / "README.md"  # of the example, linked and no page of the manual


class Page(HTMLParser):
    """What a page asks a browser for, where its links lead, and its text by paragraphs."""

    def __init__(self, text: str):
        super().__init__()
        self.fetched: list[str] = []
        self.links: list[str] = []
        self.paragraphs: list[str] = []
        self._in_paragraph, self._in_code = False, False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        elif tag != "a":
            self.fetched += [given[name] for name in ("src", "href", "data", "poster", "action") if name in given]
        if tag == "p":
            self.paragraphs.append("")
        self._in_code = tag == "code"
        self._in_paragraph = tag == "p" or (self._in_paragraph and tag in ("a", "code", "em", "strong"))

    def handle_data(self, data: str) -> None:
        if self._in_paragraph:
            self.paragraphs[-1] += "code" if self._in_code else data

    def handle_endtag(self, tag: str) -> None:
        self._in_code = False
        if tag == "p":
            self._in_paragraph = False


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> Path:
    """The built site."""
    pytest.importorskip("mkdocs", reason="the extra `docs` is not installed")
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(folder)]
    done = subprocess.run(
        command, cwd=TOP, env={**os.environ, "NO_MKDOCS_2_WARNING": "1"}, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


def html(site: Path, page: Path) -> Path:
    """Where a page of docs/ came to stand."""
    inner = page.relative_to(DOCS)
    return (
        site / inner.parent / "index.html" if inner.name == "README.md" else site / inner.with_suffix("") / "index.html"
    )


def test_every_page_of_the_index_is_in_the_navigation_and_no_other(site):
    listed = re.findall(r"\]\(([^)#]+\.md)\)", (DOCS / "README.md").read_text("utf-8"))
    start = Page((site / "index.html").read_text("utf-8"))
    menu = [(site / link / "index.html").resolve() for link in start.links if re.fullmatch(r"[a-z/-]+/", link)]
    assert {html(site, page) for page in PAGES if page != ASIDE} <= {site / "index.html", *menu}
    assert {html(site, DOCS / name) for name in listed} | {site / "index.html"} == {site / "index.html", *menu}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(DOCS)))
def test_page_fetches_nothing_from_elsewhere_and_its_markdown_was_understood(site, page):
    found = Page(html(site, page).read_text("utf-8"))
    assert found.fetched and not [each for each in found.fetched if re.match(r"[a-z]+:|//", each)]
    there = html(site, page).parent
    missing = [each for each in found.fetched if not (there / each.partition("?")[0]).exists()]
    assert not missing
    for (
        text
    ) in found.paragraphs:  # lists and tables that GitHub shows as such, and other programs only after an empty line
        assert not re.search(r"^(- |1\. |\|)", text, re.MULTILINE), text[:200]


def test_styles_and_scripts_fetch_nothing_from_elsewhere(site):
    for path in (*site.rglob("*.css"), *site.rglob("*.html")):
        text = path.read_text("utf-8")
        assert not re.search(r"@import|url\(\s*['\"]?(?:https?:)?//", text), path


def test_files_beside_the_pages_are_there_and_tools_are_not(site):
    assert (site / "notebook.ipynb").read_bytes() == (DOCS / "notebook.ipynb").read_bytes()
    assert not list(site.rglob("*.py"))
