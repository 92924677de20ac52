"""Recordings of a cantilever: Hermite's elements assembled here, stepped exactly by scipy, decks read from files."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.linalg import eigh
from scipy.signal import cont2discrete, dlsim

from mouse_cli.cli.main import cli
from mouse_cli.diagnosis.extend.laws import with_linear
from mouse_cli.diagnosis.likelihoods.history.order import alike, elsewhere
from mouse_cli.formats import read_deck
from mouse_cli.model.arrays import dense
from mouse_cli.terms.assembly import assembly
from mouse_cli.terms.laws import registry
from mouse_cli.updating.recordings.records import records
from mouse_cli.updating.recordings.regression import Start, allowed
from mouse_cli.updating.recordings.study import Study, study

N, SPAN, E, A, I, DENSITY = 8, 1.2, 2.1e11, 3.2e-4, 1.70667e-9, 7850.0
RATE, SECONDS, DRIVEN, SENSED = 1000.0, 6.0, 6, (4, 6, 9)
DECK = f"""mouse: 1
model:
  structure:
    directions: [TY, RZ]
    nodes: {{{", ".join(f"{i + 1}: [{i * SPAN / N}, 0, 0]" for i in range(N + 1))}}}
    materials: {{steel: {{E: {E}, density: {DENSITY}}}}}
    sections: {{bar: {{A: {A}, Iz: {I}}}}}
    elements:
{chr(10).join(f"      - {{id: {i}, type: beam, nodes: [{i}, {i + 1}], material: steel, section: bar}}" for i in range(1, N + 1))}
    supports: {{1: all}}
parameters: [{{name: E, material: steel, property: E, sd: 2 %}}]
test:
  recordings:
    - file: run.npz
      sample_rate: {RATE}
      inputs: [{{sensor: {DRIVEN}TY, channel: f, quantity: force, unit: N}}]
      outputs: [{", ".join(f"{{sensor: {i}TY, channel: a{i}, quantity: acceleration, unit: m/s2}}" for i in SENSED)}]
"""


def matrices() -> tuple[np.ndarray, np.ndarray]:
    """K and M of deflections and rotations behind the clamped end (Przemieniecki 1968, sections 5.6 and 11.3)."""
    h, K, M = SPAN / N, np.zeros((2 * N + 2,) * 2), np.zeros((2 * N + 2,) * 2)
    k = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]) * E * I / h**3
    m = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) * DENSITY * A * h / 420
    scale = np.outer([1, h, 1, h], [1, h, 1, h])
    for i in range(0, 2 * N, 2):
        K[i : i + 4, i : i + 4] += k * scale
        M[i : i + 4, i : i + 4] += m * scale
    return K[2:, 2:], M[2:, 2:]


def cantilever(folder: Path, noise: float = 0.0) -> str:
    """A deck of a sound cantilever, 1 % stiffer than stated, every mode damped by 0.8 %, under a random force below 120 Hz.

    noise: white, of the force channel, by its rms.
    """
    K, M = matrices()
    w2, S = eigh(1.01 * K, M)
    own = np.stack([S[2 * (i - 2)] for i in (*SENSED, DRIVEN)])
    rng, fine = np.random.default_rng(3), 8
    lines = np.fft.rfftfreq(int(SECONDS * RATE * fine), 1 / RATE / fine)
    phases = np.exp(2j * np.pi * rng.uniform(size=len(lines)))
    f = np.fft.irfft(np.where((lines > 3) & (lines < 120), phases, 0))
    f *= 10 * np.minimum(np.arange(len(f)) / RATE / fine / 0.2, 1) / f.std()
    a = np.zeros((len(f), len(SENSED)))
    for w, shape in zip(np.sqrt(w2), own.T, strict=True):
        rates = np.array([[0, 1], [-(w**2), -0.016 * w]])
        mode = (rates, np.array([[0], [shape[-1]]]), rates[1:], np.array([[shape[-1]]]))
        a += dlsim(cont2discrete(mode, 1 / RATE / fine, "foh"), f)[1] * shape[:-1]
    a = a[::fine] + 0.01 * a.std(axis=0) * rng.standard_normal(a[::fine].shape)
    read = f[::fine] + noise * f.std() * rng.standard_normal(len(a))
    np.savez(folder / "run.npz", f=read, **{f"a{i}": one for i, one in zip(SENSED, a.T, strict=True)})
    (folder / "deck.yaml").write_text(DECK)
    return str(folder / "deck.yaml")


def test_a_sound_cantilever_lacks_nothing(tmp_path):
    """Rotations and deflections are no masses on springs: of 96 free parts, some of which pushed, no fit came to an end."""
    deck = cantilever(tmp_path)
    problem = read_deck(Path(deck))
    own = study(problem, records(problem))
    assert own.model.basis.shape[1] < problem.structure.n
    assert not [name for name in own.base.names if "between" in name]
    lacks_nothing(deck)


def test_noise_of_the_force_that_shakes_modes_above_its_band_is_nothing_that_is_missing(tmp_path):
    """Noise of 1 % shakes modes at 159, 263 and 393 Hz, which the force below 120 Hz does not."""
    lacks_nothing(cantilever(tmp_path, noise=0.01))


def lacks_nothing(deck: str) -> None:
    done = CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q"])
    found = json.loads(done.stdout)
    assert found["verdict"]["kind"] == "nothing-missing"
    assert found["residual"]["chi2"] < 1.1 * found["residual"]["dof"]


def test_what_a_place_may_have_follows_from_the_structure_and_not_from_the_mesh(tmp_path):
    """The tip of a cantilever: 3 EI/L^3 against a force, a quarter of its mass in every mode (Blevins 1979, table 8-1)."""
    problem = read_deck(Path(cantilever(tmp_path)))
    own = study(problem, records(problem))
    tip = next(one.scale for one in own.places if one.site.ids == (f"{N + 1}TY",))
    assert tip.heaviest == pytest.approx(DENSITY * A * SPAN / 4, rel=0.01)
    assert 0.99 * 3 * E * I / SPAN**3 < tip.softest < 0.02 * tip.stiffness


def test_laws_may_act_between_measured_places_of_a_reduced_model(tmp_path):
    problem = read_deck(Path(cantilever(tmp_path)))
    places = study(problem, records(problem)).places
    assert {f"{i}TY" for i in range(2, N + 2)} == {one.site.ids[0] for one in places if one.ground}  # measured or not
    both = [one.site.ids for one in places if len(one.site.ids) == 2]
    assert both == [("4TY", "6TY"), ("4TY", "9TY"), ("6TY", "9TY")]


def in_a_plane(tmp_path) -> Study:
    """The same with axial motion: nodes that translate along two axes."""
    deck = Path(cantilever(tmp_path))
    deck.write_text(deck.read_text().replace("directions: [TY, RZ]", "plane: XY"))
    problem = read_deck(deck)
    return study(problem, records(problem))


def test_a_mass_acts_along_all_that_its_node_translates_by(tmp_path):
    """A floor carries it up and down as well as sideways; forces of springs act along one of them."""
    own = in_a_plane(tmp_path)
    labels, V, m = own.problem.structure.labels, own.model.basis, 0.7
    place = next(one for one in own.places if one.site.text == "node 5")
    assert {law.key for law in allowed(place)} == {"mass", "mass-loss"}
    assert not {"mass", "mass-loss"} & {law.key for one in own.places if one.site.kind == "dof" for law in allowed(one)}
    heavy = own.base.placed(place).at(registry()["mass"], 0)
    x = np.append(np.zeros(heavy.nuisances), np.log(m))
    added = heavy.plant(x[None], own.look).M[0] - own.base.plant(np.zeros((1, own.base.nuisances)), own.look).M[0]
    both = V[[labels.index("5TX"), labels.index("5TY")]]
    np.testing.assert_allclose(added, m * both.T @ both, atol=1e-9 * np.abs(added).max())
    deck = with_linear(own.problem, heavy.parts[0], np.array([m]))
    M = [dense(assembly(each).matrices(each.prior.mean)[1]) for each in (deck, own.problem)]
    np.testing.assert_allclose(V.T @ (M[0] - M[1]) @ V, added, atol=1e-9 * np.abs(added).max())


def test_beside_an_oscillator_the_mass_that_it_is_above_the_band_is_tried_first(tmp_path):
    """Oscillators at other nodes and richer laws come after what has fewer sizes at its own node."""
    own = in_a_plane(tmp_path)
    at = {one.site.text: one for one in own.places}
    start = lambda law, text: Start(own.base.placed(at[text]).at(registry()[law], 0), np.zeros(0), 0.0)
    leader = start("oscillator", "between 5TY and the ground")
    others = [start("oscillator", f"between {i}TY and the ground") for i in (2, 3, 4, 6, 7, 8)]
    mass, there = start("mass", "node 5"), start("mass", "node 6")
    found = alike([leader, *others, there, mass], [leader], ("oscillator", leader.hypothesis.place.where))
    assert [id(one) for one in found] == [id(one) for one in (mass, *others[:5])]
    tried = elsewhere([mass, there, *others], [mass], "mass")
    assert [id(one) for one in tried] == [id(there)]
    assert len(elsewhere(others, [], "oscillator")) == 4
