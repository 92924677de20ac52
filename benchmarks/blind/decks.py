"""A case as two things: a deck, which holds what an engineer would know, and an answer, which the tool never reads."""

import hashlib
import json
from pathlib import Path

import numpy as np

from benchmarks.blind.case import Case
from benchmarks.blind.test_data import Config, Measured


def name_of(case: Case, words: tuple) -> str:
    """A name that says nothing: part of a hash."""
    return hashlib.sha256(repr((case.name, *words)).encode()).hexdigest()[:10]


def deliver(folder: Path, case: Case, test: Measured, config: Config, known: dict) -> tuple[Path, dict]:
    """The deck in `folder`/decks, the answer in `folder`/answers, and both."""
    for name in ("decks", "answers"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    name = name_of(case, tuple(known["words"]))
    path = write(folder / "decks", name, case, test, config)
    (folder / "answers" / f"{name}.json").write_text(json.dumps(known))
    return path, known


def write(folder: Path, name: str, case: Case, test: Measured, config: Config) -> Path:
    """The deck, and the files that it refers to."""
    path = folder / f"{name}.yaml"
    for file, text in case.files.items():
        if not (folder / file).exists():
            (folder / file).write_text(text)
    path.write_text(as_text(name, case, test, config))
    return path


def as_text(name: str, case: Case, test: Measured, config: Config) -> str:
    """The deck as YAML."""
    return f"mouse: 1\ntitle: {name}\n\n{case.model}\n{_test(case, test, config)}"


def _test(case: Case, test: Measured, config: Config) -> str:
    """The section `test`."""
    lines, dofs = ["test:"], []
    own = [(f"s{n}", case.sites[s]) for n, s in enumerate(test.sites, 1) if isinstance(case.sites[s], dict)]
    if own:
        lines.append("  sensors:")
        lines += [f"    - {{name: {n}, at: {site['at']}, direction: {site['direction']}}}" for n, site in own]
    for n, s in enumerate(test.sites, 1):
        dofs.append(f"s{n}" if isinstance(case.sites[s], dict) else case.sites[s])
    m = len(test.frequency)
    rows = ["      - [" + ", ".join(f"{x:.5f}" for x in row) + "]" for row in test.shapes]
    lines += [
        "  modes:",
        f"    number: {list(case.numbers[:m])}",
        f"    frequency: [{', '.join(f'{f:.8g}' for f in test.frequency)}]",
        f"    frequency_sd: {100 * config.frequency_sd:g} %",
        f"    dofs: [{', '.join(dofs)}]",
        *("    shapes:", *rows, f"    shape_sd: {100 * config.shape_sd:g} %"),
        "  hold_out:",
        f"    modes: {list(case.numbers[config.modes : m])}",
        "    altered:",
        "      - title: mass added",
        f"        mass: {case.altered}",
        f"        number: {list(case.numbers[: len(test.altered)])}",
        f"        frequency: [{', '.join(f'{f:.8g}' for f in test.altered)}]",
        f"        frequency_sd: {100 * config.frequency_sd:g} %",
    ]
    return "\n".join(lines) + "\n"


def answer(case: Case, truth: dict[str, np.ndarray], words: tuple) -> dict:
    """What the deck does not say, for scoring."""
    kept = (
        "name",
        "kind",
        "truth",
        "groups",
        "places",
        "ends",
        "span",
        "outside",
        "tolerated",
        "altered",
        "sensor_fault",
        "numbers",
        "sizes",
    )
    return {k: getattr(case, k) for k in kept} | {"frequency": truth["frequency"].tolist(), "words": list(words)}
