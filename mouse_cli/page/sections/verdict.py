"""Verdict: what was found and whether to trust it, in plain words, before anything else."""

from collections.abc import Iterator

from mouse_cli._texts import capital
from mouse_cli.page.html import Markup, tag
from mouse_cli.page.numbers import probable
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._unjudged import UNJUDGED
from mouse_cli.page.sections._words import listed, paragraphs
from mouse_cli.page.sections.causes import size
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_FORM = {
    "accepted": "The data do not contradict the form of the model.",
    "rejected": "The form of the model is rejected: the data show what the model lacks, lie farther from the prior than it "
    "allows, or are less accurate than stated. Do not trust the revised values.",
    "untested": "The form of the model is not tested: the data leave no degrees of freedom, or there is no answer.",
}
_GOOD, _BAD = ("good", "✓ Answer found and trusted"), ("bad", "✗ No answer")
_DOUBTED = {
    True: ("doubt", "! Do not trust the model as it is"),
    False: ("doubt", "! Finished, but do not trust the answer"),
}
_TESTS = (
    ("innovation", "prior model against the data"),
    ("residual", "what no values explain"),
    ("prior_shift", "values against the prior"),
)


def verdict(document: Part) -> Iterator[Markup]:
    """Mark, sentence, cautions, tests of the model's form."""
    found = document.part("verdict")
    looks, words = mark(document)
    yield tag("p", words, class_=f"mark {looks}")
    yield tag("p", sentence(document), class_="verdict")
    if not found:
        yield paragraphs(document.text("advice"), form(document))
    yield listed([*further(document), *document.texts("cautions")])
    yield paragraphs(_refuted(document), _misstated(document))
    yield paragraphs(_size(document))
    heads = ("test", "chi-square", "degrees of freedom", "p-value")
    tests = table("tests", "Tests of the model's form", heads, _tests(document))
    if tests:
        yield tag("details", tag("summary", "Tests of the model's form"), tests)


def _size(document: Part) -> str:
    """The size of a mechanism that is named, of one deck."""
    if document.part("verdict").text("kind") != "named" or not document.parts("candidates"):
        return ""
    sizes = ", ".join(map(size, document.parts("candidates")[0].parts("parameters")))
    return sizes and f"{capital(sizes)}."


def mark(document: Part) -> tuple[str, str]:
    """Class and words of the mark that stands before all."""
    if document.text("schema") in UNJUDGED:
        return UNJUDGED[document.text("schema")].mark(document)
    return {0: _GOOD, 1: _DOUBTED[bool(document.part("verdict"))]}.get(document.number("exit_code"), _BAD)


def sentence(document: Part) -> str:
    """What was found."""
    found, schema = document.part("verdict"), document.text("schema")
    if schema in UNJUDGED:
        return UNJUDGED[schema].sentence(document)
    return next(iter(found.texts("sentences")), "") if found else _run(document)


def form(document: Part) -> str:
    """What the data say of the form of the model, of a run."""
    return _FORM.get(document.text("model_form"), "")


def further(document: Part) -> list[str]:
    """The other sentences of the verdict."""
    return document.part("verdict").texts("sentences")[1:]


def _run(document: Part) -> str:
    message = document.text("message")
    return f"{capital(message).removesuffix('.')}." if message else f"The run ended: {document.text('status')}."


def _refuted(document: Part) -> str:
    """Documents of arrangements name one cause, those of a diagnosis a list of groups."""
    one = isinstance(document.values.get("refuted"), str)
    against = document.text("refuted") if one else ", ".join(document.labels("refuted"))
    return f"Refuted by held-out data: {against}." if against else ""


def _misstated(document: Part) -> str:
    what = document.text("misstated")
    return f"The deck seems to be wrong about its test: {what}." if what else ""


def _tests(document: Part) -> Iterator[tuple[object, ...]]:
    for key, name in _TESTS:
        test = document.part(key)
        if test.number("dof"):
            p = test.number("p")
            yield (
                f"{key.replace('_', ' ')}: {name}",
                test.number("chi2"),
                test.number("dof"),
                Cell(p, probable(p)),
            )


SECTION = PageSection("verdict", 10, "Verdict", verdict, folded=False)
