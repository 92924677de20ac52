"""Several mechanisms at once, truths by finite elements written here: all of them named, with their sites, and none too many."""

from itertools import combinations_with_replacement
from types import SimpleNamespace

import numpy as np
import pytest
from hermite_beams import EI, LENGTH, MASS, Truth, deck
from proofs import proofs

from mouse_cli.diagnosis import diagnose
from mouse_cli.diagnosis.gates import MATERIAL, log_prior, prior
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search import moves
from mouse_cli.diagnosis.search import several as search
from mouse_cli.diagnosis.search.added_up import Effects
from mouse_cli.diagnosis.search.descents import best
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.found import Found, keep, key, material
from mouse_cli.diagnosis.search.moves import adequate
from mouse_cli.diagnosis.search.rank import _log_prior
from mouse_cli.diagnosis.search.several import _exchangeable, _fewer, same_kind
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NAMED, Choices, Site

LOCAL = ("mass", "ground-spring", "stiffness-loss")
PLACES = (6, 10, 15, 19, 24, 28)  # of 30 elements, where point masses of 0.1 of the beam stand
ATTACHED = "".join(
    f"      - {{id: {i}, type: mass, nodes: {n + 1}, mass: {0.1 * MASS * LENGTH}}}\n" for i, n in enumerate(PLACES, 101)
)


def problem(truth: Truth, more: str = "", free: bool = False):
    return assemble(yaml_deck.read(deck(truth, free, modes=6, held=1, more=more), "beam.yaml"))


def without(gone: tuple[int, ...]):
    """A cantilever whose deck has six masses, of which those `gone` (from 0) are not there."""
    return problem(Truth(masses=tuple((n / 30, 0.1) for i, n in enumerate(PLACES) if i not in gone)), ATTACHED)


@pytest.mark.parametrize("gone", [(1, 4), *proofs([((0, 2, 5),), ((0, 2, 3, 5),)])])
def test_masses_that_are_gone_are_named_one_by_one(gone):
    """Two, three and four of six: beside one alone even errors of the test look better than what it states."""
    found = diagnose(without(gone), choices=Choices(("mass-loss", "mass", "ground-spring")))
    assert found.kind == NAMED and not found.cautions
    assert found.best.physics == " + ".join(["mass-loss"] * len(gone))
    assert {cause.site.ids for cause in found.best.causes} == {(101 + i,) for i in gone}
    assert all(cause.sizes[0].value > 0.9 for cause in found.best.causes)
    assert found.held_out.revised.rms_frequency_error < 0.3 * found.held_out.baseline.rms_frequency_error
    assert found.extended_result.status.key == "converged" and not found.extended_result.rejected
    assert len(found.extended.parameters) == 2 + len(gone)


def test_no_more_than_may_be_sought():
    found = diagnose(without((0, 2, 5)), choices=Choices(("mass-loss", "ground-spring"), causes=2))
    assert max(len(one.causes) for one in found.explanations) == 2


def near(cause, x: float) -> bool:
    """Whether a cause stands at x / L, to a fiftieth."""
    return abs(cause.site.position[0] / LENGTH - x) < 0.02


@pytest.mark.parametrize("free", proofs([False, True], False))
def test_a_spring_a_mass_and_a_softer_stretch(free):
    softer = lambda x: 0.7 if abs(x - 0.3) < 0.05 else 1.0
    truth = Truth(softer, springs=((0.55, 40.0),), masses=((0.8, 0.05),))
    found = diagnose(problem(truth, free=free), choices=Choices(LOCAL))
    assert (found.kind, found.best.physics) == (NAMED, "ground-spring + stiffness-loss + mass")
    spring, loss, mass = found.best.causes
    assert near(spring, 0.55) and near(mass, 0.8) and near(loss, 0.3)
    assert abs(mass.sizes[0].value - 0.05 * MASS * LENGTH) < 3 * mass.sizes[0].sd


@pytest.mark.parametrize("free", proofs([False, True], True))
def test_a_third_is_not_named_where_there_are_two(free):
    found = diagnose(problem(Truth(springs=((0.55, 40.0),), masses=((0.8, 0.05),)), free=free), choices=Choices(LOCAL))
    assert (found.kind, found.best.physics) == (NAMED, "ground-spring + mass")
    assert not any(len(one.causes) > 2 for one in found.explanations)


def test_several_of_one_kind_and_as_many_as_are_needed():
    """Three of six are gone, four may be: the fourth is not added."""
    beam = without((0, 2, 5))
    study = Study(reduced(beam, beam.prior.mean), {"mass-loss": registry()["mass-loss"]})
    single = best(study, "mass-loss")
    sets = same_kind(study, [single], 4)
    last = max(sets, key=lambda one: one.log_evidence)
    assert key(last) == ("mass-loss",) * 3 and adequate(last)
    assert {recipe.site(recipe.grid[0]).ids[0] for recipe in last.recipes} == {101, 103, 106}
    assert max(len(one.recipes) for one in sets) == 3
    assert max(len(one.recipes) for one in same_kind(study, [single], 2)) == 2


def of(log_evidence: float, *names: str):
    """A fit of mechanisms of those keys."""
    recipes = tuple(SimpleNamespace(candidate=SimpleNamespace(key=name, group=name), parts=()) for name in names)
    own = {"sites": (Site("node", ()),) * len(names), "c": np.zeros(len(names)), "bearable": Fit.bearable}
    return SimpleNamespace(recipes=recipes, log_evidence=log_evidence, **own)


@pytest.mark.parametrize(
    ("other", "at", "kept"),
    [("local-stiffness", (1, 2), False), ("local-stiffness", (1,), True), ("mass", (1, 2), True)],
)
def test_what_a_mechanism_does_is_not_undone_by_another_at_the_same_elements(other, at, kept):
    """Braces twice as stiff, their mass alike, and half as stiff are braces of twice the mass, which has a name."""
    both = of(-10.0, "added-stiffness", other)
    both.sites = (Site("element", (1, 2)), Site("element", at))
    keep(found := Found(), both)
    assert bool(found) == kept


def test_what_is_not_needed_is_material_to_nothing():
    """Each set has to gain on the best of its parts, however many; sets that are none of its parts do not count."""
    one, other, apart = of(-50.0, "mass"), of(-40.0, "crack"), of(-1.0, "taper")
    assert material(of(-40.0 + MATERIAL + 0.1, "crack", "mass"), [one, other, apart])
    assert not material(of(-40.0 + MATERIAL - 0.1, "crack", "mass"), [one, other, apart])
    pair = of(-20.0, "crack", "mass")
    assert not material(of(-20.0 + MATERIAL - 0.1, "crack", "mass", "mass"), [one, other, pair])
    assert material(of(-30.0, "mass", "mass"), [one, other])
    assert not material(of(-49.0, "mass", "mass"), [one, other])  # a second of one kind, on one of it
    assert material(of(-90.0, "shear", "taper"), [one, other])


def test_what_came_first_is_dropped_where_the_rest_does_without_it():
    """A softer stretch, then the true spring and the true mass: the first is needless, and the pair had not been found."""
    beam = problem(Truth(springs=((0.55, 40.0),), masses=((0.8, 0.05),)))
    study = Study(reduced(beam, beam.prior.mean), {name: registry()[name] for name in LOCAL})
    names, values = (
        ("stiffness-loss", "ground-spring", "mass"),
        ((0.1, 0.1, 0.2 * LENGTH), (30 * EI / LENGTH**3, 0.5 * LENGTH), (0.05 * MASS * LENGTH, 0.8 * LENGTH)),
    )
    recipes = tuple(study.recipes(name)[0] for name in names)
    c = np.concatenate([one.coordinates(np.array(own)) for one, own in zip(recipes, values, strict=True)])
    three = fit(study.kind(study.model, recipes), c)
    two = max(_fewer(study, [three], [best(study, name) for name in LOCAL]), key=lambda one: one.log_evidence)
    assert key(two) == ("ground-spring", "mass") and adequate(two)
    assert not material(three, [two])


def test_two_feet_of_own_sizes_are_no_part_of_a_foot_and_a_spring():
    """Both have two sizes: neither has to gain on the other. A pair of two feet, one by one, is the same once more."""
    feet, foot, spring = of(-40.0, "foot"), of(-70.0, "foot"), of(-80.0, "spring")
    feet.recipes[0].parts = ("1RZ", "23RZ")
    assert key(feet) == ("foot", "foot")
    assert material(of(-42.0, "foot", "spring"), [feet, foot, spring])
    assert not material(of(-40.0, "foot", "foot"), [feet, foot, spring])
    assert not material(of(-39.0, "foot", "foot", "spring"), [feet, foot, spring])


def test_beside_two_feet_of_own_sizes_sets_are_sought_where_one_foot_is_refuted(monkeypatch):
    """The two leave noise, the best single foot 200 on 100 (p = 1e-8): something else may act beside it as well."""
    foot = lambda misfit: SimpleNamespace(misfit=misfit, dof=100, elsewhere=(), **vars(of(-misfit, "foot")))
    one, two, asked = foot(200.0), foot(90.0), []
    two.recipes[0].parts, two.elsewhere = ("1RZ", "23RZ"), ((one, 1e-9),)
    monkeypatch.setattr(search, "pairs", lambda study, singles, *_: asked.extend(singles) or [])
    monkeypatch.setattr(search, "same_kind", lambda *given: [])
    search.several(SimpleNamespace(known=()), [two], 2)
    assert asked == [two, one]


def test_a_pair_is_exchanged_that_leads_by_a_mechanism_which_is_none_of_it(monkeypatch):
    """Alone b is the worst of ten, beside c all; the best of the leading ones, a, has c beside it."""
    names = ("a", *"defghijk", "b")
    singles = [SimpleNamespace(misfit=900.0, dof=100, **vars(of(-500.0 - i, name))) for i, name in enumerate(names)]
    for each in singles:
        each.recipes[0].candidate.group = each.recipes[0].candidate.key
    best_of = {("a", "c"): -400.0, ("b", "c"): -50.0}

    def beside(study, first, partners, found):
        for name in ("b", "c"):
            both = tuple(sorted((*key(first), name)))
            if both in best_of:
                found[both] = SimpleNamespace(misfit=900.0, dof=100, model=None, errs_alike=False, **vars(of(best_of[both], *both)))

    alone = lambda one, i: of(-600.0, *(key(one)[:i] + key(one)[i + 1 :]))
    for name, stub in (("beside", beside), ("without", alone), ("swap", lambda *given: None)):
        for module in (search, moves):
            monkeypatch.setattr(module, name, stub)
    monkeypatch.setattr(search, "centred", lambda study, first: None)
    monkeypatch.setattr(search, "finished", lambda study, found: list(found.values()))
    study = SimpleNamespace(known=(*names, "c"), coarse=SimpleNamespace(effects=Effects({}, np.zeros((1, 0)), np.zeros((0, 1)))))
    assert max(search.pairs(study, singles), key=lambda one: one.log_evidence).log_evidence == -50.0


def test_sites_of_sets_that_are_as_good_leave_the_place_open():
    """Of five weights in mirror order on a free beam two are gone, the middle one and one beside it: frequencies alone, and a
    single sensor, cannot tell on which side. The middle one is certain.
    """
    at = (3, 9, 15, 21, 27)
    weights = "".join(
        f"      - {{id: {i}, type: mass, nodes: {n + 1}, mass: {0.1 * MASS * LENGTH}}}\n" for i, n in enumerate(at, 101)
    )
    truth = Truth(masses=tuple((n / 30, 0.1) for n in at if n not in (9, 15)))
    text = deck(truth, True, sensors=1, modes=7, held=1, more=weights)
    found = diagnose(
        assemble(yaml_deck.read(text, "beam.yaml")), choices=Choices(("mass-loss", "mass", "stiffness-loss"))
    )
    assert found.kind == NAMED and dict(found.certain.companions)["mass-loss"] > 0.999
    assert [cause.site.ids for cause in found.certain.causes] == [(103,)]


def single(candidate: str, group: str):
    """A fit of one mechanism of that group."""
    recipe = SimpleNamespace(candidate=SimpleNamespace(key=candidate, group=group))
    return SimpleNamespace(recipes=(recipe,), nameless=None)


def joint(*fits):
    return SimpleNamespace(recipes=tuple(one.recipes[0] for one in fits), nameless=None)


def test_a_set_of_sites_is_counted_once():
    """Three masses at sites of equal prior: 3! orders are one set; a mass and two springs: 2!."""
    mass, spring = single("mass", "mass"), single("ground-spring", "ground-spring")
    same, mixed, apart = joint(mass, mass, mass), joint(mass, spring, spring), joint(mass, spring)
    fits = [mass, spring, same, mixed, apart]
    assert _log_prior(same, fits) == pytest.approx(log_prior(3, 2, True) + np.log(6))
    assert _log_prior(mixed, fits) == pytest.approx(log_prior(3, 2, False) + np.log(2))
    assert _log_prior(apart, fits) == pytest.approx(log_prior(2, 2, False))


def test_members_of_a_group_share_its_prior():
    """A crack and a softer stretch are hard to tell apart: together they are as probable as a mass beforehand."""
    crack, soft, mass = single("crack", "local"), single("stiffness-loss", "local"), single("mass", "mass")
    p = [np.exp(_log_prior(one, [crack, soft, mass])) for one in (crack, soft, mass)]
    assert p[0] == pytest.approx(p[1]) and p[0] + p[1] == pytest.approx(p[2])
    assert sum(p) == pytest.approx(0.6)


def test_priors_of_numbers_of_mechanisms():
    """0.3 for none; what remains falls by seven with each further one, and sums to it."""
    assert prior(0) == 0.3
    assert sum(prior(count) for count in range(1, 40)) == pytest.approx(0.7, abs=1e-12)
    assert prior(2) / prior(3) == pytest.approx(7.0)


@pytest.mark.parametrize("count", [0, 1, 2, 3])
def test_all_sets_of_groups_share_it(count):
    """Multisets of 0, 1, 2 and 3 of five groups: 1, 5, 15, 35; half of those of several are drawn from the five of one group."""
    sets = list(combinations_with_replacement(range(5), count))
    p = [np.exp(log_prior(count, 5, len(set(one)) == 1)) for one in sets]
    assert sum(p) == pytest.approx(prior(count))
    alike = sum(each for each, one in zip(p, sets, strict=True) if len(set(one)) == 1)
    assert count < 2 or alike / prior(count) == pytest.approx(0.5 + 0.5 * 5 / len(sets))


def test_adequate_is_a_p_value_of_a_twentieth():
    """The 95 % point of chi-squared on 20 degrees of freedom is 31.41 (tables)."""
    assert adequate(SimpleNamespace(misfit=31.40, dof=20)) and not adequate(SimpleNamespace(misfit=31.42, dof=20))


@pytest.mark.parametrize(("p", "sought"), [(0.009, True), (0.02, False), (None, False)])
def test_a_pair_that_does_not_predict_what_is_held_out_is_not_enough(monkeypatch, p, sought):
    """It leaves no more than noise of what it was fitted to, and yet something else acts: a third is sought beside it."""
    pair = SimpleNamespace(misfit=20.0, dof=20, **vars(of(-40.0, "mass", "support")))
    single, asked = SimpleNamespace(misfit=90.0, dof=20, elsewhere=(), **vars(of(-90.0, "mass"))), []
    monkeypatch.setattr(search, "held_out_density", lambda one: None if p is None else SimpleNamespace(p=p))
    monkeypatch.setattr(search, "pairs", lambda study, singles, *_: [pair])
    monkeypatch.setattr(search, "same_kind", lambda *given: [])
    monkeypatch.setattr(search, "_as_good", lambda *given: [])
    monkeypatch.setattr(search, "added_up", lambda *given: None)
    monkeypatch.setattr(search, "beside", lambda study, first, partners, found: asked.append(first))
    assert search.several(SimpleNamespace(known=()), [single], 3) == [pair]
    assert asked == [pair] * sought


@pytest.mark.parametrize(("misfit", "most", "goes_on"), [(400.0, 4, True), (700.0, 4, False), (400.0, 3, False), (25.0, 3, True)])
def test_larger_sets_are_sought_while_they_may_explain_the_data(misfit, most, goes_on):
    """One leaves 1000 on 20: two that leave 400 leave 10 if two more gain twice as much each, those that leave 700 leave 168."""
    single, pair = (SimpleNamespace(misfit=own, dof=20, **vars(of(-own, *names)))
                    for own, names in ((1000.0, ("mass",)), (misfit, ("mass", "support"))))  # fmt: skip
    assert search.hopeful([single], [pair, SimpleNamespace(**vars(pair) | {"misfit": 900.0})], most) is goes_on
    assert not search.hopeful([single], [], most)


@pytest.mark.parametrize(("trusted", "misfit", "sought"), [(False, 20.0, 1), (False, 40.0, 0), (True, 40.0, 1)])
def test_a_pair_that_leaves_noise_shows_that_the_test_is_as_accurate_as_stated(monkeypatch, trusted, misfit, sought):
    """What one alone leaves looks like errors of the test, and the pair leaves 20 on 20, or 40 (p = 0.005)."""
    pair = SimpleNamespace(misfit=misfit, dof=20, **vars(of(-40.0, "mass", "support")))
    single, asked = SimpleNamespace(misfit=90.0, dof=20, elsewhere=(), **vars(of(-90.0, "mass"))), []
    monkeypatch.setattr(search, "held_out_density", lambda one: SimpleNamespace(p=1e-5))
    monkeypatch.setattr(search, "pairs", lambda study, singles, *_: [pair])
    monkeypatch.setattr(search, "same_kind", lambda *given: [])
    monkeypatch.setattr(search, "_as_good", lambda *given: [])
    monkeypatch.setattr(search, "added_up", lambda *given: None)
    monkeypatch.setattr(search, "beside", lambda study, first, partners, found: asked.append(first))
    search.several(SimpleNamespace(known=()), [single], 3, trusted)
    assert len(asked) == sought


def test_sets_that_are_as_good_as_the_best_are_known(monkeypatch):
    """Each of its mechanisms is exchanged; what is better than the best is exchanged too, what is far behind is left."""
    pair, single = fitted(-40.0, 20.0, "mass", "support"), of(-90.0, "support")
    beside = {
        "support": {("crack", "support"): -39.0, ("support", "taper"): -46.1},
        "crack": {("crack", "joint"): -44.0},
    }
    exchanging(monkeypatch, beside)
    found = search._as_good(SimpleNamespace(known=()), [pair], [single])
    assert {key(one) for one in found} == {("crack", "support"), ("crack", "joint")}


@pytest.mark.parametrize(("misfit", "better"), [(31.4, False), (31.5, True)])
def test_two_mechanisms_that_stand_for_others_are_both_exchanged(monkeypatch, misfit, better):
    """A softer stretch and an oscillator for a joint and a mass: either alone is the worse, and only the second best leads on."""
    beside = {"oscillator": {("joint", "oscillator"): -42.0}, "joint": {("joint", "mass"): -30.0}}
    exchanging(monkeypatch, beside)
    found = search._as_good(SimpleNamespace(known=()), [fitted(-40.0, misfit, "oscillator", "stretch")], [])
    assert (("joint", "mass") in map(key, found)) is better


def fitted(nats: float, misfit: float, *names: str):
    """A set of those mechanisms that leaves so much on 20 degrees of freedom."""
    return SimpleNamespace(misfit=misfit, dof=20, **vars(of(nats, *names)))


def exchanging(monkeypatch, beside: dict):
    """What makes a set with the mechanism that is left, by its name, and its log evidence; all fit as well."""

    def tried(study, first, partners, found):
        found.update({both: fitted(nats, 20.0, *both) for both, nats in beside.get(key(first)[0], {}).items()})

    monkeypatch.setattr(search, "beside", tried)
    monkeypatch.setattr(search, "without", lambda one, i: of(-90.0, *(key(one)[:i] + key(one)[i + 1 :])))
    monkeypatch.setattr(search, "finished", lambda study, found: list(found.values()))


FEET = ((5, 600.0), (16, 1500.0), (27, 4000.0))  # nodes of a beam of 30 elements, and springs below them in EI / L^3


@pytest.mark.parametrize("flexible", [(0, 2), *proofs([((0, 1, 2),), ((0, 1),), ((1,),)])])
def test_feet_that_give_way_are_named_each_with_a_stiffness_of_its_own(flexible):
    """As many as do: one beside them that is stiff, here of 1e9 EI / L^3, is none of them."""
    truth = Truth(springs=tuple(((n - 1) / 30, k if i in flexible else 1e9) for i, (n, k) in enumerate(FEET)))
    held = "    supports: {5: [TY], 16: [TY], 27: [TY]}\n"
    found = diagnose(problem(truth, held, free=True), choices=Choices(("support-translation", "mass")))
    (cause,) = found.best.causes
    assert found.kind == NAMED and cause.site.ids == tuple(FEET[i][0] for i in flexible)
    assert len(found.extended.parameters) == 2 + len(flexible) and not found.extended_result.rejected
    for size, i in zip(cause.sizes, flexible, strict=True):
        true = FEET[i][1] * EI / LENGTH**3
        assert abs(size.value - true) < max(4 * size.sd, 0.02 * true)


@pytest.mark.parametrize(
    ("misfit", "gain", "held", "sought"),
    [
        *((130.0, -1.0, None, 0), (130.0, 2.9, None, 0), (130.0, 3.1, None, 1), (200.0, -1.0, None, 1)),
        *((130.0, -1.0, 2e-3, 0), (130.0, -1.0, 9e-4, 1)),
    ],
)
def test_beside_one_that_is_not_refuted_no_sets_are_sought_that_promise_nothing(
    monkeypatch, misfit, gain, held, sought
):
    """130 on 100 has p = 0.024, 200 has 1e-8: the second is sought beside anything at all, as is what is held out at p = 9e-4."""
    monkeypatch.setattr(search, "held_out_density", lambda one: None if held is None else SimpleNamespace(p=held))
    cause = lambda name: SimpleNamespace(candidate=SimpleNamespace(key=name), parts=())
    single = SimpleNamespace(misfit=misfit, dof=100, log_evidence=-80.0, recipes=[cause("a")], elsewhere=())
    asked = []
    beside = lambda study, first, partners, found: found.update(
        {("a", "b"): SimpleNamespace(log_evidence=first.log_evidence + gain, recipes=[cause("a"), cause("b")])}
    )
    monkeypatch.setattr(search, "beside", beside)
    monkeypatch.setattr(search, "pairs", lambda study, singles, *_: asked.append(1) or [])
    monkeypatch.setattr(search, "same_kind", lambda *given: [])
    monkeypatch.setattr(search, "finished", lambda study, found: list(found.values()))
    assert search.several(SimpleNamespace(known=()), [single], 2) == []
    assert len(asked) == sought


@pytest.mark.parametrize(("alone", "two", "may"), [(1000.0, 300.0, True), (10_000.0, 7_000.0, False)])
def test_no_exchange_is_tried_where_one_more_mechanism_would_not_do(alone, two, may):
    """Of 80 degrees of freedom: 300 (300 / 1000)^2 is noise, 7000 (7000 / 10000)^2 is none."""
    of = lambda count, misfit: SimpleNamespace(recipes=(None,) * count, misfit=misfit, dof=80, bearable=1.5)
    assert _exchangeable([of(2, two)], [of(1, alone)]) is may
