"""Sound inputs: the sample decks and the tests' samples of every format, each with the files that it names."""

import io
import sys
from contextlib import redirect_stdout
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DECKS = ROOT / "decks"
_HEAVY = ("plate_calculix", "tube_frame", "garteur", "cracked_bar", "saturn", "beam_58", "eighteen")
_MATRICES = "mouse: 1\nmodel: {{stiffness: {{file: {}{}}}, mass: {{diagonal: [1.0, 2.0, 3.0]}}}}\n"
_TEST = (
    "parameters: [{name: k, nominal: 1, sd: 10 %, stiffness: [[1, 1, 1.0e+5]]}]\n"
    "test: {modes: {frequency: [30.0, 60.0], frequency_sd: 1 %}}\n"
)
_RECORDED = """\
mouse: 1
title: Two masses, recorded
model:
  stiffness: {order: 2, entries: [[1, 1, 5.0e4], [1, 2, -3.0e4], [2, 2, 3.0e4]]}
  mass: {diagonal: [1, 1]}
  damping: {order: 2, entries: [[1, 1, 6.0], [1, 2, -3.6], [2, 2, 3.6]]}
parameters:
  - {name: k1, nominal: 2.0e4, sd: 5 %, stiffness: [[1, 1, 1]]}
laws: [{law: cubic, variant: hardening, at: [1, 2], values: {cubic_stiffness: 2.0e8}}]
test:
  recordings:
    - title: run 1
      file: run.csv
      segment: [0, 300]
      inputs: [{sensor: 2, channel: f, quantity: force, unit: N}]
      outputs: [{sensor: 1, channel: a1, quantity: acceleration, unit: m/s2}, {sensor: 2, channel: a2, unit: g}]
    - {title: run 2, file: run.csv, sample_rate: 512, inputs: {2: f}, outputs: {1: a1, 2: a2}, segment: [300, 512]}
  hold_out: {recordings: [run 2]}
"""


@dataclass(frozen=True)
class Seed:
    """main: the file that a command is given; kind: deck, large, records, couple, modify, data, result, manifest."""

    main: str
    kind: str
    files: dict[str, bytes]


def seeds(scratch: Path) -> list[Seed]:
    """All of them; scratch: an empty folder for what other programs' writers write."""
    return [*_decks(), *_arrangements(), *_samples(scratch), *_recorded(scratch), *_answers()]


def _read(*paths: Path) -> dict[str, bytes]:
    return {str(path.relative_to(DECKS)): path.read_bytes() for path in paths}


def _decks() -> list[Seed]:
    found = []
    for path in sorted((*DECKS.glob("*.yaml"), *DECKS.glob("*.dat"), *(DECKS / "coupled").glob("*.yaml"))):
        text = path.read_text()
        named = [one for one in DECKS.glob("*/*") if one.suffix != ".py" and str(one.relative_to(DECKS)) in text]
        if path.parent != DECKS:
            files = {one.name: one.read_bytes() for one in path.parent.glob("*.yaml")}
            kind = next((key for key in ("couple", "modify") if f"\n{key}:" in text), "modify")
        else:
            files, kind = _read(path, *named), "large" if path.name.startswith(_HEAVY) else "deck"
        found.append(Seed(path.name, kind, files))
    plate = DECKS / "plate_calculix" / "plate.inp"
    return [*found, Seed(plate.name, "inp", {plate.name: plate.read_bytes()})]


def _arrangements() -> list[Seed]:
    files = {path.name: path.read_bytes() for path in sorted((DECKS / "arrangements").glob("*.yaml"))[:3]}
    return [Seed(next(iter(files)), "deck", files)]


def _samples(scratch: Path) -> list[Seed]:
    sys.path.insert(0, str(ROOT / "tests" / "property"))
    import samples

    made: dict[str, dict[str, bytes]] = {}
    for package, formats in samples.FILES.items():
        for name, sample in ((name, one) for each in formats.values() for name, one in each.items()):
            samples.write(scratch / name, sample)
            made.setdefault(package, {})[name] = (scratch / name).read_bytes()
    found = [Seed(name, "data", {name: raw}) for name, raw in made["recording_files"].items()]
    for name, raw in made["matrix_files"].items():
        deck = (_MATRICES.format(name, ", variable: K.K" if "cells" in name else "") + _TEST).encode()
        found.append(Seed("matrices.yaml", "deck", {"matrices.yaml": deck, name: raw}))
    for key, package in (("dofs", "dof_files"), ("nodes", "node_files")):
        for name, raw in made[package].items():
            files = {"triples.csv": made["matrix_files"]["triples.csv"], "job.dof": made["dof_files"]["job.dof"]}
            text = _MATRICES.format("triples.csv", "")[:-2] + f", {key}: {{file: {name}}}"
            text += ("" if key == "dofs" else ", dofs: {file: job.dof}") + "}\n"
            found.append(Seed("places.yaml", "deck", {"places.yaml": (text + _TEST).encode(), **files, name: raw}))
    texts = {
        "spring.yaml": "deck",
        "frame.yaml": "deck",
        "couple.yaml": "couple",
        "modify.yaml": "modify",
        "jobs.yaml": "manifest",
    }
    own = {"spring.yaml": samples.SPRING, "frame.yaml": samples.FRAME, "couple.yaml": samples.COUPLED,
           "modify.yaml": samples.MODIFIED, "jobs.yaml": samples.MANIFEST}  # fmt: skip
    beside = {path.name: path.read_bytes() for path in (DECKS / "coupled").glob("*.yaml")}
    for name, kind in texts.items():
        near = beside if kind in ("couple", "modify") else {"spring.yaml": own["spring.yaml"].encode()}
        found.append(Seed(name, kind, {**near, name: own[name].encode()}))
    return found


def _recorded(scratch: Path) -> list[Seed]:
    """A deck of recordings: two masses under a random force, as scipy simulates them; and the file alone."""
    import numpy as np
    from scipy.signal import cont2discrete, dlsim

    k, c = np.array([[5e4, -3e4], [-3e4, 3e4]]), np.array([[6.0, -3.6], [-3.6, 6.0]])
    a, b = np.block([[np.zeros((2, 2)), np.eye(2)], [-k, -c]]), np.array([[0.0], [0.0], [0.0], [1.0]])
    rng = np.random.default_rng(1)
    force = 20 * rng.standard_normal(512)
    seen = dlsim(cont2discrete((a, b, a[2:], b[2:]), 1 / 512), force)[1]
    seen *= 1 + 0.01 * rng.standard_normal(seen.shape)
    table = np.column_stack([np.arange(512) / 512, force, seen])
    path = scratch / "table.csv"
    np.savetxt(path, table, delimiter=",", header="t (s),f (N),a1 (m/s2),a2 (g)", comments="", fmt="%.7g")
    raw = path.read_bytes()
    return [
        Seed("recorded.yaml", "records", {"recorded.yaml": _RECORDED.encode(), "run.csv": raw}),
        Seed("run.csv", "data", {"run.csv": raw}),
    ]


def _answers() -> list[Seed]:
    """What commands write with --json, of sound decks."""
    from mouse_cli.cli.main import _run

    asked = {"run.json": ["run", "sound_chain.yaml"], "diagnosis.json": ["diagnose", "ground_spring.yaml", "--causes", "1"],
             "modes.json": ["modes", "cantilever.yaml"], "comparison.json": ["compare", "sound_chain.yaml"],
             "sound.json": ["run", "table_5_2.yaml"]}  # fmt: skip
    found = []
    for name, (command, deck, *more) in asked.items():
        stream = io.StringIO()
        with redirect_stdout(stream):
            _run([command, str(DECKS / deck), "--json", "-q", *more])
        files = {name: stream.getvalue().encode(), "sound_chain.yaml": (DECKS / "sound_chain.yaml").read_bytes()}
        found.append(Seed(name, "result", files))
    return found
