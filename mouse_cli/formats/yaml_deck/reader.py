"""Decks in YAML (version 1): text in, Draft out."""

from dataclasses import replace

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli.formats.draft import Draft, LawDraft, MeshDraft
from mouse_cli.formats.record_drafts import FrfDraft, RecordingDraft
from mouse_cli.formats.rules import review
from mouse_cli.formats.yaml_deck import bindings
from mouse_cli.formats.yaml_deck import parameters as yaml_parameters
from mouse_cli.formats.yaml_deck import prior as yaml_prior
from mouse_cli.formats.yaml_deck.hold_out import hold_out
from mouse_cli.formats.yaml_deck.modal_damping import modal_damping
from mouse_cli.formats.yaml_deck.model import Model, model
from mouse_cli.formats.yaml_deck.modes import modal_test
from mouse_cli.formats.yaml_deck.nodes import compose
from mouse_cli.formats.yaml_deck.powers import raised
from mouse_cli.formats.yaml_deck.run import run_options
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.formats.yaml_deck.theory import theory
from mouse_cli.model.parameter import Parameter
from mouse_cli.model.problem import Source
from mouse_cli.model.units import SYSTEMS, UNDECLARED, Units


def read(text: str | bytes, path: str, outside: bool = False) -> Draft:
    """A deck as written; `outside`: it may name files outside of its folder. Findings that leave no gap stand in `diagnostics`.

    Raises DeckError with all findings when text or values are missing or not what they should be.
    """
    document, root = compose(text, path, outside)
    deck = Section(document, root, "deck")
    deck.value("mouse")
    _for_others(deck)
    draft = _draft(deck)
    draft.laws = laws(deck)
    draft.modal_damping = modal_damping(deck)
    draft.theory = theory(deck)
    draft.where_theory = document.span(deck.nodes["theory"]) if "theory" in deck else None
    draft.diagnostics.extend(document.diagnostics)
    if document.incomplete:
        raise review(draft)
    return draft


def _for_others(deck: Section) -> None:
    """Raise DeckError (MD700) for a deck that holds no model, but what other commands read."""
    for key in ("couple", "modify"):
        if key in deck:
            message = f"the deck holds {key} instead of a model"
            deck.document.error("MD700", deck.nodes[key], message, f"use `mouse {key}`")
            raise DeckError(deck.document.diagnostics)


def _draft(deck: Section) -> Draft:
    """All sections are read, so that all errors are found; what could not be read is missing."""
    document = deck.document
    below = deck.section("model")
    matrices = model(below) if below else Model(deck.node, {})
    declared = SYSTEMS.get(deck.value("units", ""), UNDECLARED)
    parameters, covariance, properties = _properties(deck, matrices.mesh, declared)
    elements, A = yaml_parameters.moves(deck, properties, matrices.order, matrices.rows)
    measured = deck.section("test")
    test, held = modal_test(measured, declared), hold_out(measured)
    frf, recordings = records(measured, declared)
    run, where = run_options(deck.section("run"))
    deck.value("source")
    return Draft(
        title=deck.value("title", ""),
        order=matrices.order,
        **{name: matrices.matrices.get(name) for name in ("K", "M", "C", "D")},
        mesh=matrices.mesh,
        geometry=matrices.rows.geometry() if matrices.rows else None,
        elements=elements,
        A=A,
        parameters=parameters,
        run=run,
        source=Source(document.path, "yaml", tuple(document.lines)),
        covariance=None if document.incomplete else covariance,  # a parameter may be missing
        test=test,
        labels=matrices.labels,
        supports=matrices.supports,
        groups=matrices.groups,
        units=declared,
        frf=frf,
        recordings=recordings,
        hold_out=held,
        where_order=document.span(matrices.where_order),
        where_covariance=document.span(deck.nodes["prior"]) if "prior" in deck else None,
        where_total_mass=where.get("fix_total_mass"),
        where_estimator=where.get("estimator"),
    )


def _properties(
    deck: Section, mesh: MeshDraft | None, units: Units
) -> tuple[list[Parameter], np.ndarray | None, list[Section]]:
    """The parameters, their covariance when they are correlated, and their sections; those of elements are bound to `mesh`."""
    sections = yaml_parameters.sections(deck, mesh)
    bound = [bindings.bound(section, i, mesh, units) for i, section in enumerate(sections)]
    prior = deck.section("prior")
    form = prior.form() if prior else None
    covariance = yaml_prior.covariance(prior, form, len(sections))
    variances = [None] * len(sections) if covariance is None else np.diag(covariance).tolist()
    if covariance is None and form == "covariance":
        variances = [1.0] * len(sections)  # the matrix was refused: a missing sd is no second error
    found, powers = raised(sections, lambda i: yaml_parameters.parameter(sections[i], variances[i], bound[i]))
    read = [i for i, parameter in enumerate(found) if parameter is not None]
    parameters = [found[i] for i in read]
    if mesh is not None:
        mesh.bindings = [replace(own, parameter=j) for j, i in enumerate(read) if bound[i] for own in bound[i].bindings]
    if len(parameters) == len(sections) and form != "covariance":
        names, sd = [p.name for p in parameters], np.array([p.sd for p in parameters])
        covariance = yaml_prior.correlated(prior, form, names, sd)
    if powers is not None and len(parameters) == len(sections):
        covariance = np.diag([p.variance for p in parameters]) if covariance is None else covariance
        covariance = powers @ covariance @ powers.T
    return parameters, covariance, sections


def laws(deck: Section) -> tuple[LawDraft, ...]:
    """Those that could be read."""
    found = []
    for section in deck.listed("laws"):
        law, dofs, below = section.value("law"), section.value("at"), section.section("values")
        if law is None or dofs is None or below is None:
            continue
        values = {key: below.value(key) for key in below.nodes}
        if None not in values.values():
            found.append(LawDraft(law, section.value("variant", ""), dofs, values, deck.document.span(section.node)))
    return tuple(found)


def records(test: Section | None, units: Units) -> tuple[tuple[FrfDraft, ...], tuple[RecordingDraft, ...]]:
    """Both, as far as they could be read; their readers are loaded only where there are any."""
    if test is None or not ("frf" in test or "recordings" in test):
        return (), ()
    from mouse_cli.formats.yaml_deck.frf import functions
    from mouse_cli.formats.yaml_deck.recordings import recordings
    from mouse_cli.formats.yaml_deck.sensors import sensors

    document = test.document
    count = len(document.diagnostics)
    named, files = sensors(test), {}
    del document.diagnostics[count:]  # findings on sensors were noted with the modes
    return tuple(functions(test, named, files, units)), tuple(recordings(test, named, files, units))
