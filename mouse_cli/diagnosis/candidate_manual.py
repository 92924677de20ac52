"""The physics that a diagnosis knows, and the rivals without a name, in Markdown: for `mouse explain` and the reference."""

from mouse_cli._texts import capital
from mouse_cli.diagnosis.likelihoods.candidates import OWN
from mouse_cli.diagnosis.mechanisms import Candidate, registry
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless import registry as rivals
from mouse_cli.terms.laws import Law

_HEAD = """# Candidates

What `mouse diagnose` can name. Each is fitted beside all parameters of the deck, wherever it has a meaning; candidates that data
can hardly distinguish share a group, and the group is decided first. [Diagnosis](../explanation/diagnosis.md) explains how."""
_NAMELESS = """## Rivals without a name

Changes of the model made of smooth random fields, one kind a row: what the library has no name for looks more like one of these
than like the nearest candidate. They compete with all candidates by evidence and are never named; where one leads and no mechanism
is a rival, the answer is `unknown` with the values of the field. [Diagnosis](../explanation/diagnosis.md#rivals-without-a-name)
explains how. `--candidates` and `--without` do not concern them.
"""


def manual() -> str:
    """All candidates: a table of the groups, then each candidate."""
    members = dict(sorted((registry() | OWN).items()))
    groups: dict[str, list[str]] = {}
    for key, candidate in members.items():
        groups.setdefault(candidate.group, []).append(key)
    rows = [f"| {name} | {', '.join(f'[{key}](#{key})' for key in keys)} |" for name, keys in sorted(groups.items())]
    table = "\n".join(["| group | candidates |", "|---|---|", *rows])
    named = [f"## {key}\n\n{_summary(candidate)}" for key, candidate in members.items()]
    return "\n\n".join([_HEAD, table, *named, _nameless()])


def _nameless() -> str:
    """All rivals without a name: a table, then each."""
    found = rivals()
    rows = [f"| [{key}](#{key}) | {rival.title} | `{rival.property}` |" for key, rival in found.items()]
    table = "\n".join(["| rival | it is | `verdict.field.property` |", "|---|---|---|", *rows])
    return "\n\n".join([_NAMELESS, table, *(f"### {key}\n\n{_meant(rival)}" for key, rival in found.items())])


def about(candidate: Candidate | Law) -> str:
    """One candidate, or law of recordings, in plain text."""
    return f"candidate {candidate.key}, group {candidate.group}\n\n{_summary(candidate)}"


def about_nameless(rival: Nameless) -> str:
    """One rival without a name, in plain text."""
    return f"rival without a name {rival.key}\n\n{_meant(rival)}"


def _meant(rival: Nameless) -> str:
    spreads = ", ".join(f"{spread:g}" for spread in rival.spreads)
    return f"{_sentence(rival)} Spreads (sd of the field): {spreads}. Property: {rival.property}."


def _summary(candidate: Candidate | Law) -> str:
    return f"{_sentence(candidate)} Group: {candidate.group}."


def _sentence(one: Candidate | Law | Nameless) -> str:
    return f"{capital(one.title)}: {one.meaning.rstrip('.')}."
