"""A structure written as a deck and read back is the same structure, whatever it is made of."""

import math

import numpy as np
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from mouse_cli._errors import DeckError
from mouse_cli.formats import read_deck, write_deck, yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.terms.assembly import assembly

number = st.floats(min_value=1e-6, max_value=1e12)
coordinate = st.floats(min_value=-10, max_value=10).map(lambda v: round(v, 6))
_MATERIALS = {"m 1": "{E: 2.1e+11, nu: 0.29, density: 7850}", "alu": "{E: 7.0e+10, G: 2.6e+10, density: 2700}"}
_SECTIONS = {"bar": "{rectangle: [0.01, 0.03]}", "t": "{tube: [0.05, 0.002], kappa_y: 0.6}"}
_BEAM = ("", ", theory: timoshenko", ", releases: {2: [RZ]}", ", offsets: {1: [0.0, 0.0, 0.01]}, mass: lumped")


def _nodes(draw, count):
    start, end = ([draw(coordinate) for _ in range(3)] for _ in range(2))
    assume(math.dist(start, end) > 0.1)
    if draw(st.booleans()):
        return f"{{line: {{from: 1, to: {count}, start: {start}, end: {end}}}}}"
    places = [
        [a + (b - a) * i / (count - 1) + 0.01 * (i % 2) for a, b in zip(start, end, strict=True)] for i in range(count)
    ]
    return "{" + ", ".join(f"{i}: {place}" for i, place in enumerate(places, 1)) + "}"


@st.composite
def decks(draw):
    count = draw(st.integers(3, 8))
    lines = ["mouse: 1", "model:", "  structure:", f"    nodes: {_nodes(draw, count)}"]
    lines.append("    materials: {" + ", ".join(f"{k}: {v}" for k, v in _MATERIALS.items()) + "}")
    lines.append("    sections: {" + ", ".join(f"{k}: {v}" for k, v in _SECTIONS.items()) + "}")
    first = draw(st.integers(1, count - 1))
    lines.append("    elements:")
    for low, high in ((1, first), (first, count)):
        if high > low:
            material, section = draw(st.sampled_from([*_MATERIALS])), draw(st.sampled_from([*_SECTIONS]))
            made = f"type: beam, nodes: {low}-{high}, material: {material}, section: {section}"
            own = draw(st.sampled_from(["", f", E: {draw(number)!r}", ", nonstructural_mass: 0.7"]))
            lines.append(
                f"      - {{id: {low}-{high - 1}, {made}{own}{draw(st.sampled_from(_BEAM))}}}".replace(
                    f"{low}-{low},", f"{low},"
                )
            )
    lines.append(f"      - {{id: 50, type: spring, nodes: [{count}], TX: {draw(number)!r}, RY: {draw(number)!r}}}")
    masses = ", ".join(repr(draw(number)) for _ in range(2))
    lines.append(f"      - {{id: [61, 60], type: mass, nodes: [1, {count}], mass: [{masses}], Jx: 0.5}}")
    lines.append("    supports: {1: " + draw(st.sampled_from(["all", "[TX, TY, TZ]", "[TZ]"])) + "}")
    if draw(st.booleans()):
        lines.append("    plane: " + draw(st.sampled_from(["XY", "XZ"])))
    lines += ["parameters:", "  - {name: E, elements: 1, property: E, sd: 3 %}"]
    lines.append("  - {name: m, elements: 60-61, property: mass, factor: true, sd: 3 %, transform: log}")
    lines.append("  - {name: s, elements: 50, property: [TX, RY], sd: 0.1}")
    return "\n".join(lines) + "\n"


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much])
@given(decks())
def test_written_structures_read_back(tmp_path_factory, text):
    try:
        first = assemble(yaml_deck.read(text, "deck.yaml"))
    except DeckError as error:  # a mechanism, or a mass that no stiffness holds
        assert all(d.code.startswith(("MD4", "MD3")) for d in error.diagnostics), text
        assume(False)
    path = tmp_path_factory.mktemp("deck") / "again.yaml"
    write_deck(first, path)
    again = read_deck(path)
    assert again.structure.labels == first.structure.labels
    assert np.array_equal(again.mesh.coordinates, first.mesh.coordinates)
    for one, other in zip(again.mesh.elements, first.mesh.elements, strict=True):
        assert (one.type, one.ids.tolist(), one.nodes.tolist()) == (
            other.type,
            other.ids.tolist(),
            other.nodes.tolist(),
        )
        assert one.origin == other.origin and one.options == other.options
    assert [(b.parameter, b.set, b.members.tolist(), b.property, b.factor) for b in again.bindings] == [
        (b.parameter, b.set, b.members.tolist(), b.property, b.factor) for b in first.bindings
    ]
    assert np.array_equal(again.prior.mean, first.prior.mean) and np.array_equal(again.prior.cov, first.prior.cov)
    theta = 1.25 * first.prior.mean
    for one, other in zip(assembly(again).matrices(theta), assembly(first).matrices(theta), strict=True):
        assert np.array_equal(one, other)
