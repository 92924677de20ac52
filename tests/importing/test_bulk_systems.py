"""Local systems, and points that move as the mean of others, in bulk data of Nastran. Truth: closed forms, and CalculiX by hand."""

import numpy as np
import pytest
from test_bulk_data import BRICKS, MORE, hertz, solver, written

from mouse_cli import DeckError
from mouse_cli.importing.jobs import frequencies
from mouse_cli.importing.read import read

SYSTEMS = (  # a quarter turn about z, moved; cylinders and spheres about its axes; three grid points
    "CORD2R,5,,1.,0.,0.,1.,0.,1.\n,1.,1.,0.\nCORD2C,6,5,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
    "CORD2S,7,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCORD1R,8,1,5,2\n"
)


def test_grid_points_of_local_systems_are_where_they_say(tmp_path):
    """x of system 5 is the basic y; its cylinder turns from there; 45 degrees from z, 90 about it; origin, z and x by points."""
    points = "GRID,21,5,1.,2.,3.\nGRID,22,6,2.,90.,1.\nGRID,23,7,2.,45.,90.\nGRID,24,8,0.,0.,2.\n"
    model = read(written(tmp_path, MORE + SYSTEMS + points))
    half = 2**0.5
    expected = {21: (-1, 1, 3), 22: (-1, 0, 1), 23: (0, half, half), 24: (0, 0, 2)}
    assert all(np.allclose(model.nodes[n], at, atol=1e-12) for n, at in expected.items())


@solver
def test_bricks_in_another_system_have_the_same_frequencies(tmp_path):
    """All grid points given in, and moving by, a system that is turned and moved."""
    expected = hertz(frequencies(read(written(tmp_path, BRICKS)), 4))
    local = BRICKS.replace("GRID,9,,0.,0.,2.", "GRID,9,5,0.,1.,2.,5").replace(
        "GRID,11,,1.,1.,2.", "GRID,11,5,1.,0.,2.,5"
    )
    model = read(written(tmp_path, local.replace("ENDDATA", SYSTEMS + "ENDDATA")))
    assert np.allclose(hertz(frequencies(model, 4)), expected, rtol=1e-9)


REFUSED = {
    "held in its own directions": (MORE.replace("GRID,4,,0.,1.,0.", "GRID,4,,0.,1.,0.,5,12") + SYSTEMS, "MD268", "own system"),
    "no such system": (MORE + "GRID,21,9,0.,0.,0.\n", "MD272", "9 is not defined"),
    "defined by itself": (MORE + "GRID,21,9,0.,0.,0.\nCORD2R,9,9,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n", "MD272", "by itself"),
    "on one line": (MORE + "GRID,21,9,0.,0.,0.\nCORD2R,9,,0.,0.,0.,0.,0.,1.\n,0.,0.,2.\n", "MD272", "one line"),
    "a mean of two": (MORE + "GRID,30,,.5,.5,3.\nRBE3,31,,30,123,1.,123,5,6\n", "MD268", "one line, or too few"),
    "one direction": (MORE + "GRID,30,,.5,.5,3.\nRBE3,31,,30,3,1.,123,5,6,7\n", "MD268", "directions 3 alone"),
    "rotations of its points": (MORE + "GRID,30,,.5,.5,3.\nRBE3,31,,30,123,1.,123456,5,6,7\n", "MD268", "other than"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_not_read_of_them_is_refused_by_its_line(name, tmp_path):
    text, code, words = REFUSED[name]
    with pytest.raises(DeckError, match=words) as told:
        read(written(tmp_path, text))
    assert told.value.diagnostics[0].code == code and told.value.diagnostics[0].span.line > 1


@solver
def test_a_mass_on_a_weighted_mean_of_points(tmp_path):
    """Above the middle of the upper face: its motion is the mean one of the four corners, and their rotation times the arm."""
    more = "GRID,30,,.5,.5,3.\nCONM2,32,30,,500.\nRBE3,31,,30,123,1.,123,9,THRU\n,12\n"
    found = hertz(frequencies(read(written(tmp_path, MORE + more)), 4))
    bare = frequencies(read(written(tmp_path, MORE)), 4)
    # of corners at (+-1/2, +-1/2), sum x2 = 1: theta_x = sum y w, theta_y = -sum x w; U_x = mean + theta_y, U_y = mean - theta_x
    corners = {9: (-0.5, -0.5), 10: (0.5, -0.5), 11: (0.5, 0.5), 12: (-0.5, 0.5)}
    terms = lambda d, tilt: [(n, d, -0.25) for n in corners] + [(n, 3, tilt(*at)) for n, at in corners.items()]
    rows = {1: terms(1, lambda x, y: x), 2: terms(2, lambda x, y: y), 3: [(n, 3, -0.25) for n in corners]}
    text = "*NODE\n30, 0.5, 0.5, 3.0\n*ELEMENT, TYPE=MASS, ELSET=TOP\n32, 30\n*MASS, ELSET=TOP\n500.0\n"
    for d, each in rows.items():
        every = [(30, d, 1.0), *each]
        text += f"*EQUATION\n{len(every)}\n"
        for k in range(0, len(every), 4):
            text += ", ".join(f"{n}, {c}, {v}" for n, c, v in every[k : k + 4]) + "\n"
    at = bare.index("*BOUNDARY")
    assert np.allclose(found, hertz(bare[:at] + text + bare[at:]), rtol=1e-6)
    assert np.abs(found / hertz(bare) - 1).max() > 0.01
