"""The file of a job's answer, schema mouse.job/1: written whole or not at all, and read again by a batch that goes on."""

import json
from dataclasses import asdict, dataclass
from typing import Any

from mouse_cli import __version__
from mouse_cli._atomic import write_text_atomically
from mouse_cli._errors import Diagnostic
from mouse_cli._span import Span
from mouse_cli.batch.job import Job

SCHEMA = "mouse.job/1"


@dataclass(frozen=True)
class Answer:
    """What a job came to: exit code, findings, the document of its command (None for check and for rejected decks).

    identity: of the job that it answers; empty for an answer that is to be sought again, such as a worker that died.
    """

    identity: str
    exit_code: int
    diagnostics: tuple[Diagnostic, ...]
    document: dict[str, Any] | None
    seconds: float = 0.0


def write(path: str, job: Job, answer: Answer) -> None:
    """Write the answer of `job` to `path`. Raises WrittenError."""
    found = {
        "schema": SCHEMA,
        "version": __version__,
        "job": answer.identity or None,
        "deck": job.deck,
        "command": job.command,
        "options": job.options,
        "exit_code": answer.exit_code,
        "seconds": round(answer.seconds, 6),
        "diagnostics": [asdict(each) for each in answer.diagnostics],
        "document": answer.document,
    }
    write_text_atomically(path, json.dumps(found, allow_nan=False) + "\n")


def read(path: str, identity: str) -> Answer | None:
    """The answer in `path` when it is that of the job so identified; None for any other, and for a file that is damaged."""
    try:
        with open(path, encoding="utf-8") as stream:
            found = json.load(stream)
        if found["schema"] != SCHEMA or found["job"] != identity:
            return None
        diagnostics = tuple(_diagnostic(each) for each in found["diagnostics"])
        return Answer(identity, int(found["exit_code"]), diagnostics, found["document"], float(found["seconds"]))
    except (OSError, ValueError, KeyError, TypeError, RecursionError):  # absent, cut short, or not of ours
        return None


def _diagnostic(found: dict[str, Any]) -> Diagnostic:
    span = found["span"]
    return Diagnostic(**{**found, "span": None if span is None else Span(**span)})
