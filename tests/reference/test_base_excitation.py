"""Motion of the ground as excitation: truths in absolute coordinates by scipy's exact first-order hold, and closed forms."""

import csv
import json
import re
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.linalg import eigh

from mouse_cli._errors import DeckError
from mouse_cli.cli.main import cli
from mouse_cli.dynamics.response import simulate
from mouse_cli.formats import read_deck
from mouse_cli.terms.laws import registry
from mouse_cli.updating.recordings.acting import Part
from mouse_cli.updating.recordings.ground import derivative
from mouse_cli.updating.recordings.mistakes import check
from mouse_cli.updating.recordings.pushed import pushed
from mouse_cli.updating.recordings.records import records
from mouse_cli.updating.recordings.regression import Start, starts
from mouse_cli.updating.recordings.segments import Segments
from mouse_cli.updating.recordings.series import REACH
from mouse_cli.updating.recordings.study import fitted, study

RATE, SECONDS = 200.0, 20.0
K, M, ZETA = np.array([6e4, 5e4, 4e4]), np.array([100.0, 90.0, 80.0]), 0.0144


def chain(k):
    found = np.diag(k + np.append(k[1:], 0.0))
    i = np.arange(len(k) - 1)
    found[i, i + 1] = found[i + 1, i] = -k[1:]
    return found


def table(seed=1, rate=RATE * 8):
    """A band-limited random acceleration of the table (t,), and its velocity and displacement, exact line by line."""
    t, rng = int(SECONDS * rate), np.random.default_rng(seed)
    hz = np.fft.rfftfreq(t, 1 / rate)
    lines = np.where((hz >= 0.5) & (hz <= 30), np.exp(2j * np.pi * rng.uniform(size=len(hz))), 0)
    w = 2 * np.pi * np.maximum(hz, 1e-9)
    a, v, d = (np.fft.irfft(lines / (1j * w) ** order, t) for order in (0, 1, 2))
    size = a.std()
    return a / size, v / size, d / size


def absolute(m, C, k_matrix, J, seed=1):
    """Absolute accelerations and displacements (t, n) of M u'' + C (u' - J d') + K (u - J d) = 0 at RATE, by scipy's lsim.

    In absolute coordinates the table acts through springs and dashpots, by its displacement and velocity: not as mouse does it.
    """
    from scipy.signal import StateSpace, lsim

    a, v, d = table(seed)
    n, t = len(m), np.arange(len(a)) / (RATE * 8)
    inverse = np.diag(1 / m)
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ k_matrix, -inverse @ C]])
    B = np.vstack([np.zeros((n, 2)), np.column_stack([inverse @ k_matrix @ J, inverse @ C @ J])])
    x0 = np.concatenate([J * d[0], J * v[0]])
    out = np.vstack([A[n:], np.eye(n, 2 * n)])
    feed = np.vstack([B[n:], np.zeros((n, 2))])
    _, y, _ = lsim(StateSpace(A, B, out, feed), np.column_stack([d, v]), t, x0)
    return a[::8], d[::8], y[::8, :n], y[::8, n:]


def damping(m, k_matrix, zeta=ZETA):
    root = np.sqrt(m)
    w2, s = np.linalg.eigh(k_matrix / np.outer(root, root))
    return root[:, None] * (s @ np.diag(2 * zeta * np.sqrt(w2)) @ s.T) * root


def deck(
    folder,
    ag,
    floors,
    outputs="{1: f1, 2: f2, 3: f3}",
    ground="{sensor: ground, channel: ag, unit: m/s2}",
    more="",
    m=M,
):
    noisy = np.column_stack([ag, floors])
    noisy = noisy + 0.003 * noisy.std(axis=0) * np.random.default_rng(5).standard_normal(noisy.shape)
    with open(folder / "run.csv", "w", newline="") as file:
        out = csv.writer(file)
        out.writerow(["ag", *(f"f{i + 1}" for i in range(floors.shape[1]))])
        out.writerows(noisy.tolist())
    rows = [[i + 1, j + 1, float(chain(K)[i, j])] for i in range(3) for j in range(i, 3) if chain(K)[i, j]]
    lines = [
        "mouse: 1",
        "model:",
        f"  stiffness: {{order: 3, entries: {rows}}}",
        f"  mass: {{diagonal: {list(map(float, m))}}}",
    ]
    lines += ["parameters:"]
    for i in range(3):
        entries = [[1, 1, 1]] if i == 0 else [[i, i, 1], [i, i + 1, -1], [i + 1, i + 1, 1]]
        lines += [f"  - {{name: k{i + 1}, nominal: {K[i]}, sd: 5 %, stiffness: {entries}}}"]
    lines += [f"  - {{name: m{i + 1}, nominal: {m[i]}, sd: 1 %, mass: [[{i + 1}, {i + 1}, 1]]}}" for i in range(3)]
    lines += [
        "test:",
        "  recordings:",
        "    - file: run.csv",
        f"      sample_rate: {RATE:g}",
        f"      inputs: [{ground}]",
    ]
    lines += [f"      outputs: {outputs}", *([f"      {more}"] if more else [])]
    path = folder / "deck.yaml"
    path.write_text("\n".join(lines) + "\n")
    return path


def sound(folder, **more):
    k = chain(K)
    ag, _, floors, _ = absolute(M, damping(M, k), k, np.ones(3))
    return deck(folder, ag, floors, **more)


def with_oscillator(mass, hz, zeta):
    """A building with a mass on a spring and a dashpot on floor 3; its absolute accelerations."""
    w = 2 * np.pi * hz
    big, C = np.zeros((4, 4)), np.zeros((4, 4))
    big[:3, :3], C[:3, :3] = chain(K), damping(M, chain(K))
    b = np.array([0, 0, -1.0, 1.0])
    big += mass * w**2 * np.outer(b, b)
    C += 2 * zeta * mass * w * np.outer(b, b)
    ag, _, floors, _ = absolute(np.append(M, mass), C, big, np.ones(4))
    return ag, floors[:, :3]


def test_a_motion_of_the_ground_is_read_from_the_deck(tmp_path):
    recording = read_deck(sound(tmp_path)).recordings[0]
    ground, first = recording.channels[:2]
    assert ground.ground and ground.quantity == "acceleration" and ground.weights == {0: 1.0, 1: 1.0, 2: 1.0}
    assert first.frame == "absolute" and not first.ground
    moved = "{sensor: ground, channel: ag, unit: g, moves: {1: 1, 3: 0.5}}"
    recording = read_deck(sound(tmp_path, ground=moved, more="frame: relative")).recordings[0]
    assert recording.channels[0].weights == {0: 1.0, 2: 0.5} and recording.channels[1].frame == "relative"


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"ground": "{sensor: ground, channel: ag, unit: N}"}, "is force; the ground has a motion"),
        ({"ground": "{sensor: groundTX, channel: ag}"}, "carries nothing along"),
        ({"ground": "{sensor: 1, channel: ag, unit: N, moves: {1: 1}}"}, "is no motion of the ground"),
        ({"outputs": "{1: f1, ground: f2}"}, "stands among the outputs"),
        ({"ground": "{sensor: 1, channel: ag, unit: N}", "more": "frame: relative"}, "has no motion of the ground"),
    ],
)
def test_a_ground_that_cannot_be_is_diagnosed(tmp_path, more, words):
    with pytest.raises(DeckError) as error:
        read_deck(sound(tmp_path, **more))
    found = [d for d in error.value.diagnostics if d.severity == "error"]
    assert {(d.code, words in d.message, d.span is not None) for d in found} == {("MD644", True, True)}


def test_check_says_what_diagnose_will_refuse(tmp_path):
    """An absolute displacement beside the acceleration of the ground; a motion that is prescribed where the model is free."""
    for more in (
        {"outputs": "[{sensor: 1, channel: f1, unit: m}]"},
        {"ground": "{sensor: 1, channel: ag, unit: m/s2}"},
    ):
        path = str(sound(tmp_path, **more))
        checked, judged = (
            CliRunner().invoke(cli, [word, path], standalone_mode=False) for word in ("check", "diagnose")
        )
        code = "MD644" if "outputs" in more else "MD640"
        assert f"warning[{code}]" in checked.stderr
        assert [one.code for one in judged.exception.diagnostics] == [code]


def test_derivatives_of_a_record():
    t = np.arange(4000) / 200
    x = 0.3 + 0.2 * t + np.sin(2 * np.pi * 3 * t)
    inner = slice(200, -200)
    first, second = (derivative(x, 1 / 200, times) for times in (1, 2))
    w = 2 * np.pi * 3
    np.testing.assert_allclose(first[inner], 0.2 + w * np.cos(w * t)[inner], atol=2e-3 * w)
    np.testing.assert_allclose(second[inner], -(w**2) * np.sin(w * t)[inner], atol=5e-3 * w**2)


@pytest.mark.parametrize("quantity", ["acceleration", "displacement"])
def test_absolute_and_relative_channels_say_the_same(tmp_path, quantity):
    k = chain(K)
    ag, d, floors, places = absolute(M, damping(M, k), k, np.ones(3))
    if quantity == "acceleration":
        whole = records(read_deck(deck(tmp_path, ag, floors))).fitted[0]
        other = records(read_deck(deck(tmp_path, ag, floors - ag[:, None], more="frame: relative"))).fitted[0]
    else:
        unit = (
            "[{sensor: 1, channel: f1, unit: m}, {sensor: 2, channel: f2, unit: m}, {sensor: 3, channel: f3, unit: m}]"
        )
        ground = "{sensor: ground, channel: ag, unit: m}"
        whole = records(read_deck(deck(tmp_path, d, places, unit, ground))).fitted[0]
        other = records(read_deck(deck(tmp_path, d, places - d[:, None], unit, ground, "frame: relative"))).fitted[0]
    size = whole.measured.std()
    np.testing.assert_allclose(whole.measured, other.measured, atol=0.05 * size)
    assert np.corrcoef(whole.force[500:-500, 0], ag[500 : len(whole) - 500])[0, 1] > 0.9


def test_hidden_masses_feel_the_motion_of_the_ground(tmp_path):
    """A simulation in relative coordinates with a hidden oscillator, beside the answer in absolute ones."""
    p = np.array([12.0, 4.0, 0.03])
    ag, floors = with_oscillator(*p)
    own = study(read_deck(deck(tmp_path, ag, floors)), records(read_deck(deck(tmp_path, ag, floors))))
    place = next(one for one in own.places if one.ground and one.B[2])
    h = own.base.placed(place).at(registry()["oscillator"], 0)
    x = np.concatenate([np.zeros(h.nuisances), np.log(p)])
    x[[own.model.linear.names.index(name) for name in own.model.linear.names if name.startswith("damping of mode")]] = (
        0.0
    )
    series = own.look
    part = Segments(series, np.array([REACH]), len(series) - 2 * REACH)
    plant = h.plant(x[None], series)
    u0 = np.zeros((1, plant.states, 1))
    out = simulate(plant, series.dt / series.factor, part.force, u0)
    simulated = out[0, :, :: series.factor, 0].T
    truth = (floors - ag[:, None])[: len(simulated)]
    late = slice(
        1200, len(simulated)
    )  # the assumed damping, 1 % for 1.44 %, and the beginning from rest have died away by half
    assert np.sqrt(((simulated - truth)[late] ** 2).mean()) < 0.35 * truth[late].std()


def test_first_looks_find_masses_that_the_ground_moves(tmp_path):
    """Closed-form starts: an oscillator's mass, frequency and place, and an added mass, from the record alone."""
    ag, floors = with_oscillator(12.0, 4.0, 0.03)
    problem = read_deck(deck(tmp_path, ag, floors))
    own = study(problem, records(problem))
    look = own.at(next(one for one in own.places if one.ground and one.B[2]))
    (force,) = look.forces(registry()["oscillator"], 0, np.array([[12.0, 4.0, 0.03]]))
    s = look.spectrum
    look.local = replace(look.local, carried=np.zeros_like(look.local.carried))
    (resting,) = look.forces(registry()["oscillator"], 0, np.array([[12.0, 4.0, 0.03]]))
    assert look.share([-s.history(force[:, 0])]) > max(0.8, look.share([-s.history(resting[:, 0])]))
    heavier = M + np.array([0, 25.0, 0])
    ag, _, floors, _ = absolute(heavier, damping(heavier, chain(K)), chain(K), np.ones(3))
    problem = read_deck(deck(tmp_path, ag, floors))
    own = study(problem, records(problem))
    looks = [own.looked(one, own.spectrum, error=0.02) for one in own.places if one.ground]
    found = {look.local.place.site.ids[0]: look.best(registry()["mass"], 0) for look in looks}
    best = min((one for one in found.values() if one), key=lambda one: one.left)
    assert best is found["2"] and np.exp(best.x[-1]) == pytest.approx(25.0, rel=0.5)


def verdict(path):
    done = CliRunner().invoke(cli, ["diagnose", str(path), "--json", "-q"], standalone_mode=False)
    assert done.exit_code in (0, 1), done.stderr
    return json.loads(done.stdout)["verdict"]


def test_a_sound_building_whose_damping_the_deck_leaves_out_lacks_nothing(tmp_path):
    """1.44 % in every mode, absent from the deck: neither an oscillator nor a dashpot."""
    assert verdict(sound(tmp_path))["kind"] == "nothing-missing"


def test_a_sound_building_of_a_run_has_its_parameters_back(tmp_path):
    """`mouse run` takes the motion of the ground too; masses 1 % off move the loads with them."""
    heavier = M * [1.01, 0.99, 1.01]
    k = chain(K * [1.04, 0.97, 1.02])
    ag, _, floors, _ = absolute(heavier, damping(heavier, k), k, np.ones(3))
    done = CliRunner().invoke(cli, ["run", str(deck(tmp_path, ag, floors)), "--json", "-q"], standalone_mode=False)
    assert done.exit_code == 0, done.stderr
    found = {one["name"]: one for one in json.loads(done.stdout)["parameters"]}
    ratio = found["k1"]["posterior"] / found["m1"]["posterior"]
    assert ratio == pytest.approx(1.04 * K[0] / heavier[0], rel=0.01)
    for name, true in zip(("k1", "k2", "k3"), K * [1.04, 0.97, 1.02], strict=True):
        assert abs(found[name]["posterior"] - true) < 3 * found[name]["posterior_sd"]


@pytest.mark.proof
@pytest.mark.parametrize(("more", "physics"), [(25.0, "mass"), (-22.5, "mass-loss")])
def test_mass_that_was_added_or_removed_is_named_at_its_floor(tmp_path, more, physics):
    other = M + np.array([0, more, 0])
    ag, _, floors, _ = absolute(other, damping(other, chain(K)), chain(K), np.ones(3))
    said = verdict(deck(tmp_path, ag, floors))
    assert (said["kind"], said["physics"], said["site"]["ids"]) == ("named", physics, [2])


@pytest.mark.parametrize(
    ("more", "left", "law", "sign", "ids", "size"),
    [
        ([25.0, 0, 0], [1, 1, 1], "mass", 1.0, [1], 25.0),
        ([0, -22.5, 0], [1, 1, 1], "mass-loss", 1.0, [2], 22.5),
        ([0, 0, 0], [1, 1, 0.8], "spring", -1.0, [2, 3], 0.2 * K[2]),
    ],
)
def test_what_a_parameter_is_pushed_to_do_is_tried_as_a_law(tmp_path, more, left, law, sign, ids, size):
    """A parameter of the deck does the same at many prior sd, so that a first look sees nothing; the law begins with its size."""
    m, k = M + np.array(more), chain(K * np.array(left))
    ag, _, floors, _ = absolute(m, damping(m, k), k, np.ones(3))
    own = study(*(lambda problem: (problem, records(problem)))(read_deck(deck(tmp_path, ag, floors))))
    baseline = fitted(own, None)
    first = pushed(baseline, own.places, None)[0]
    (part,) = first.hypothesis.parts
    assert (part.law.key, part.words.get("sign", 1.0), [int(i) for i in part.place.site.ids]) == (law, sign, ids)
    assert 0.5 * size < np.exp(first.x[-1]) < 1.3 * size  # what all masses and stiffnesses share, no record knows
    assert np.abs(first.x[: own.base.linear.k]).max() < np.abs(baseline.x).max()
    assert pushed(fitted(own, first), own.places, None) == []


def opened(path):
    problem = read_deck(path)
    return study(problem, records(problem))


def test_modal_damping_of_a_deck_counts(tmp_path):
    path = sound(tmp_path)
    path.write_text(path.read_text().replace("parameters:", "modal_damping: {ratio: [0.03, 0.01]}\nparameters:"))
    model = opened(path).model
    np.testing.assert_allclose(model.linear.C, damping(M, chain(K), np.array([0.03, 0.01, 0.01])), atol=1e-9)
    assert not model.bare and not any("no damping" in one for one in model.remarks)


@pytest.mark.parametrize(("law", "size"), [("mass", 60.0), ("mass-loss", 40.0)])
def test_modal_damping_follows_the_modes_of_the_altered_structure(tmp_path, law, size):
    """Ratios are those of modes that are there: by those of the deck's model a mass of 60 kg left 1.3 times the noise."""
    other = M + np.array([0, size if law == "mass" else -size, 0])
    ag, _, floors, _ = absolute(other, damping(other, chain(K)), chain(K), np.ones(3))
    own = opened(deck(tmp_path, ag, floors))
    h = own.base.placed(next(one for one in own.places if one.ground and one.B[1])).at(registry()[law], 0)
    x = np.append(np.zeros(h.nuisances), np.log(size))
    np.testing.assert_allclose(h.plant(x[None], own.look).C[0], damping(other, chain(K), 0.01), rtol=1e-9, atol=1e-9)
    z = np.zeros((1, own.base.nuisances))
    z[0, h.names.index("m2")] = (other - M)[1] / (0.01 * M[1])  # a parameter that does the same to masses: by its modes too
    X = eigh(chain(K), np.diag(other))[1]
    by_modes = X.T @ own.base.plant(z, own.look).C[0] @ X
    np.testing.assert_allclose(by_modes, np.diag(np.diag(by_modes)), atol=1e-9)
    ag, _, floors, _ = absolute(M, damping(M, chain(K)), chain(K), np.ones(3))
    assert fitted(own, Start(h, x, 0.0)).misfit < 1.05 * fitted(opened(deck(tmp_path, ag, floors)), None).misfit


def test_functions_of_a_moving_ground_are_refused_with_the_way_out(tmp_path):
    done = CliRunner().invoke(cli, ["spectra", str(sound(tmp_path))], standalone_mode=False)
    (found,) = [one for one in done.exception.diagnostics if one.severity == "error"]
    assert found.code == "MD618" and "--output-only" in found.help


def test_a_common_factor_is_set_by_the_prior(tmp_path):
    """M, C and K 10 % off alike: the same motion, so the factor goes back to where the prior is largest."""
    own = study(*(lambda problem: (problem, records(problem)))(read_deck(sound(tmp_path))))
    linear = own.model.linear
    z = linear.scaled(np.zeros(linear.k), 1.1)
    for one, mean in zip(linear.matrices(z[None]), (linear.M, linear.C, linear.K), strict=True):
        np.testing.assert_allclose(one[0], 1.1 * mean, rtol=1e-6, atol=1e-9 * np.abs(mean).max())
    x = np.concatenate([z, np.zeros(own.base.nuisances - linear.k)])
    assert np.abs(own.base.gauged(x)).max() < 0.05 * np.abs(z).max()


@pytest.mark.parametrize(
    ("outputs", "gain", "table", "said"),
    [
        ("{1: f1, 2: f3, 3: f2}", 1.0, 1.0, "with channels f3 and f2 exchanged"),
        ("{1: f1, 2: f2, 3: f3}", 1.15, 1.0, "if channel f2 reads 1.1"),
        ("{1: f1, 2: f2, 3: f3}", 1.0, 1.08, "if channel ag reads 1.0"),
    ],
)
def test_a_channel_on_a_table_that_is_another_one_or_scaled_is_told(tmp_path, outputs, gain, table, said):
    """Masses 1 % sure would be 90 prior sd off for it; 15 % of one channel passed for noise, with nothing missing; and 8 % of the
    table's for a heavy oscillator below the band.
    """
    k = chain(K)
    ag, _, floors, _ = absolute(M, damping(M, k), k, np.ones(3))
    assert said in refused(deck(tmp_path, ag * table, floors * [1.0, gain, 1.0], outputs=outputs))


@pytest.mark.parametrize(("late", "name"), [(0, "ag"), (2, "f2")])
def test_a_channel_on_a_table_that_is_late_is_told(tmp_path, late, name):
    """Of the table's 10 ms made an oscillator, refuted by what was held out, in 255 s."""
    k = chain(K)
    ag, _, floors, _ = absolute(M, damping(M, k), k, np.ones(3))
    channels = np.column_stack([ag, floors])
    channels[:, late] = np.roll(channels[:, late], 2)
    said = refused(deck(tmp_path, channels[:, 0], channels[:, 1:]))
    assert float(re.search(rf"if channel {name} is ([\d.]+) ms late", said)[1]) == pytest.approx(10, rel=0.02)


def refused(path) -> str:
    """What MD457 says of a deck that is refused."""
    problem = read_deck(str(path))
    with pytest.raises(DeckError) as error:
        check(study(problem, records(problem)))
    (found,) = error.value.diagnostics
    assert found.code == "MD457"
    return found.message


def test_nothing_is_lost_that_the_model_does_not_have(tmp_path):
    """A spring between floor 3 and the ground may be added; one is lost where the model has one, and no more than all of it."""
    problem = read_deck(str(sound(tmp_path)))
    own, law = study(problem, records(problem)), registry()["spring"]
    links = {place.site.text: place.scale.link for place in own.places}
    assert links["between degree of freedom 3 and the ground"] == 0 < links["between degree of freedom 2 and degree of freedom 3"]
    for place in own.places:
        assert law.variants_at(place.scale) == ([0, 1] if place.scale.link else [0])
        lost = {start.hypothesis.parts[0].variant for start in starts([own.at(place)], [law])}
        assert lost <= set(law.variants_at(place.scale))
        if place.scale.link:
            (size,) = Part(place, law, 1).unknowns
            assert size.lower < size.upper <= place.scale.link
