"""H1 of a chain whose resonances are narrower than a line, by scipy.signal from exact responses of unevenly damped modes."""

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.signal import csd, welch

from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import read_deck
from mouse_cli.formats.frf_files import write_frf
from mouse_cli.model.diagnosis import NAMED, NOTHING

N, STIFFNESS, MASS, BLOCK, BLOCKS = 4, 4.0e4, 2.0, 4.0, 60  # N/m, kg, s
ZETA = np.array([0.004, 0.0015, 0.003, 0.002])
SENSORS, FORCE = [0, 1, 3], 3
DECK = f"""mouse: 1
title: chain
model:
  structure:
    nodes: {{line: {{from: 0, to: {N}, start: [0, 0, 0], end: [{N}.0, 0, 0]}}}}
    elements:
      - {{id: 1-{N}, type: spring, nodes: 0-{N}, TX: {STIFFNESS}, loss_factor: 0.01}}
      - {{id: 11-{10 + N}, type: mass, nodes: 1-{N}, mass: {MASS}}}
    supports: {{0: all}}
    directions: [TX]
parameters:
  - {{name: k, elements: 1-{N}, property: TX, sd: 5 %, transform: log}}
  - {{name: m, elements: 11-{10 + N}, property: mass, sd: 1 %, transform: log}}
test:
  frf:
    - file: h1.csv
      kind: accelerance
      input: 4TX
      averages: {2 * BLOCKS - 6}
      outputs:
        1TX: {{real: r0, imag: i0, coherence: c0}}
        2TX: {{real: r1, imag: i1, coherence: c1}}
        4TX: {{real: r3, imag: i3, coherence: c3}}
"""


def estimated(folder, added: float, seed: int) -> None:
    """H1 and coherences of a period of the response to white noise, exact up to half the sample rate; 1 % of noise; Hann window."""
    K = 1.02 * STIFFNESS * (2 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1))
    K[-1, -1] /= 2
    values, X = eigh(K, np.diag([MASS, MASS + added, MASS, MASS]))
    rate, rng = 256.0, np.random.default_rng(seed)
    force = rng.standard_normal(int(rate * BLOCK * BLOCKS))
    s = 2j * np.pi * np.fft.rfftfreq(len(force), 1 / rate)[:, None]
    H = (s**2 / (s**2 + 2 * ZETA * np.sqrt(values) * s + values) * X[FORCE]) @ X[SENSORS].T
    motions = np.fft.irfft(H * np.fft.rfft(force)[:, None], len(force), axis=0)
    motions += 0.01 * motions.std(axis=0) * rng.standard_normal(motions.shape)
    how = {"fs": rate, "nperseg": int(rate * BLOCK), "detrend": False}
    hz, power = welch(force, **how)
    columns, names = [hz], ["f"]
    for name, motion in zip(SENSORS, motions.T, strict=True):
        cross = csd(force, motion, **how)[1]
        columns += [(cross / power).real, (cross / power).imag, np.abs(cross) ** 2 / power / welch(motion, **how)[1]]
        names += [f"{part}{name}" for part in "ric"]
    used = (hz > 4) & (hz < 48)
    table = np.array(columns).T[used]
    np.savetxt(folder / "h1.csv", table, delimiter=",", header=",".join(names), comments="")


def diagnosed(folder, added: float, keys: str = "", seed: int = 3):
    estimated(folder, added, seed)
    (folder / "deck.yaml").write_text(DECK.replace("      outputs:", f"{keys}      outputs:"))
    return diagnose(read_deck(str(folder / "deck.yaml")))


@pytest.mark.proof
def test_a_sound_structure_whose_resonances_are_narrower_than_a_line_lacks_nothing(tmp_path):
    found = diagnosed(tmp_path, 0.0, "      window: hann\n")
    assert found.kind == NOTHING
    assert not any("window" in remark for remark in found.remarks)


@pytest.mark.proof
def test_a_window_that_the_deck_does_not_state_is_found_and_reported(tmp_path):
    found = diagnosed(tmp_path, 0.0)
    assert found.kind == NOTHING
    assert sum("under a window 'hann'" in remark for remark in found.remarks) == 1


@pytest.mark.proof
def test_a_mass_is_named_from_averages_under_a_window(tmp_path):
    found = diagnosed(tmp_path, 0.25, "      window: hann\n")
    assert found.kind == NAMED
    assert (found.best.causes[0].group, found.best.causes[0].site.text) == ("mass", "node 2")
    size = found.best.causes[0].sizes[0]
    assert abs(size.value - 0.25) < 4 * size.sd


def test_files_carry_the_window(tmp_path):
    estimated(tmp_path, 0.0, 3)
    keys = "      window: hann\n      block: 4.0\n      burst: 0.5\n"
    (tmp_path / "deck.yaml").write_text(DECK.replace("      outputs:", f"{keys}      outputs:"))
    test = read_deck(str(tmp_path / "deck.yaml")).frf[0]
    write_frf(test, str(tmp_path / "h1.npz"))
    plain = DECK[: DECK.index("    - file")] + "    - file: h1.npz\n"
    (tmp_path / "again.yaml").write_text(plain)
    assert read_deck(str(tmp_path / "again.yaml")).frf[0].window == test.window
    assert (test.window.name, test.window.seconds, test.window.burst) == ("hann", 4.0, 0.5)


@pytest.mark.parametrize("keys", ["block: 4", "window: hann\n      burst: 1.5", "window: hann\n      block: 0"])
def test_faulty_windows_are_told(tmp_path, keys):
    from mouse_cli import DeckError

    estimated(tmp_path, 0.0, 3)
    (tmp_path / "deck.yaml").write_text(DECK.replace("      outputs:", f"      {keys}\n      outputs:"))
    with pytest.raises(DeckError) as caught:
        read_deck(str(tmp_path / "deck.yaml"))
    assert [each.code for each in caught.value.diagnostics] == ["MD215"]
