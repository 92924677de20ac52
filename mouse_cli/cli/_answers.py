"""An answer as text: JSON, or the report in the look and to the length asked for."""

import click

_FULL = "mouse_cli.full"  # among the `meta` of click's context


def keep_full(context: click.Context, _: click.Parameter, value: bool) -> None:
    """Callback of `--full`, so that no command need pass it on."""
    context.meta[_FULL] = value


def answer_text(found: object, form: str | None, numbers: str | None, full: bool = False) -> str:
    """The answer as JSON, Markdown, or what is printed; full: whole without `--full` too."""
    from mouse_cli.cli._terminal import json_text
    from mouse_cli.report import document, written

    if form == "json":
        return json_text(document(found))
    context = click.get_current_context(silent=True)
    full = full or bool(context and context.meta.get(_FULL))
    looks = form or ("printout" if full else "screen")
    return written(found, looks, numbers, short=not full)
