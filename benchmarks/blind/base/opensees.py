"""Truths: motions of a building on a moving table from OpenSees, by its own elements, materials and modal damping."""

import numpy as np

from benchmarks.blind.base.storeys import CUBIC_TO, RATE, Storeys, table
from benchmarks.blind_records.opensees import STEPS, limited, recorded

_POINTS = 4000  # of the curve of a softening storey


def motions(case: Storeys, run: int) -> tuple[np.ndarray, np.ndarray]:
    """Acceleration of the table (t,), and what the sensors of the floors read (t, n), at RATE and limited to its band."""
    given = table(case, run, RATE * STEPS)
    found = simulated(case, given, 1 / (RATE * STEPS), "disp" if case.lvdt else "accel")
    if not case.lvdt:
        found = found + given[:, None]
    return given[::STEPS], limited(found)


def simulated(case: Storeys, given: np.ndarray, h: float, what: str) -> np.ndarray:
    """Displacements or accelerations (t, n) relative to the table at every step h, Newmark's average acceleration."""
    import openseespy.opensees as ops

    n = len(case.m)
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    for i in range(n + 1):
        ops.node(i, 0.0)
    ops.fix(0, 1)
    for i, m in enumerate(case.m):
        ops.mass(i + 1, float(m))
    for i, k in enumerate(case.k):
        lost = case.values["share"] if (case.kind, case.place) == ("stiffness-loss", i) else 0.0
        ops.uniaxialMaterial("Elastic", i + 1, float(k * (1 - lost)))
        ops.element("zeroLength", i + 1, i, i + 1, "-mat", i + 1, "-dir", 1, "-doRayleigh", 0)
    ops.eigen("-fullGenLapack", n)
    ops.modalDamping(*map(float, case.zeta))
    _mechanism(ops, case)
    ops.timeSeries("Path", 1, "-dt", h, "-values", *given.tolist(), "-prependZero")
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    return recorded(ops, n, len(given), h, what, case.name)


def _mechanism(ops, case: Storeys) -> None:
    """The concealed mechanism beside storey `place`; a stop of the table beside floor `place`."""
    p, near, far, tag = case.values, case.place, case.place + 1, 100
    if case.kind in ("none", "stiffness-loss"):
        return
    if case.kind == "added-mass":
        ops.mass(far, float(case.m[case.place] + p["m"]))
        return
    if case.kind == "hysteresis":
        ops.uniaxialMaterial("ElasticPP", tag, p["kt"], p["Fs"] / p["kt"])
    elif case.kind == "softening":
        reach = CUBIC_TO * np.sqrt(case.k[case.place] / p["k3"])
        x = np.linspace(-reach, reach, 2 * _POINTS + 1)
        ops.uniaxialMaterial("ElasticMultiLinear", tag, "-strain", *x, "-stress", *(-p["k3"] * x**3))
    else:
        _stops(ops, tag, p, both=case.kind == "loose-brace")
        near = 0 if case.kind == "pounding" else near
    ops.element("zeroLength", 100, near, far, "-mat", tag, "-dir", 1, "-doRayleigh", 0)


def _stops(ops, tag: int, p: dict[str, float], both: bool) -> None:
    """Elastic stops beyond a clearance, on both sides or on that of extension."""
    reach = 1e3
    x = np.array([-(1 + reach), -1, 1, 1 + reach]) * p["g"]
    F = np.array([-reach if both else 0.0, 0.0, 0.0, reach]) * p["g"] * p["kc"]
    ops.uniaxialMaterial("ElasticMultiLinear", tag, "-strain", *x, "-stress", *F)
