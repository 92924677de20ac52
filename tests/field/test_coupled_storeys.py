"""Measured: the nine FRFs of a three-storey building with a mass coupled to them, beside the model revised by them with that
mass."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from test_frf_three_storeys import DECK, ENTRY, FILES, MEASURED

from mouse_cli.cli.main import _run
from mouse_cli.coupling import couple, modify
from mouse_cli.formats import read_deck
from mouse_cli.formats.yaml_deck import coupled, modified
from mouse_cli.updating.earlier import after

MASS = 1.5  # kg at the top floor, whose own mass is about 4.6 kg
COUPLED = """mouse: 1
title: Measured floors, and a mass at the top
couple:
  substructures: {{floors: {{deck: storeys.yaml, measured: true}}}}
  connections: [{{mass: {mass}, at: {{floors: 3TX}}}}]
  responses: {{floors: [1TX, 2TX, 3TX]}}
  kind: accelerance
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """The deck of the building beside its functions, and the result of a run on them."""
    if not MEASURED.exists():
        pytest.skip("the measured data are not beside the project")
    folder = tmp_path_factory.mktemp("storeys")
    entries = [ENTRY.format(file=name, input=floor, form="log") for floor, name in FILES.items()]
    (folder / "storeys.yaml").write_text(DECK + "".join(entries))
    for name in FILES.values():
        shutil.copy(MEASURED / name, folder)
    assert _run(["run", str(folder / "storeys.yaml"), "--json", "-o", str(folder / "result.json"), "-q"]) == 1
    return folder


def revised(folder: Path, mass: float):
    """The revised model with the mass: modes, and functions at the measured lines."""
    problem = read_deck(folder / "storeys.yaml")
    hz = problem.frf[0].frequency_hz
    text = f"mouse: 1\nmodify:\n  deck: m\n  changes: [{{mass: {mass}, at: 3TX}}]\n  responses: [1TX, 2TX, 3TX]\n"
    text += f"  kind: accelerance\n  lines: {{frequency: [{', '.join(repr(float(f)) for f in hz)}]}}\n"
    return modify(modified.read(text, "<test>", after(problem, str(folder / "result.json"), {})))


def decibels(one: np.ndarray, other: np.ndarray) -> float:
    return float(np.median(np.abs(20 * np.log10(np.abs(one / other)))))


def test_measured_functions_with_a_mass_are_those_of_the_revised_model_with_it(folder):
    """No worse than the fit itself (0.49 dB by its makers), where the mass alone moves functions by 3 dB."""
    found = couple(coupled.read(COUPLED.format(mass=MASS), str(folder / "c.yaml")))
    measured = read_deck(folder / "storeys.yaml").frf[0]
    model = revised(folder, MASS)
    assert decibels(found.functions.H, model.functions.after.H) < 0.7
    assert decibels(measured.H, model.functions.before.H) < 0.5
    assert decibels(found.functions.H, measured.H) > 2.5


def test_peaks_are_where_the_revised_model_has_its_modes(folder):
    """6.50, 17.47 and 26.50 Hz go down by 0.5, 0.8 and 0.35 Hz; the lines are 0.03 Hz apart."""
    found = couple(coupled.read(COUPLED.format(mass=MASS), str(folder / "c.yaml")))
    modes = revised(folder, MASS).after.frequencies_hz
    hz = found.functions.frequency_hz
    for mode, bare, shift in zip(modes, (6.50, 17.47, 26.50), (0.5, 0.8, 0.35), strict=True):
        assert bare - mode == pytest.approx(shift, abs=0.03)
        window = np.abs(hz - mode) < 1.0
        for floor in range(3):
            peak = hz[window][np.abs(found.functions.H[window, floor, floor]).argmax()]
            assert peak == pytest.approx(mode, abs=0.08)


def test_the_mass_taken_away_again_leaves_what_was_measured(folder):
    """Functions with the mass written to a file, and -1.5 kg coupled to those."""
    (folder / "c.yaml").write_text(COUPLED.format(mass=MASS))
    assert (
        _run(
            [
                "couple",
                str(folder / "c.yaml"),
                "--functions",
                str(folder / "heavy.npz"),
                "-q",
                "-o",
                str(folder / "c.txt"),
            ]
        )
        == 0
    )
    back = """mouse: 1
couple:
  substructures: {heavy: {functions: heavy.npz}}
  connections: [{mass: -1.5, at: {heavy: floors 3TX}}]
  responses: {heavy: [floors 1TX, floors 2TX, floors 3TX]}
  kind: accelerance
"""
    found = couple(coupled.read(back, str(folder / "back.yaml"))).functions.H
    measured = read_deck(folder / "storeys.yaml").frf[0].H
    np.testing.assert_allclose(found, measured, atol=1e-9 * np.abs(measured).max())


def test_a_mass_that_moves_the_first_mode_does_so_on_the_measured_functions(folder, capsys):
    """The inverse: which mass at the top brings mode 1 to 6 Hz, by the revised model; coupled to what was measured the peak is
    there."""
    line = [
        "modify",
        str(folder / "storeys.yaml"),
        "--prior",
        str(folder / "result.json"),
        "--target",
        "1<6",
        "--place",
        "3TX",
    ]
    assert _run([*line, "--json", "-q"]) == 0
    (need,) = json.loads(capsys.readouterr().out)["targets"]
    assert 1.2 < need["value"] < 1.8 and 0 < need["sd"] < 0.1 and need["sure"] > need["value"]
    found = couple(coupled.read(COUPLED.format(mass=need["value"]), str(folder / "c.yaml"))).functions
    window = np.abs(found.frequency_hz - 6) < 1
    assert found.frequency_hz[window][np.abs(found.H[window, 2, 2]).argmax()] == pytest.approx(6.0, abs=0.05)
