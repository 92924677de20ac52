"""The whole page: one file that needs nothing else, and that the browser forbids to fetch anything."""

from base64 import b64encode
from hashlib import sha256
from importlib.resources import files

from mouse_cli.page.html import Markup, join, tag
from mouse_cli.page.section import sections
from mouse_cli.page.sections._unjudged import UNJUDGED
from mouse_cli.report.reading import ANSWERS, Part

DOCUMENTS = (*ANSWERS, *UNJUDGED)  # what pages are made of


def page(document: Part) -> str:
    """`document` as HTML: verdict first, then figures and tables, its style and script inline.

    The page's Content-Security-Policy allows this style and this script, by their SHA-256, and nothing else: no request, no
    image, no frame, no form. Raises DeckError (MD922) where the document is not what its schema says.
    """
    title = document.text("title") or document.text("source") or document.file
    found = list(sections(document))
    heading = (tag("p", _origin(document), class_="source"), _contents(found))
    made = f"Made by mouse from {document.text('schema')}, version {document.text('version')}."
    return written(title, heading, tuple(body for _, body in found), made, ("page", "stage"))


def written(title: str, heading: tuple, main: tuple, made: str, parts: tuple[str, ...]) -> str:
    """A page: what stands below its title, its sections, who made it; `parts` names its styles and scripts."""
    style, script = (_joined(parts, end) for end in ("css", "js"))
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=_policy(style, script)),
        tag("meta", name_="viewport", content="width=device-width, initial-scale=1"),
        tag("title", f"{title} – mouse"),
        tag("style", Markup(style)),
    )
    body = tag(
        "body",
        tag("a", "Skip to the verdict", href="#verdict", class_="skip"),
        tag("header", tag("h1", title), *heading),
        tag("main", *main),
        tag("footer", tag("p", made)),
        tag("p", id="spoken", role="status", class_="skip"),
        tag("script", Markup(script)),
    )
    return join([Markup("<!DOCTYPE html>\n"), tag("html", head, body, lang="en"), "\n"])


def _joined(parts: tuple[str, ...], end: str) -> str:
    """Their styles or their scripts."""
    found = [files(__package__).joinpath(f"{name}.{end}") for name in parts]
    return "".join(each.read_text("utf-8") for each in found if each.is_file())


def _origin(document: Part) -> str:
    """Where the answer is from and how it was found."""
    asked = document.part("asked") or document
    deck = document.text("source") or ", ".join(document.labels("sources"))
    named = (
        ("deck", deck),
        ("estimator", asked.text("estimator")),
        ("recursion", asked.text("recursion")),
    )
    return "; ".join(f"{name} {value}" for name, value in named if value)


def _contents(found: list) -> Markup:
    entries = [tag("li", tag("a", section.title, href=f"#{section.key}")) for section, _ in found]
    return tag("nav", tag("ul", *entries), aria_label="Contents")


def _policy(style: str, script: str) -> str:
    inline = f"style-src '{_hashed(style)}'; script-src '{_hashed(script)}'"
    return f"default-src 'none'; {inline}; base-uri 'none'; form-action 'none'"


def _hashed(text: str) -> str:
    return f"sha256-{b64encode(sha256(text.encode()).digest()).decode()}"
