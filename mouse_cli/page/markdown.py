"""An answer in short, in GitHub's Markdown, for a merge request: verdict first, then what changed.

Names and texts of a deck are escaped: no markup, no mention, no link and no reference comes of them.
"""

import re
from collections.abc import Iterator, Sequence

from mouse_cli.page.numbers import apart, probable, shown, signed_per_cent
from mouse_cli.page.sections import verdict
from mouse_cli.page.sections._unjudged import UNJUDGED
from mouse_cli.page.sections._words import places
from mouse_cli.page.sections.field import significant, title, words_of
from mouse_cli.page.tables import Cell
from mouse_cli.report.reading import Part, updates
from mouse_cli.report.renderers.markdown import verbatim

_LONG, _MOST = 10, 200  # rows beyond which a table is folded, and beyond which it is cut
_COUNTS = 1e-3  # probability from which on a cause is reported
_JOINER = "\u2060"  # takes no room; servers find no mention, link or reference across it
_MARKUP = re.compile(r"([\\`*_{}\[\]<>()#+!|~&$^=-])")
_HIDDEN = re.compile("[\x00-\x1f\x7f-\x9f\u200b-\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufeff]+")
_FOUND = re.compile(r"(@|#|(?<=\w):(?=\S)|www(?=\.)|\bgh-|\b[0-9a-f](?=[0-9a-f]{6,39}\b))", re.IGNORECASE)


def summary(document: Part) -> str:
    """The answer as Markdown, some lines for a reader of a merge request. Raises DeckError (MD922)."""
    blocks = [f"**{escaped(verdict.mark(document)[1])}.** {escaped(verdict.sentence(document))}"]
    if not document.part("verdict"):
        blocks.append(escaped(verdict.form(document)))
    blocks.append(_listed([*verdict.further(document), *document.texts("cautions")]))
    blocks += [
        *_field(document),
        *_causes(document),
        *_untried(document),
        *_frequencies(document),
        *_parameters(document),
    ]
    blocks += [*_records(document), *_methods(document), *_unjudged(document)]
    remarks = [*document.texts("remarks"), *document.texts("warnings")]
    if remarks:
        blocks += _folds(_counted(remarks, "remark"), _listed(remarks[:_MOST]))
    return "\n\n".join(filter(None, [*blocks, _origin(document)])) + "\n"


def escaped(text: str) -> str:
    """`text` as plain words.

    >>> print(escaped("a * b: see @all, <b>, #12, www.x.org").replace(_JOINER, "~"))
    a \\* b: see @~all, \\<b\\>, \\#~12, www~.x.org
    """
    plain = _HIDDEN.sub(" ", text)
    joined = _FOUND.sub(lambda at: at[0] + _JOINER, plain)
    return re.sub(r"^(\s*\d+)([.)])", r"\1\\\2", _MARKUP.sub(r"\\\1", joined))


def _origin(document: Part) -> str:
    decks = [document.text("source")] if document.text("source") else document.labels("sources")
    named = ", ".join(decks[:2]) + (f" and {len(decks) - 2} more" if len(decks) > 2 else "")
    return f"<sub>{verbatim(document.text('title'))} {verbatim(named)} mouse {verbatim(document.text('version'))}</sub>"


def _causes(document: Part) -> Iterator[str]:
    """Explanations that count, with place, size and probability; the others folded."""
    rows, others = [], []
    for one in document.parts("candidates"):
        p, title = one.number("probability"), escaped(one.text("title") or one.text("physics"))
        row = (title, verbatim(places(one)), _sizes(one), probable(p))
        (rows if (p or 0.0) >= _COUNTS else others).append(row)
    heads = ("mechanism", "site", "size", "probability")
    yield _table(heads, rows[:_MOST])
    if others:
        yield from _folds(f"What else was tried: {len(others)}", _table(heads, others[:_MOST]))


def _field(document: Part) -> Iterator[str]:
    """Physics without a name: the values that differ from none by more than two standard deviations."""
    found = document.part("verdict").part("field")
    chosen, others = significant(found)
    rows = [(verbatim(name), value, sd) for name, value, sd in map(words_of(found), chosen)]
    left = f"; {_counted(others, 'site')} with negligible values left out" if others else ""
    yield from _folded_table(f"{escaped(title(found))}{left}", ("site", "value", "sd"), rows, "site", _MOST)


def _untried(document: Part) -> Iterator[str]:
    """Candidates that were left out, folded."""
    found = document.part("verdict").parts("untried")
    if found:
        listed = [f"{each.text('physics')}: {each.text('reason')}" for each in found[:_MOST]]
        yield from _folds(f"Not tried: {_counted(found, 'candidate')}", _listed(listed))


def _sizes(one: Part) -> str:
    found = []
    for size in one.parts("parameters"):
        unit = f" {verbatim(size.text('unit'))}" if size.text("unit") not in ("", "1") else ""
        value, sd = shown(size.number("value"), 4), shown(size.number("sd"), 2)
        found.append(f"{escaped(size.text('name'))} {value}{unit} (sd {sd})")
    return ", ".join(found) or "–"


def _frequencies(document: Part) -> Iterator[str]:
    """Before and after: the prior and the revised model; in a diagnosis the model as it is and with the mechanism, both revised."""
    found, extended = [part for _, _, part in updates(document)], bool(document.part("extended"))
    if not found:
        return
    key = "revised_hz" if extended else "prior_hz"
    before = {mode.label("mode"): mode.number(key) for mode in found[0].parts("modes")}
    rows = []
    for mode in found[-1].parts("modes"):
        label, test, after = mode.label("mode"), mode.number("test_hz"), mode.number("revised_hz")
        off = [signed_per_cent(apart(value, test)) for value in (before.get(label), after)]
        cells = (shown(test), shown(before.get(label)), off[0], shown(after), off[1], shown(mode.number("mac"), 4))
        rows.append((escaped(label), *cells))
    names = ("as it is, Hz", "with the mechanism, Hz") if extended else ("before, Hz", "after, Hz")
    yield from _folded_table(
        "Frequencies", ("mode", "test, Hz", names[0], "off", names[1], "off", "MAC"), rows, "mode", _LONG
    )


def _parameters(document: Part) -> Iterator[str]:
    """Of the last model that was updated; folded where causes are the answer."""
    for _, name, found in updates(document)[-1:]:
        rows = []
        for each in found.parts("parameters"):
            prior, value = each.number("prior"), each.number("posterior")
            sd = each.number("posterior_sd" if "posterior_sd" in each.values else "sd")
            label, unit = verbatim(each.text("name")), verbatim(each.text("unit"))
            rows.append((label, unit, shown(prior), shown(value), shown(sd, 3), signed_per_cent(apart(value, prior))))
        heads = ("parameter", "unit", "before", "after", "sd", "change")
        longest = 0 if document.part("verdict") else _LONG
        yield from _folded_table(f"Parameters of {name}", heads, rows, "parameter", longest)


def _records(document: Part) -> Iterator[str]:
    """What is missed of records held out, by the rms of each output."""
    rows = []
    for each in document.part("held_out").parts("records"):
        before, after = (each.part("error").numbers(key) for key in ("as it is", "with the cause"))
        for i, rms in enumerate(each.numbers("rms")):
            errors = [shown(x[i], 4) if i < len(x) else "–" for x in (before, after)]
            rows.append((verbatim(each.text("title")), str(i + 1), shown(rms, 4), *errors))
    yield _table(("record held out", "output", "rms", "missed before", "missed after"), rows[:_MOST])


def _methods(document: Part) -> Iterator[str]:
    """What each method misses of what it was given, and of each configuration that it was not."""
    found = document.parts("methods")
    titles = list(dict.fromkeys(c.text("title") for one in found for c in one.parts("configurations")))
    rows = []
    for one in found:
        missed = {c.text("title"): shown(c.number("rms_percent"), 3) for c in one.parts("configurations")}
        rows.append((verbatim(one.text("method")), *(missed.get(title, "–") for title in titles)))
    yield _table(("missed, % rms", *map(escaped, titles)), rows)


def _unjudged(document: Part) -> Iterator[str]:
    """The tables of answers that judge no model."""
    kind = UNJUDGED.get(document.text("schema"))
    for found in kind.tables(document) if kind else ():
        rows = [tuple(escaped(_words(cell)) for cell in row) for row in found.rows()]
        yield from _folded_table(escaped(found.caption), tuple(map(escaped, found.heads)), rows, "line", _LONG)


def _words(cell: object) -> str:
    return cell if isinstance(cell, str) else cell.words if isinstance(cell, Cell) else shown(cell)


def _folded_table(title: str, heads: Sequence[str], rows: list[tuple[str, ...]], unit: str, longest: int) -> list[str]:
    """A table under its title, folded where it has more rows than `longest`."""
    if not rows:
        return []
    if len(rows) <= longest:
        return [f"{title}:", _table(heads, rows)]
    cut = f", the first {_MOST}" if len(rows) > _MOST else ""
    return _folds(f"{title}: {_counted(rows, unit)}{cut}", _table(heads, rows[:_MOST]))


def _counted(found: Sequence[object], unit: str) -> str:
    return f"{len(found)} {unit}{'s' * (len(found) > 1)}"


def _folds(title: str, body: str) -> list[str]:
    return [f"<details><summary>{title}</summary>", body, "</details>"]


def _listed(texts: list[str]) -> str:
    return "\n".join(f"- {escaped(words)}" for words in texts)


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    if not rows:
        return ""
    lines = [heads, ["---"] + ["---:"] * (len(heads) - 1), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)
