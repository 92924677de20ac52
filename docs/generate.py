"""Writes the generated pages: docs/reference/{cli,yaml,elements,methods,candidates,codes,statuses,estimators}.md, the card part
of the manual, the map of the layers, docs/explanation/layers.svg, and the picture of the README, docs/explanation/found_spring.svg.

Run it from anywhere after a change of an option, a deck key, a card, a diagnostic code or a status:

    python docs/generate.py            write the pages
    python docs/generate.py --check    write nothing; exit 1 and name the pages that are not current
"""

import re
import sys
from collections.abc import Iterator
from pathlib import Path

DOCS = Path(__file__).resolve().parent
sys.path[:0] = [str(DOCS.parent), str(DOCS)]

import click  # noqa: E402
import found_spring  # noqa: E402
import layers_map  # noqa: E402
from click.testing import CliRunner  # noqa: E402

from mouse_cli._registry import discover  # noqa: E402
from mouse_cli.cli.main import cli  # noqa: E402
from mouse_cli.codes import catalogue  # noqa: E402
from mouse_cli.updating.loop import RECURSIONS  # noqa: E402
from mouse_cli.updating.statuses import STATUSES  # noqa: E402

BEGIN, END = "<!-- mouse explain cards: begin -->", "<!-- mouse explain cards: end -->"
_NOTE = "<!-- Written by docs/generate.py; do not edit. -->\n"
_RANGES = {
    "MD1": "Card decks",
    "MD2": "YAML decks and matrix files",
    "MD3": "What a deck says",
    "MD4": "Structures",
    "MD5": "What the numbers say",
    "MD6": "Recordings",
    "MD7": "Coupled and modified structures",
    "MD9": "Batches and pages",
}
_BLANKS = {  # the words in braces of a status sentence, as the page shows them
    "cycles": "c", "exceedances": "e", "data": "q", "allowed": "a", "cycle": "c", "reason": "reason", "names": "names",
    "chi2_first": "first", "chi2_last": "last",
}  # fmt: skip


def told(*arguments: str) -> str:
    """What `mouse` answers to `arguments`."""
    result = CliRunner().invoke(cli, arguments, prog_name="mouse", terminal_width=100, max_content_width=100)
    if result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result.output.strip() + "\n"


def pages() -> dict[Path, str]:
    """Every generated page, whole, by its path."""
    return {
        DOCS / "explanation" / "found_spring.svg": found_spring.drawing(),
        DOCS / "explanation" / "layers.svg": layers_map.drawing(),
        DOCS / "manual.md": manual((DOCS / "manual.md").read_text("utf-8")),
        DOCS / "reference" / "cli.md": "\n".join(_cli()),
        DOCS / "reference" / "yaml.md": f"{_NOTE}\n{told('explain', 'yaml')}",
        DOCS / "reference" / "elements.md": f"{_NOTE}\n{told('explain', 'elements')}",
        DOCS / "reference" / "methods.md": f"{_NOTE}\n{told('explain', 'methods')}",
        DOCS / "reference" / "candidates.md": f"{_NOTE}\n{told('explain', 'candidates')}",
        DOCS / "reference" / "codes.md": "\n".join(_codes()),
        DOCS / "reference" / "statuses.md": "\n".join(_statuses()),
        DOCS / "reference" / "estimators.md": "\n".join(_estimators()),
    }


def manual(page: str) -> str:
    """The manual with its generated part renewed; headings one level down, the first one left out."""
    before, _, rest = page.partition(BEGIN)
    _, _, after = rest.partition(END)
    cards = re.sub(r"^(#+) ", r"#\1 ", told("explain", "cards"), flags=re.MULTILINE)
    cards = re.sub(r"\A## .*\n+", "", cards)
    return f"{before}{BEGIN}\n\n{cards.strip()}\n\n{END}{after}"


def _cli() -> Iterator[str]:
    yield _NOTE
    yield "# Commands\n"
    yield "`-` instead of a deck is standard input. The answer goes to standard output, everything else to standard error.\n"
    yield f"```\n{told('--help')}```\n"
    context = click.Context(cli)
    for name in cli.list_commands(context):
        yield f"## mouse {name}\n"
        yield f"```\n{told(name, '--help')}```\n"
    yield "## Exit codes\n"
    yield f"```\n{told('explain', 'exit')}```"
    yield ""


def _codes() -> Iterator[str]:
    yield _NOTE
    yield "# Diagnostic codes\n"
    yield (
        "`mouse explain CODE` prints the same. An error ends the command without an answer (exit 4, or 5 where the "
        "numbers fail); a warning does not.\n"
    )
    heading = None
    for code, entry in catalogue().items():
        if heading != code[:3]:
            heading = code[:3]
            yield f"## {heading}xx: {_RANGES[heading]}\n"
        yield f"### {code}\n"
        yield f"**{entry.title}.** {entry.meaning}\n"
        yield f"*Remedy:* {entry.remedy}\n"


def _statuses() -> Iterator[str]:
    yield _NOTE
    yield "# Statuses\n"
    yield (
        "How a run ended: the key `status` of the JSON document and the first line of the verdict. Exit 0 becomes exit 1 "
        "where other values fit as well, and where the [form of the model](../explanation/model-form.md) is rejected.\n"
    )
    yield "| status | exit | mouse says | advice |"
    yield "|---|---|---|---|"
    for status in STATUSES.values():
        yield f"| `{status.key}` | {status.exit_code} | {_filled(status.sentence)} | {_filled(status.advice)} |"
    yield ""


def _filled(sentence: str) -> str:
    plain = sentence.replace("|", "\\|").replace("*", "\\*")
    return re.sub(r"\{(\w+)[^}]*\}", lambda found: f"*{_BLANKS[found[1]]}*", plain)


def _estimators() -> Iterator[str]:
    yield _NOTE
    yield "# Estimators and recursions\n"
    yield "See [estimators](../explanation/estimators.md) and [recursions](../explanation/recursions.md) for what they mean.\n"
    yield "## Estimators\n"
    yield "| `--estimator` | name | equation | weights data by R | uses the prior |"
    yield "|---|---|---|---|---|"
    for key, row in discover("mouse_cli.estimators", "ESTIMATOR").items():
        flags = " | ".join("yes" if flag else "no" for flag in (row.weighted, row.uses_prior))
        yield f"| `{key}` | {row.title} | `{row.equation}` | {flags} |"
    yield "\n## Recursions\n"
    yield "| `--recursion` | meaning |"
    yield "|---|---|"
    for key, recursion in RECURSIONS.items():
        yield f"| `{key}` | {recursion.MEANING} |"
    yield ""


def main(arguments: list[str]) -> int:
    """Write the pages, or with --check name those that are not current."""
    stale = [path for path, text in pages().items() if not path.exists() or path.read_text("utf-8") != text]
    for path in stale:
        print(path.relative_to(DOCS.parent))
        if "--check" not in arguments:
            path.parent.mkdir(exist_ok=True)
            path.write_text(pages()[path], "utf-8")
    return 1 if stale and "--check" in arguments else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
