"""The physics that a diagnosis knows, in Markdown: for `mouse explain candidates` and the reference."""

from mouse_cli.diagnosis.likelihoods.candidates import OWN
from mouse_cli.diagnosis.mechanisms import Candidate, registry
from mouse_cli.terms.laws import Law

_HEAD = """# Candidates

What `mouse diagnose` can name. Each is fitted beside all parameters of the deck, wherever it has a meaning; candidates that data
can hardly tell apart share a group, and the group is decided first. [Diagnosis](../explanation/diagnosis.md) explains how."""


def manual() -> str:
    """All candidates: a table of the groups, then each candidate."""
    members = dict(sorted((registry() | OWN).items()))
    groups: dict[str, list[str]] = {}
    for key, candidate in members.items():
        groups.setdefault(candidate.group, []).append(key)
    rows = [f"| {name} | {', '.join(f'[{key}](#{key})' for key in keys)} |" for name, keys in sorted(groups.items())]
    table = "\n".join(["| group | candidates |", "|---|---|", *rows])
    return "\n\n".join([_HEAD, table, *(f"## {key}\n\n{_told(candidate)}" for key, candidate in members.items())])


def about(candidate: Candidate | Law) -> str:
    """One candidate, or law of recordings, in plain text."""
    return f"candidate {candidate.key}, group {candidate.group}\n\n{_told(candidate)}"


def _told(candidate: Candidate | Law) -> str:
    meaning = candidate.meaning.rstrip(".")
    return f"{candidate.title[0].upper()}{candidate.title[1:]}: {meaning}. Group: {candidate.group}."
