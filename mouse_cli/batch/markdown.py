"""The outcomes of a batch in GitHub's Markdown: what a merge request, or the summary of a job, shows."""

from collections.abc import Iterable

from mouse_cli.batch.outcome import Outcome
from mouse_cli.batch.summary import count
from mouse_cli.report.renderers.markdown import verbatim

_MOST = 200  # rows of a table; servers cut summaries off at a megabyte
_HEADINGS = ("deck", "command", "exit", "ended", "expected")
_MARKS = {0: "✅", 1: "⚠️"}


def markdown_text(outcomes: list[Outcome]) -> str:
    """The count; a table of the jobs that are not well, what each missed in it; one of the others, folded."""
    bad = [each for each in outcomes if each.counted or each.missed]
    well = [each for each in outcomes if not (each.counted or each.missed)]
    parts = [f"**{count(outcomes)}**", _table(bad)]
    if well:
        parts.append(f"<details><summary>{len(well)} as they should be</summary>\n\n{_table(well)}\n\n</details>")
    return "\n\n".join(filter(None, parts)) + "\n"


def _table(outcomes: list[Outcome]) -> str:
    if not outcomes:
        return ""
    rows = [_line(_HEADINGS), _line("---" for _ in _HEADINGS), *(_line(_cells(each)) for each in outcomes[:_MOST])]
    more = len(outcomes) - _MOST
    return "\n".join([*rows, *([f"\n{more} more are left out."] if more > 0 else [])])


def _line(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _cells(found: Outcome) -> tuple[str, ...]:
    mark = "❌" if found.missed else _MARKS.get(found.counted, "❌")
    headlines = [verbatim(each.headline) for each in (*found.missed, *found.errors[:1])]
    met = f"{found.expected - len(found.missed)} of {found.expected}" if found.expected else ""
    ended = "<br>".join([verbatim(found.ended), *headlines])
    return (f"{mark} {verbatim(found.deck)}", found.command, str(found.exit_code), ended, met)
