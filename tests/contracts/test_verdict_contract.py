"""The contract of a diagnosis' answer: the same keys and honest sentences for every kind of test, in every form."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_examples import CRACK, DIAGNOSES, MASS, SHEAR, SOFT, SPRING, explanation, named, nameless
from page_answers import Reader
from report_examples import chain
from test_sections import plain_python, valid

from mouse_cli import report
from mouse_cli.model.arrangements import ArrangementsDiagnosis, Turn
from mouse_cli.model.diagnosis import NAMED, NOTHING, ONE_OF, Choices, Diagnosis, Explanation, Site, elsewhere
from mouse_cli.model.record_diagnosis import RecordDiagnosis
from mouse_cli.page import Part, page, summary
from mouse_cli.report.section import Options, blocks
from mouse_cli.report.verdict_sentences import sentences

KEYS = {"kind", "sentences", "physics", "group", "site", "sites", "probability", "members"}
KEYS |= {"companions", "elsewhere", "rest", "field", "untried"}


def configurations(kind: str = NAMED, adequate: bool = True, **more) -> ArrangementsDiagnosis:
    """A crack with a rival site, or a softer element, then a mass."""
    before = explanation(ln_z=-900.0, probability=0.0, p=0.0)
    crack = replace(explanation(CRACK, ln_z=-30.0, probability=0.69), elsewhere=(((Site("node", (9,)),), 0.49),))
    soft, mass = explanation(SOFT, ln_z=-31.0, probability=0.31), explanation(MASS, ln_z=-20.0, probability=0.97)
    none = explanation(ln_z=-29.0, probability=0.03)
    turns = (
        Turn(kind, (crack, soft, before), (("local-stiffness", 1.0), ("none", 0.0)), 1.0, before),
        Turn(NAMED, (mass, none), (("mass", 0.97), ("none", 0.03)), 1.0, none),
    )
    problem = chain()
    values = np.array([p.nominal for p in problem.parameters])
    return ArrangementsDiagnosis(
        (problem,),
        None,
        (),
        0.01,
        turns,
        3.6,
        4,
        0.46 if adequate else 1e-9,
        adequate,
        values,
        0.1 * values,
        (),
        (none,),
        **more,
    )


def recordings(name: str) -> RecordDiagnosis:
    """The answer so called, as of recordings."""
    found = DIAGNOSES[name]()
    kept = {
        key: getattr(found, key) for key in ("kind", "innovation", "explanations", "groups", "field", "rest", "untried")
    }
    return RecordDiagnosis(problem=found.problem, result=None, channels=("a",), units=("g",), sd=np.ones(1), **kept)


ALL = dict(DIAGNOSES)
ALL |= {f"recordings {name}": lambda name=name: recordings(name) for name in ("members", "likely", "three", "nameless")}
ALL |= {
    "configurations": configurations,
    "configurations unsettled": lambda: configurations(ONE_OF),
    "configurations unknown": lambda: configurations(adequate=False),
    "configurations nameless": lambda: configurations(
        adequate=False, field=nameless().field, untried=nameless().untried
    ),
}


def words(found) -> str:
    """Of the Markdown of the report, without its escapes."""
    return " ".join(report.markdown(found).replace("\\", "").split())


def text_of(found) -> str:
    return " ".join(Reader(page(Part(report.document(found), "answer.json"))).named("main")[0]["text"].split())


@pytest.mark.parametrize("name", ALL)
def test_every_kind_of_test_has_the_same_keys(name):
    found = ALL[name]()
    document = report.document(found)
    verdict = document["verdict"]
    assert plain_python(document)
    assert set(verdict) >= KEYS
    assert len(verdict["sites"]) == (0 if verdict["physics"] is None else len(verdict["physics"].split(" + ")))
    assert verdict["site"] == (verdict["sites"] or [None])[0]
    assert (verdict["members"] is None) == (verdict["physics"] is None)
    if verdict["members"]:
        assert sum(verdict["members"].values()) == pytest.approx(1.0)
        assert verdict["physics"] in verdict["members"]
    assert all(sentence in words(found) for sentence in verdict["sentences"])
    for block in blocks(found, Options()):
        assert valid(block) or getattr(block, "level", 0) == 1, block


@pytest.mark.parametrize("name", ALL)
def test_the_page_and_the_summary_say_the_same(name):
    found = ALL[name]()
    document = report.document(found)
    told, short = text_of(found), summary(Part(document, "answer.json"))
    for sentence in document["verdict"]["sentences"]:
        assert " ".join(sentence.split()) in told
    assert short.startswith("**") and len(short) > 200


@pytest.mark.parametrize(
    "name", ["unknown", "nameless", "recordings nameless", "configurations unknown", "configurations nameless"]
)
def test_unknown_has_no_probability(name):
    """Of a hypothesis none explains the data, so that none is probable, in any form."""
    found = ALL[name]()
    document = report.document(found)
    assert document["verdict"]["probability"] is None and document["verdict"]["members"] is None
    judged = [document, *document.get("turns", [])]
    every = [one for part in judged for key in ("candidates", "groups") for one in part.get(key, [])]
    assert every and {one["probability"] for one in every} == {None}
    assert not any(f"| {name} |" in report.markdown(found) for name in ("probability", "Probability"))
    for told in (words(found), text_of(found), summary(Part(document, "answer.json"))):
        assert not any(f"probability {p}" in told for p in ("1.000", "0.", "1.0", "> 0.999"))


def test_a_probability_is_that_of_the_group_or_of_its_member():
    found = DIAGNOSES["members"]()
    verdict = report.document(found)["verdict"]
    assert verdict["members"] == {"crack": pytest.approx(0.69), "stiffness-loss": pytest.approx(0.31)}
    assert (verdict["group"], verdict["probability"]) == ("local-stiffness", 1.0)
    within = "an open crack 0.69, a softer part 0.31"
    begin = f"The model lacks a local loss of stiffness (probability > 0.999): {within}"
    assert verdict["sentences"][0].startswith(begin)
    assert "an open crack (probability > 0.999)" not in words(found)


def test_rival_sites_stand_beside_the_site():
    verdict = report.document(DIAGNOSES["members"]())["verdict"]
    (other,) = verdict["elsewhere"]
    assert (other["sites"][0]["ids"], other["probability"]) == ([14], pytest.approx(0.49))
    told = "element 12, 0.43 m from node 1; or at element 14, 0.58 m from node 1 (probability of this site 0.49)."
    assert told in words(DIAGNOSES["members"]())
    assert "or at node 9 (probability of this site 0.49)" in words(configurations())
    assert report.document(configurations())["verdict"]["causes"][0]["elsewhere"][0]["sites"][0]["ids"] == [9]


def test_fits_of_the_same_physics_elsewhere_are_rival_sites():
    """As recordings have them: each site is an explanation of its own."""
    at = lambda i, p: explanation(replace(SPRING, site=Site("node", (i,))), ln_z=-1.0, probability=p)
    found = elsewhere([at(1, 0.5), at(2, 0.3), at(1, 0.17), at(3, 0.03)], at(1, 0.5))
    assert found == (((Site("node", (2,)),), pytest.approx(0.3)),)


def test_sites_that_read_alike_are_no_rivals():
    """A set that was found twice, its mass 0.2 micrometres apart and its parts in another order, was its own rival at 0.50."""
    at = lambda *x, p: replace(explanation(SPRING, SPRING, ln_z=-1.0, probability=p), causes=tuple(
        replace(SPRING, site=Site("node", (round(each),), (each, 0.0, 0.0), f"node {each:.2f}")) for each in x))  # fmt: skip
    best = at(5.8805523, 1.0, p=0.5)
    found = elsewhere([best, at(5.8805521, 1.0, p=0.3), at(1.0, 5.88, p=0.1), at(3.0, 1.0, p=0.1)], best)
    assert [[site.text for site in sites] for sites, _ in found] == [["node 3.00", "node 1.00"]]


def test_what_remains_is_said():
    found = DIAGNOSES["members"]()
    assert report.document(found)["verdict"]["rest"] == {"share": 0.12, "p": 3e-9, "there": False}
    assert ", and something more: 12 % of the misfit remains, p < 1e-6." in words(found)
    assert report.document(DIAGNOSES["named"]())["verdict"]["rest"] is None
    shaped = replace(found, rest=replace(found.rest, there=True))
    assert report.document(shaped)["verdict"]["rest"]["there"]
    remains = "12 % of the misfit remains, and most of it follows from the motion there, p < 1e-6."
    assert f", whose law is of another shape than this: {remains}" in words(shaped)
    some = configurations(adequate=False)
    assert report.document(some)["verdict"]["rest"] == {"share": pytest.approx(3.6 / 12.0), "p": 1e-9, "there": False}
    assert "with all of it in the model 30 % of the misfit remains, p < 1e-6." in words(some)


def test_likely_is_not_proved():
    found = DIAGNOSES["likely"]()
    assert "none" in report.document(found)["verdict"]["rivals"] and found.exit_code == 1
    told = (
        "It is likely, not proved, that the model lacks a spring to the ground: degree of freedom 2 (probability 0.88; "
    )
    assert f"{told}that nothing is missing: 0.12)." in words(found)
    other = replace(found, groups=(("none", 0.6), ("ground-spring", 0.4)))
    assert sentences(other)[0].startswith("It is possible, not likely, that the model lacks a spring to the ground")
    little = replace(found, groups=(("ground-spring", 0.96), ("none", 0.04)))
    assert sentences(little)[0].endswith("(probability 0.96; that nothing is missing: 0.04).")
    open_ = replace(found, groups=(("force", 0.64), ("ground-spring", 0.2), ("none", 0.16)))
    assert sentences(open_)[0] == (
        "It is likely, not proved, that something is missing (probability that nothing is: 0.16), and the test does not settle "
        "what: one of {a spring to the ground; a change without a name (probability 0.64)}."
    )
    several = words(DIAGNOSES["one-of"]())
    assert "It is likely, not proved, that something is missing (probability that nothing is: 0.10)" in several
    every = dict(DIAGNOSES["one-of"]().groups)
    for none, begin in ((0.03, "It is likely, not proved, that something"), (0.01, "Something is missing")):
        groups = tuple({**every, "none": none}.items())
        assert sentences(replace(DIAGNOSES["one-of"](), groups=groups))[0].startswith(begin)


def test_what_is_certain_is_named_while_its_companion_is_open():
    """Everywhere the crack and its probability alone; what acts beside it with probabilities of its own."""
    found = DIAGNOSES["companions"]()
    verdict = report.document(found)["verdict"]
    assert (verdict["physics"], verdict["group"], verdict["probability"]) == ("crack", "local-stiffness", 0.95)
    assert [site["ids"] for site in verdict["sites"]] == [[12]] and verdict["members"] == {"crack": 1.0}
    beside = {each["group"]: each["probability"] for each in verdict["companions"]}
    assert list(beside) == ["shear", "none", "mass"] and sum(beside.values()) == pytest.approx(1.0)
    assert verdict["sentences"] == [
        "The model lacks an open crack: element 12, 0.43 m from node 1 (probability 0.95).",
        "What acts beside it is open: shear or rotary inertia 0.53, nothing 0.32, an added mass 0.16.",
    ]
    sure = replace(found, certain=replace(found.certain, companions=(("mass", 0.9995), ("none", 0.0005))))
    assert sentences(sure)[1] == "Beside it acts an added mass (probability > 0.999), and the test does not settle where."
    told = words(found)
    assert "An open crack, group local-stiffness, probability 0.95 of the group." in told
    assert "The extended deck has the likeliest companion in it too." in told
    assert "An open crack: depth over height 0.7" in told and "An open crack and" not in told
    assert report.document(DIAGNOSES["named"]())["verdict"]["companions"] == []


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_mechanisms_stand_in_one_order(count):
    """Physics, group, sites, title and sizes, whatever the order in which they were found."""
    causes = (SPRING, MASS, SHEAR, CRACK)[:count]
    for given in (causes, causes[::-1]):
        moved = tuple(Site("node", (i,), text=f"near {cause.physics}") for i, cause in enumerate(given))
        one = replace(explanation(*given, ln_z=-1.0, probability=0.97), elsewhere=())
        one = Explanation(given, 1.0, 1, 0.4, -1.0, np.ones(1), 0.97, ((moved, 0.2),))
        found = replace(DIAGNOSES["three"](), explanations=(one,), groups=((one.group, 0.97),))
        verdict = report.document(found)["verdict"]
        order = [c for key in verdict["physics"].split(" + ") for c in causes if c.physics == key]
        assert verdict["group"] == " + ".join(cause.group for cause in order)
        assert [site["text"] for site in verdict["sites"]] == [s["text"] for s in map(site_of, order)]
        assert [s["text"] for s in verdict["elsewhere"][0]["sites"]] == [f"near {cause.physics}" for cause in order]
        assert all(cause.title in verdict["sentences"][0] for cause in causes)


def site_of(cause):
    return report.verdict_document.site(cause.site)


def test_three_mechanisms_read_well():
    told = (
        "The model lacks an open crack (element 12, 0.43 m from node 1), a lumped mass (node 7) and shear flexibility "
    )
    assert f"{told}(the whole structure): probability 0.96." in words(DIAGNOSES["three"]())
    assert "An open crack, a lumped mass and shear flexibility, group local-stiffness + mass + shear" in words(
        DIAGNOSES["three"]()
    )


def test_a_field_without_a_name():
    found = nameless()
    field = report.document(found)["verdict"]["field"]
    assert (field["property"], field["log_evidence_over_named"], field["unit"]) == ("stiffness", 19.3, "m")
    assert field["sites"][13]["ids"] == [14] and field["sites"][13]["value"] == pytest.approx(-0.2237, abs=1e-4)
    assert field["held_out"]["revised"]["covered"] == 0.9
    told = words(found)
    assert "What is missing has no name in the library. It acts on the stiffness, most of it about" in told
    assert "about element 12 to 17 (-22 %, sd 4 % at element 14)." in told
    assert "Its log evidence is 19.3 above that of everything that has a name." in told
    assert "| element 14 | -22.4 | 4 |" in told and "| element 2 |" not in told
    worse = words(replace(found, field=replace(found.field, log_evidence_over_named=-97.7)))
    assert "Its log evidence is 97.7 below that of the best that has a name, which is rejected." in worse
    listed = sum(abs(each.value) > 0.08 for each in found.field.values)
    assert f"{30 - listed} sites with negligible values (below two sd) left out." in told


def test_a_field_is_drawn_on_the_page():
    found = Reader(page(Part(report.document(nameless()), "answer.json")))
    (band,) = [
        e for e in found.named("polygon") if "band" in e["attrs"]["class"] and len(e["attrs"]["points"].split()) > 4
    ]
    assert len(band["attrs"]["points"].split()) == 60
    (section,) = [e for e in found.named("section") if e["attrs"]["id"] == "field"]
    assert "element 14" in section["text"] and "negligible" in section["text"]


def test_figures_of_a_field_show_value_and_two_sd():
    figure = pytest.importorskip("matplotlib.figure")
    from mouse_cli.plots import figures_of

    found = nameless()
    for subject, key in ((found, "field"), (Part(report.document(found), "answer.json"), "answer-field")):
        axes = figure.Figure().add_subplot()
        assert figures_of(type(subject))[key].draw(subject, axes)
        (line,) = [each for each in axes.lines if each.get_label() == "value"]
        assert line.get_xydata()[13].tolist() == pytest.approx([1.4, 100 * found.field.values[13].value])
        edges = axes.collections[0].get_paths()[0].get_extents()
        assert edges.ymin == pytest.approx(100 * min(each.value - 2 * each.sd for each in found.field.values))
    assert not figures_of(Diagnosis)["field"].draw(DIAGNOSES["unknown"](), axes)


def test_a_force_and_a_bed_have_their_own_units():
    field = nameless().field
    softer = tuple(replace(each, value=40 * each.value) for each in field.values)
    bed = words(replace(nameless(), field=replace(field, property="bed", values=softer)))
    assert (
        "It acts as a bed, a stiffness from the structure to the ground, most of it about element 12 to 17 (-8.9 EI/L^4"
        in bed
    )
    force = words(replace(nameless(), field=replace(field, property="force", held_out=None)))
    assert "It acts as one spring along a motion of the whole structure, most of it about element 12 to 17" in force


def test_untried_candidates_are_folded_by_reason():
    found = nameless()
    assert report.document(found)["verdict"]["untried"][0] == {"physics": "joint", "reason": "no site in this model"}
    told = "Not tried, 3 candidates: joint, items (no site in this model); shear (the data do not respond)."
    assert told in words(found)
    assert told in words(configurations(untried=found.untried))
    assert "Not tried: 3 candidates" in summary(Part(report.document(found), "answer.json"))
    text = page(Part(report.document(found), "answer.json"))
    assert "<details><summary>Not tried: 3</summary>" in text


def test_nothing_missing_says_what_may_be_all_the_same():
    """Where something leads, but not so far that it would be likely: exit 0, with what it is."""
    one = DIAGNOSES["one-of"]()
    leader = next(each for each in one.explanations if each.causes)
    groups = ((leader.group, 0.74), ("none", 0.16), ("field-mass", 0.1))
    found = replace(DIAGNOSES["nothing"](), explanations=(leader,), groups=groups)
    first, second = sentences(found)
    assert first.startswith("This test does not show that something is missing, nor that nothing is")
    assert second == f"Something may be missing all the same, most likely {leader.title} (probability 0.74; that nothing is: 0.16)."
    groups = (("field-mass", 0.74), ("none", 0.16))
    nameless = "most likely a change without a name (probability 0.74; that nothing is: 0.16)."
    assert sentences(replace(found, groups=groups))[1].endswith(nameless)
    assert len(sentences(replace(found, groups=(("none", 0.44), (leader.group, 0.3), ("field-mass", 0.26))))) == 1


def test_nothing_missing_names_nothing():
    verdict = report.document(DIAGNOSES["nothing"]())["verdict"]
    assert verdict["kind"] == NOTHING and verdict["probability"] == 0.97
    assert (verdict["physics"], verdict["members"], verdict["elsewhere"]) == (None, None, [])


@pytest.mark.parametrize(
    "found", [named, lambda: recordings("members"), configurations], ids=["modes", "records", "several"]
)
def test_what_was_asked_stands_in_every_form(found):
    """`--candidates` and `--causes` change the answer: whoever reads it sees them, whatever kind of test it is of."""
    asked = replace(found(), choices=Choices(("mass", "crack"), 1))
    told = report.document(asked)["asked"]
    assert (told["candidates"], told["causes"]) == (["mass", "crack"], 1)
    assert "Considered: of all candidates only mass, crack; one mechanism at a time." in " ".join(
        report.markdown(asked).split()
    )
