"""The four answers of a diagnosis, in plain sentences: what, where, how much, and is it true."""

from collections.abc import Iterator
from operator import attrgetter

import numpy as np

from mouse_cli._texts import capital
from mouse_cli.model.diagnosis import (
    BY_MODE,
    LAW,
    NAMED,
    NOTHING,
    ONE_OF,
    UNKNOWN,
    Diagnosis,
    HeldOut,
    Location,
    Score,
    elsewhere,
)
from mouse_cli.report.blocks import Block, Column, Heading, Table, Text, heads
from mouse_cli.report.field_words import held_words
from mouse_cli.report.section import VERDICT, Options, Section
from mouse_cli.report.sections._diagnosis_wording import (
    called,
    companions,
    grouped,
    inside,
    leaders,
    p_value,
    place,
    probable,
    sized,
    standing,
    whereabouts,
    with_p,
    within,
)
from mouse_cli.report.sections._field import field_blocks
from mouse_cli.report.sections._wording import LEFT, counted
from mouse_cli.report.verdict_sentences import faulty, remains, sentences

_DEMANDED = 0.5  # probability of no cause below which others stay likely though the data do not demand them
_FEW = 0.25  # share of all places that may hold half of the energy, for it to point anywhere
_INFLATED = 1.05  # noise scale from which on it is told
_SURE = 0.95  # probability from which on a doubt is none between groups
_GAIN, _RATIO = 3.0, 0.7  # what a proof takes: gain in log density, ratio of errors
_ADEQUATE, _ODDS = 1e-3, 3.0  # p-value of what a candidate leaves, and log odds over none, by which it explains the data
_OWN_MODE = ("oscillator", "sprung-mass")  # mechanisms that bring a mode with them, whatever group they are in
_RARE = 0.01  # probability of so few frequencies within their intervals below which these are too narrow


def answers(found: Diagnosis, options: Options) -> Iterator[Block]:
    """The verdict and what it stands or falls with, then the answers one by one."""
    yield Text(" ".join(sentences(found)))
    yield from (Text(text) for text in found.cautions)
    missing = found.kind != NOTHING  # what is nowhere has no size either
    for question, answer in (("Where?", _where), ("What?", _what), ("How much?", _how_much), ("Validated?", _true)):
        if missing or answer in (_what, _true):
            yield Heading(question, 2)
            yield from answer(found)


def _where(found: Diagnosis) -> Iterator[Block]:
    units = found.problem.units
    shapes = "" if found.kind == NAMED and faulty(found.best) else f"{_by_shapes(found)}{_energy(found)}"
    if found.kind == NAMED:
        yield Text(f"{capital(whereabouts(found.best, units, found.elsewhere))}.{shapes}")
    elif found.kind == ONE_OF:
        where = "That depends on what it is" if len(leaders(found)) > 1 else "If it is there, here"
        yield Text(f"{where if found.placed else 'At one of several sites'}.{shapes}")
        columns = heads("<if it is | <then at")
        at = lambda one: whereabouts(one, units, elsewhere(found.explanations, one))
        yield Table(columns, tuple((one.title, at(one)) for one in leaders(found)))
        if found.field is not None:
            yield Text("If it is a change without a name, here:")
            yield from field_blocks(found.field, units)
    elif found.field is not None:
        yield from field_blocks(found.field, units)
        yield from map(Text, filter(None, [shapes.strip()]))
    else:
        yield Text(shapes.strip() or "No site can be given without a mechanism that explains the data.")


def _by_shapes(found: Diagnosis) -> str:
    """What shapes say of the place; not that it is many, where one at one site explains the data: it need not act by one force."""
    single = any(len(one.causes) == 1 for one in ([found.best] if found.kind == NAMED else leaders(found)))
    single = single or (found.kind == UNKNOWN and found.field is not None and found.field.property == LAW)
    return "" if single and found.location is not None and not found.location.single else _location(found.location)


def _location(location: Location | None) -> str:
    """What the shapes say by themselves, whatever the law of the force."""
    if location is None or not location.places:
        return ""
    if not location.single:
        return " No force at a single site makes the measured shapes; what is missing is distributed, or acts at several sites."
    first, region = location.places[0], counted(location.region, "site")
    return (
        f" If one force made the measured shapes, whatever its law, it would act here: {place(first.site)} "
        f"({with_p(first.probability)} among sites; the 90 % region holds {region} of {len(location.places)})."
    )


def _energy(found: Diagnosis) -> str:
    """Where stiffness and shapes disagree, when no single force can be it."""
    energy, location = found.energy, found.location
    if energy is None or location is None or location.single or energy.half > _FEW * len(energy.sites):
        return ""
    most = ", ".join(place(energy.sites[i]) for i in energy.order[: min(energy.half, 3)])
    return (
        f" Stiffness and shapes disagree most at {most}: {energy.half} of {len(energy.sites)} sites hold half of that."
    )


def _what(found: Diagnosis) -> Iterator[Block]:
    best, conditional = found.best, "Probabilities are among the mechanisms that mouse knows"
    if found.kind == NOTHING:
        total = found.result.residual
        p = found.baseline.p if found.baseline else total.p  # with what was allowed, or corrected, for a coarse mesh
        chances = f": goodness of fit {p_value(p)}" if total.dof else ""
        hidden = "An effect that moves the data by less than their accuracies stays hidden"
        yield Text(f"Nothing{chances}. {hidden}.{_open(found)}")
    elif found.kind == NAMED:
        yield Text(
            f"{capital(called(found))}, group {best.group}, {with_p(found.probability)} of the group{_inside(found)}. "
            f"Goodness of fit of the extended model {p_value(best.p)}{_noise(found)}. {conditional}."
        )
        if found.certain is not None:
            yield Text(_companions(found))
        if found.rest is not None:
            yield Text(f"That is not all: {remains(found.rest)}. It has no name here.")
    elif found.kind == ONE_OF:
        members = Column("members within the group", align=LEFT)
        columns = heads("<mechanism | <group | probability", members)
        tried, p = found.explanations, dict(found.groups)
        rows = [(grouped(tried, one), one.group, probable(p[one.group]), within(tried, one)) for one in standing(found)]
        yield Text(_unsettled(found))
        yield Table(columns, tuple(rows)).without_empty_columns()
        yield Text(f"{conditional}{_noise(found)}.")
    else:
        yield Text(_if_accurate(found) or _inadequate(found))


def _inadequate(found: Diagnosis) -> str:
    """What comes nearest to an answer, and that it is none."""
    near = found.nearest
    if near is None:
        return "No candidate does better than none at all."
    fit = f" has a goodness of fit of {p_value(near.p)}" if near.dof > 0 else " has as many parameters as there are data"
    return f"No candidate is adequate. The nearest, {near.title},{fit}{_noise(found)}; nearest does not mean adequate."


def _if_accurate(found: Diagnosis) -> str:
    """What explains the data as they stand, where an error of the test is the more probable; empty: nothing does."""
    none = next((one for one in found.explanations if not one.causes), None)
    explaining = [one for one in found.explanations if one.causes and one.p >= _ADEQUATE]
    best = max(explaining, key=attrgetter("log_evidence"), default=None)
    if not found.misstated or none is None or best is None or best.log_evidence - none.log_evidence < _ODDS:
        return ""
    where = " and ".join(map(place, best.sites))
    return (
        f"An error of the test is more probable than any candidate. If the test is as accurate as stated, {best.title} at {where} "
        f"explains it: goodness of fit {p_value(best.p)}."
    )


def _inside(found: Diagnosis) -> str:
    """Members of the group of what is named, where there are several that count."""
    members = inside(found)
    return f", members within it: {members}" if members else ""


def _companions(found: Diagnosis) -> str:
    """What is in the extended deck beside what is named."""
    also = found.certain.companions[0][0]
    extended = "" if also == "none" else " The extended deck has the likeliest companion in it too."
    return f"Probabilities of what acts beside it: {companions(found)}.{extended}"


def _unsettled(found: Diagnosis) -> str:
    """Why no name is given."""
    best, measured = found.best, found.problem.test
    if dict(found.groups).get("none", 0.0) > found.probability:
        return (
            "No mechanism makes the data much more probable than none does: they may also be less accurate than stated."
        )
    if found.probability < _SURE:
        return f"No mechanism is probable enough to be named: that takes a probability of {_SURE:g}."
    if not np.isfinite(measured.shapes).any() and any(cause.physics in _OWN_MODE for cause in best.causes):
        return (
            f"{capital(best.title)} is the most probable, with {with_p(found.probability)}, but frequencies without shapes do "
            "not prove that the structure has a mode which the model has not. Mode shapes would."
        )
    return f"{capital(best.title)} is the most probable, with {with_p(found.probability)}, but without enough support for a name."


def _open(found: Diagnosis) -> str:
    """What data that demand no cause leave possible."""
    if not found.probability < _DEMANDED:
        return ""
    probability = with_p(found.probability)
    return f" The data demand no mechanism, and do not exclude the first of the table either: that there is none has {probability}."


def _noise(found: Diagnosis) -> str:
    if not found.noise_scale > _INFLATED:
        return ""
    return f", all stated variances multiplied by {found.noise_scale:.3g}, which the best fit needs"


def _how_much(found: Diagnosis) -> Iterator[Block]:
    if found.kind == NAMED:
        yield Text(f"{capital('; '.join(f'{cause.title}: {sized(cause)}' for cause in found.best.causes))}.")
    elif found.kind == ONE_OF:
        columns = heads("<if it is | <then of")
        yield Table(columns, tuple((one.title, "; ".join(map(sized, one.causes))) for one in leaders(found)))
    else:
        yield Text("Without a mechanism there is no size.")


def _true(found: Diagnosis) -> Iterator[Block]:
    held, field = found.held_out, found.field
    if field is not None and field.held_out is not None:
        yield Text(held_words(field.held_out))
        return
    if held is None:
        yield Text(
            "Not proved: no data were held out from the fits, and there are too few modes to predict each from the others."
        )
        return
    subject = "Each mode, predicted from the others" if held.kind == BY_MODE else "Data that no fit has seen"
    base, after = held.baseline, held.revised
    if after is None or found.kind == NOTHING:
        yield Text(f"{subject}: {' and '.join(_errors(base))}.{_predicted_frf(found)}")
        return
    number = int(np.isfinite(held.measured_hz).sum())
    extended = {NAMED: "the extended model", ONE_OF: "all hypotheses together, each with its probability,"}.get(
        found.kind, f"{found.best.title}, one of those that were tried,"
    )
    within = ""
    if number:
        lie = f"{round(number * after.covered)} of {counted(number, 'frequency', 'frequencies')}"
        within = f", and {lie} lie within its 90 % intervals"
    yield Text(
        f"{subject}: with {extended} {' and '.join(_errors(base, after))}, the log predictive density from "
        f"{base.log_predictive_density:.1f} to {after.log_predictive_density:.1f}{within}. "
        f"{_proof(found, held)}{_predicted_frf(found)}"
    )


def _predicted_frf(found: Diagnosis) -> str:
    """FRFs that no fit has seen, over their noise."""
    text = ""
    for fit in found.held_frf:
        left = " and ".join(f"{fit.rms_sd(model.H):.3g} times their noise ({model.name})" for model in fit.models)
        text += f" FRFs that no fit has seen, {len(fit.test.frequency_hz)} lines: the residual is {left}."
    return text


def _errors(base: Score, after: Score | None = None) -> Iterator[str]:
    """Root mean square errors, of the model as it is, or before and after; of frequencies, and at sensors held out."""
    for name, of in (
        ("frequency error", "rms_frequency_error"),
        ("shape error at sensors held out", "rms_shape_error"),
    ):
        before, now = (None if score is None else 100 * getattr(score, of) for score in (base, after))
        if before == before:
            goes = "is" if now is None else f"{'rises' if now > before else 'goes'} from"
            yield f"the rms {name} {goes} {before:.2g} %{'' if now is None else f' to {now:.2g} %'}"


def _proof(found: Diagnosis, held: HeldOut) -> str:
    base, after = held.baseline, held.revised
    if found.kind == UNKNOWN:
        return "It validates nothing, as none explains the fitted data."
    fails = []
    if not after.log_predictive_density - base.log_predictive_density > _GAIN:
        fails.append("the density gains too little")
    of_frequencies = base.rms_frequency_error == base.rms_frequency_error
    error = attrgetter("rms_frequency_error" if of_frequencies else "rms_shape_error")
    ratio = error(after) / error(base)
    if not faulty(found.best) and not ratio < _RATIO:
        fails.append("the error falls too little")
    if of_frequencies and held.within < _RARE:
        fails.append("too few frequencies lie within the intervals")
    if fails:
        return f"Validation is incomplete: {', and '.join(fails)}."
    if found.kind != NAMED:
        return "A better prediction does not make a name of it."
    if held.kind == BY_MODE:
        return (
            "The extended model passes, but its mechanism was chosen with all modes: measure with a known change, such as "
            "an added mass, hold that out in the deck, and diagnose again."
        )
    return "The extended model passes. A better prediction is necessary for a name, not sufficient."


SECTION = Section("diagnosis-answers", 10, "Diagnosis", answers, (Diagnosis,), place=VERDICT)
