"""A test engineer who searches a term of the field finds the page that explains it.

The terms are those that indexes of standard texts have in common: Ewins, Modal Testing (2000); Heylen, Lammens and Sas, Modal
Analysis Theory and Testing (1997); Friswell and Mottershead, Finite Element Model Updating in Structural Dynamics (1995).
"""

import re

import pytest
from pages import DOCS

GLOSSARY = DOCS / "reference" / "glossary.md"
TERMS = """
accelerance, added mass, antiresonance, auto-MAC, Bayes factor, bootstrap, chi-square, coherence, COMAC, complex mode,
component mode synthesis, condition number, covariance, Craig-Bampton, damping ratio, decoupling, degree of freedom, dynamic
stiffness, eigenvalue, eigenvalue sensitivity, error localisation, evidence, expansion, exponential window, FRAC, frequency
response function, FRF, FRF-based updating, goodness of fit, Guyan reduction, H1, half-power bandwidth, hammer test,
hysteretic damping, identifiability, innovation, leakage, likelihood, loss factor, MAC, maximum likelihood, MCMC, mobility,
modal assurance criterion, modal identification, modal truncation, mode pairing, mode shape, model updating, natural
frequency, nonlinearity, orthogonality, p-value, posterior, prediction, prior, proportional damping, receptance,
regularisation, residual, residual flexibility, rigid-body mode, rotary inertia, sensitivity, SEREP, stabilisation diagram,
standard deviation, structural modification, substructuring, test-analysis correlation, universal file, validation, viscous
damping
"""
STEMS = {
    "expansion": "expan",
    "hammer test": "hammer",
    "prediction": "predict",
    "sensitivity": "sensitivit",
    "mode pairing": "mode pair",
}


def _terms() -> list[str]:
    return re.split(r",\s+", " ".join(TERMS.split()))


def _entries() -> dict[str, tuple[str, str]]:
    """By its heading in small letters each entry: definition, and the page that it links to."""
    entries = re.findall(r"^### (.+)\n\n(.+) See \[.+\]\((.+\.md)\)\.$", GLOSSARY.read_text("utf-8"), re.MULTILINE)
    return {heading.lower(): (definition, page) for heading, definition, page in entries}


def _entry(term: str) -> tuple[str, str]:
    """The entry whose heading has `term` as a word."""
    found = [
        entry
        for heading, entry in _entries().items()
        if re.search(rf"(?<![\w-]){re.escape(term.lower())}(?![\w-])", heading)
    ]
    assert found, f"{term} is not in the glossary"
    return found[0]


def test_there_are_sixty_terms_at_least():
    assert len(set(_terms())) == len(_terms()) >= 60


@pytest.mark.parametrize("term", _terms())
def test_term_is_defined_and_its_page_has_it(term):
    definition, page = _entry(term)
    assert len(definition) >= 20 and page != GLOSSARY.name
    text = " ".join((GLOSSARY.parent / page).read_text("utf-8").lower().split())
    assert STEMS.get(term, term).lower() in text, f"{page} does not have {term}"


def test_every_entry_is_in_order_and_links_to_a_page_under_its_title():
    text = GLOSSARY.read_text("utf-8")
    headings = re.findall(r"^### (.+)$", text, re.MULTILINE)
    assert headings == sorted(headings, key=str.lower) and len(headings) == len(_entries())
    for title, page in re.findall(r"See \[(.+)\]\((.+\.md)\)\.$", text, re.MULTILINE):
        assert re.search(rf"^# {re.escape(title)}$", (GLOSSARY.parent / page).read_text("utf-8"), re.MULTILINE), (
            title,
            page,
        )


def test_pages_link_to_the_glossary():
    linking = [page for page in DOCS.rglob("*.md") if "glossary.md#" in page.read_text("utf-8")]
    assert len(linking) >= 8
