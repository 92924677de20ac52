"""What is said of a diagnosis: every section and form for every kind of answer, the document, the figures."""

import json
from dataclasses import replace

import numpy as np
import pytest
from diagnosis_examples import DIAGNOSES, held_out, named
from test_sections import plain_python, valid

from mouse_cli import report
from mouse_cli._errors import MouseError, WrittenError
from mouse_cli.model.diagnosis import NAMED, NOTHING, ONE_OF, UNKNOWN, Certain, Choices, Diagnosis, Site
from mouse_cli.plots import draw, registry, require
from mouse_cli.report.field_words import held_words
from mouse_cli.report.renderers.printout import WIDTH
from mouse_cli.report.section import Options, sections
from mouse_cli.report.section import registry as every_section
from mouse_cli.report.verdict_sentences import sentences
from mouse_cli.updating.statuses import STATUSES

SECTIONS = every_section()


def _words(name: str) -> str:
    return " ".join(report.markdown(DIAGNOSES[name]()).split())


@pytest.mark.parametrize("name", DIAGNOSES)
@pytest.mark.parametrize("key", [section.key for section in sections(Diagnosis)])
def test_section(key, name):
    for block in SECTIONS[key].blocks(DIAGNOSES[name](), Options()):
        assert valid(block), block


def test_the_answers_come_first():
    orders = [section.order for section in sections(Diagnosis)]
    assert sections(Diagnosis)[0].key == "diagnosis-answers"
    assert len(set(orders)) == len(orders)


@pytest.mark.parametrize("numbers", ["legacy", "modern"])
@pytest.mark.parametrize("name", DIAGNOSES)
def test_printout(name, numbers):
    lines = report.printout(DIAGNOSES[name](), numbers).split("\n")
    assert max(map(len, lines)) <= WIDTH
    assert all(line == line.rstrip() and line.isprintable() for line in lines)


@pytest.mark.parametrize("name", DIAGNOSES)
def test_document(name):
    found = DIAGNOSES[name]()
    document = report.document(found)
    assert json.loads(json.dumps(document, allow_nan=False)) == document
    assert plain_python(document)
    assert document["schema"] == "mouse.diagnosis/1"
    assert document["verdict"]["kind"] == found.kind
    assert document["exit_code"] == found.exit_code
    assert (document["verdict"]["physics"] is not None) == (found.kind in (NAMED, ONE_OF))


def test_document_of_functions():
    """A model that leaves noise alone leaves 1, and 90 % of the magnitudes lie within 90 % intervals."""
    document = report.document(DIAGNOSES["functions"]())
    (fitted,), (held,) = document["frf"], document["held_out_frf"]
    assert fitted["revised_rms_sd"] == pytest.approx(1.0, abs=4 / np.sqrt(2 * 800))
    assert fitted["baseline_rms_sd"] > 3 and len(fitted["functions"]) == 2
    assert held["revised_covered"] == pytest.approx(0.9, abs=4 * np.sqrt(0.09 / 800)) and held["lines"] == 0
    assert [each["determined"] for each in document["damping"]] == [True, False]


def test_document_of_two_causes():
    document = report.document(DIAGNOSES["two"]())
    assert document["verdict"]["physics"] == "crack + shear"
    assert [place["kind"] for place in document["verdict"]["sites"]] == ["element", "structure"]
    assert document["verdict"]["site"] == document["verdict"]["sites"][0]
    assert document["candidates"][0]["parameters"][0]["cause"] == "crack"
    assert document["candidates"][-1]["physics"] == "none"
    assert document["candidates"][-1]["site"]["kind"] == "none"


def test_exit_codes():
    assert {name: make().exit_code for name, make in DIAGNOSES.items() if make().kind != NOTHING} == {
        "named": 1,
        "two": 1,
        "one-of": 1,
        "unknown": 1,
        "bare": 1,
        "functions": 1,
        "members": 1,
        "likely": 1,
        "three": 1,
        "companions": 1,
        "nameless": 1,
    }
    nothing = DIAGNOSES["nothing"]()
    assert nothing.exit_code == nothing.result.status.exit_code


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("nothing", "Nothing is missing that this test could show"),
        ("named", "The model lacks a spring to the ground: degree of freedom 2 (probability 0.98)."),
        ("named", "all stated variances multiplied by 1.15, which the best fit needs"),
        ("named", "Probabilities are among the mechanisms that mouse knows"),
        ("named", "stiffness 393.5 N/m (sd 6.8)"),
        ("named", "The extended model passes."),
        (
            "two",
            "an open crack (element 12, 0.43 m from node 1) and shear flexibility (the whole structure): probability 0.99.",
        ),
        ("two", "depth over height 0.7 (sd 0.02, at the limit of its range)"),
        ("two", "No force at a single site makes the measured shapes"),
        (
            "two",
            "Validation is incomplete: the error falls too little, and too few frequencies lie within the intervals",
        ),
        (
            "one-of",
            "one of {a spring to the ground; an open crack}. Measure this to separate them: the frequency of mode 5",
        ),
        ("one-of", "predicted separation 5.2, will settle it"),
        ("one-of", "No mechanism is probable enough to be named: that takes a probability of 0.95."),
        ("one-of", "| an open crack | local-stiffness | 0.30 |"),
        ("one-of", "| nothing | none | 0.10 |"),
        (
            "one-of",
            "the shapes at node 3 too | a wider band | ground-spring and local-stiffness | 0.4 | will not settle it",
        ),
        ("unknown", "Something is missing that no candidate explains."),
        ("unknown", "nearest does not mean adequate"),
        ("unknown", "Held out: mode 4; 1 frequency of the configuration 'tip mass'."),
        ("unknown", "MD513: sensor 2 does not fit."),
        ("bare", "No candidate has a meaning for this model."),
        ("functions", "fitted at 200 of them, as they are"),
        ("functions", "| loss factor: structural damping, of all stiffness | 0.02 | 0.001 | | |"),
        ("functions", "Damping of the structure is that of the model with a spring to the ground."),
        ("functions", "The rms residual is"),
    ],
)
def test_words(name, words):
    assert words in _words(name)


def test_nothing_missing_and_yet_not_excluded():
    """The gate asks whether a cause is demanded; the probability that is told is that of no cause."""
    nothing = DIAGNOSES["nothing"]()
    open_ = replace(nothing, groups=(("shear", 0.8), ("none", 0.2)))
    assert report.document(nothing)["verdict"]["probability"] == 0.97
    assert report.document(open_)["verdict"]["probability"] == 0.2
    assert "that there is none has probability 0.20" in " ".join(report.markdown(open_).split())
    assert "demand no mechanism" not in report.markdown(nothing)


def _told(found) -> str:
    return " ".join(report.markdown(found).split())


def test_what_a_diagnosis_was_asked_is_echoed():
    found = replace(named(), choices=Choices(("crack", "ground-spring"), 1))
    assert "of all candidates only crack, ground-spring; one mechanism at a time. Estimator: bayes" in _told(found)
    asked = report.document(found)["asked"]
    assert (asked["candidates"], asked["causes"], asked["estimator"]) == (["crack", "ground-spring"], 1, "bayes")
    assert report.document(named())["asked"]["candidates"] is None


def test_cautions_stand_before_the_answers():
    found = replace(named(), cautions=("Calibrate the sensors.",))
    assert _told(found).index("Calibrate the sensors.") < _told(found).index("### Where?")
    assert report.document(found)["cautions"] == ["Calibrate the sensors."]


def test_other_places_of_the_cause_are_told():
    found = named()
    first = replace(found.best, elsewhere=(((Site("dof", ("3",), text="degree of freedom 3"),), 0.21),))
    found = replace(found, explanations=(first, *found.explanations[1:]))
    assert "Degree of freedom 2; or at degree of freedom 3 (probability of this site 0.21)." in _told(found)
    (other,) = report.document(found)["candidates"][0]["elsewhere"]
    assert (other["share"], other["sites"][0]["ids"]) == (0.21, [3])


def test_measurements_that_settle_nothing_are_not_recommended():
    found = DIAGNOSES["one-of"]()
    poor = tuple(replace(p, separation=0.1 * p.separation) for p in found.proposals)
    told = _told(replace(found, proposals=poor))
    assert "None of the measurements that were tried will settle it; the best, the frequency of mode 5," in told
    assert "Measure this" not in told
    assert "No measurement can be proposed" in _told(replace(found, proposals=()))


def test_a_list_of_frequencies_does_not_prove_a_mode_more():
    found = DIAGNOSES["one-of"]()
    cause = replace(found.best.causes[0], physics="oscillator", title="a hidden oscillator")
    test = replace(found.problem.test, shapes=np.full(found.problem.test.shapes.shape, np.nan))
    groups = (("ground-spring", 0.97), ("local-stiffness", 0.03), ("none", 0.0))
    first = replace(found.best, causes=(cause,))
    found = replace(
        found, explanations=(first, *found.explanations[1:]), groups=groups, problem=replace(found.problem, test=test)
    )
    sentence = (
        "A hidden oscillator is the most probable, with probability 0.97, but frequencies without shapes do not prove"
    )
    assert sentence in _told(found)


def test_nothing_missing_is_no_praise_for_an_update_that_failed():
    found = DIAGNOSES["nothing"]()
    failed = replace(found, result=replace(found.result, status=STATUSES["restless"]))
    assert failed.exit_code == 1
    assert "But its revision is not to be trusted. Not converged" in _told(failed)
    saturated = replace(found, result=replace(found.result, residual=replace(found.result.residual, dof=0)))
    assert "and it could show little" in _told(saturated)


def test_a_faulty_sensor_is_no_fault_of_the_model():
    found = named()
    cause = replace(
        found.best.causes[0], title="two sensors exchanged", site=Site("sensor", ("3", "4"), text="sensors 3 and 4")
    )
    first = replace(found.best, causes=(cause,))
    swapped = replace(found, explanations=(first, *found.explanations[1:]))
    told = report.printout(swapped)
    assert "The test is at fault, not the model: two sensors exchanged: sensors 3 and 4 (probability 0.98)." in told
    open_, sure = (("ground-spring", 0.6), ("none", 0.4)), (("ground-spring", 1.0),)
    for companions, said in ((open_, ", not the model:"), (sure, "fault: two")):
        beside = replace(swapped, certain=Certain((cause,), 0.98, (), companions))
        assert said in " ".join(sentences(beside))


def test_a_doubtful_test_hides_no_field():
    """What leads beside an error of the test is told too, and what no test says is not."""
    found = DIAGNOSES["nameless"]()
    told = _told(replace(found, misstated="frequency"))
    assert "an error of the test is more probable than that it is as accurate as stated, unless what is" in told
    assert "best beside such an error has no name in the library. It" in told
    assert "What is missing has no name" not in told
    assert "has no name" not in _told(replace(found, misstated="frequency", field=None))


def test_what_explains_a_test_that_is_right_is_told_beside_an_error_of_it():
    """An error of the test is the more probable, and the mechanism has its odds over none all the same."""
    found = DIAGNOSES["unknown"]()
    none = next(one for one in found.explanations if not one.causes)
    best = next(one for one in found.explanations if one.causes)
    fitting = replace(best, p=0.2, log_evidence=none.log_evidence + 40.0)
    groups = (("none", 0.9), (best.group, 0.1))
    at_fault = replace(found, misstated="frequency", groups=groups, field=None, explanations=(none, fitting))
    words = f"If the test is as accurate as stated, {best.title} at"
    assert words in _told(at_fault) and "goodness of fit p = 0.20." in _told(at_fault)
    worse = replace(at_fault, explanations=(none, replace(fitting, p=1e-4)))
    assert words not in _told(worse) and f"No candidate is adequate. The nearest, {best.title}, has" in _told(worse)
    idle = replace(at_fault, explanations=(none, replace(fitting, log_evidence=none.log_evidence - 1.0)))
    assert "No candidate does better than none at all." in _told(idle)


def test_no_name_without_a_verdict():
    """Neither `unknown` nor `one-of` says that the model lacks a certain thing."""
    for name in ("one-of", "unknown", "nothing", "bare"):
        assert "The model lacks" not in _words(name)


def test_unnamed_leader_of_groups_is_not_the_first_fit():
    """The group decides: its own best explanation is told, though that of another group leads alone."""
    found = named()
    first, second, none = found.explanations
    turned = Diagnosis(found.problem, NAMED, found.result, found.innovation, (second, first, none), found.groups)
    assert turned.best.physics == "ground-spring"


@pytest.mark.parametrize("name", DIAGNOSES)
def test_figures(name, tmp_path):
    pytest.importorskip("matplotlib")
    found = DIAGNOSES[name]()
    written = draw(found, str(tmp_path / "figures"))
    for path in written:
        with open(path, "rb") as file:
            assert file.read(8) == b"\x89PNG\r\n\x1a\n"
    expected = {"named": 6, "two": 5, "one-of": 2, "unknown": 2, "nothing": 3, "bare": 1, "functions": 10}
    expected |= {"members": 2, "likely": 2, "three": 2, "companions": 2, "nameless": 3}
    assert len(written) == expected[name]
    assert len(written) <= len(registry())


@pytest.mark.parametrize(("kind", "head"), [("pdf", b"%PDF"), ("png", b"\x89PNG"), ("svg", b"<?xml")])
def test_figures_in_one_file(kind, head, tmp_path):
    pytest.importorskip("matplotlib")
    path = tmp_path / f"all.{kind}"
    assert draw(named(), str(path)) == [str(path)]
    assert path.read_bytes().startswith(head)


@pytest.mark.parametrize("name", ["all.doc", "no/such/folder/all.png"])
def test_figures_that_cannot_be_written(name, tmp_path):
    pytest.importorskip("matplotlib")
    with pytest.raises(WrittenError, match="MD531"):
        draw(named(), str(tmp_path / name))
    assert not list(tmp_path.iterdir())


def test_without_matplotlib(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "matplotlib", None)
    with pytest.raises(MouseError, match="MD530"):
        require()


def test_examples_are_of_every_kind():
    assert {make().kind for make in DIAGNOSES.values()} == {NOTHING, NAMED, ONE_OF, UNKNOWN}
    assert all(isinstance(make().probability, float) for make in DIAGNOSES.values())
    assert np.isnan(DIAGNOSES["bare"]().probability)


def test_one_mechanism_that_is_named_is_not_said_to_act_at_several_sites():
    """A missing diagonal, which no single force replaces, was "distributed, or acts at several sites", below its name."""
    two = DIAGNOSES["two"]()
    first = replace(two.best, causes=two.best.causes[:1])
    one = replace(two, explanations=(first, *two.explanations[1:]), groups=((first.group, 0.99), *two.groups[1:]))
    assert "at several sites" in _told(two) and "at several sites" not in _told(one)


@pytest.mark.parametrize(("error", "density", "words"), [
    (0.004, 12.0, "the rms frequency error of held-out data goes from 10 % to 0.4 %, and the log predictive density from -340.0 to "
                  "12.0."),
    (0.2, 12.0, "held-out data are predicted no better: their rms frequency error goes from 10 % to 20 %, and the log predictive "
                "density from -340.0 to 12.0, as less accuracy is claimed."),
    (0.2, -400.0, "held-out data are predicted no better: their rms frequency error goes from 10 % to 20 %, and the log predictive "
                  "density from -340.0 to -400.0."),
])  # fmt: skip
def test_an_error_that_rises_is_no_merit(error, density, words):
    """The density gains where a prediction claims less accuracy than the model as it is."""
    held = held_out(error)
    held = replace(held, revised=replace(held.revised, log_predictive_density=density))
    assert held_words(held) == f"By all hypotheses together, each with its probability, {words}"
