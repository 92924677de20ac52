"""The outcomes of a batch as people and programs read them: table, CSV, JUnit XML, annotations of GitHub."""

import re
from collections.abc import Iterable, Iterator

from mouse_cli import _texts
from mouse_cli._errors import ERROR, Diagnostic
from mouse_cli.batch.outcome import Outcome

_WIDEST = 60  # characters of the name of a deck in the table
_HEADINGS = ("deck", "command", "exit", "ended", "residual_p", "expected", "missed", "findings", "message", "result")
_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def table(outcomes: list[Outcome], only_bad: bool = False) -> str:
    """One line for each job in order, what it missed below it; then the count. only_bad: without those that are well."""
    shown = [each for each in outcomes if not only_bad or each.counted or each.missed]
    width = max((len(_deck(each)) for each in shown), default=0)
    lines = [line for each in shown for line in _lines(each, width)]
    return "\n".join([*lines, count(outcomes)]) + "\n"


def _lines(found: Outcome, width: int) -> Iterator[str]:
    ending = f"expected {found.expected - len(found.missed)}/{found.expected}" if found.expected else ""
    yield f"{_deck(found):<{width}}  {found.command:<8}  {found.exit_code}  {_plain(found.ended):<40}  {ending}".rstrip()
    yield from (f"    {_plain(each.headline)}" for each in (*found.missed, *found.errors[:1]))


def _deck(found: Outcome) -> str:
    """The name, or its end; never what a CI server takes for a command, which begins with two colons."""
    name = _plain(found.deck)
    name = name if len(name) <= _WIDEST else f"...{name[3 - _WIDEST :]}"
    return f"./{name}" if name.startswith("::") else name


def _plain(text: str) -> str:
    """The text on one line."""
    return "".join(c if c.isprintable() else "?" for c in text)


def count(outcomes: list[Outcome]) -> str:
    """How many ended how."""
    codes = [each.exit_code for each in outcomes]
    meanings = {0: "trusted or sound", 1: "not to be trusted", 4: "rejected", 5: "without an answer"}
    parts = [f"{codes.count(code)} {words}" for code, words in meanings.items() if code in codes]
    missed = sum(bool(each.missed) for each in outcomes)
    judged = sum(bool(each.expected) for each in outcomes)
    parts += [f"{missed} of {judged} missed what was expected"] if judged else []
    there = sum(each.resumed for each in outcomes)
    parts += [f"{there} done before"] if there else []
    return f"{len(outcomes)} job{'' if len(outcomes) == 1 else 's'}: {', '.join(parts)}"


def csv_text(outcomes: Iterable[Outcome]) -> str:
    """A table for spreadsheets; no cell is a formula, whatever decks and parameters are called."""
    return _texts.csv_text((_HEADINGS, *map(_row, outcomes)))


def _row(found: Outcome) -> tuple[object, ...]:
    codes = " ".join(dict.fromkeys(each.code for each in found.diagnostics))
    message = "; ".join(each.message for each in found.missed or found.errors[:1])
    p = None if found.residual_p is None else f"{found.residual_p:.6g}"
    return (
        found.deck, found.command, found.exit_code, found.ended, p, found.expected, len(found.missed), codes, message, found.result,
    )  # fmt: skip


def junit_text(outcomes: list[Outcome], name: str = "mouse batch") -> str:
    """JUnit XML: a failure is an answer that is not trusted or not as expected, an error a job without an answer."""
    from xml.etree import ElementTree

    root = ElementTree.Element("testsuites")
    failures = sum(_kind(each) == "failure" for each in outcomes)
    errors = sum(_kind(each) == "error" for each in outcomes)
    seconds = f"{sum(each.seconds for each in outcomes):.3f}"
    counts = {"tests": str(len(outcomes)), "failures": str(failures), "errors": str(errors), "skipped": "0"}
    suite = ElementTree.SubElement(root, "testsuite", {"name": _xml(name), **counts, "time": seconds})
    for each in outcomes:
        named = {"classname": f"mouse.{each.command}", "name": _xml(each.deck), "file": _xml(each.deck)}
        case = ElementTree.SubElement(suite, "testcase", {**named, "time": f"{each.seconds:.3f}"})
        if _kind(each):
            reasons = [found.headline for found in (*each.missed, *each.errors)] or [each.ended]
            below = ElementTree.SubElement(
                case, _kind(each), {"message": _xml(reasons[0]), "type": _xml(each.ended.split()[0])}
            )
            below.text = _xml("\n".join(reasons))
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=False) + "\n"


def _kind(found: Outcome) -> str:
    if found.missed:
        return "failure"
    return {0: "", 1: "failure"}.get(found.counted, "error")


def _xml(text: str) -> str:
    return _NOT_XML.sub("?", text)


def annotations(outcomes: Iterable[Outcome]) -> str:
    """Workflow commands by which GitHub shows findings beside their lines; missed expectations in the manifest."""
    return "".join(f"{_annotation(each, one)}\n" for each in outcomes for one in _findings(each))


def _findings(found: Outcome) -> tuple[Diagnostic, ...]:
    if found.exit_code == 1 and found.counted and not found.missed:
        ended = Diagnostic("not trusted", "warning", found.ended)
        return (*found.diagnostics, ended)
    return (*found.missed, *found.diagnostics)


def _annotation(found: Outcome, finding: Diagnostic) -> str:
    span = finding.span
    place = {"file": span.file, "line": span.line, "col": span.column} if span else {"file": found.deck}
    properties = {**place, "title": f"mouse {found.command}: {finding.code}"}
    given = ",".join(f"{key}={_escaped(str(value), True)}" for key, value in properties.items())
    kind = "error" if finding.severity == ERROR and not _settled(found, finding) else "warning"
    return f"::{kind} {given}::{_escaped(finding.message)}"


def _settled(found: Outcome, finding: Diagnostic) -> bool:
    """An error that the manifest expects is no alarm."""
    return finding not in found.missed and not found.counted


def _escaped(text: str, within: bool = False) -> str:
    """As the runner of GitHub decodes it."""
    pairs = [("%", "%25"), ("\r", "%0D"), ("\n", "%0A"), *([(":", "%3A"), (",", "%2C")] if within else [])]
    for plain, coded in pairs:
        text = text.replace(plain, coded)
    return text
