"""Reads the pages of docs/: their fenced blocks and links."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
DOCS = TOP / "docs"
PAGES = sorted(DOCS.rglob("*.md"))


@dataclass(frozen=True)
class Block:
    """A fenced block: its language, its lines, and the line of the page it starts on."""

    language: str
    lines: tuple[str, ...]
    line: int

    @property
    def text(self) -> str:
        """What the file holds: on cards there is no place for the line that names it."""
        lines = self.lines[1:] if (self.file or "").endswith(".dat") else self.lines
        return "\n".join(lines) + "\n"

    @property
    def file(self) -> str | None:
        """The name in a first line such as `# rig.yaml`: the block is then the content of that file."""
        found = re.fullmatch(r"# ([\w-]+\.(?:yaml|dat|py|sh))", self.lines[0]) if self.lines else None
        return found[1] if found else None


def blocks(page: Path) -> Iterator[Block]:
    """The fenced blocks of `page`, in order."""
    language, lines, start = None, [], 0
    for number, line in enumerate(page.read_text("utf-8").splitlines(), 1):
        if line.startswith("```"):
            if language is None:
                language, lines, start = line[3:].strip(), [], number
            else:
                yield Block(language, tuple(lines), start)
                language = None
        elif language is not None:
            lines.append(line)


@dataclass(frozen=True)
class Command:
    """A `$ ...` line of a console block with the lines expected after it and the exit code told by `# exit 1`."""

    command: str
    expected: tuple[str, ...]
    exit_code: int


def commands(block: Block) -> Iterator[Command]:
    """The commands of a console block."""
    command, expected = None, []
    for line in (*block.lines, "$ "):
        if line.startswith("$ "):
            if command is not None:
                text, _, told = command.partition("# exit ")
                yield Command(text.strip(), tuple(expected), int(told or 0))
            command, expected = line[2:], []
        else:
            expected.append(line)


def differs(expected: tuple[str, ...], output: str) -> str:
    """Why `output` is not what was expected, where a line `...` stands for any lines; empty when it is.

    The width of blanks does not count: a column may grow without making a page wrong.
    """
    got = [_squeezed(line) for line in output.rstrip("\n").split("\n")] if output.strip() else []
    place, free = 0, False
    for chunk in _chunks(expected):
        if chunk is None:
            free = True
            continue
        starts = range(place, len(got)) if free else [place]
        found = next((i for i in starts if got[i : i + len(chunk)] == chunk), None)
        if found is None:
            missing = next((line for line in chunk if line not in got[place:]), chunk[0])
            near = get_close_matches(missing, got[place:], 3, 0.4)
            return "expected\n  " + "\n  ".join(chunk) + f"\nbut not found: {missing}\nnear to it: {near}"
        place, free = found + len(chunk), False
    if not free and place != len(got):
        return "more lines than expected:\n  " + "\n  ".join(got[place:])
    return ""


def _squeezed(line: str) -> str:
    return re.sub(r"\s+", " ", line.strip())


def _chunks(expected: tuple[str, ...]) -> Iterator[list[str] | None]:
    """Runs of lines, with None for each `...`."""
    run: list[str] = []
    for line in expected:
        if line.strip() == "...":
            if run:
                yield run
            yield None
            run = []
        else:
            run.append(_squeezed(line))
    if run:
        yield run
