"""The gates between evidence and an answer: rankings made up here, each on one side of a gate, and small chains."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hermite_beams import Truth, deck
from made_up_rankings import made_up, ranked

from mouse_cli.diagnosis import explained
from mouse_cli.diagnosis import verdict as decided
from mouse_cli.diagnosis.cautions import _centres
from mouse_cli.diagnosis.effects.change import PLACE
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.diagnosis.validate import placed as asked
from mouse_cli.diagnosis.validate.informed import informed
from mouse_cli.diagnosis.verdict import decide, far_parameters, judge, rest
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.arrangements import Turn
from mouse_cli.model.diagnosis import (
    BY_DECK,
    BY_MODE,
    EVERYWHERE,
    NAMED,
    NOTHING,
    ONE_OF,
    UNKNOWN,
    Cause,
    Diagnosis,
    Explanation,
    HeldOut,
    Score,
    Site,
    elsewhere,
)
from mouse_cli.model.mesh import Mesh
from mouse_cli.report.verdict_sentences import sentences

# nodes 1 to 9 of a wall at y = 0: x = 0, 4, 8 at z = 0, then 3 and 6; 10 to 18 the same at y = 5
WALLS = np.array([[x, y, z] for y in (0.0, 5.0) for z in (0.0, 3.0, 6.0) for x in (0.0, 4.0, 8.0)])


@pytest.fixture
def proofs(monkeypatch):
    """Nats that a group gains on data the deck holds out, by its name; without any, nothing is held out."""
    gains: dict[str, float] = {}
    score = lambda density: Score(0.01, density, 1.0, np.ones(1), np.ones(1), np.ones(1), p=gains.get("p of none", 0.5))

    def proof(model, baseline, best):
        if not gains:
            return None
        more = None if best is None else score(gains.get(decided.group(best), 0.0))
        return HeldOut(BY_DECK, ("mode 7",), np.ones(1), score(0.0), more)

    monkeypatch.setattr(decided, "held_out", proof)
    monkeypatch.setattr(decided, "averaged", lambda model, ranking: None)
    told = lambda one: SimpleNamespace(over_noise=gains.get(decided.group(one), 0.0)) if gains else None
    monkeypatch.setattr(asked, "held_out_density", told)
    monkeypatch.setattr(decided, "unmeasured_hz", lambda one: ())
    monkeypatch.setattr(decided, "significant", lambda one: one.shown)
    return gains


SPRING, BARE = made_up("ground-spring"), made_up(misfit=25.0)


def judged(*fits, rejected: bool = False, **given):
    return judge(informed(ranked(*fits, **given)), rejected, None)


def test_one_of_several_predicts_as_all_of_them(proofs, monkeypatch):
    """What is held out is predicted by every hypothesis, not by the leading one alone; a name by itself."""
    proofs.update({"ground-spring": 5.0, "mass": 5.0})
    together = HeldOut(BY_DECK, ("mode 7",), np.ones(1), Score(0.0, 0.0, 1.0, np.ones(1), np.ones(1), np.ones(1)), None)
    monkeypatch.setattr(decided, "averaged", lambda model, ranking: together)
    several, one = judged(SPRING, made_up("mass"), BARE, p=(0.6, 0.399, 0.001)), judged(SPRING, BARE, p=(0.999, 0.001))
    assert several.kind == ONE_OF and several.proof is together
    assert one.kind == NAMED and one.proof is not together


@pytest.mark.parametrize(("shown", "misfit", "kind"), [(True, 25.0, UNKNOWN), (False, 25.0, NOTHING), (False, 90.0, UNKNOWN)])
def test_what_has_no_name_and_no_value_is_nothing_where_the_model_explains_the_data(proofs, shown, misfit, kind):
    """Members that scatter by 1 % make a law at a tie probable, none of whose values is 2 sd: a control was an alarm."""
    law, bare = made_up(nameless="law", shown=shown), made_up(misfit=misfit)
    assert judged(law, SPRING, bare, p=(0.95, 0.046, 0.004)).kind == kind


@pytest.mark.parametrize("left", [0.0, 1e-320, 1e-30])
def test_what_is_held_out_may_refute_all_that_the_fitted_data_leave(proofs, left):
    """A density lower by thousands: probabilities are shares of what is left, however little that was."""
    proofs.update({"ground-spring": -5000.0, "force": 0.0})
    field = made_up(nameless="force")
    found = informed(ranked(SPRING, field, BARE, p=(1.0, left, 1e-35), odds=(80.0, 5.0, 0.0)))
    assert found.fits[0] is field and found.probabilities == pytest.approx([1, 1e-35, 0], abs=1e-40)
    assert judged(SPRING, field, BARE, p=(1.0, left, 1e-35), odds=(80.0, 5.0, 0.0)).kind == UNKNOWN


# --- whether something is missing


def test_a_model_of_one_in_a_hundred_lacks_something(proofs):
    """Adequate by its misfit, and yet improbable beside a mechanism."""
    found = judged(SPRING, BARE, p=(0.99, 0.01))
    assert (found.kind, found.best) == (NAMED, SPRING)


def test_a_model_of_one_in_twenty_may_lack_nothing(proofs):
    """One of several, the model as it is among them; and that is no pass."""
    ranking = ranked(SPRING, BARE, p=(0.95, 0.05))
    found = judge(ranking, False, None)
    assert found.kind == ONE_OF and found.best is SPRING
    spring = Cause("ground-spring", "ground-spring", "a spring", Site("dof", (2,)), ())
    told = tuple(Explanation(causes, 20.0, 20, 0.5, 0.0, np.zeros(2)) for causes in ((spring,), ()))
    answer = Diagnosis(None, found.kind, None, None, told, ranking.groups)
    assert [name for name, _ in answer.rivals] == ["ground-spring", "none"]
    assert answer.exit_code == 1


@pytest.mark.parametrize(
    ("where", "share", "kind"), [("0.9", 0.06, ONE_OF), ("0.9", 0.04, NAMED), ("0.12", 0.4, NAMED)]
)
def test_a_name_takes_a_site_as_sure_as_itself(proofs, where, share, kind):
    """Sites within 5 % of the span are one."""
    other = made_up(f"ground-spring@{where}")
    found = judged(made_up("ground-spring@0.1", elsewhere=((other, share),)), BARE, p=(0.99, 0.01))
    assert (found.kind, found.placed) == (kind, kind == NAMED)


@pytest.mark.parametrize(("others", "kind"), [("/left/right", NAMED), ("/right", ONE_OF), ("/right/third", ONE_OF)])
def test_a_part_is_sure_where_others_may_act_with_it(proofs, others, kind):
    """A foot that turns does so too in the explanation that has another foot besides, and not where another turns instead."""
    other = made_up(f"support@0.9{others}")
    found = judged(made_up("support@0.1/left", elsewhere=((other, 0.4),)), BARE, p=(0.99, 0.01))
    assert (found.kind, found.placed) == (kind, kind == NAMED)


@pytest.mark.parametrize(
    ("sd", "certain"), [((0.0255, 0.0255), None), ((0.001, 0.0256), (0,)), ((0.0256, 0.0256), None)]
)
def test_of_a_set_those_are_named_whose_places_are_sure(proofs, sd, certain):
    """0.95 of a Gaussian is within 1.96 sd, and 0.05 m is one place; where no place is, all are named with their sd."""
    pair = made_up("mass@0.2", "ground-spring@0.7", covariance=np.diag([1.0, 1.0, *np.square(sd)]))
    for recipe in pair.recipes:
        recipe.unknowns = (SimpleNamespace(name=PLACE),)
    found = judged(pair, BARE, p=(0.999, 0.001))
    assert (found.kind, found.certain and found.certain.which) == (NAMED, certain)


def test_one_of_several_sites_is_told_as_such():
    spring = lambda x: Cause("ground-spring", "ground-spring", "a spring", Site("dof", (x,)), ())
    told = Explanation((spring(2),), 20.0, 20, 0.5, 0.0, np.zeros(2), 0.999, (((spring(7).site,), 0.3),))
    bare = Explanation((), 90.0, 20, 0.0, 0.0, np.zeros(2), 0.001)
    answer = Diagnosis(
        None, ONE_OF, None, None, (told, bare), (("ground-spring", 0.999), ("none", 0.001)), placed=False
    )
    assert [name for name, _ in answer.rivals] == ["ground-spring"]
    first, _ = sentences(answer)
    assert "does not settle where: dof 2; or at dof 7 (probability of this site 0.30)" in first


@pytest.mark.parametrize(("shares", "listed"), [((0.04, 0.03), [7]), ((0.04,), []), ((0.06, 0.04), [7]), ((0.3, 0.2), [7, 8])])
def test_a_site_that_is_not_settled_is_listed_with_a_rival(shares, listed):
    """The most probable of them where each has less than 0.05, and all together more."""
    spring = lambda x: Cause("ground-spring", "ground-spring", "a spring", Site("dof", (x,)), ())
    others = tuple(((spring(7 + i).site,), share) for i, share in enumerate(shares))
    told = Explanation((spring(2),), 20.0, 20, 0.5, 0.0, np.zeros(2), 0.999, others)
    assert [site.ids[0] for (site,), _ in elsewhere((told,), told)] == listed


@pytest.mark.parametrize(("at", "said"), [(0.04, True), (0.06, False)])
def test_several_mechanisms_at_one_place_are_said_to_be_there(at, said):
    foot = Cause("support-rotation", "support", "a flexible support", Site("node", (1,)), ())
    crack = Cause("crack", "local-stiffness", "an open crack", Site("element", (1,), (at, 0.0, 0.0)), ())
    each = [Explanation((cause,), 20.0, 20, 0.5, 0.0, np.zeros(2), p) for cause, p in ((foot, 0.7), (crack, 0.3))]
    mesh = SimpleNamespace(node_ids=np.array([1, 2]), coordinates=np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]))
    groups = (("support", 0.7), ("local-stiffness", 0.3))
    answer = Diagnosis(SimpleNamespace(mesh=mesh), ONE_OF, None, None, tuple(each), groups)
    told = "All of these act at or beside node 1: an inspection there finds which it is." in sentences(answer)
    assert told == said


@pytest.mark.parametrize(("none", "kind"), [(0.019, NAMED), (0.021, ONE_OF), (0.099, ONE_OF), (0.11, NOTHING)])
def test_demanded_and_likely(proofs, none, kind):
    assert judged(SPRING, BARE, p=(1 - none, none)).kind == kind


def test_probability_of_none_counts_over_all_mechanisms(proofs):
    """Two that cannot be told apart: something is missing, and it is one of them."""
    other = made_up("mass")
    assert judged(SPRING, other, BARE, p=(0.5, 0.49, 0.01)).kind == ONE_OF


def test_held_out_data_confirm_what_is_likely(proofs):
    likely = {"p": (0.95, 0.05), "odds": (4.0, 0.0)}
    proofs["ground-spring"] = 4.0
    assert judged(SPRING, BARE, **likely).kind == NAMED
    proofs["ground-spring"] = 2.0
    assert judged(SPRING, BARE, **likely).kind == ONE_OF


def test_held_out_data_refute_what_is_likely(proofs):
    """They speak against the mechanism, and nothing else says that anything is missing."""
    proofs["ground-spring"] = -4.0
    assert judged(SPRING, BARE, p=(0.95, 0.05)).kind == NOTHING


@pytest.mark.parametrize(
    ("of_field", "kind"), [(9.1, NAMED), (9.3, ONE_OF), (12.1, ONE_OF), (14.3, ONE_OF), (14.5, UNKNOWN)]
)
def test_held_out_data_turn_the_odds_of_a_field(proofs, of_field, kind):
    """24 to 1 against it, exp(3.18): 3.18 + ln 9 nats more of what no fit has seen leave the name a tenth of both, and
    3.18 - ln 19 leave it 0.95: each nat counts, the first as the last.
    """
    proofs.update({"ground-spring": 9.0, "force": of_field})
    field = made_up(nameless="force")
    found = judged(SPRING, field, BARE, p=(0.9576, 0.0399, 0.0025), odds=(8.0, 5.0, 0.0))
    assert found.kind == kind
    if kind == UNKNOWN:
        assert found.field is field


@pytest.mark.parametrize(
    ("gain", "p", "kind"), [(4.0, 9e-4, ONE_OF), (3.5, 9e-4, NOTHING), (4.0, 1.1e-3, NOTHING), (9.0, 0.2, NOTHING)]
)
def test_what_predicts_is_likely(proofs, gain, p, kind):
    """No mechanism is improbable, and yet it predicts what refutes the model as it is: ln 2 beyond the odds, as two were tried."""
    proofs.update({"ground-spring": gain, "p of none": p})
    assert judged(SPRING, BARE, p=(0.6, 0.4)).kind == kind
    assert judged(BARE, SPRING, p=(0.6, 0.4)).kind == NOTHING  # nor where the data it was fitted to are against it


def test_modes_from_one_another_are_no_new_data(proofs, monkeypatch):
    """The evidence has all of them already, and the place was chosen with them."""
    proofs.update({"ground-spring": 9.0, "p of none": 1e-9})
    by_deck = decided.held_out
    monkeypatch.setattr(decided, "held_out", lambda *given: replace(by_deck(*given), kind=BY_MODE))
    assert judged(SPRING, BARE, p=(0.6, 0.4)).kind == NOTHING


def test_held_out_data_settle_what_the_fitted_data_leave_open(proofs):
    """0.69 and 0.22, exp(5) the other way: a softer member beside a flexible support of the same column."""
    proofs.update({"local-stiffness": 1.0, "support": 6.0})
    member, support = made_up("local-stiffness"), made_up("support")
    found = judged(member, support, BARE, p=(0.74, 0.25, 0.01))
    assert (found.kind, found.best) == (NAMED, support)
    proofs["local-stiffness"] = 4.2  # 0.69 and exp(1.8) leave it a third
    assert judged(member, support, BARE, p=(0.74, 0.25, 0.01)).kind == ONE_OF


def test_held_out_data_strike_a_name(proofs):
    """The rival that they do not refute takes its place, among others; alone, it leaves none."""
    proofs.update({"ground-spring": -4.0, "mass": 0.0, "field-bed": -4.0})
    fits = (SPRING, made_up(nameless="field-bed"), made_up("mass"), BARE)
    found = judged(*fits, p=(0.70, 0.08, 0.21, 0.01), rejected=True)
    assert (found.kind, found.best) == (ONE_OF, fits[2])
    found = judged(SPRING, BARE, p=(0.99, 0.01), rejected=True)
    assert (found.kind, found.refuted) == (UNKNOWN, ("ground-spring",))


@pytest.mark.parametrize(("misfit", "kind"), [(40.0, NOTHING), (70.0, UNKNOWN)])
def test_what_an_update_leaves(proofs, misfit, kind):
    """On 20 degrees of freedom: p = 0.005 and 2e-7. Without a mechanism that leads there is no name."""
    bare = made_up(misfit=misfit)
    assert judged(bare, made_up("mass", misfit=misfit - 1), p=(0.8, 0.2)).kind == kind


def test_what_the_update_itself_rejects_lacks_something(proofs):
    assert judged(BARE, SPRING, p=(0.5, 0.5), rejected=True).kind == UNKNOWN
    assert judged(made_up(strained=True), SPRING, p=(0.5, 0.5)).kind == UNKNOWN


def test_a_test_that_is_not_believed_is_no_reason(proofs):
    """Errors of the test explain the data better than what the deck states: no mechanism follows from that."""
    assert judged(SPRING, BARE, p=(0.99, 0.01), stated=0.4).kind == NOTHING


# --- whether it has a name


def kind_of(first, *others, p=(0.97, 0.01), **given) -> str:
    return decide(ranked(first, *others, BARE, p=p, **given))[0]


def test_a_plain_case_has_one(proofs):
    assert kind_of(SPRING) == NAMED


@pytest.mark.parametrize(("sure", "kind"), [(0.951, NAMED), (0.949, ONE_OF)])
def test_a_name_is_sure(proofs, sure, kind):
    assert kind_of(SPRING, made_up("mass"), p=(sure, 0.999 - sure, 0.001)) == kind


@pytest.mark.parametrize(("odds", "kind"), [(3.1, NAMED), (2.9, ONE_OF)])
def test_a_name_has_its_odds(proofs, odds, kind):
    assert kind_of(SPRING, odds=(odds, 0.0)) == kind


def test_one_mechanism_may_leave_more_than_several(proofs):
    """p = 0.005 of 40 on 20: enough for one, not for two. 28 on 20 is 1.4 times its expectation: next to noise."""
    one, two = made_up("mass", misfit=40.0), made_up("mass", "ground-spring", misfit=40.0)
    assert (kind_of(one), kind_of(two)) == (NAMED, UNKNOWN)
    assert kind_of(made_up("mass", "ground-spring", misfit=30.0)) == NAMED
    many = {"misfit": 2800.0, "dof": 2000}
    assert (kind_of(made_up("mass", **many)), kind_of(made_up("mass", misfit=3100.0, dof=2000))) == (NAMED, UNKNOWN)


def test_a_parameter_far_from_its_prior_takes_the_name(proofs):
    """By more than five of its prior sd, whatever its unit; the caution says which."""
    assert kind_of(made_up("mass", z=(0.0, -4.9))) == NAMED
    far = made_up("mass", z=(0.0, -5.1))
    kind, reasons = decide(ranked(far, BARE, p=(0.99, 0.01)))
    assert kind == UNKNOWN and "'density'" in reasons[0] and "'E'" not in reasons[0]
    found = judged(far, BARE, p=(0.99, 0.01))
    assert (found.kind, found.reasons) == (UNKNOWN, reasons)


def test_a_fixed_parameter_is_not_far():
    one = made_up("mass", z=(7.0, 0.0))
    one.model.base.L[0, 0] = 0.0
    assert far_parameters(one) == ""


def test_a_strained_fit_has_none(proofs):
    assert kind_of(made_up("mass", strained=True)) == UNKNOWN


def test_a_test_that_is_not_believed_gives_none(proofs):
    """Unless no mechanism at all is impossible whatever errors the test has."""
    assert kind_of(SPRING, stated=0.4) == UNKNOWN
    assert kind_of(SPRING, p=(1 - 1e-7, 1e-7), stated=0.4) == NAMED


def test_a_mode_of_its_own_is_seen_first(proofs, monkeypatch):
    monkeypatch.setattr(decided, "unmeasured_hz", lambda one: (12.3412,))
    kind, reasons = decide(ranked(SPRING, BARE, p=(0.99, 0.01)))
    assert kind == ONE_OF and "12.34 Hz" in reasons[0]
    assert kind_of(made_up("mass", telling=True)) == NAMED  # functions cover the band


def test_a_list_of_frequencies_proves_no_mode_more(proofs):
    assert kind_of(made_up("oscillator", own=1, by_shape=False)) == ONE_OF
    assert kind_of(made_up("oscillator", own=1)) == NAMED


def test_what_leads_without_a_name_is_unknown_with_a_field(proofs):
    field = made_up(nameless="field-bed")
    found = judged(field, SPRING, BARE, p=(0.9, 0.095, 0.005))
    assert (found.kind, found.field, found.best) == (UNKNOWN, field, SPRING)


@pytest.mark.parametrize(("named", "kind"), [(0.11, ONE_OF), (0.09, UNKNOWN)])
def test_a_name_stays_beside_what_has_none(proofs, named, kind):
    """As a rival of more than a tenth; unless it leaves too much."""
    field = made_up(nameless="field-bed")
    p = (0.995 - named, named, 0.005)
    assert judged(field, SPRING, BARE, p=p).kind == kind
    assert judged(field, made_up("mass", misfit=60.0), BARE, p=p).kind == UNKNOWN


def test_a_field_that_gains_little_is_not_told(proofs):
    field, bare = made_up(nameless="field-bed"), made_up(misfit=90.0)
    told = lambda odds: judged(bare, field, p=(0.6, 0.4), odds=(0.0, odds)).field
    assert told(2.9) is None and told(3.1) is field


def test_the_rest_is_a_share_of_the_misfit_of_the_model_as_it_is():
    """80 on 20 of 200 on 20; nothing where p is no less than 0.001."""
    found = rest(ranked(made_up("mass", misfit=80.0), made_up(misfit=200.0), p=(0.99, 0.01)))
    assert found.share == pytest.approx(60 / 180) and found.p < 1e-6
    assert rest(ranked(made_up("mass", misfit=44.0), made_up(misfit=200.0), p=(0.99, 0.01))) is None


# --- what is another mechanism at an end of its range


def test_a_field_counts_as_what_it_is_where_it_does_not_vary(proofs):
    """A bed that may vary is no rival of a bed, as long as that it varies is the less probable."""
    bed, uneven = made_up("foundation"), made_up(nameless="field-bed", even="foundation")
    found = ranked(bed, uneven, BARE, p=(0.9, 0.09, 0.01))
    assert found.groups[0] == ("foundation", pytest.approx(0.99))
    assert decide(found)[0] == NAMED
    assert decide(ranked(bed, made_up(nameless="field-bed"), BARE, p=(0.9, 0.09, 0.01)))[0] == ONE_OF
    more = ranked(uneven, bed, BARE, p=(0.9, 0.09, 0.01))
    assert dict(more.groups)["field-bed"] == pytest.approx(0.9)


@pytest.mark.parametrize(("own", "of_spring"), [("support", 0.0), ("brace", 0.06)])
def test_only_what_a_mechanism_contains_counts_as_it(own, of_spring):
    """Of a rival that is a mechanism at some of its values and none at others, each part for itself."""
    mesh = Mesh(np.arange(1, 19), WALLS, (), np.zeros((0, 2), int))
    known, free = made_up(own), made_up(nameless="spring" if own == "brace" else "compliance", even=own)
    known.model.base.problem.mesh, known.sites = mesh, [Site("node", (1, 5))]
    between = lambda *ids: SimpleNamespace(sites=tuple(Site("node", (i,)) for i in ids))
    free.nameless.cells, other = between(2, 6), made_up(nameless=free.nameless.rival.key, even=own)
    other.nameless.cells = between(1, 14)  # ends in two walls
    third = made_up(nameless=free.nameless.rival.key)
    third.nameless.cells = between(3)  # no such motion: against a turn, or none of a rigid body
    free.variants = ((other, 0.6), (third, 0.1))
    if own == "support":
        known.recipes[0].unknowns = ("stiffness", "inertia")
    groups = dict(ranked(known, free, BARE, p=(0.85, 0.1, 0.05)).groups)
    assert groups[own] == pytest.approx(0.94 - of_spring) and groups[free.nameless.rival.key] == pytest.approx(
        0.01 + of_spring
    )


@pytest.mark.parametrize(("along", "counted"), [((1, 2, 3), 0.98), ((1, 2, 3, 4), 0.89)])
def test_a_gradient_of_a_section_is_a_taper_of_its_own_member(along, counted):
    """And none of a taper that ends before it does; a section that varies otherwise is a rival."""
    known, free, wavy = (
        made_up("taper"),
        made_up(nameless="field-section", even="taper", gradient="taper"),
        made_up(nameless="field-section", gradient="taper"),
    )
    known.recipes[0].unknowns, known.sites = ("slope of EI", "slope of the mass"), [Site("element", (1, 2, 3))]
    free.nameless.cells = SimpleNamespace(sites=tuple(Site("element", (i,)) for i in along))
    free.variants = ((wavy, 0.1),)
    groups = dict(ranked(known, free, BARE, p=(0.89, 0.1, 0.01)).groups)
    assert groups["taper"] == pytest.approx(counted)


@pytest.mark.parametrize(
    ("at", "p", "counted", "kind"),
    [
        (0.53, (0.89, 0.09), 0.98, NAMED),
        (0.53, (0.3, 0.68), 0.98, NAMED),  # the law is more probable, by less than ODDS
        (0.53, (0.04, 0.94), 0.04, UNKNOWN),  # it varies from mode to mode
        (0.60, (0.89, 0.09), 0.89, ONE_OF),  # another place
    ],
)
def test_a_law_at_the_site_of_a_spring_is_that_spring_unless_it_is_shown_to_vary(proofs, at, p, counted, kind):
    spring, law = made_up("ground-spring@0.5"), made_up(nameless="law", even="ground-spring")
    spring.recipes[0].unknowns, spring.sites = ("place", "stiffness"), [Site("element", (5,), (0.5, 0.0, 0.0))]
    spring.model.base.problem.mesh = None
    law.nameless.cells = SimpleNamespace(sites=(Site("element", (6,), (at, 0.0, 0.0)),))
    one, other = zip(*sorted([(p[0], spring), (p[1], law)], key=lambda each: -each[0]), strict=True)
    found = ranked(*other, BARE, p=(*one, 0.02), odds=(9.0, 9.0, 0.0))
    assert dict(found.groups)["ground-spring"] == pytest.approx(counted)
    assert decide(found)[0] == kind


def test_an_oscillator_above_the_band_is_a_mass():
    """An item on a mount so stiff that it follows the structure, or so soft that it stands still."""
    problem = assemble(yaml_deck.read(deck(Truth(), modes=6, held=1), "beam.yaml"))
    hz = problem.test.frequency_hz
    recipe = Study(reduced(problem, problem.prior.mean)).recipes("oscillator")[0]
    within = lambda f: recipe.group(recipe.coordinates(np.array([0.01, f, 0.5])))
    assert [within(f) for f in (1.1 * hz.max(), hz.mean(), 0.9 * hz.min())] == ["mass", "oscillator", "ground-spring"]


@pytest.mark.parametrize(("odds", "own"), [(2.9, "ground-spring"), (3.1, "oscillator")])
def test_what_stands_in_for_another_does_not_lead(proofs, monkeypatch, odds, own):
    """An oscillator below the band is a spring to the ground, which has no mode there that would have to be measured.

    What leads the ranking, and is put into a deck, is what the answer describes, whatever is more probable in its group.
    """
    soft = made_up("oscillator")
    soft.recipes[0].group = lambda c: "ground-spring"
    soft.groups[:] = ["ground-spring"]
    p = np.array([1.0, np.exp(-odds), 1e-4])
    ranking = ranked(soft, SPRING, BARE, p=p / p.sum())
    assert decided.leader(ranking).recipes[0].candidate.key == own
    cause = lambda recipe: Cause(recipe.candidate.key, "ground-spring", recipe.candidate.title, EVERYWHERE, ())
    of = lambda one: tuple(cause(recipe) for recipe in one.recipes)
    told = lambda one, p, stands: Explanation(of(one), 20.0, 20, 0.5, 0.0, np.zeros(2), p, (), stands)
    monkeypatch.setattr(explained, "explanation", told)
    every = explained.explanations(ranking)
    assert [one.physics for one in every] == ["oscillator", "ground-spring", "none"]
    answer = Diagnosis(None, NAMED, None, None, every, ranking.groups)
    assert answer.best.physics == own and answer.members[0][0] == "oscillator"
    assert Turn(NAMED, every, ranking.groups, 1.0, every[-1]).best is answer.best


def test_of_fields_that_which_predicts_is_given(proofs):
    """The data that the deck holds out count with those that were fitted."""
    law, bed = made_up(nameless="law"), made_up(nameless="field-bed")
    ranking = ranked(law, bed, BARE, p=(0.9, 0.09, 0.01), odds=(60.0, 50.0, 0.0))
    proofs |= {"law": 0.0, "field-bed": 5.0}
    assert judge(ranking, True, None).field is law
    proofs |= {"field-bed": 15.0}
    found = judge(ranking, True, None)
    assert (found.kind, found.field) == (UNKNOWN, bed) and found.field_proof.revised.log_predictive_density == 15.0


def _among_sites(first: Site, others: list[tuple[Site, float]], key: str, mesh=None):
    """A fit of one mechanism at `first`, with others of it elsewhere."""

    def at(site):
        recipe = SimpleNamespace(**vars(made_up(key).recipes[0]) | {"site": lambda values: site, "unknowns": ()})
        one = made_up(key)
        one.recipes, one.sites = (recipe,), (site,)
        one.model.base.problem.mesh = mesh
        return one

    one = at(first)
    one.elsewhere = tuple((at(site), share) for site, share in others)
    return one


@pytest.mark.parametrize(("others", "kind"), [((4, 5), NAMED), ((5, 6), ONE_OF)])
def test_a_member_is_sure_where_the_row_that_it_is_of_may_be_softer(proofs, others, kind):
    row = Site("element", others, (0.5, 0.0, 0.0), "the row")
    one = _among_sites(Site("element", (4,), (0.25, 0.0, 0.0), "element 4"), [(row, 0.2)], "member")
    assert judged(one, BARE, p=(0.99, 0.01)).kind == kind


# a wall of two bays by two storeys in x and z, and a second one behind it
_GRID = np.array([[x, y, z] for z in (0.0, 3.0, 6.0) for y in (0.0, 5.0) for x in (0.0, 4.0, 8.0)])
_MESH = SimpleNamespace(coordinates=_GRID, node_ids=np.arange(1, 19), elements=())


@pytest.mark.parametrize(
    ("first", "others", "kind"),
    [
        ((1, 8), [((2, 7), 0.4)], NAMED),  # the other diagonal of a panel
        ((1, 8), [((2, 7), 0.3), ((2, 9), 0.3)], NAMED),  # the next bay
        ((1, 8), [((7, 14), 0.4)], NAMED),  # the next storey
        ((1, 8, 2, 7), [((1, 8), 0.3), ((2, 7), 0.2)], NAMED),  # both diagonals, or one of them
        ((1, 8, 2, 7), [((1, 10), 0.4)], ONE_OF),  # both, or one of another wall
        ((1, 8), [((4, 11), 0.4)], ONE_OF),  # the wall behind
        ((1, 8), [((2, 9), 0.3), ((7, 14), 0.3)], ONE_OF),  # neither bay nor storey
        ((1, 8), [((1, 10), 0.4)], ONE_OF),  # another wall, across
        ((1, 8), [((2, 7), 0.3), ((1, 10), 0.04)], NAMED),  # of a share that no name asks for
    ],
)
def test_panels_of_a_brace_are_its_place(proofs, first, others, kind):
    pair = lambda ids: Site("node", ids, None, f"between nodes {ids[0]} and {ids[1]}")
    one = _among_sites(pair(first), [(pair(ids), share) for ids, share in others], "brace", _MESH)
    found = judged(one, BARE, p=(0.99, 0.01))
    assert (found.kind, found.placed) == (kind, False)


@pytest.mark.parametrize(("kind", "group", "type", "count"), [
    ("named", "offset", "storey", 1), ("one-of", "offset", "storey", 1), ("unknown", "offset", "storey", 0),
    ("named", "mass", "storey", 0), ("named", "offset", "beam", 0),
])  # fmt: skip
def test_masses_off_their_nodes_may_be_storeys_off_their_axes(kind, group, type, count):
    """With storeys whose columns were stiffer on one side, masses were named, P > 0.999, which were where the deck has them."""
    elements = [SimpleNamespace(type="mass"), SimpleNamespace(type=type)]
    base = SimpleNamespace(problem=SimpleNamespace(mesh=SimpleNamespace(elements=elements)))
    recipes = [SimpleNamespace(candidate=SimpleNamespace(group=group))]
    best = SimpleNamespace(recipes=recipes, model=SimpleNamespace(base=base))
    assert len([*_centres(SimpleNamespace(kind=kind, best=best))]) == count
