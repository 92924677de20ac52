"""The documentation as a site of mkdocs: it builds without a warning, has the pages of the index, and fetches nothing."""

import functools
import os
import re
import subprocess
import sys
import threading
from html.parser import HTMLParser
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest
from contracts.test_page_browser import browser  # noqa: F401
from pages import DOCS, PAGES, TOP
from test_glossary import terms

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


@pytest.fixture(scope="module")
def search(site, browser):  # noqa: F811
    """The search of the site in a browser: a term gives (location, heading) of each result, the best first."""

    class Quiet(SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(site)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    page = browser.new_page()
    page.goto(f"http://127.0.0.1:{server.server_port}/search.html?q=MAC")
    page.wait_for_selector("#mkdocs-search-results article")
    yield lambda term: page.evaluate(
        """term => new Promise(done => {
            searchWorker.onmessage = told => done(told.data.results.map(each => [each.location, each.title]));
            searchWorker.postMessage({query: term});
        })""",
        term,
    )
    page.close()
    server.shutdown()
    server.server_close()


def test_search_finds_each_term_of_the_field_where_it_is_explained(search):
    """One of the first three results is a page or section about the term, by its heading; keys and codes are no explanations."""

    def explained(term: str) -> bool:
        return any(
            term.lower() in heading.lower() and re.match(r"(explanation|how-to|reference/glossary)/", location)
            for location, heading in search(term)[:3]
        )

    assert not [term for term in terms() if not explained(term)]


def test_search_takes_the_shortest_terms(site):
    assert '"min_search_length":2' in (site / "search" / "search_index.json").read_text("utf-8")
