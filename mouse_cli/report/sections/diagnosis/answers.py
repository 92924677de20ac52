"""The four answers of a diagnosis, in plain sentences: what, where, how much, and is it true."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.diagnosis import (
    BY_MODE,
    NAMED,
    NOTHING,
    ONE_OF,
    UNKNOWN,
    Diagnosis,
    Explanation,
    HeldOut,
    Location,
    Score,
)
from mouse_cli.report.blocks import Block, Column, Heading, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import (
    leaders,
    place,
    probable,
    separation,
    sized,
    standing,
    where,
    whereabouts,
    with_p,
)
from mouse_cli.report.sections._wording import LEFT, chance, counted

_DEMANDED = 0.5  # probability of no cause below which others stay likely though the data do not demand them
_FEW = 0.25  # share of all places that may hold half of the energy, for it to point anywhere
_INFLATED = 1.05  # noise scale from which on it is told
_SURE = 0.9  # probability from which on a doubt is none between groups
_GAIN, _RATIO, _COVERED = 3.0, 0.7, 0.7  # what a proof takes: nats, ratio of errors, share within 90 % intervals


def answers(found: Diagnosis, options: Options) -> Iterator[Block]:
    """The verdict and what it stands or falls with, then the answers one by one."""
    yield Text(_verdict(found))
    yield from (Text(text) for text in found.cautions)
    for question, told in (("Where?", _where), ("What?", _what), ("How much?", _how_much), ("Is it true?", _true)):
        yield Heading(question, 2)
        yield from told(found)


def _verdict(found: Diagnosis) -> str:
    best = found.best
    if found.kind == NOTHING:
        return _nothing(found)
    if found.kind == NAMED:
        begin = "The test is at fault, not the model:" if _faulty(best) else "The model lacks"
        return f"{begin} {best.title}: {where(best)} ({with_p(found.probability)})."
    if found.kind == ONE_OF:
        named = "; ".join(one.title for one in leaders(found))
        return f"Something is missing, and the test does not settle what: one of {{{named}}}. {_separating(found)}"
    if found.misstated:
        return (
            "Model and test disagree, and the test itself looks at fault. No cause can be told before that is settled."
        )
    return (
        "Something is missing that no candidate explains. Do not trust the revised parameters, and do not name a cause."
    )


def _faulty(best: Explanation) -> bool:
    """Whether the cause lies in the test alone."""
    return all(cause.site.kind == "sensor" for cause in best.causes)


def _nothing(found: Diagnosis) -> str:
    status = found.result.status
    told = "Nothing is missing that this test could show: the model, with its parameters revised, explains the data."
    if not found.result.residual.dof:
        told = (
            "Nothing is missing that this test could show, and it could show little: its parameters can follow all of its data, so "
            "that only how far they move from the prior speaks of what is missing."
        )
    return told if status.exit_code == 0 else f"{told} But its revision is not to be trusted. {status.sentence}"


def _separating(found: Diagnosis) -> str:
    if not found.proposals:
        return "No measurement can be proposed to separate them."
    best = found.proposals[0]
    if not best.promise:
        best = max(found.proposals, key=lambda each: each.separation)
        tried = f"the best, {best.text}, has a predicted separation of {separation(best.separation)}"
        return f"None of the measurements that were tried will settle it; {tried}."
    return f"Measure this to separate them: {best.text} (predicted separation {separation(best.separation)}, {best.outlook})."


def _where(found: Diagnosis) -> Iterator[Block]:
    shapes = "" if found.kind == NAMED and _faulty(found.best) else f"{_location(found.location)}{_energy(found)}"
    if found.kind == NOTHING:
        yield Text("Nowhere: model and test part no more than their accuracies let expect.")
    elif found.kind == NAMED:
        yield Text(f"{_capital(whereabouts(found.best, found.problem.units))}.{shapes}")
    elif found.kind == ONE_OF:
        yield Text(f"That depends on what it is.{shapes}")
        columns = (Column("if it is", align=LEFT), Column("then at", align=LEFT))
        yield Table(columns, tuple((one.title, whereabouts(one, found.problem.units)) for one in leaders(found)))
    else:
        yield Text(shapes.strip() or "No place can be given without a cause that explains the data.")


def _location(location: Location | None) -> str:
    """What the shapes say by themselves, whatever the law of the force."""
    if location is None or not location.places:
        return ""
    if not location.single:
        return " No force at a single place makes the measured shapes; the cause is distributed, or there are several."
    first, region = location.places[0], counted(location.region, "place")
    return (
        f" If one force made the measured shapes, whatever its law, it would act here: {place(first.site)} "
        f"({with_p(first.probability)}; the 90 % region holds {region} of {len(location.places)})."
    )


def _energy(found: Diagnosis) -> str:
    """Where stiffness and shapes disagree, when no single force can be it."""
    energy, location = found.energy, found.location
    if energy is None or location is None or location.single or energy.half > _FEW * len(energy.sites):
        return ""
    most = ", ".join(place(energy.sites[i]) for i in energy.order[: min(energy.half, 3)])
    return (
        f" Stiffness and shapes disagree most at {most}: {energy.half} of {len(energy.sites)} places hold half of that."
    )


def _what(found: Diagnosis) -> Iterator[Block]:
    best, conditional = found.best, "P holds on condition that the cause is one of those that mouse knows"
    if found.kind == NOTHING:
        total = found.result.residual
        p = found.baseline.p if found.frf and found.baseline else total.p  # functions alone decide where there are any
        chances = f": noise alone leaves a larger misfit {chance(p)}" if total.dof else ""
        hidden = "An effect that moves the data by less than their accuracies stays hidden"
        yield Text(f"Nothing{chances}. {hidden}.{_open(found)}")
    elif found.kind == NAMED:
        yield Text(
            f"{_capital(best.title)}, group {best.group}, {with_p(found.probability)}. Noise alone leaves a larger misfit than the "
            f"extended model does {chance(best.p)}{_noise(found)}. {conditional}."
        )
    elif found.kind == ONE_OF:
        columns = (Column("cause", align=LEFT), Column("group", align=LEFT), Column("probability"))
        rows = [(one.title, one.group, probable(dict(found.groups)[one.group])) for one in standing(found)]
        yield Text(_unsettled(found))
        yield Table(columns, tuple(rows))
        yield Text(f"{conditional}{_noise(found)}.")
    elif best is None or not best.causes or found.groups[0][0] == "none":
        yield Text("No candidate does better than none at all.")
    else:
        yield Text(
            f"No candidate is adequate. Noise alone leaves a larger misfit than the nearest, {best.title}, does "
            f"{chance(best.p)}{_noise(found)}; that it is nearest does not make it the cause."
        )


def _unsettled(found: Diagnosis) -> str:
    """Why no name is given."""
    best, measured = found.best, found.problem.test
    if dict(found.groups).get("none", 0.0) > found.probability:
        return "No cause makes the data much more probable than none does: they may also be less accurate than they are said to be."
    if found.probability < _SURE:
        return f"No cause is probable enough to be named: that takes P = {_SURE:g}."
    if not np.isfinite(measured.shapes).any() and any(cause.physics == "oscillator" for cause in best.causes):
        return (
            f"{_capital(best.title)} leads with {with_p(found.probability)}, but a list of frequencies alone does not prove "
            "that the structure has a mode which the model has not. Mode shapes would."
        )
    return f"{_capital(best.title)} leads with {with_p(found.probability)}, but the data do not bear it out as a name."


def _open(found: Diagnosis) -> str:
    """What data that demand no cause leave possible."""
    if not found.probability < _DEMANDED:
        return ""
    told = with_p(found.probability)
    return f" The data demand no cause, and do not rule out those that lead the table either: that there is none has {told}."


def _noise(found: Diagnosis) -> str:
    if not found.noise_scale > _INFLATED:
        return ""
    return f", all stated variances multiplied by {found.noise_scale:.3g}, which the best fit needs"


def _how_much(found: Diagnosis) -> Iterator[Block]:
    if found.kind == NOTHING or found.best is None:
        yield Text("Nothing to be sized.")
    elif found.kind == NAMED:
        yield Text(f"{_capital('; '.join(f'{cause.title}: {sized(cause)}' for cause in found.best.causes))}.")
    elif found.kind == ONE_OF:
        columns = (Column("if it is", align=LEFT), Column("then of", align=LEFT))
        yield Table(columns, tuple((one.title, "; ".join(map(sized, one.causes))) for one in leaders(found)))
    else:
        yield Text("Without a cause there is no size.")


def _true(found: Diagnosis) -> Iterator[Block]:
    held = found.held_out
    if held is None:
        yield Text(
            "Not proved: no data were held out from the fits, and there are too few modes to predict each from the others."
        )
        return
    told = "Each mode, predicted from the others" if held.kind == BY_MODE else "Data that no fit has seen"
    base, after = held.baseline, held.revised
    if after is None or found.kind == NOTHING:
        yield Text(f"{told}: {' and '.join(_errors(base))}.{_foreseen(found)}")
        return
    number = int(np.isfinite(held.measured_hz).sum())
    extended = {NAMED: "the extended model", ONE_OF: f"{found.best.title}, which leads,"}.get(
        found.kind, f"{found.best.title}, the nearest,"
    )
    within = ""
    if number:
        lie = f"{round(number * after.covered)} of {counted(number, 'frequency', 'frequencies')}"
        within = f", and {lie} lie within its 90 % intervals"
    yield Text(
        f"{told}: with {extended} {' and '.join(_errors(base, after))}, the ln predictive density from "
        f"{base.log_predictive_density:.1f} to {after.log_predictive_density:.1f}{within}. {_proof(found, held)}{_foreseen(found)}"
    )


def _foreseen(found: Diagnosis) -> str:
    """Functions that no fit has seen, over their noise."""
    told = ""
    for fit in found.held_frf:
        left = " and ".join(f"{fit.rms_sd(model.H):.3g} times their noise ({model.name})" for model in fit.models)
        told += f" Functions that no fit has seen, {len(fit.test.frequency_hz)} lines: what is left is {left}."
    return told


def _errors(base: Score, after: Score | None = None) -> Iterator[str]:
    """Root mean square errors, of the model as it is, or before and after; of frequencies, and at sensors held out."""
    frequencies = (
        "the root mean square error of frequencies",
        base.rms_frequency_error,
        after and after.rms_frequency_error,
    )
    shapes = (
        "the root mean square error of shapes at sensors held out",
        base.rms_shape_error,
        after and after.rms_shape_error,
    )
    for name, before, now in (frequencies, shapes):
        if before == before:
            yield (
                f"{name} is {100 * before:.2g} %"
                if now is None
                else f"{name} goes from {100 * before:.2g} % to {100 * now:.2g} %"
            )


def _proof(found: Diagnosis, held: HeldOut) -> str:
    base, after = held.baseline, held.revised
    if found.kind == UNKNOWN:
        return "It is no proof of anything, as none explains the data that were fitted."
    fails = []
    if not after.log_predictive_density - base.log_predictive_density > _GAIN:
        fails.append("the density gains too little")
    of_frequencies = base.rms_frequency_error == base.rms_frequency_error
    ratio = (
        after.rms_frequency_error / base.rms_frequency_error
        if of_frequencies
        else after.rms_shape_error / base.rms_shape_error
    )
    if not _faulty(found.best) and not ratio < _RATIO:
        fails.append("the error falls too little")
    if of_frequencies and not after.covered >= _COVERED:
        fails.append("too few frequencies lie within the intervals")
    if fails:
        return f"That is no full proof: {', and '.join(fails)}."
    if found.kind != NAMED:
        return "A better prediction does not make a name of it."
    if held.kind == BY_MODE:
        return (
            "The extended model passes, but its cause was chosen with all modes: measure the structure with a known change, such "
            "as an added mass, hold that out in the deck, and ask again."
        )
    return (
        "The extended model passes. A better prediction is needed for a name to be right; it does not prove it alone."
    )


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


SECTION = Section("diagnosis-answers", 10, "Diagnosis", answers, (Diagnosis,))
