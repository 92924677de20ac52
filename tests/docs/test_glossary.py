"""A test engineer who searches a term of the field finds the page that explains it.

The terms are those that indexes of standard texts have in common: Ewins, Modal Testing (2000); Heylen, Lammens and Sas, Modal
Analysis Theory and Testing (1997); Friswell and Mottershead, Finite Element Model Updating in Structural Dynamics (1995).
"""

import re

import pytest
from pages import DOCS

GLOSSARY = DOCS / "reference" / "glossary.md"
TERMS = """
accelerance, added mass, aliasing, antiresonance, auto-MAC, base excitation, Bayes factor, bootstrap, chi-square, close
modes, CMIF, coherence, COMAC, complex mode, component mode synthesis, condition number, covariance, Craig-Bampton, credible
interval, damping ratio, decoupling, degree of freedom, driving-point FRF, dynamic stiffness, effective independence,
eigenvalue, eigenvalue sensitivity, error localisation, evidence, expansion, exponential window, FDAC, force window, FRAC,
frequency response function, frequency-based substructuring, FRF, FRF-based updating, Gauss-Newton, goodness of fit, Guyan
reduction, H1, H2, half-power bandwidth, hammer test, hysteretic damping, identifiability, ill-conditioning, innovation,
L-curve, Laplace approximation, leakage, likelihood, loss factor, MAC, mass loading, mass normalisation, maximum likelihood,
MCMC, MIF, mobility, modal assurance criterion, modal identification, modal mass, modal phase collinearity, modal scale
factor, modal truncation, mode indicator function, mode pairing, mode shape, model updating, MPC, natural frequency,
nonlinearity, Nyquist frequency, Occam factor, orthogonality, output-only identification, p-LSCF, p-value, pole, posterior,
prediction, pretest planning, prior, proportional damping, receptance, reciprocity, regularisation, residual, residual
flexibility, restoring force, rigid-body mode, rotary inertia, sensitivity, SEREP, stabilisation diagram, standard deviation,
structural modification, substructuring, test-analysis correlation, Tikhonov regularisation, transmissibility, universal
file, validation, viscous damping, window
"""
STEMS = {
    "expansion": "expan",
    "hammer test": "hammer",
    "prediction": "predict",
    "sensitivity": "sensitivit",
    "mode pairing": "mode pair",
    "close modes": "**close modes**",
    "CMIF": "mode indicator function",
    "MIF": "mode indicator function",
    "H2": "`h2`",
    "ill-conditioning": "ill-conditioned",
    "mass normalisation": "mass-normalised",
    "driving-point FRF": "driving point",
    "transmissibility": "transmissibilit",
    "window": "--window",
    "force window": "--force-window",
    "Laplace approximation": "laplace",
}


def terms() -> list[str]:
    return re.split(r",\s+", " ".join(TERMS.split()))


def _entries() -> dict[str, tuple[str, str]]:
    """By its heading in small letters each entry: definition, and the page that it links to."""
    entries = re.findall(r"^### (.+)\n\n(.+) See \[.+\]\((.+\.md)\)\.$", GLOSSARY.read_text("utf-8"), re.MULTILINE)
    return {heading.lower(): (definition, page) for heading, definition, page in entries}


def _entry(term: str) -> tuple[str, str]:
    """The entry whose heading has `term` as a word, at its beginning or in parentheses if there is one such."""
    word = re.compile(rf"(?<![\w-]){re.escape(term.lower())}(?![\w-])")
    found = {
        at.start() > 0 and heading[at.start() - 1] != "(": entry
        for heading, entry in reversed(_entries().items())
        if (at := word.search(heading))
    }
    assert found, f"{term} is not in the glossary"
    return found.get(False) or found[True]


def test_there_are_sixty_terms_at_least():
    assert len(set(terms())) == len(terms()) >= 60


@pytest.mark.parametrize("term", terms())
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
