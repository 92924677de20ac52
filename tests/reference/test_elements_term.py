"""Parameters of elements: values and derivatives at any of them, for every property of every type."""

import mpmath
import numpy as np
import pytest
from element_meshes import BAR, STEEL, XY, beam_line, elements, matrices, mesh, pairs

from mouse_cli.model.arrays import dense
from mouse_cli.model.mesh import Binding, Mesh, RigidLink
from mouse_cli.terms.assembly import Assembly
from mouse_cli.terms.build import built
from mouse_cli.terms.elements import DAMPING, registry

TYPES = registry()
EVERY = [(key, name) for key, kind in TYPES.items() for name in kind.properties]


def sample(key: str, property: str) -> Mesh:
    """Two free elements of a type, with all properties different from zero, next to one another."""
    kind, rng = TYPES[key], np.random.default_rng(7)
    points = rng.uniform(-1, 1, (3, 3))
    nodes = pairs(2) if 2 in kind.nodes else np.array([[0], [1]])
    words = {word for declared in [kind.properties[property]] for word in declared.only}
    options = {name: w for name, option in kind.options.items() for w in option.choices if w in words}
    values = {name: rng.uniform(0.5, 1.5, 2) for name, p in kind.properties.items() if p.default is None}
    values |= {
        name: rng.uniform(0.1, 0.4, 2) for name, p in kind.properties.items() if not callable(p.default)
    } | values
    values.setdefault(property, rng.uniform(0.5, 1.5, 2))
    return mesh(points[: nodes.max() + 1], [elements(key, nodes, options=options, **values)])


@pytest.mark.parametrize(("key", "property"), EVERY)
def test_derivatives_by_every_property(key, property):
    """Complex steps against central differences in the same property."""
    from mouse_cli.terms.element_matrices import ElementMatrices
    from mouse_cli.terms.elements import Layout

    given = sample(key, property)
    own = given.elements[0]
    binding = Binding(0, 0, np.array([1]), property)
    matrices = ElementMatrices(TYPES[key], own, Layout(given.coordinates[own.nodes], own.options), (binding,))
    matrices.choose(matrices.standing)
    at, h = own.properties[property][1], 1e-5
    found = matrices.derivatives(np.array([at]), property)
    moved = 0.0
    for name in matrices.names:
        sides = []
        for value in (at + h, at - h):
            entries = {other: matrices.fixed()[other] for other in matrices.names}
            matrices.add_moving(np.array([value]), entries)
            sides.append(entries[name])
        difference = (sides[0] - sides[1]) / (2 * h)
        size = np.abs(difference).max(initial=0.0) + np.abs(sides[0]).max() * 1e-4
        assert np.abs(found[name] - difference).max() < 1e-6 * size
        moved = max(moved, np.abs(found[name]).max())
    assert moved > 0, "the property acts on nothing"


def test_derivative_of_a_timoshenko_beam_in_extended_precision():
    """d/dA of k_22 = E I (4 + phi)/(l (1 + phi)), phi = 12 E I/(kappa G A l^2), to 15 digits by mpmath."""
    length, E, I = 0.3, STEEL["E"], BAR["Iz"]

    def k22(A):
        phi = (
            12
            * mpmath.mpf(E)
            * I
            / (mpmath.mpf(5) / 6 * (mpmath.mpf(E) / mpmath.mpf(2.6)) * A * mpmath.mpf(length) ** 2)
        )
        return mpmath.mpf(E) * I / length * (4 + phi) / (1 + phi)

    given = beam_line(1, length, [(0, XY), (1, (0, 1))], {"theory": "timoshenko"})
    term = built(given, (Binding(0, 0, np.array([0]), "A"),)).terms[0]
    slopes = term.slopes(np.array([BAR["A"]]))["K"]
    with mpmath.workdps(40):
        exact = float(mpmath.diff(k22, mpmath.mpf(BAR["A"])))
    assert slopes.value.sum() == pytest.approx(exact, rel=1e-13)
    assert not term.linear


_MANY = np.arange(4)
_LINEAR = {
    "E": (((0, "E", True),), {}, True),
    "E and density": (((0, "E", True), (1, "density", False)), {}, True),
    "E after Timoshenko, G following it": (((0, "E", True),), {"theory": "timoshenko"}, True),
    "E after Timoshenko, G given": (((0, "E", True),), {"theory": "timoshenko", "G": 8e10}, False),
    "E and A": (((0, "E", True), (1, "A", True)), {}, False),
    "one factor of E and density": (((0, "E", True), (0, "density", True)), {}, True),
    "one factor of E and Iz": (((0, "E", True), (0, "Iz", True)), {}, False),
    "two factors of E": (((0, "E", True), (1, "E", True)), {}, False),
    "preload": (((0, "preload", False),), {}, True),
    "kappa_y": (((0, "kappa_y", False),), {"theory": "timoshenko"}, False),
    "both stiffnesses of a generic beam": (
        ((0, "symmetric_z", False), (1, "antisymmetric_z", False)),
        {"theory": "generic"},
        True,
    ),
    "E of a released beam": (((0, "E", True),), {"releases": {1: ["RZ"]}}, True),
    "E of an offset beam": (((0, "E", True),), {"offsets": {1: [0, 0.1, 0]}}, True),
}


@pytest.mark.parametrize("case", _LINEAR)
def test_what_is_linear_is_found_out(case):
    """And values and slopes are those of the same mesh made with these properties at once."""
    bound, options, linear = _LINEAR[case]
    options = dict(options)
    extra = {"G": options.pop("G")} if "G" in options else {}
    bindings = tuple(Binding(p, 0, _MANY, name, factor) for p, name, factor in bound)
    nominal = {**STEEL, **BAR, **extra, "preload": 50.0}
    theta = np.array([1.3, 0.8])[: 1 + max(p for p, _, _ in bound)]
    for p, name, factor in bound:
        if not factor:
            theta[p] *= nominal.get(name, 1.0)
    made = dict(nominal)
    for p, name, factor in bound:
        made[name] = theta[p] * (made[name] if factor else 1.0)
    supports = [(0, XY)]
    model = built(beam_line(4, supports=supports, options=options, **{**extra, "preload": 50.0}), bindings)
    assert model.terms[0].linear is linear
    assembly = Assembly(model.structure, model.terms, len(theta))
    expected = matrices(beam_line(4, supports=supports, options=options, **made))
    for one, other in zip(assembly.matrices(theta), expected, strict=True):
        assert np.abs(one - other).max() < 1e-13 * np.abs(other).max()
    _against_differences(assembly, theta)


def _against_differences(assembly: Assembly, theta: np.ndarray) -> None:
    slopes = assembly.slopes(theta)
    for name, number in (("K", 0), ("M", 1)):
        for p, value in enumerate(theta):
            step = np.zeros(len(theta))
            step[p] = 1e-5 * value
            up, down = (dense(assembly.matrices(theta + s)[number]) for s in (step, -step))
            own, found = slopes[name].parameter == p, np.zeros_like(up)
            np.add.at(found, (slopes[name].row[own], slopes[name].col[own]), slopes[name].value[own])
            difference = (up - down) / (2 * step[p])
            size = np.abs(difference).max() + np.abs(up).max() / abs(value) * 1e-4
            assert np.abs(found - difference).max() < 1e-6 * size


def test_parts_of_a_mesh_with_links_offsets_and_nonlinear_bindings():
    """Some elements bound, some not, some twice; a rigid link spreads the entries of one of them."""
    points = np.random.default_rng(5).uniform(-1, 1, (6, 3))
    sets = [
        elements("beam", pairs(4), 1, {"theory": "timoshenko", "offsets": {2: [0.1, 0, 0]}}, **STEEL, **BAR),
        elements("rod", [[5, 0], [5, 2]], 10, E=1e10, A=1e-4, density=2e3),
    ]
    given = mesh(points, sets, [(0, range(6))], links=(RigidLink(3, 5),))
    bindings = (
        Binding(0, 0, np.array([1, 3]), "E", True),
        Binding(1, 0, np.array([3]), "A", True),
        Binding(2, 1, np.array([0, 1]), "E", False),
        Binding(0, 1, np.array([1]), "A", True),
    )
    model = built(given, bindings)
    assert [term.linear for term in model.terms] == [False, False]
    _against_differences(Assembly(model.structure, model.terms, 3), np.array([1.1, 0.9, 0.8e10]))


def test_a_parameter_at_zero_has_a_derivative():
    given = mesh(
        [[0, 0, 0]], [elements("spring", [[0]], TX=3.0), elements("mass", [[0]], 2, mass=1.0)], directions=(0,)
    )
    model = built(given, (Binding(0, 0, np.array([0]), "TX", True),))
    assembly = Assembly(model.structure, model.terms, 1)
    assert assembly.matrices(np.zeros(1))[0].tolist() == [[0.0]]
    assert assembly.slopes(np.zeros(1))["K"].value.tolist() == [3.0]


def test_a_value_of_zero_keeps_its_place():
    """A spring whose nominal stiffness is 0 but that a parameter may raise holds its degree of freedom."""
    spring = elements("spring", [[0]], TX=0.0)
    base = elements("spring", [[0]], 3, TY=1.0)
    given = mesh([[0, 0, 0]], [spring, base, elements("mass", [[0]], 2, mass=1.0)])
    model = built(given, (Binding(0, 0, np.array([0]), "TX"),))
    assert model.structure.labels == ("1TX", "1TY")


@pytest.mark.parametrize("key", TYPES)
def test_types_say_what_they_are(key):
    """Meanings and units are there, words are distinct, and nothing damps unless it is asked for."""
    kind = TYPES[key]
    assert kind.meaning
    assert all(p.meaning and p.unit for p in kind.properties.values())
    words = [word for option in kind.options.values() for word in option.choices]
    assert len(words) == len(set(words)), "a word of two options would make Property.only ambiguous"
    assert all(word in words for p in kind.properties.values() for word in p.only)
    assert all(option.default in option.choices or option.default is None for option in kind.options.values())
    for name in set(DAMPING) & set(kind.properties):
        assert kind.properties[name].default == 0.0
