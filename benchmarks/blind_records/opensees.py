"""Truths: motions of a chain from OpenSees, by its own elements and materials."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from benchmarks.blind_records.chain import SAMPLE_RATE, Chain, force

STEPS = 16  # in a sample
RECORDED = {"acceleration": "accel", "velocity": "vel", "displacement": "disp"}  # what the solver calls a quantity
_POINTS = 4000  # of the curve of a cubic spring


def motions(chain: Chain, quantity: str = "acceleration") -> np.ndarray:
    """Motions of the masses (t, n) at SAMPLE_RATE, limited to the band of the samples."""
    rate = SAMPLE_RATE * STEPS
    return limited(run(chain, force(chain, rate), 1 / rate, what=RECORDED[quantity]))


def limited(fine: np.ndarray) -> np.ndarray:
    """Samples (t, n) behind a steep low pass at 0.45 of the sample rate, as a data acquisition system gives them; mirrored at the
    ends, where a displacement is not what it was at the beginning.
    """
    whole = np.concatenate([fine, fine[::-1]])
    lines = np.fft.rfft(whole, axis=0)
    keep = np.fft.rfftfreq(len(whole), 1 / STEPS) <= 0.45
    return np.fft.irfft(lines * keep[:, None], len(whole), axis=0)[: len(fine) : STEPS]


def run(chain: Chain, given: np.ndarray, h: float, speed: float = 0.0, what: str = "accel") -> np.ndarray:
    """Motion `what` (t, n) at every step h under the force (t,), Newmark's average acceleration; speed: of the first mass at 0."""
    import openseespy.opensees as ops

    n = len(chain.m)
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    for i in range(n + 1):
        ops.node(i, 0.0)
    ops.fix(0, 1)
    for i, m in enumerate(chain.m):
        ops.mass(i + 1, float(m))
    for i, (k, c) in enumerate(zip(chain.k, chain.c, strict=True)):
        ops.uniaxialMaterial("Elastic", i + 1, float(k), float(c))
        ops.element("zeroLength", i + 1, i, i + 1, "-mat", i + 1, "-dir", 1, "-doRayleigh", 0)
    _law(ops, chain)
    if speed:
        ops.setNodeVel(1, 1, speed, "-commit")
    if given.any():
        ops.timeSeries("Path", 1, "-dt", h, "-values", *given.tolist(), "-prependZero")
        ops.pattern("Plain", 1, 1)
        ops.load(chain.driven + 1, 1.0)
    return recorded(ops, n, len(given), h, what, chain.name)


def recorded(ops, n: int, steps: int, h: float, what: str, name: str) -> np.ndarray:
    """Motion `what` (t, n) of nodes 1 to n in so many steps h of the model that stands, by Newmark's average acceleration."""
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormUnbalance", 1e-9, 50)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    with TemporaryDirectory() as folder:
        path = Path(folder) / "motion.out"
        ops.recorder("Node", "-file", str(path), "-precision", 12, "-node", *range(1, n + 1), "-dof", 1, what)
        if ops.analyze(steps, h):
            raise RuntimeError(f"OpenSees did not finish {name}")
        ops.wipe()
        return np.loadtxt(path).reshape(-1, n)


def _law(ops, chain: Chain) -> None:
    """The concealed law beside link `place`, or an oscillator on mass `place`."""
    p, near, far = chain.values, chain.place, chain.place + 1
    tag = 100
    if chain.law == "none":
        return
    if chain.law == "oscillator":
        w = 2 * np.pi * p["f"]
        ops.node(200, 0.0)
        ops.mass(200, p["m"])
        ops.uniaxialMaterial("Elastic", tag, p["m"] * w**2, 2 * p["zeta"] * p["m"] * w)
        near, far = far, 200
    elif chain.law == "cubic":
        reach = 12 * np.sqrt(chain.k[chain.place] / p["k3"])
        x = np.linspace(-reach, reach, 2 * _POINTS + 1)
        ops.uniaxialMaterial("ElasticMultiLinear", tag, "-strain", *x, "-stress", *(p["k3"] * x**3))
    elif chain.law == "bilinear":
        ops.uniaxialMaterial("ENT", tag, p["dk"])  # acts in compression: the link is turned round
        near, far = far, near
    elif chain.law == "friction":
        ops.uniaxialMaterial("ElasticPP", tag, p["kt"], p["Fs"] / p["kt"])
    elif chain.law == "quadratic-damping":
        ops.uniaxialMaterial("Viscous", tag, p["c2"], 2.0)
    else:
        _stops(ops, tag, p, both=chain.law == "gap")
    ops.element("zeroLength", 100, near, far, "-mat", tag, "-dir", 1, "-doRayleigh", 0)


def _stops(ops, tag: int, p: dict[str, float], both: bool) -> None:
    """Elastic stops beyond a clearance, on both sides or on that of extension."""
    reach = 1e3
    x = np.array([-(1 + reach), -1, 1, 1 + reach]) * p["g"]
    F = np.array([-reach if both else 0.0, 0.0, 0.0, reach]) * p["g"] * p["kc"]
    ops.uniaxialMaterial("ElasticMultiLinear", tag, "-strain", *x, "-stress", *F)
