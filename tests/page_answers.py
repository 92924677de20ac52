"""Answers of commands as documents and pages, made once, and what reads a page."""

import contextlib
import io
import json
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from once import once
from scipy.signal import lfilter

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
OTHERS = {  # command, deck, options; FOLDER stands for a folder of its own
    "compared": ("compare", "tube_frame"),
    "predicted": ("modes", "three_storey_building"),
    "correlated": ("correlate", "cantilever"),
    "identified": ("identify", "chain_functions"),
    "coupled": ("couple", "coupled/portal"),
    "modified": ("modify", "coupled/portal_calmed"),
    "swept": ("sweep", "table_5_3", "--vary", "k1.sd=5000,20000", "-j", "1", "-o", "FOLDER"),
    "resampled": ("bootstrap", "table_5_3", "--replicates", "20", "-j", "1", "-o", "FOLDER"),
    "sampled": ("sample", "twin_springs"),
    "spectra": ("spectra", "FOLDER/run.csv", "--force", "1=f", "--response", "2=a", "--sample-rate", "256"),
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
    return once(f"{name}.json", lambda: _written(name))


def _written(name: str) -> bytes:
    if name in RUNS:
        with TemporaryDirectory() as folder:
            path = Path(folder) / "answer.json"
            _run(["run", str(DECKS / f"{RUNS[name]}.yaml"), "--json", "-q", "-o", str(path)])
            return path.read_bytes()
    layouts = [str(path) for path in sorted((DECKS / "arrangements").glob("layout*.yaml"))]
    decks = layouts if name == "arrangements" else [str(DECKS / f"{DIAGNOSES.get(name)}.yaml")]
    with contextlib.redirect_stdout(io.StringIO()) as told, TemporaryDirectory() as folder:
        if name in OTHERS:
            command, source, *options = OTHERS[name]
            recorded(Path(folder) / "run.csv")
            words = [source.replace("FOLDER", folder) if "." in source else str(DECKS / f"{source}.yaml"), *options]
            _run([command, *(folder if word == "FOLDER" else word for word in words), "--json", "-q"])
        else:
            _run(["diagnose", *decks, "--json", "-q"])
    return told.getvalue().encode()


def recorded(path: Path) -> None:
    """A minute of white noise through one resonance at 20 Hz, with noise on the response."""
    rng = np.random.default_rng(1)
    force = rng.standard_normal(60 * 256)
    pole = np.exp((-0.02 + 1j) * 2 * np.pi * 20 / 256)
    response = lfilter([1.0, -2.0, 1.0], [1.0, -2 * pole.real, abs(pole) ** 2], force) + 0.1 * rng.standard_normal(
        len(force)
    )
    np.savetxt(path, np.column_stack([force, response]), delimiter=",", header="f,a", comments="")


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
