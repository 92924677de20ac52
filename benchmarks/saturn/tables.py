"""What `python -m benchmarks.saturn` prints; figures of the study are quoted beside, and are not compared with by any rule."""

from collections.abc import Sequence

import numpy as np

from benchmarks.saturn.of_1972 import Update
from benchmarks.saturn.rivals import Rival
from benchmarks.saturn.stack import MASS, MEASURED, PREDICTED, STAGES, Vehicle
from mouse_cli.dynamics.correlation import mac

ONE_PARAMETER = ("shear", "rotary-inertia", "timoshenko")
THIN_TUBE = 5.32  # E / (kappa G) = 2 (1 + nu) / kappa, kappa = 1/2, nu = 0.33
STUDY = {  # median ln Z, rms % of the five fitted, median error % of modes 4 and 5 from 1 to 3
    "none": (-395, 12.1, 41),
    "rotary-inertia": (-51, 3.2, 17),
    "shear": (-20, 1.4, 7.9),
    "timoshenko": (-22, 1.8, 9.0),
    "oscillator": (-16, 0.06, 9.7),
    "mass": (-306, None, None),
    "ground-spring": (-124, 6.6, 33),
    "compression": (-398, None, None),
    "joint": (-296, None, None),
    "stiffness-loss": (-49, 3.2, 36),
}


def vehicles(family: Sequence[Vehicle], found: np.ndarray) -> str:
    """The family: how heavy, how stiff, how near to the predicted frequencies `found` (v, 5)."""
    lines = [f"{len(family)} vehicles, 58 degrees of freedom, bending only; predicted frequencies and worst error:"]
    worst = np.abs(found / PREDICTED - 1).max(axis=0)
    lines += ["  " + " ".join(f"{f:.3f} Hz ({100 * e:.2f} %)" for f, e in zip(PREDICTED, worst, strict=True))]
    mass = [vehicle.mass / MASS for vehicle in family]
    lines += [f"  mass {min(mass):.2f} to {max(mass):.2f} of 2767 t; EI (N m2), median [range] over the vehicles:"]
    for i, stage in enumerate(STAGES):
        EI = np.concatenate([vehicle.EI[vehicle.stage == i] for vehicle in family])
        lines.append(f"    {stage.name:28} {np.median(EI):.1e} [{EI.min():.1e}, {EI.max():.1e}]")
    return "\n".join(lines)


def of_1972(rows: Sequence[dict[int, Update]]) -> str:
    """Loop and innovation, a line for each vehicle."""
    lines = ["the loop of 1972, upper half free (14 EI, 25 %; data 1 %), and the innovation test on the same deck"]
    lines.append(
        "  vehicle  modes 1-2: loop, factors, p        modes 1-3: p   modes 1-5: loop, factors after one cycle, p"
    )
    for number, row in enumerate(rows, 1):
        two, three, five = row[2], row[3], row[5]
        lines.append(
            f"  {number:7}  {two.status} {two.cycles:2} {_range(two.factors)} {two.p:6.2f}"
            f"   {three.p:11.0e}   {five.status} {_range(five.factors)} {five.p:.0e}"
        )
    for k, quoted in ((2, "0.88"), (3, "5e-07"), (5, "6e-141")):
        p = np.array([row[k].p for row in rows])
        lines.append(
            f"  modes 1-{k}: p median {np.median(p):.1e} [{p.min():.0e}, {p.max():.0e}]; study, one vehicle: {quoted}"
        )
    negative = sum(row[5].factors.min() < 0 for row in rows)
    lines.append(
        f"  a stiffness turns negative in the first cycle of modes 1-5: {negative} of {len(rows)}; study: -3.18 to 3.74"
    )
    return "\n".join(lines)


def evidence(rows: Sequence[dict[str, Rival]], early: Sequence[dict[str, Rival]]) -> str:
    """Candidates on five frequencies, and what modes 1 to 3 foretell of 4 and 5."""
    lines = [
        "candidates of mouse diagnose; five frequencies, 1 %; EI of each stage 30 %. Study's figures in parentheses"
    ]
    lines.append(
        f"  {'candidate':15} {'ln Z median [range]':>26} {'over none':>10} {'rms %':>12} {'1-3 -> 4-5, %':>16}"
    )
    for key in rows[0]:
        Z = np.array([row[key].fit.log_evidence for row in rows if key in row])
        gain = np.median([row[key].gain for row in rows if key in row])
        rms = 100 * np.median([row[key].rms for row in rows if key in row])
        study = STUDY.get(key, (None, None, None))
        ahead = 100 * np.median(error_ahead(early, key)) if key in early[0] else None
        lines.append(
            f"  {key:15} {np.median(Z):7.0f} [{Z.min():.0f}, {Z.max():.0f}] {_study(study[0])} {gain:10.0f}"
            f" {rms:6.2f} {_study(study[1])} {'' if ahead is None else f'{ahead:6.1f}'} {_study(study[2])}"
        )
    return "\n".join([*lines, *counts(rows), *sizes(rows)])


def error_ahead(early: Sequence[dict[str, Rival]], key: str) -> np.ndarray:
    """|errors| of modes 4 and 5 (v, 2) by candidates that were fitted to modes 1 to 3."""
    return np.array([np.abs(row[key].hz[3:5] / MEASURED[3:5] - 1) for row in early if key in row])


def counts(rows: Sequence[dict[str, Rival]]) -> list[str]:
    """How often which candidate leads."""
    over = np.array([row["shear"].gain - row["rotary-inertia"].gain for row in rows])
    single = [[r for r in row.values() if r.fit.model.t == 1 and r.key != "timoshenko"] for row in rows]
    lead = _tally([max(own, key=_gain).key for own in single])
    best = _tally([max(row.values(), key=_gain).key for row in rows])
    return [
        f"  shear over rotary inertia: {(over > 0).sum()} of {len(rows)}, by {_spread(over, 0)} nats (study: 9 of 12)",
        f"  first of those with one parameter: {lead}",
        f"  first of all: {best} (study: oscillator 8, shear 3, shear and joint 1)",
    ]


def _gain(one: Rival) -> float:
    return one.gain


def sizes(rows: Sequence[dict[str, Rival]]) -> list[str]:
    """What the candidates would have to be."""

    def found(key: str, name: str) -> np.ndarray:
        return np.array([row[key].values[name] for row in rows])

    shear = _spread(found("shear", "E / (kappa G)") / THIN_TUBE, 1)
    turning = _spread(found("rotary-inertia", "times density I of the section"), 1)
    tons, hz = _spread(found("oscillator", "mass") / 1e3, 0), _spread(found("oscillator", "frequency"), 2)
    return [
        f"  shear: {shear} times a thin tube's (study: 2.6 [1.0, 3.5])",
        f"  rotary inertia: {turning} times the section's own (study: 8.5 [1, 31])",
        f"  oscillator: {tons} t at {hz} Hz, {_spread(found('oscillator', 'place'), 0)} m from the top",
        "    (study: 30 to 500 t at 1.7 to 2.5 Hz)",
    ]


def settling(rows: Sequence[dict[str, Rival]]) -> str:
    """What would tell shear from the oscillator: mode 6, and shapes of modes 3 to 5."""
    lines = ["what would settle it"]
    for key, quoted in (("shear", "5.9 to 7.1"), ("oscillator", "8.2 to 8.7")):
        hz = np.array([row[key].hz[5] for row in rows])
        lines.append(f"  mode 6 after {key}: {hz.min():.1f} to {hz.max():.1f} Hz (study: {quoted})")
    alike = np.array([mac(row["shear"].shapes, row["oscillator"].shapes).diagonal() for row in rows])
    lines.append(
        "  MAC between both, 19 stations of Table 5-5, median: "
        + " ".join(f"mode {i + 1} {np.median(alike[:, i]):.2f}" for i in range(5))
        + " (study, modes 3 to 5: 0.91 0.82 0.79)"
    )
    return "\n".join(lines)


def thin_tube(plain: np.ndarray, turning: np.ndarray) -> str:
    """Frequencies over measured ones without a fitted parameter but the scale of EI: (v, 5) with shear, and with both."""
    before = np.array(PREDICTED) / MEASURED
    lines = ["shear of a thin tube, EI scaled on mode 1 alone, over measured; median over the vehicles"]
    for name, values, quoted in (
        ("bending", before, "1.014 1.010 1.198 1.379 1.561"),
        ("with shear", np.median(plain / MEASURED, axis=0), "1.000 0.995 1.113 1.153 1.165"),
        ("with rotary inertia too", np.median(turning / MEASURED, axis=0), "1.000 0.989 1.111 1.134 1.141"),
    ):
        lines.append(f"  {name:24}" + " ".join(f"{v:.3f}" for v in values) + f"   (study: {quoted})")
    removed = 1 - (np.median(plain / MEASURED, axis=0) - 1)[2:] / (before - 1)[2:]
    lines.append(
        "  of the excess of modes 3 4 5, shear removes "
        + " ".join(f"{100 * r:.0f}" for r in removed)
        + " % (study: 43 60 71 %)"
    )
    return "\n".join(lines)


def _spread(values: np.ndarray, digits: int) -> str:
    """Median [least, most]."""
    return f"{np.median(values):.{digits}f} [{values.min():.{digits}f}, {values.max():.{digits}f}]"


def _range(values: np.ndarray) -> str:
    return f"{values.min():5.2f} .. {values.max():4.2f}"


def _study(value) -> str:
    return f"{'' if value is None else f'({value:g})':>7}"


def _tally(names: Sequence[str]) -> str:
    return ", ".join(
        f"{name} {names.count(name)}" for name in sorted(set(names), key=lambda one: -list(names).count(one))
    )
