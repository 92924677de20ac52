"""mouse explain: what a diagnostic code, a card group, an estimator, a candidate, a deck key means."""

import difflib
import json
import re
from collections.abc import Iterator
from importlib import import_module

import click

_FACT = re.compile(r"\{\w+\}")  # what a status fills in when it is reached
_EXIT = """\
0    answer found and trusted: converged, and the model explains the data
1    finished, but do not trust it: not converged, other values fit as well, or the model lacks physics
2    wrong command line
3    batch: a job missed what its manifest expects
4    a deck was rejected (diagnostics printed, nothing written)
5    no answer: numerical failure, or the answer could not be written
130  interrupted; nothing half-written"""
TOPICS = {  # where the text of each is made, imported for it alone
    "candidates": "diagnosis.candidate_manual:manual",
    "cards": "formats.cards.manual:manual",
    "elements": "terms.element_manual:manual",
    "exit": "",
    "methods": "methods.manual:manual",
    "schema": "formats.yaml_deck.reference:schema",
    "yaml": "formats.yaml_deck.reference:reference",
}


def _topic(name: str) -> str:
    if not TOPICS[name]:
        return _EXIT
    module, _, made_by = TOPICS[name].partition(":")
    text = getattr(import_module(f"mouse_cli.{module}"), made_by)()
    return text if isinstance(text, str) else json.dumps(text, indent=1)


@click.command()
@click.argument("topic")
def command(topic: str) -> int:
    """Explain a code, an estimator, a deck key or another TOPIC.

    TOPIC is a code (MD104), an estimator, recursion, status, element or candidate, a field of the cards (NPARD), an
    operation of the report (O-2), a key of YAML decks (shapes, or modes.shapes), or: cards, candidates, elements,
    methods, yaml, schema, exit.
    """
    if topic in TOPICS:
        click.echo(_topic(topic))
        return 0
    entries: dict[str, str] = {}
    for key, entry in _entries():  # a mass is an element and a candidate
        entries[key] = f"{entries[key]}\n\n{entry}" if key in entries else entry
    parts = topic.split(".")
    names = [topic, topic.upper(), *(".".join(parts[k:]) for k in range(1, len(parts)))]  # test.modes.shapes: modes.shapes
    text = next((entries[name] for name in names if name in entries), None)
    if text is None:
        near = difflib.get_close_matches(topic, [*entries, *TOPICS], 3)
        hint = f" Near to it: {', '.join(near)}." if near else ""
        raise click.UsageError(
            f"nothing is known of '{topic}'.{hint} `mouse list` shows the names, `mouse explain yaml` the keys of decks."
        )
    click.echo(text)
    return 0


def _entries() -> Iterator[tuple[str, str]]:
    """Everything that has a name and an explanation."""
    from mouse_cli.codes import catalogue
    from mouse_cli.diagnosis import candidate_manual
    from mouse_cli.diagnosis.likelihoods.candidates import OWN
    from mouse_cli.diagnosis.mechanisms import registry as mechanisms
    from mouse_cli.diagnosis.nameless import registry as rivals
    from mouse_cli.estimators import registry as estimators
    from mouse_cli.formats.cards.operations import explanations
    from mouse_cli.formats.yaml_deck import reference
    from mouse_cli.methods import manual as method_manual
    from mouse_cli.methods import registry as methods
    from mouse_cli.terms.element_manual import about
    from mouse_cli.terms.elements import registry
    from mouse_cli.terms.laws import registry as laws
    from mouse_cli.updating.loop import RECURSIONS
    from mouse_cli.updating.statuses import STATUSES

    for key in {status.key: None for status in STATUSES.values()}:
        ends = [status for status in STATUSES.values() if status.key == key]
        text = "\n\n".join(f"{_FACT.sub('...', end.sentence)}\n{end.advice}".rstrip() for end in ends)
        yield key, f"status {key}, exit {ends[0].exit_code}\n\n{text}"
    for code, entry in catalogue().items():
        yield code, f"{code}: {entry.title}\n\n{entry.meaning}\n\n{entry.remedy}"
    for key, estimator in estimators().items():
        yield key, f"{estimator.title}\n\n{estimator.equation}"
    for key, method in methods().items():
        yield key, method_manual.about(method)
    for key, recursion in RECURSIONS.items():
        yield key, f"{key}: {recursion.MEANING}"
    for key, kind in registry().items():
        yield key, about(kind)
    for known in (mechanisms(), OWN, laws()):
        for key, candidate in known.items():
            yield key, candidate_manual.about(candidate)
    for key, rival in rivals().items():
        yield key, candidate_manual.about_nameless(rival)
    yield from explanations()
    yield from reference.entries()
