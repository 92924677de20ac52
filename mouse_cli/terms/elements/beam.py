"""Beam: axial force, torsion and bending in two planes, after Euler and Bernoulli, Timoshenko, or generic."""

import numpy as np

from mouse_cli.terms.elements import DAMPING, GEOMETRIC, ElementType, Layout, Matrices, Option, Properties, Property
from mouse_cli.terms.elements import _beam as beam

_OMITTED, _INCLUDED = "omitted", "included"
_GENERIC, _TIMOSHENKO = ("generic",), ("timoshenko",)


def matrices(layout: Layout, properties: Properties) -> Matrices:
    """K (with axial force apart, GEOMETRIC) and M of each beam.

    Bending in a plane, as the sum of its symmetric and antisymmetric natural modes v_s = [0, -1, 0, 1], v_a = [1, l/2, -1, l/2]:
    K = E I (s/l v_s v_s' + 12 a/l^3 v_a v_a' + c sqrt(12)/l^2 (v_s v_a' + v_a v_s')), with s = a = 1, c = 0 after
    Euler-Bernoulli, a = 1/(1 + phi) after Timoshenko, and any s, a, c with s a > c^2 for the generic element of Gladwell and
    Ahmadian (1995): k_ww = 12 a, k_thth = s + 3 a in their terms. Torsion couples to both in generic elements, see `_coupled`.
    """
    return beam.to_nodes(layout, local(layout, properties))


def local(layout: Layout, properties: Properties) -> Matrices:
    """The same of the ends, in local axes, before anything is released."""
    p, length = properties, beam.span(layout).length
    kind = np.result_type(*p.values())
    K, M, Kg = (np.zeros((len(layout), 12, 12), kind) for _ in range(3))
    _bar(layout, p, length, K, M)
    tension = p["preload"] + (0.0 if layout.axial is None else layout.axial)
    for plane, axis, across in ((0, "z", "y"), (1, "y", "z")):
        EI, phi = p["E"] * p[f"I{axis}"], np.zeros(len(layout))
        if layout.options.get("theory") == "timoshenko":
            phi = 12 * EI / (p[f"kappa_{across}"] * p["G"] * p["A"] * length**2)
        beam.in_plane(K, _bending(layout, p, axis, EI, phi, length), plane)
        w, rotation = beam.inertial(length, phi)
        beam.in_plane(
            M, _inertia(layout, p, p["rotary_factor"] * p["density"] * p[f"I{axis}"], w, rotation, length), plane
        )
        if layout.options.get("theory") == "generic":
            _coupled(p, axis, EI, length, K, plane)
        if (tension != 0).any():
            beam.in_plane(Kg, beam.integral(beam.shapes(length, phi)[1], tension * length), plane)
    return {"K": K, "M": M, GEOMETRIC: Kg} if (tension != 0).any() else {"K": K, "M": M}


def _coupled(p: Properties, axis: str, EI: np.ndarray, length: np.ndarray, K: np.ndarray, plane: int) -> None:
    """Adds what couples torsion to the bending in a plane: k13 (u_1 u_3' + u_3 u_1') + k23 (u_2 u_3' + u_3 u_2').

    u_1, u_2, u_3: symmetric and antisymmetric bending and twist, scaled so that K = u_1 u_1' + u_2 u_2' + u_3 u_3' after Euler and
    Bernoulli; k13, k23 are those of the frame element of lecture 21-1 in these units.
    """
    (dofs, sense), GJ = beam.PLANES[plane], p["G"] * p["J"]
    for name, shape in (("symmetric", _symmetric(length)), ("antisymmetric", np.sqrt(12) * _antisymmetric(length))):
        strength = p[f"{name}_twist_{axis}"] * np.sqrt(EI) * np.sqrt(GJ) / length
        column = strength[:, None] * shape * sense
        for twist, sign in ((3, -1.0), (9, 1.0)):
            K[:, dofs, twist] += sign * column
            K[:, twist, dofs] += sign * column


def _symmetric(length: np.ndarray) -> np.ndarray:
    """v_s (e, 4)."""
    return np.tile([0.0, -1.0, 0.0, 1.0], (len(length), 1))


def _antisymmetric(length: np.ndarray) -> np.ndarray:
    """v_a / l (e, 4)."""
    found = np.tile([0.0, 0.5, 0.0, 0.5], (len(length), 1))
    found[:, 0], found[:, 2] = 1 / length, -1 / length
    return found


def _bar(layout: Layout, p: Properties, length: np.ndarray, K: np.ndarray, M: np.ndarray) -> None:
    """Axial motion and torsion."""
    line, polar = _per_length(p) * length, p["density"] * (p["Iy"] + p["Iz"]) * length
    pattern = (0.5, 0.0) if layout.options.get("mass") in beam.AT_ENDS else (1 / 3, 1 / 6)
    polar = 0.0 * polar if layout.options.get("mass") == beam.TRANSLATIONAL else polar
    for dofs, k, m in (((0, 6), p["E"] * p["A"], line), ((3, 9), p["G"] * p["J"], polar)):
        beam.two_ended(K, k / length, dofs, (1.0, -1.0))
        beam.two_ended(M, m, dofs, pattern)


def _per_length(p: Properties) -> np.ndarray:
    return p["density"] * p["A"] + p["nonstructural_mass"]


def _bending(
    layout: Layout, p: Properties, axis: str, EI: np.ndarray, phi: np.ndarray, length: np.ndarray
) -> np.ndarray:
    """Stiffness (e, 4, 4) in one plane."""
    one = np.ones(len(layout))
    symmetric, antisymmetric, coupling = one, 1 / (1 + phi), 0 * one
    if layout.options.get("theory") == "generic":
        symmetric, antisymmetric, coupling = (
            p[f"{name}_{axis}"] for name in ("symmetric", "antisymmetric", "coupling")
        )
    s, a = _symmetric(length), length[:, None] * _antisymmetric(length)
    ss, aa, sa = (u[:, :, None] * v[:, None, :] for u, v in ((s, s), (a, a), (s, a)))
    factors = symmetric / length, 12 * antisymmetric / length**3, np.sqrt(12) * coupling / length**2
    blocks = ss, aa, sa + sa.transpose(0, 2, 1)
    return sum((EI * f)[:, None, None] * block for f, block in zip(factors, blocks, strict=True))


def _inertia(
    layout: Layout, p: Properties, rotary: np.ndarray, w: np.ndarray, rotation: np.ndarray, length: np.ndarray
) -> np.ndarray:
    """Mass (e, 4, 4) in one plane; rotary (e,): inertia of the section per length, counted where it is included."""
    options = layout.options
    theory = options.get("theory") or "euler-bernoulli"
    turning = options.get("rotary_inertia") or (_INCLUDED if theory == "timoshenko" else _OMITTED)
    line = _per_length(p)
    if options.get("mass") in beam.AT_ENDS:  # half a bar turning about its end: l^3/24
        half = 0.0 if options["mass"] == beam.TRANSLATIONAL else 1 / 24
        ends = half * line * length**3 + (rotary * length / 2 if turning == _INCLUDED else 0.0)
        M = np.zeros((len(layout), 4, 4), ends.dtype)
        M[:, (0, 2), (0, 2)] = (line * length / 2)[:, None]
        M[:, (1, 3), (1, 3)] = ends[:, None]
        return M
    M = _generic_mass(p, line, length) if theory == "generic" else beam.integral(w, line * length)
    return M + beam.integral(rotation, rotary * length) if turning == _INCLUDED else M


def _generic_mass(p: Properties, line: np.ndarray, length: np.ndarray) -> np.ndarray:
    """The symmetric family (e, 4, 4) with the mass and the moment of inertia of a rigid bar."""
    m11, m12, m14, m22 = (p[name] for name in ("m11", "m12", "m14", "m22"))
    m24 = 1 / 6 - m11 / 2 + m12 + m14 - m22
    rows = (
        (m11, m12, 0.5 - m11, m14),
        (m12, m22, -m14, m24),
        (0.5 - m11, -m14, m11, -m12),
        (m14, m24, -m12, m22),
    )
    scale = np.where(np.array([0, 1, 0, 1]) == 1, length[:, None], 1.0)
    block = np.stack([np.stack(row, axis=-1) for row in rows], axis=1)
    return (line * length)[:, None, None] * block * scale[:, :, None] * scale[:, None, :]


def tension(layout: Layout, properties: Properties, u: np.ndarray) -> np.ndarray:
    """E A times the mean axial strain (e,) under displacements of the nodes u (e, 12); 0 where TX is released."""
    if any("TX" in names for names in (layout.options.get("releases") or {}).values()):
        return np.zeros(len(layout))
    at = beam.span(layout)
    ends = np.einsum("eij,ej->ei", at.motion[:, (0, 6)], u)
    return properties["E"] * properties["A"] / at.length * (ends[:, 1] - ends[:, 0])


def _of(name: str, axis: str) -> str:
    """What the stiffness `name` of a generic element is measured by."""
    return f"the root of E I{axis} G J" if "twist" in name else f"E I{axis}"


PROPERTIES = {
    "E": Property("Young's modulus", "Pa", positive=True),
    "nu": Property("Poisson's ratio", "1", 0.3),
    "G": Property("shear modulus; not given: E / (2 (1 + nu))", "Pa", lambda _, p: p["E"] / (2 * (1 + p["nu"])), True),
    "density": Property("density", "kg/m3", 0.0),
    "A": Property("area of the section", "m2", positive=True),
    "Iy": Property("second moment of area for bending in the local x-z plane", "m4", 0.0),
    "Iz": Property("second moment of area for bending in the local x-y plane", "m4", 0.0),
    "J": Property("torsion constant", "m4", 0.0),
    "kappa_y": Property("shear coefficient for the local x-y plane", "1", 5 / 6, True, only=_TIMOSHENKO),
    "kappa_z": Property("shear coefficient for the local x-z plane", "1", 5 / 6, True, only=_TIMOSHENKO),
    "nonstructural_mass": Property("further mass per length", "kg/m", 0.0),
    "preload": Property("axial force, tension positive; it stiffens bending", "N", 0.0),
    "rotary_factor": Property(
        "inertia of sections that turn in bending, over density I of the section",
        "1",
        1.0,
        only=(_INCLUDED, *_TIMOSHENKO),
    ),
    **{
        f"{name}_{axis}": Property(f"{meaning}, in units of {_of(name, axis)}", "1", default, positive, only=_GENERIC)
        for axis in "yz"
        for name, meaning, default, positive in (
            ("symmetric", f"stiffness of symmetric bending about {axis}", 1.0, True),
            ("antisymmetric", f"stiffness of antisymmetric bending about {axis}", 1.0, True),
            ("coupling", f"coupling of both about {axis}, less than the root of their product", 0.0, False),
            ("symmetric_twist", f"coupling of torsion to symmetric bending about {axis}", 0.0, False),
            ("antisymmetric_twist", f"coupling of torsion to antisymmetric bending about {axis}", 0.0, False),
        )
    },
    **{
        name: Property(f"coefficient {name} of the mass matrix, times density A l", "1", value, only=_GENERIC)
        for name, value in (("m11", 13 / 35), ("m12", 11 / 210), ("m14", -13 / 420), ("m22", 1 / 105))
    },
}

ELEMENT = ElementType(
    "beam",
    "straight beam in space or in a plane",
    (2,),
    PROPERTIES,
    matrices,
    {
        "theory": Option("how it bends", "euler-bernoulli", ("euler-bernoulli", "timoshenko", "generic")),
        "mass": Option(
            "mass matrix; lumped: of half the beam at each end; translational: without its inertia against rotation",
            "consistent",
            ("consistent", *beam.AT_ENDS),
        ),
        "rotary_inertia": Option(
            "inertia of sections that turn in bending; none: included after Timoshenko only",
            None,
            (_INCLUDED, _OMITTED),
        ),
        **beam.ORIENTATION,
        **beam.OFFSETS,
        **beam.RELEASES,
    },
    tuple(DAMPING),
    tension,
    reach=True,
)
