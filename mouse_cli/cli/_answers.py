"""An answer as text: JSON, or the report in the look and to the length asked for."""

from mouse_cli.cli._options import value_of

_AS_ASKED = "as the command line says"


def answer_text(found: object, numbers: str | None = None, full: bool = False, form: str | None = _AS_ASKED) -> str:
    """The answer as JSON, Markdown, or what is printed.

    numbers: their style, full: whether all is printed, where the command line says nothing of it; form: another one than it asks.
    """
    from mouse_cli.cli._terminal import json_text
    from mouse_cli.report import document, written

    form = value_of("form") if form == _AS_ASKED else form
    if form == "json":
        return json_text(document(found))
    full = full or bool(value_of("full"))
    return written(found, form or ("printout" if full else "screen"), value_of("numbers") or numbers, short=not full)


def deliver_answer(found: object, deck: str, numbers: str | None = "modern", full: bool = False) -> None:
    """The figures of an answer, and its text, to where the command line asks for them. Raises WrittenError."""
    from mouse_cli.cli._terminal import deliver, drawn

    drawn(found)
    deliver(answer_text(found, numbers, full), value_of("output"), deck)
