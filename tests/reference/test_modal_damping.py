"""Damping by ratios of modes: functions against superposition of modes, ratios of poles, ratios as parameters, bad input."""

import numpy as np
import pytest
from test_frf_updating import K0, M0, deck

from mouse_cli._errors import DeckError, NumericalError
from mouse_cli.formats import read_deck, write_deck
from mouse_cli.updating import forecast, run

BARE = deck(4).replace(", loss_factor: 0.01", "").split("  - {name: eta")[0]
HZ = np.linspace(5.0, 75.0, 150)


def receptance(ratio: np.ndarray, k: float = K0) -> np.ndarray:
    """H (f, n) at the last mass for forces on all, by the modes of the uniform chain in closed form (Blevins 1979, table 8-1)."""
    n = len(ratio)
    a = (2 * np.arange(1, n + 1) - 1) * np.pi / (2 * n + 1)
    shapes = np.sqrt(4 / (M0 * (2 * n + 1))) * np.sin(np.arange(1, n + 1)[:, None] * a)
    own, omega = 2 * np.sqrt(k / M0) * np.sin(a / 2), 2 * np.pi * HZ[:, None]
    return (shapes[-1] / (own**2 - omega**2 + 2j * ratio * own * omega)) @ shapes.T


def written(tmp_path, damping: str, ratio: np.ndarray, noise: float = 0.0, k: float = K0):
    """A deck with the functions of masses 1 and 4 for a force on 4."""
    H = receptance(ratio, k)[:, [0, 3]]
    rng = np.random.default_rng(11)
    H = H + noise * np.abs(H) * (rng.standard_normal(H.shape) + 1j * rng.standard_normal(H.shape))
    rows = (
        f"{f!r}," + ",".join(f"{z.real:.17g}{z.imag:+.17g}j" for z in row)
        for f, row in zip(HZ.tolist(), H, strict=True)
    )
    (tmp_path / "h.csv").write_text("hz,a,b\n" + "\n".join(rows))
    entry = "{file: h.csv, kind: receptance, unit: m/N, input: 4TX, outputs: {1TX: a, 4TX: b}, sd: 1 %}"
    path = tmp_path / "deck.yaml"
    path.write_text(f"{BARE}modal_damping: {damping}\ntest:\n  frf: [{entry}]\n")
    return path


@pytest.mark.parametrize(
    ("damping", "ratio"),
    [
        ("{ratio: 2 %}", [0.02, 0.02, 0.02, 0.02]),
        ("{ratio: [0.01, 0.03]}", [0.01, 0.03, 0.03, 0.03]),
        ("{ratio: [0.004, 0.01, 0.02, 0.05]}", [0.004, 0.01, 0.02, 0.05]),
    ],
)
def test_functions_are_sums_over_modes(tmp_path, damping, ratio):
    (fit,) = run(read_deck(written(tmp_path, damping, np.array(ratio)))).frf
    exact = receptance(np.array(ratio))[:, [0, 3], None]
    np.testing.assert_allclose(fit.prior, exact, rtol=1e-9)
    assert not any(remark.code == "MD518" for remark in run(read_deck(tmp_path / "deck.yaml")).warnings)


def test_poles_have_these_ratios(tmp_path):
    found = forecast(read_deck(written(tmp_path, "{ratio: [0.01, 0.02, 0.03], sd: 50 %}", np.full(4, 0.01)))).damped
    np.testing.assert_allclose(found.damping, [0.01, 0.02, 0.03, 0.03], rtol=1e-9)
    np.testing.assert_allclose(found.damping_sd[:3], [0.005, 0.01, 0.015], rtol=0.05)  # springs add a little


def test_ratios_are_estimated_beside_stiffness(tmp_path):
    """C is that of the nominal model: with 5 % less stiffness everywhere its ratio is zeta / sqrt(1.05), omega being higher."""
    truth = np.array([0.01, 0.02, 0.03, 0.03])
    path = written(tmp_path, "{ratio: [0.02, 0.02, 0.02, 0.02], sd: 100 %}", truth, 0.01, 1.05 * K0)
    result = run(read_deck(path))
    names = [p.name for p in result.problem.parameters]
    assert names[4:] == [
        "damping ratio of mode 1", "damping ratio of mode 2", "damping ratio of mode 3", "damping ratio of modes from 4 on"
    ]  # fmt: skip
    assert result.status.key == "converged" and not result.rejected
    known = np.concatenate([np.full(4, 1.05 * K0), truth * np.sqrt(1.05)])
    assert np.abs((result.revised.theta - known) / result.sd_theta).max() < 4
    assert np.abs(result.revised.theta / known - 1).max() < 0.03


def test_a_deck_comes_back(tmp_path):
    given = read_deck(written(tmp_path, "{ratio: [0.01, 0.03], sd: 50 %}", np.full(4, 0.01)))
    again = read_deck(write_deck(given, str(tmp_path / "again.yaml"))[-1])
    assert again.modal_damping.ratio.tolist() == [0.01, 0.03] and again.modal_damping.sd == 0.5
    assert len(again.parameters) == len(given.parameters) == 4


@pytest.mark.parametrize(
    "damping", ["{ratio: 0}", "{ratio: -1 %}", "{ratio: 150 %}", "{ratio: []}", "{sd: 10 %}", "{ratio: 1 %, sd: 0}"]
)
def test_what_is_no_ratio_is_refused_with_its_place(tmp_path, damping):
    with pytest.raises(DeckError) as caught:
        read_deck(written(tmp_path, damping, np.full(4, 0.01)))
    assert "modal_damping" in str(caught.value) and all(d.span for d in caught.value.diagnostics)


def test_large_models_are_told_what_to_do_instead(tmp_path):
    (tmp_path / "large.yaml").write_text(
        "mouse: 1\nmodel:\n  structure:\n    nodes: {line: {from: 0, to: 401, start: [0, 0, 0], end: [1, 0, 0]}}\n"
        "    elements:\n      - {id: 1-401, type: spring, nodes: 0-401, TX: 1.0e5}\n"
        "      - {id: 501-901, type: mass, nodes: 1-401, mass: 2.0}\n    supports: {0: all}\n    directions: [TX]\n"
        "modal_damping: {ratio: 1 %}\n"
    )
    with pytest.raises(NumericalError, match="MD519"):
        forecast(read_deck(tmp_path / "large.yaml"))
