"""Beam with an open edge crack at midspan: it opens about a point off the axis, slides, and parts a little (lecture 21-1)."""

from dataclasses import replace

import numpy as np

from mouse_cli.terms import fracture
from mouse_cli.terms.elements import ElementType, Layout, Matrices, Option, Properties, Property
from mouse_cli.terms.elements import _beam as beam
from mouse_cli.terms.elements.beam import PROPERTIES as BEAM
from mouse_cli.terms.elements.beam import matrices as sound
from mouse_cli.terms.elements.beam import tension

_THEORY = ("kappa", "rotary_factor", "m11", "m12", "m14", "m22", "symmetric", "antisymmetric", "coupling")


def matrices(layout: Layout, properties: Properties) -> Matrices:
    """The sound beam, and what K loses in series with the crack: E'[(F + c)^-1 - F^-1] E on the natural strains E of `_strain`.

    F = diag(l/EI, l/3EI, l/EA); c is the compliance of the crack (see `fracture.compliance`) at midspan, where the bending moment
    does work on the first strain and the shear force, 2/l of its moment, on the second. Without the coupling to axial force,
    K = EI (s/l v_s v_s' + 12 a/l^3 v_a v_a') with s = 1/(1 + x), a = 1/(1 + y), x = 6 (1 - nu^2) alpha F1, y = 2 (1 - nu^2)
    alpha^3 F2, alpha = h/l: k_ww = 12 a and k_thth = s + 3 a of lecture 21-1, whose printed k_ww lacks the 2 of y. Bending in the
    other plane and torsion are those of the sound beam. M is that of the bar kinked and
    parted as it is under static loads, see `beam.kinked`.
    """
    p, at = properties, beam.span(layout)
    plane = "zy".index(layout.options.get("about") or "z")
    EI, length = p["E"] * p["Iz" if plane == 0 else "Iy"], at.length
    c = fracture.compliance(fracture.factors(p["depth"]), p["height"], EI, p["nu"])
    both = c.both if layout.stretches is None else c.both * layout.stretches
    bent, drawn = length / EI, length / (p["E"] * p["A"])
    S = np.zeros((len(layout), 3, 3), np.result_type(bent, c.turning))
    area = (bent + c.turning) * (drawn + c.parting) - both**2
    S[:, 0, 0], S[:, 2, 2] = (drawn + c.parting) / area, (bent + c.turning) / area
    S[:, 0, 2] = S[:, 2, 0] = -both / area
    S[:, 1, 1] = 1 / (bent / 3 + 4 * c.sliding / length**2)
    E = _strain(length, plane) @ at.motion
    lost = S.copy()
    for i, flexibility in enumerate((bent, bent / 3, drawn)):
        lost[:, i, i] -= 1 / flexibility
    found = sound(replace(layout, options={**layout.options, "theory": "euler-bernoulli"}), p | _of_beam(layout))
    found["K"] = found["K"] + E.transpose(0, 2, 1) @ lost @ E
    if layout.options.get("mass") != "lumped":
        line = p["density"] * p["A"] + p["nonstructural_mass"]
        angle = c.turning[:, None] * S[:, 0] + both[:, None] * S[:, 2]
        gap = both[:, None] * S[:, 0] + c.parting[:, None] * S[:, 2]
        dofs, sense = beam.PLANES[plane]
        for jump, to, sign, inertia in ((angle, dofs, sense, beam.kinked), (gap, np.array([0, 6]), 1.0, beam.parted)):
            across, own = inertia(length, 0.5)
            ends = ((sign * across)[:, None] @ at.motion[:, to])[:, 0]
            found["M"] = found["M"] + line[:, None, None] * _jumped(ends, own, (jump[:, None] @ E)[:, 0])
    return found


def _jumped(ends: np.ndarray, own: np.ndarray, jump: np.ndarray) -> np.ndarray:
    """What a jump (e, 12) adds to M (e, 12, 12), by integrals of its shape with the others (e, 12) and squared (e,)."""
    crossed = ends[:, :, None] * jump[:, None]
    return crossed + crossed.transpose(0, 2, 1) + own[:, None, None] * jump[:, :, None] * jump[:, None]


def _strain(length: np.ndarray, plane: int) -> np.ndarray:
    """(e, 3, 12): symmetric and antisymmetric bending and elongation by the local motion of the ends."""
    dofs, sense = beam.PLANES[plane]
    found = np.zeros((len(length), 3, 12))
    found[:, 0, dofs] = sense * [0.0, -1.0, 0.0, 1.0]
    found[:, 1, dofs] = sense * np.stack([2 / length, 0 * length + 1, -2 / length, 0 * length + 1], axis=1)
    found[:, 2, 0], found[:, 2, 6] = -1.0, 1.0
    return found


def _of_beam(layout: Layout) -> Properties:
    """Properties of a beam that a cracked one has not."""
    return {name: np.full(len(layout), BEAM[name].default) for name in ("kappa_y", "kappa_z", "rotary_factor")}


def _height(layout: Layout, p: Properties) -> np.ndarray:
    return np.sqrt(12 * p[f"I{layout.options.get('about') or 'z'}"] / p["A"])


ELEMENT = ElementType(
    "cracked_beam",
    "straight beam of Euler and Bernoulli with an open edge crack at midspan",
    (2,),
    {
        **{name: about for name, about in BEAM.items() if not name.startswith(_THEORY) and "damping" not in name},
        "depth": Property("depth of the crack over the height of the section, below 1", "1", 0.1, True, below=1.0),
        "height": Property(
            "height h of the section; not given: sqrt(12 I/A) about the axis of `about`, that of a rectangle",
            "m",
            _height,
            True,
        ),
    },
    matrices,
    {
        "about": Option("local axis of the bending under which the crack opens", "z", ("y", "z")),
        "mass": Option("mass matrix", "consistent", ("consistent", "lumped")),
        **beam.ORIENTATION,
        **beam.OFFSETS,
    },
    ("loss_factor", "stiffness_damping", "mass_damping"),
    tension,
    reach=True,
    opens=True,
)
