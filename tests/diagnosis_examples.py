"""Diagnoses of every kind, put together by hand around real updates, for whatever reads them."""

from dataclasses import replace
from functools import cache

import numpy as np
from report_examples import chain

from mouse_cli._errors import WARNING, Diagnostic
from mouse_cli.model.diagnosis import (
    EVERYWHERE,
    NAMED,
    NOTHING,
    ONE_OF,
    UNKNOWN,
    Cause,
    Certain,
    Diagnosis,
    EnergyMap,
    Explanation,
    Field,
    FieldValue,
    HeldOut,
    Law,
    Location,
    Place,
    Proposal,
    Rest,
    Score,
    Site,
    Size,
    Untried,
)
from mouse_cli.model.frf_fit import Damping, FrfFit, Modelled
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.hold_out import Altered, HoldOut
from mouse_cli.updating import run

SPRING = Cause(
    "ground-spring",
    "ground-spring",
    "a spring to the ground",
    Site("dof", ("2",), text="degree of freedom 2"),
    (Size("stiffness", "N/m", 393.5, 6.8, 1.0, 1e6),),
)
CRACK = Cause(
    "crack",
    "local-stiffness",
    "an open crack",
    Site("element", (12,), (0.43, 0.0, 0.0), "element 12, 0.43 m from node 1"),
    (Size("depth over height", "1", 0.7, 0.02, 0.05, 0.7), Size("place", "m", 0.43, 0.004, 0.0, 1.0)),
)
SOFT = Cause("stiffness-loss", "local-stiffness", "a softer part", Site("element", (12,), text="element 12"), ())
MASS = Cause(
    "mass", "mass", "a lumped mass", Site("node", (7,), (0.7, 0.0, 0.0)), (Size("mass", "kg", 0.2, 0.01, 0, 9),)
)
SHEAR = Cause("shear", "shear", "shear flexibility", EVERYWHERE, ())


def explanation(*causes: Cause, ln_z: float, probability: float, p: float = 0.4) -> Explanation:
    return Explanation(causes, 12.0, 14, p, ln_z, np.array([1.0]), probability)


def _score(error: float, density: float, covered: float) -> Score:
    hz = np.array([18.0, 55.0, np.nan])
    return Score(error, density, covered, hz, np.array([0.1, 0.2, 0.3]), np.array([0.99, np.nan, 1.0]))


def held_out(error: float = 0.004, covered: float = 0.9) -> HeldOut:
    labels = ("mode 1", "mode 2", "tip mass, mode 1")
    revised = _score(error, 12.0, covered)
    return HeldOut("held out by the deck", labels, np.array([18.1, 54.6, np.nan]), _score(0.1, -340.0, 0.0), revised)


@cache
def _result(scale: str = "none"):
    return run(chain(scale=scale))


def _diagnosis(kind: str, explanations: tuple, groups: tuple, **more) -> Diagnosis:
    result = _result()
    return Diagnosis(result.problem, kind, result, result.innovation, explanations, groups, **more)


def nothing() -> Diagnosis:
    only = explanation(ln_z=-10.0, probability=0.97)
    shear = explanation(SHEAR, ln_z=-15.0, probability=0.03)
    base = replace(held_out(), revised=None)
    return _diagnosis(NOTHING, (only, shear), (("none", 0.97), ("shear", 0.03)), held_out=base)


def named() -> Diagnosis:
    one, two = explanation(SPRING, ln_z=-28.0, probability=0.98), explanation(CRACK, ln_z=-60.0, probability=0.02)
    none = explanation(ln_z=-2700.0, probability=0.0, p=0.0)
    places = (Place(SPRING.site, "w", 0.93, 0.0), Place(CRACK.site, "kappa", 0.07, 2.6))
    law = Law(
        SPRING.site,
        "N/m",
        np.array([2.1, 5.3]),
        np.array([397.0, np.nan]),
        np.array([6.0, np.inf]),
        np.array([393.5] * 2),
    )
    return _diagnosis(
        NAMED,
        (one, two, none),
        (("ground-spring", 0.98), ("local-stiffness", 0.02), ("none", 0.0)),
        noise_scale=1.15,
        location=Location(places, 1, 0.3),
        energy=EnergyMap((SPRING.site, CRACK.site), np.array([0.2, 0.8]), np.array([1]), np.array([0.02])),
        law=law,
        held_out=held_out(),
        extended=_result().problem,
        extended_result=_result("least-squares"),
        remarks=("The mesh was refined once, and nothing moved",),
    )


def two_causes() -> Diagnosis:
    both = explanation(CRACK, SHEAR, ln_z=-30.0, probability=0.99)
    none = explanation(ln_z=-200.0, probability=0.0)
    along = tuple(Place(Site("element", (i,), (0.1 * i, 0.0, 0.0)), "kappa", 0.1, 0.5 * i) for i in range(10))
    poor = held_out(error=0.09, covered=0.0)
    return _diagnosis(
        NAMED,
        (both, none),
        (("local-stiffness + shear", 0.99), ("none", 0.01)),
        location=Location(along, 9, 1e-9),
        energy=EnergyMap(tuple(p.site for p in along), np.array([0.1] * 10), np.array([1, 2]), np.array([0.02, 0.1])),
        held_out=poor,
    )


def one_of() -> Diagnosis:
    first, second = explanation(SPRING, ln_z=-28.0, probability=0.6), explanation(CRACK, ln_z=-29.0, probability=0.3)
    none = explanation(ln_z=-35.0, probability=0.1)
    first = replace(first, elsewhere=(((Site("dof", ("3",), text="degree of freedom 3"),), 0.21),))
    proposals = (
        Proposal("the frequency of mode 5", ("ground-spring", "local-stiffness"), 5.2),
        Proposal("the shapes at node 3 too", ("ground-spring", "local-stiffness"), 0.4),
    )
    groups = (("ground-spring", 0.6), ("local-stiffness", 0.3), ("none", 0.1))
    return _diagnosis(ONE_OF, (first, second, none), groups, proposals=proposals)


def unknown() -> Diagnosis:
    nearest = explanation(CRACK, ln_z=-500.0, probability=0.99, p=1e-12)
    none = explanation(ln_z=-900.0, probability=0.0, p=0.0)
    found = _diagnosis(UNKNOWN, (nearest, none), (("local-stiffness", 0.99), ("none", 0.01)), noise_scale=40.0)
    problem = found.problem
    altered = Altered("tip mass", {3: 0.5}, {}, np.array([1]), np.array([17.0]), np.array([0.1]))
    warnings = (Diagnostic("MD513", WARNING, "sensor 2 does not fit"),)
    return replace(
        found, problem=replace(problem, hold_out=HoldOut(problem.test, [3], [], (altered,)), warnings=warnings)
    )


def members() -> Diagnosis:
    """A group of two members, a rival site of the leading one, and something more that has no name."""
    crack = explanation(CRACK, ln_z=-28.0, probability=0.69)
    crack = replace(crack, elsewhere=(((Site("element", (14,), text="element 14, 0.58 m from node 1"),), 0.49),))
    soft, none = explanation(SOFT, ln_z=-29.0, probability=0.31), explanation(ln_z=-2700.0, probability=0.0, p=0.0)
    groups = (("local-stiffness", 1.0), ("none", 0.0))
    return _diagnosis(NAMED, (crack, soft, none), groups, rest=Rest(0.12, 3e-9))


def likely() -> Diagnosis:
    """One mechanism, or none."""
    one, none = explanation(SPRING, ln_z=-28.0, probability=0.88), explanation(ln_z=-31.0, probability=0.12)
    return _diagnosis(ONE_OF, (one, none), (("ground-spring", 0.88), ("none", 0.12)))


def three() -> Diagnosis:
    """Three mechanisms, given in another order than that of their groups."""
    every = explanation(SHEAR, MASS, CRACK, ln_z=-28.0, probability=0.96)
    none = explanation(ln_z=-2700.0, probability=0.04, p=0.0)
    return _diagnosis(NAMED, (every, none), (("local-stiffness + mass + shear", 0.96), ("none", 0.04)))


def companions() -> Diagnosis:
    """A crack in every explanation; alone, or with shear or a mass beside it."""
    with_shear, alone = (
        explanation(CRACK, SHEAR, ln_z=-28.0, probability=0.5),
        explanation(CRACK, ln_z=-29.0, probability=0.3),
    )
    with_mass, none = explanation(CRACK, MASS, ln_z=-30.0, probability=0.15), explanation(ln_z=-90.0, probability=0.0)
    groups = (
        ("local-stiffness + shear", 0.5),
        ("local-stiffness", 0.3),
        ("local-stiffness + mass", 0.15),
        ("none", 0.0),
    )
    beside = (("shear", 0.5 / 0.95), ("none", 0.3 / 0.95), ("mass", 0.15 / 0.95))
    certain = Certain((CRACK,), 0.95, (("crack", 1.0),), beside)
    return _diagnosis(NAMED, (with_shear, alone, with_mass, none), groups, certain=certain)


def nameless() -> Diagnosis:
    """No candidate explains the data; a smooth field of stiffness does."""
    change = -0.23 * np.exp(-(((np.arange(1, 31) - 14.5) / 3.0) ** 2))
    values = tuple(
        FieldValue(Site("element", (i,), (0.1 * i, 0.0, 0.0)), float(x), 0.04) for i, x in enumerate(change, 1)
    )
    field = Field("stiffness", values, 0.2, 0.4, "m", 19.3, held_out())
    nothing_there = "no site in this model"
    untried = (
        Untried("joint", nothing_there),
        Untried("items", nothing_there),
        Untried("shear", "the data do not respond"),
    )
    return replace(unknown(), field=field, untried=untried)


def bare() -> Diagnosis:
    """No candidate has a meaning for the model, and nothing else was found out."""
    return _diagnosis(UNKNOWN, (), ())


def functions() -> Diagnosis:
    """Two receptances of a mass on a spring in closed form, 4 % noise: without and with 5 % more stiffness, some lines held out."""
    rng = np.random.default_rng(1)
    hz = np.linspace(1.0, 30.0, 400)
    of = lambda k: (1 / (k * (1 + 0.02j) - (2 * np.pi * hz) ** 2))[:, None, None] * np.array([[1.0], [0.5]])
    truth = of(1.05e4)
    sd = 0.04 * np.abs(truth)
    H = truth + sd * (rng.standard_normal(H_SHAPE) + 1j * rng.standard_normal(H_SHAPE))
    test = FrfTest(
        hz, H, "receptance", np.array([0, 1]), np.array([0]), 2 * sd**2, ("1TX", "2TX"), ("1TX",),
        np.full(H_SHAPE[:2], 0.98), "hammer",
    )  # fmt: skip
    models = tuple(
        Modelled(key, name, of(k), np.full(H_SHAPE, 0.01))
        for key, name, k in (("baseline", "model as it is", 1.0e4), ("revised", "with a spring to the ground", 1.05e4))
    )
    fit = FrfFit(test, "complex", np.arange(0, 400, 2), np.ones(H_SHAPE, bool), sd, False, models)
    amounts = (Damping("loss factor", "structural damping, of all stiffness", "1", 0.02, 0.001, True),
               Damping("damping by mass", "viscous damping over mass", "1/s", 0.01, 0.02, False))  # fmt: skip
    return replace(named(), frf=(fit,), held_frf=(replace(fit, lines=np.zeros(0, int)),), damping=amounts)


H_SHAPE = (400, 2, 1)
DIAGNOSES = {
    "nothing": nothing,
    "named": named,
    "two": two_causes,
    "one-of": one_of,
    "unknown": unknown,
    "bare": bare,
    "functions": functions,
    "members": members,
    "likely": likely,
    "three": three,
    "companions": companions,
    "nameless": nameless,
}
