"""Answers of commands as documents and pages, made once, and what reads a page."""

import contextlib
import io
import json
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from tempfile import TemporaryDirectory

from mouse_cli.cli.main import _run
from mouse_cli.page import DOCUMENTS, page, read

DECKS = Path(__file__).resolve().parents[1] / "decks"
RUNS = {"shapes": "table_5_3", "frequencies": "garteur_smag19", "functions": "chain_functions", "beam": "cantilever"}
DIAGNOSES = {
    "named": "ground_spring",
    "nothing": "table_5_3",
    "one-of": "three_storey_building",
    "drawn": "chain_functions",
}
OTHERS = {
    "compared": ("compare", "tube_frame"),
    "predicted": ("modes", "three_storey_building"),
    "correlated": ("correlate", "cantilever"),
    "identified": ("identify", "chain_functions"),
}
NAMES = (*RUNS, *DIAGNOSES, "arrangements", *OTHERS)
STRUCTURES = (
    "frequencies",
    "functions",
    "beam",
    "one-of",
    "drawn",
    "arrangements",
    "predicted",
)  # of nodes with positions
VOID = {"meta", "input"}


@cache
def answer(name: str) -> bytes:
    """The document so called, as its command writes it."""
    if name in RUNS:
        with TemporaryDirectory() as folder:
            path = Path(folder) / "answer.json"
            _run(["run", str(DECKS / f"{RUNS[name]}.yaml"), "--json", "-q", "-o", str(path)])
            return path.read_bytes()
    layouts = [str(path) for path in sorted((DECKS / "arrangements").glob("layout*.yaml"))]
    decks = layouts if name == "arrangements" else [str(DECKS / f"{DIAGNOSES.get(name)}.yaml")]
    with contextlib.redirect_stdout(io.StringIO()) as told:
        if name in OTHERS:
            _run([OTHERS[name][0], str(DECKS / f"{OTHERS[name][1]}.yaml"), "--json", "-q"])
        else:
            _run(["diagnose", *decks, "--json", "-q"])
    return told.getvalue().encode()


def document(name: str) -> dict:
    return json.loads(answer(name))


@cache
def made(name: str) -> str:
    """The page of the answer so called."""
    return page(read(answer(name), f"{name}.json", DOCUMENTS))


class Reader(HTMLParser):
    """Elements of a page as (name, attributes, text so far); fails on an element that another one's end closes."""

    def __init__(self, text: str):
        super().__init__()
        self.open, self.all = [], []
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag, attrs):
        names = [name for name, _ in attrs]
        assert len(names) == len(set(names)), f"an attribute twice: {self.get_starttag_text()}"
        element = {"tag": tag, "attrs": dict(attrs), "text": "", "path": [e["tag"] for e in self.open]}
        self.all.append(element)
        if tag not in VOID:
            self.open.append(element)

    def handle_endtag(self, tag):
        assert self.open.pop()["tag"] == tag

    def handle_data(self, data):
        for element in self.open:
            element["text"] += data

    def named(self, tag):
        return [e for e in self.all if e["tag"] == tag]
