"""Functions in other units, of other kinds, signs and columns than a deck says. Truth: receptances of matrices written by hand."""

import numpy as np
import pytest

from mouse_cli import DeckError, diagnose, read_deck
from mouse_cli.diagnosis.likelihoods.frf.identified import with_modes
from mouse_cli.updating.prior_model import related

HZ, SENSORS = np.arange(2, 75, 0.25), (0, 2, 4, 8)
DECK = """\
mouse: 1
units: SI
model:
  structure:
    nodes: {{0: [0, 0, 0], 1: [0.1, 0, 0], 2: [0.2, 0, 0], 3: [0.3, 0, 0], 4: [0.4, 0, 0], 5: [0.5, 0, 0], 6: [0.2, -0.1, 0]}}
    elements:
      - {{id: 1-5, type: spring, nodes: 0-5, TX: 100000.0, TY: 60000.0, loss_factor: 0.01}}
      - {{id: 11-15, type: mass, nodes: 1-5, mass: 2.0}}
      - {{id: 21, type: rod, nodes: [6, 3], E: 3.0e+6, A: {area!r}, density: 0, loss_factor: 0.01}}
    supports: {{0: all, 6: all}}
    directions: [TX, TY]
parameters:
  - {{name: springs x, elements: 1-5, property: TX, sd: 5 %, transform: log}}
  - {{name: springs y, elements: 1-5, property: TY, sd: 5 %, transform: log}}
  - {{name: masses, elements: 11-15, property: mass, sd: 1 %, transform: log}}
test:
  frf:
    - {{title: hammer, file: hammer.csv, kind: {kind}, input: {input}, sd: 1 %, outputs: {{{outputs}}}}}
"""


def functions(power: int, extra: float) -> np.ndarray:
    """H (f, 4) for a force at 5TX, with a spring from 3TX to the ground that the deck lacks, and 0.5 % of noise.

    Five masses of 2 kg in a row, springs of 104000 N/m along it and 63000 N/m across it, and 30000 N/m at 45 degrees at mass 3.
    """
    one = 2 * np.eye(5) - np.eye(5, k=1) - np.eye(5, k=-1)
    one[4, 4] = 1
    K, oblique = np.kron(np.diag([1.04e5, 0.63e5]), one), np.zeros(10)
    oblique[[2, 7]] = np.sqrt(0.5)
    K += 3e4 * np.outer(oblique, oblique)
    K[2, 2] += extra
    s = 2j * np.pi * HZ
    H = np.array([np.linalg.inv(K * (1 + 0.01j) + 2.0 * x**2 * np.eye(10))[list(SENSORS), 4] * x**power for x in s])
    rng = np.random.default_rng(5)
    return H * (1 + 0.005 * (rng.standard_normal(H.shape) + 1j * rng.standard_normal(H.shape)))


def deck(folder, H, hz=HZ, kind="accelerance", input="5TX", forms=("real", "imag"), columns=None):
    """A deck and its file; forms: keys of the two columns of each response, or of the one."""
    both = columns or (lambda h: (h.real, h.imag))
    table = np.column_stack([hz, *(part for h in H.T for part in both(h))])
    names = [[f"{mark}{k}" for mark in "ab"[: len(forms)]] for k in range(4)]
    head = ",".join(["f", *(name for own in names for name in own)])
    np.savetxt(folder / "hammer.csv", table, delimiter=",", comments="", header=head)
    pairs = [", ".join(f"{key}: {name}" for key, name in zip(forms, own, strict=True)) for own in names]
    given = [own[0] if forms == ("value",) else f"{{{pair}}}" for own, pair in zip(names, pairs, strict=True)]
    outputs = ", ".join(f"{name}: {each}" for name, each in zip(("1TX", "3TX", "5TX", "4TY"), given, strict=True))
    area = 3e4 * float(np.hypot(0.1, 0.1)) / 3e6
    (folder / "deck.yaml").write_text(DECK.format(kind=kind, input=input, outputs=outputs, area=area))
    return folder / "deck.yaml"


def looked_at(path) -> int:
    """How many modes a diagnosis begins with."""
    problem, _ = with_modes(read_deck(path))
    related(problem)
    return problem.test.m


degrees = lambda h: (np.abs(h), np.angle(h, deg=True))
radians = lambda h: (np.abs(h), np.angle(h))
decibels = lambda h: (20 * np.log10(np.abs(h)), np.angle(h, deg=True))
MISREAD = {  # what is done to the functions, what the deck then says otherwise, and what the message and its help must say
    "g": (lambda H: H / 9.80665, {}, "in g beside m/s2", "unit: g/N"),
    "mm": (lambda H: H * 1e3, {}, "in mm beside m", "divide the functions by 1000"),
    "lbf": (lambda H: H * 4.4482216, {}, "per lbf of force", "4.4482"),
    "sign": (lambda H: -H, {}, "in the opposite direction", "signs"),
    "other sign of time": (np.conj, {}, "negative damping", "other sign"),
    "half": (lambda H: H / 2, {}, "half of what it is", "double"),
    "rms": (lambda H: H / np.sqrt(2), {}, "rms beside peaks", "sqrt"),
    "receptance": (None, {"power": 0}, "read as receptance", "kind: receptance"),
    "mobility": (None, {"power": 1}, "read as mobility", "kind: mobility"),
    "accelerance": (lambda H: H, {"kind": "receptance"}, "read as accelerance", "kind: accelerance"),
    "direction of the force": (lambda H: H, {"input": "5TY"}, "with the force at 5TX", "input: 5TX"),
    "node of the force": (lambda H: H, {"input": "4TX"}, "with the force at 5TX", "input: 5TX"),
    "spacing": (lambda H: H, {"hz": 2 * HZ}, "half as far apart", "1 / T"),
    "rad/s": (lambda H: H, {"hz": 2 * np.pi * HZ}, "read in rad/s", "2 pi"),
}  # fmt: skip
COLUMNS = {
    "degrees as radians": (2, ("magnitude", "phase_rad"), degrees, "phase_rad", "name it phase"),
    "radians as degrees": (2, ("magnitude", "phase"), radians, "phase", "name it phase_rad"),
    "decibels as magnitudes": (2, ("magnitude", "phase"), decibels, "negative", "magnitude_db"),
    "magnitudes as decibels": (2, ("magnitude_db", "phase"), degrees, "nowhere negative", "name it magnitude"),
    "magnitudes alone": (2, ("value",), lambda h: (np.abs(h),), "without phases", "form: log"),
}
RIGHT = {
    "real and imag": (2, ("real", "imag"), None),
    "degrees": (0, ("magnitude", "phase"), degrees),
    "radians": (2, ("magnitude", "phase_rad"), radians),
    "unwrapped radians": (2, ("magnitude", "phase_rad"), lambda h: (np.abs(h), np.unwrap(np.angle(h)))),
    "decibels": (0, ("magnitude_db", "phase"), decibels),
}


@pytest.mark.parametrize("extra", [0.0, 2e4])
@pytest.mark.parametrize("name", MISREAD)
def test_functions_misread_alike_are_told(tmp_path, name, extra):
    """Whether or not the model lacks a spring."""
    change, other, said, help = MISREAD[name]
    given = dict(other)
    H = functions(given.pop("power", 2), extra)
    with pytest.raises(DeckError) as refused:
        looked_at(deck(tmp_path, H if change is None else change(H), **given))
    found = refused.value.diagnostics[0]
    assert found.code == ("MD450" if "hz" in other else "MD456") and said in found.message and help in found.help


@pytest.mark.parametrize("extra", [0.0, 2e4])
@pytest.mark.parametrize("name", RIGHT)
def test_functions_read_rightly_pass(tmp_path, name, extra):
    power, forms, columns = RIGHT[name]
    kind = "accelerance" if power else "receptance"
    assert looked_at(deck(tmp_path, functions(power, extra), kind=kind, forms=forms, columns=columns)) == 10


@pytest.mark.parametrize("name", COLUMNS)
def test_a_column_that_cannot_be_what_it_is_called_is_told(tmp_path, name):
    power, forms, columns, said, help = COLUMNS[name]
    with pytest.raises(DeckError) as refused:
        read_deck(deck(tmp_path, functions(power, 0.0), forms=forms, columns=columns))
    found = refused.value.diagnostics[0]
    assert found.code == "MD456" and said in found.message and help in found.help


def test_decibels_above_zero_are_told_as_magnitudes(tmp_path):
    """Levels over a small reference have no sign that tells them."""
    positive = lambda h: (20 * np.log10(np.abs(h) / 1e-10), np.angle(h, deg=True))
    path = deck(tmp_path, functions(0, 0.0), kind="receptance", forms=("magnitude", "phase"), columns=positive)
    with pytest.raises(DeckError, match="decibels"):
        diagnose(read_deck(path))


@pytest.mark.parametrize("extra", [0.0, 2e4])
def test_decibels_by_10_log10_are_told(tmp_path, extra):
    """Half of the decibels of a function are those of its root, which has no modes."""
    halved = lambda h: (10 * np.log10(np.abs(h)), np.angle(h, deg=True))
    path = deck(tmp_path, functions(2, extra), forms=("magnitude_db", "phase"), columns=halved)
    with pytest.raises(DeckError, match="10 log10") as told:
        looked_at(path)
    assert told.value.diagnostics[0].code == "MD456" and "20 log10" in told.value.diagnostics[0].help


def test_a_gain_that_the_prior_allows_is_no_mistake(tmp_path):
    """Half of the functions, with gains known to 30 % alone."""
    path = deck(tmp_path, functions(2, 0.0) / 2)
    path.write_text(path.read_text().replace("sd: 1 %, outputs", "sd: 1 %, gain_sd: 30 %, outputs"))
    assert looked_at(path) == 10


@pytest.mark.parametrize(
    ("said", "share", "floor"),
    [("1 %", 0.01, 0.0), ("0.002", 0.0, 2e-3), ("[1 %, 0.002]", 0.01, 2e-3), ("[2e-3, 1 %]", 0.01, 2e-3)],
)
def test_accuracy_is_a_share_of_the_magnitude_and_a_floor(tmp_path, said, share, floor):
    """In the unit of the values of the file, m/s2 per N."""
    H = functions(2, 0.0)
    path = deck(tmp_path, H)
    path.write_text(path.read_text().replace("5TX, sd: 1 %", f"5TX, sd: {said}"))
    (found,) = read_deck(str(path)).frf
    assert found.variance.reshape(H.shape) == pytest.approx(2 * (share * np.abs(H) + floor) ** 2, rel=1e-5)


@pytest.mark.parametrize("said", ["[1 %, 2 %]", "[1 %]", "[0.1, 0.2]", "[1 %, 1, 2]", "[1 %, -1]", "[1 %, x]"])
def test_accuracy_that_is_none_is_told_with_its_place(tmp_path, said):
    path = deck(tmp_path, functions(2, 0.0))
    path.write_text(path.read_text().replace("5TX, sd: 1 %", f"5TX, sd: {said}"))
    with pytest.raises(DeckError) as refused:
        read_deck(str(path))
    assert {each.code for each in refused.value.diagnostics} <= {"MD215", "MD213"}
    assert refused.value.diagnostics[0].span.line > 1
