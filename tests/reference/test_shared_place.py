"""What rival sites have in common, by the coordinates of a frame of two bays and two storeys."""

from types import SimpleNamespace

import numpy as np

from mouse_cli.model.diagnosis import NAMED, ONE_OF, Cause, Diagnosis, Effort, Explanation, Proposal, Site
from mouse_cli.model.mesh import ElementSet, Mesh
from mouse_cli.model.shared_place import SharedPlace, at_one_place, shared_place
from mouse_cli.model.units import Units
from mouse_cli.report.verdict_document import shared, verdict
from mouse_cli.report.verdict_sentences import sentences

# nodes 1 to 6 at y = 0: x = 0, 4, 8 at z = 0, then 3; 7 to 12 the same at y = 5; a top node 13
XYZ = np.array([[x, y, z] for y in (0.0, 5.0) for z in (0.0, 3.0) for x in (0.0, 4.0, 8.0)] + [[4.0, 2.5, 6.0]])
COLUMNS = ElementSet("beam", np.arange(21, 27), np.array([[i, i + 3] for i in (0, 1, 2, 6, 7, 8)]), {})
MESH = Mesh(np.arange(1, 14), XYZ, (COLUMNS,), np.zeros((0, 2), int))


def brace(one: int, other: int) -> Site:
    middle = tuple(XYZ[[one - 1, other - 1]].mean(axis=0).tolist())
    return Site("node", (one, other), middle, f"between nodes {one} and {other}")


def test_diagonals_of_neighbouring_bays_share_wall_and_storey():
    found = shared_place(MESH, (brace(1, 5), brace(2, 6)))
    assert found == SharedPlace((("y", 0.0, 0.0), ("z", 0.0, 3.0)))
    assert shared(found) == {"x": None, "y": (0.0, 0.0), "z": (0.0, 3.0), "nodes": []}


def test_two_diagonals_of_a_panel_share_the_panel():
    assert shared_place(MESH, (brace(1, 5), brace(2, 4))).extents == (("x", 0, 4), ("y", 0, 0), ("z", 0, 3))


def test_columns_of_a_storey_share_it_and_nothing_else():
    sites = tuple(Site("element", (i,)) for i in (21, 25))
    assert shared_place(MESH, sites) == SharedPlace((("z", 0.0, 3.0),))


def test_sites_at_one_node_share_it():
    assert shared_place(MESH, (brace(5, 13), brace(5, 9))) == SharedPlace((), (5,))


def test_what_the_whole_structure_does_is_nothing_in_common():
    assert shared_place(MESH, (brace(1, 13), brace(9, 13))).extents == ()
    assert shared_place(MESH, (brace(1, 10), brace(3, 13), Site("dof", ("1TX",)))) is None
    assert shared_place(None, (brace(1, 5), brace(2, 6))) is None


def test_the_verdict_says_where_to_look_and_what_tells_some_of_them_apart():
    """A measurement that parts the leading site from the third is told as such, though none parts it from the second."""
    cause = lambda site: Cause("brace", "brace", "a spring between two points", site, ())
    elsewhere = (((brace(2, 4),), 0.4), ((brace(2, 6),), 0.2))
    told = Explanation((cause(brace(1, 5)),), 20.0, 20, 0.5, 0.0, np.zeros(2), 1.0, elsewhere)
    text = [each.text for each in (brace(1, 5), brace(2, 4), brace(2, 6))]
    measured = (
        Proposal("the frequency of mode 9", (text[0], text[1]), 0.2),
        Proposal("a sensor more", (text[0], text[2]), 6.0, Effort.SENSOR),
    )
    problem = SimpleNamespace(mesh=MESH, units=Units("m", "kg", "N"))
    answer = Diagnosis(
        problem, ONE_OF, None, None, (told,), (("brace", 1.0),), placed=False, proposals=measured
    )  # fmt: skip
    first, second, third = sentences(answer)
    assert "between nodes 1 and 5; or between nodes 2 and 4 (probability of this site 0.40)" in first
    assert second.startswith("All of these sites share y = 0 m, z = 0 to 3 m: ")
    assert third == (
        "No measurement that was tried separates between nodes 1 and 5 from between nodes 2 and 4; a sensor more separates "
        "between nodes 1 and 5 from between nodes 2 and 6 (predicted separation 6.0)."
    )


def test_groups_that_a_measurement_tells_apart_are_called_by_their_names():
    """Keys of groups stand in tables; a sentence has words."""
    of = lambda key, title, p: Explanation((Cause(key, key, title, brace(1, 5), ()),), 20.0, 20, 0.5, 0.0, np.zeros(2), p)
    told = (of("ground-spring", "an inclined spring", 0.5), of("mass", "a lumped mass", 0.3), of("brace", "a spring between", 0.2))
    measured = (
        Proposal("the frequency of mode 9", ("ground-spring", "mass"), 0.2),
        Proposal("a sensor more", ("ground-spring", "brace"), 6.0, Effort.SENSOR),
    )
    problem = SimpleNamespace(mesh=MESH, units=Units("m", "kg", "N"))
    groups = tuple((one.group, one.probability) for one in told)
    assert sentences(Diagnosis(problem, ONE_OF, None, None, told, groups, proposals=measured))[-1] == (
        "No measurement that was tried separates a spring to the ground from an added mass; a sensor more separates a spring to "
        "the ground from a spring between (predicted separation 6.0)."
    )


def test_what_is_named_in_a_line_of_panels_joins_two_of_their_nodes():
    cause = Cause("brace", "brace", "a spring between two points", brace(1, 5), ())
    told = Explanation((cause,), 20.0, 20, 0.5, 0.0, np.zeros(2), 1.0, (((brace(2, 4),), 0.4),))
    problem = SimpleNamespace(mesh=MESH, units=Units("m", "kg", "N"))
    answer = Diagnosis(problem, NAMED, None, None, (told,), (("brace", 1.0),), placed=False)
    assert sentences(answer)[0] == (
        "The model lacks a spring between two points (probability > 0.999) within x = 0 to 4 m, y = 0 m, z = 0 to 3 m, and the "
        "test does not settle between which nodes: between nodes 1 and 5; or between nodes 2 and 4 (probability of this site 0.40)."
    )
    assert verdict(answer)["site"] == {
        "kind": "node",
        "ids": [1, 2, 4, 5],
        "position": None,
        "text": "between two of nodes 1, 2, 4, 5",
    }


def test_points_and_nodes_within_five_per_cent_are_at_one_place():
    """A crack a little above a foot, and the foot; not at the next node, and not where a site is spread or there is one alone."""
    foot, size = Site("node", (1,)), np.ptp(MESH.coordinates, axis=0).max()
    crack = lambda share: Site("element", (1,), tuple(MESH.coordinates[0] + [share * size, 0.0, 0.0]))
    assert at_one_place(MESH, (foot, crack(0.04))) and at_one_place(MESH, (crack(0.0), crack(0.05)))
    assert not at_one_place(MESH, (foot, crack(0.06)))
    assert not at_one_place(MESH, (foot, Site("node", (2,))))
    assert not at_one_place(MESH, (foot, Site("element", (1, 2)))) and not at_one_place(MESH, (foot, brace(1, 5)))
    assert not at_one_place(MESH, (foot,)) and not at_one_place(None, (foot, foot))
