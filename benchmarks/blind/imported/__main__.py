"""The command: structures, concealed changes, imports, diagnoses, a table. `python -m benchmarks.blind.imported --seed 1`."""

import argparse
import json
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from benchmarks.blind.calculix import solve
from benchmarks.blind.diagnose import diagnosed
from benchmarks.blind.imported.parts import MATERIALS, Concealed, Mesh, cards
from benchmarks.blind.imported.scoring import NAMED, OPEN, UNSEEN, outcome
from benchmarks.blind.imported.structures import STRUCTURES
from benchmarks.blind.imported.trip import predicted

KINDS = ("control", "missing", "softer", "material", "heavier", "loose", "mass", "weld", "thinner", "rubber", "two")
MODES, FREQUENCY_SD, SHAPE_SD = 8, 0.001, 0.01  # fitted; of each frequency; of the largest component of a mode
_VISIBLE = 9.0  # noncentrality, three standard deviations in all, below which no answer but an open one can be had
_SIZES = {  # factors
    "softer": (0.3, 0.7), "heavier": (1.6, 3.0), "material": (0.0, 0.0), "weld": (0.02, 0.2), "thinner": (0.5, 0.75),
}  # fmt: skip
_FEET = 4  # supports of which two may be loose, at least
_E_SD = 0.02  # of the true moduli, which the deck holds known to 5 %


def changes(name: str, mesh: Mesh, rng: np.random.Generator) -> Iterator[Concealed]:
    """One concealed change of each kind."""
    for kind in KINDS:
        E = {key: float(1 + _E_SD * rng.standard_normal()) for key in MATERIALS}
        pick = lambda of: of[int(rng.integers(len(of)))]
        of = STRUCTURES[name].of(kind)
        if kind == "control":
            yield Concealed(E=E)
        elif not of or (kind == "two" and len(mesh.supports) < _FEET):
            continue
        elif kind == "missing":
            yield Concealed(kind, pick(of), E=E)
        elif kind == "loose":
            yield Concealed(
                kind, pick(tuple(mesh.supports)), float(rng.choice([0.0, 1.0])) * 10 ** rng.uniform(5, 6), E
            )
        elif kind == "rubber":
            yield Concealed(kind, "all supports", 10 ** rng.uniform(5, 6.5), E, float(rng.uniform(0.15, 0.4)))
        elif kind == "two":
            some = sorted(rng.choice(len(mesh.supports), 2, replace=False))
            yield Concealed(kind, " and ".join(list(mesh.supports)[i] for i in some), 0.0, E)
        elif kind == "mass":
            yield Concealed(kind, str(pick(mesh.sensors)[0]), float(rng.uniform(0.03, 0.1)) * mass(mesh), E)
        else:
            low, high = _SIZES[kind]
            yield Concealed(kind, pick(of), float(rng.uniform(low, high)), E)


def mass(mesh: Mesh) -> float:
    """Of the whole structure, kg."""
    at = {n: np.array(place) for place, n in mesh.number.items()}
    total = 0.0
    for kind, elements, material, thickness in mesh.sets.values():
        for nodes in elements:
            x = [at[n] for n in nodes]
            if kind == "S4":
                size = np.linalg.norm(np.cross(x[1] - x[0], x[3] - x[0])) * thickness
            elif kind == "B31":
                size = np.linalg.norm(x[1] - x[0]) * thickness**2
            else:
                size = abs(np.linalg.det(np.array([x[1] - x[0], x[3] - x[0], x[4] - x[0]])))
            total += MATERIALS[material][2] * size
    return float(total)


def visible(mesh: Mesh, change: Concealed) -> float:
    """Noncentrality: what the change does to the frequencies and shapes of the test, without noise, in its standard deviations.

    Revised moduli may follow a part of it, so that the test shows less.
    """
    hz, shapes = zip(*(_test(mesh, each)[:2] for each in (change, Concealed(E=change.E))), strict=True)
    scale = [each / abs(each).max(axis=0) for each in shapes]
    like = abs(scale[0].T @ scale[1]) / np.outer(*(np.linalg.norm(each, axis=0) for each in scale))
    total = 0.0
    for i, j in enumerate(like.argmax(axis=1)):
        moved = scale[0][:, i] - np.sign(scale[0][:, i] @ scale[1][:, j]) * scale[1][:, j]
        total += (np.log(hz[0][i] / hz[1][j]) / FREQUENCY_SD) ** 2 + (moved @ moved) / SHAPE_SD**2
    return float(total)


def _test(mesh: Mesh, change: Concealed) -> tuple[np.ndarray, np.ndarray, list[tuple[int, int]]]:
    """Frequencies (m,), shapes (s, m) and sensors of the structure as it is."""
    truth = solve(cards(mesh, change, MODES + 4))
    elastic = truth.frequency > 1e-2 * truth.frequency[-1]
    order = {n: i for i, n in enumerate(truth.nodes.tolist())}
    gone = (change.name,) if change.kind == "missing" else ()
    there = {n for name, each in mesh.sets.items() if name not in gone for nodes in each[1] for n in nodes}
    held = {n for nodes in mesh.supports.values() for n in nodes}
    sensors = [each for each in dict.fromkeys(mesh.sensors) if each[0] in there - held]
    shapes = truth.shapes[:, [order[n] for n, _ in sensors], [d - 1 for _, d in sensors]][elastic][:MODES].T
    return truth.frequency[elastic][:MODES], shapes, sensors


def delivered(folder: Path, name: str, mesh: Mesh, change: Concealed, rng: np.random.Generator) -> Path:
    """The deck of an import of the structure as it is drawn, with the test of the structure as it is."""
    from mouse_cli.importing.run import imported

    hz, shapes, sensors = _test(mesh, change)
    shapes = shapes / abs(shapes).max(axis=0)
    shapes += SHAPE_SD * rng.standard_normal(shapes.shape)
    hz = hz * (1 + FREQUENCY_SD * rng.standard_normal(len(hz)))
    rank = np.argsort(hz)
    folder.mkdir(parents=True, exist_ok=True)
    job, deck = folder / f"{name}.inp", folder / f"{name}.yaml"
    job.write_text(cards(mesh, Concealed()))
    imported(str(job), deck, "SI", True, lambda text: None)
    labels = ", ".join(f"{n}T{'XYZ'[d - 1]}" for n, d in sensors)
    rows = "\n".join("      - [" + ", ".join(f"{x:.4f}" for x in row) + "]" for row in shapes[:, rank])
    test = f"""
test:
  modes:
    frequency: [{", ".join(f"{f:.5g}" for f in hz[rank])}]
    frequency_sd: {100 * FREQUENCY_SD} %
    dofs: [{labels}]
    shapes:
{rows}
    shape_sd: {100 * SHAPE_SD} %
"""
    deck.write_text(deck.read_text().split("# The test goes here")[0] + test)
    return deck


def main() -> None:
    """Parse the options and print the table."""
    given = _options().parse_args()
    folder, counts = given.output or Path(tempfile.mkdtemp(prefix="imported-")), Counter()
    for name in given.structures:
        for seed in given.seed:
            rng = np.random.default_rng([seed, list(STRUCTURES).index(name)])
            mesh = STRUCTURES[name].build(rng)
            for change in changes(name, mesh, rng):
                if change.kind not in given.kinds:
                    continue
                own = np.random.default_rng([seed, list(STRUCTURES).index(name), KINDS.index(change.kind)])
                deck = delivered(folder / f"{name}-{seed}-{change.kind}", name, mesh, change, own)
                if given.decks_only:
                    continue
                document = diagnosed(deck, deck.with_name("extended.yaml"))
                deck.with_suffix(".json").write_text(json.dumps(document))
                result, said = outcome(change, document, mesh)
                judged = result == OPEN and "refused" not in document and change.kind not in ("control", "missing")
                if judged and visible(mesh, change) < _VISIBLE:
                    result = UNSEEN
                counts[change.kind == "control", result] += 1
                back = _back(deck, mesh, change, counts) if result == NAMED else ""
                print(f"{name:8} {seed:3} {change.kind:9} {change.name:12} {result:8} {back}{said}", flush=True)
    for (control, result), count in sorted(counts.items()):
        print(f"{'controls' if control else 'changes'}: {count} {result}")


def _back(deck: Path, mesh: Mesh, change: Concealed, counts: Counter) -> str:
    """What ccx predicts of held-out modes with the exported job."""
    found = predicted(deck.with_suffix(".inp"), deck.with_name("extended.yaml"), mesh, change, MODES)
    counts[False, "named, and then: " + ("not exported" if isinstance(found, str) else
                                         "better predicted" if found[1] < found[0] else "worse predicted")] += 1  # fmt: skip
    return f"[{found}] " if isinstance(found, str) else f"[held-out {100 * found[0]:.2g} -> {100 * found[1]:.2g} %] "


def _options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.blind.imported", description=sys.modules[__name__].__doc__
    )
    parser.add_argument("--seed", type=int, nargs="+", default=[1], help="structures, changes and noise")
    parser.add_argument("--structures", nargs="+", choices=STRUCTURES, default=list(STRUCTURES))
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=list(KINDS), help="changes")
    parser.add_argument("--output", type=Path, help="folder of decks and answers; else a temporary one")
    parser.add_argument("--decks-only", action="store_true", help="make decks, diagnose nothing")
    return parser


if __name__ == "__main__":
    main()
