"""Physics without a name in words: what it acts on, where most of it is, what it gains."""

from collections.abc import Sequence
from math import log1p

from mouse_cli.model.diagnosis import AXIAL, BED, COMPLIANCE, FORCE, LAW, MASS, STIFFNESS, Field, FieldValue, HeldOut
from mouse_cli.report.sections._diagnosis_wording import nats, place

ACTS = {
    STIFFNESS: "acts on the stiffness",
    MASS: "acts on the mass",
    BED: "acts as a bed, a stiffness from the structure to the ground",
    AXIAL: "acts as an axial force of bars, a pull where it is positive",
    FORCE: "acts as one spring along a motion of the whole structure",
    COMPLIANCE: "acts as one flexible joint: the whole structure can make a motion that the model does not let it make",
    LAW: "acts at one site, by a law that is in no library",
}
UNITS = {
    STIFFNESS: "per cent",
    MASS: "per cent",
    BED: "EI/L^4",
    AXIAL: "EI/L^2",
    FORCE: "of that motion",
    COMPLIANCE: "of that motion",
    LAW: "of the static stiffness there",
}  # of values as they are printed
_LOST = -0.99  # share that a part loses at most, to be compared with others
_MOST = 0.5  # of the largest value: neighbours above it belong to where most of the field is
_TOGETHER = "By all hypotheses together, each with its probability,"


def field_sentences(field: Field, what: str = "What is missing") -> tuple[str, ...]:
    """What is missing, and that it has no name; what: the subject of the first sentence."""
    besides = "" if field.beside is None else f" A second change is there with it. It {field_acts(field.beside)}."
    lead = f"{what} has no name in the library. It {field_acts(field)}.{besides}"
    return (
        lead,
        " ".join(filter(None, (_over(field.log_evidence_over_named), held_words(field.held_out)))),
        "Do not trust the revised parameters, and do not name a mechanism.",
    )


def field_acts(field: Field) -> str:
    """On what it acts, and where, as the predicate of a sentence."""
    if field.property == LAW:
        return _law(field)
    return _spring(field) if one_spring(field) else f"{ACTS[field.property]}{_most(field)}"


def _over(log_evidence: float) -> str:
    """How it compares with the best of what has a name, which may be more probable, but inadequate.

    >>> print(_over(19.3), _over(-97.7), sep="\\n")
    Its log evidence is 19.3 above that of everything that has a name.
    Its log evidence is 97.7 below that of the best that has a name, which is rejected.
    """
    if log_evidence < 0:
        beside = f"{nats(-log_evidence)} below that of the best that has a name, which is rejected"
    else:
        beside = f"{nats(log_evidence)} above that of everything that has a name"
    return f"Its log evidence is {beside}."


def factor(field: Field) -> float:
    """By which values are multiplied where they are printed."""
    return 100.0 if UNITS[field.property] == "per cent" else 1.0


def amount(field: Field, value: float) -> str:
    """A value or a standard deviation with its unit.

    >>> amount(Field(STIFFNESS, (), 0.1, 1.0, "m", 9.0), -0.2345), amount(Field(BED, (), 0.1, 1.0, "m", 9.0), 12.345)
    ('-23 %', '12 EI/L^4')
    """
    unit = UNITS[field.property]
    return f"{factor(field) * value:.2g} {'%' if unit == 'per cent' else unit}"


def significant(field: Field) -> list[FieldValue]:
    """Values that differ from 0 by more than two standard deviations, in their order; the largest where none does."""
    return [each for each in field.values if each.shown] or sorted(field.values, key=lambda each: -abs(each.value))[:1]


def core(values: Sequence[FieldValue], shares: bool) -> tuple[int, int, int]:
    """First, largest and last of the neighbours, of one sign, that have more than half of the largest value, of those that tell.

    shares: of a whole, of which the largest is by its logarithm: what lost 78 % has changed by more than what gained 88 %.

    >>> from mouse_cli.model.site import Site
    >>> core([FieldValue(Site("element", (i,)), x, 0.01) for i, x in enumerate((0.0, -0.2, -0.3, -0.1, 0.35))], True)
    (1, 2, 2)
    """
    size = [abs(log1p(max(each.value, _LOST))) if shares else abs(each.value) for each in values]
    telling = [i for i, each in enumerate(values) if each.shown] or range(len(values))
    top = max(telling, key=lambda i: size[i])
    belongs = lambda i: values[i].value * values[top].value > _MOST * values[top].value ** 2
    first, last = top, top
    while first > 0 and belongs(first - 1):
        first -= 1
    while last < len(values) - 1 and belongs(last + 1):
        last += 1
    return first, top, last


def one_spring(field: Field) -> bool:
    """Whether it is a spring between two sites, or against the turn of one."""
    return field.property == FORCE and len(field.values) < 3


def _spring(field: Field) -> str:
    """Where one spring ends."""
    sites = [place(each.site) for each in field.values]
    where = f"between {' and '.join(sites)}" if len(sites) > 1 else f"against the turn of {sites[0]}"
    return f"acts as one spring {where}, which no mechanism of the library is"


def _law(field: Field) -> str:
    """Where a law acts, and its values at the frequencies of the modes that tell."""
    where = field.values[0].site.text.rpartition(", mode ")[0]
    each = [f"{v.value:.3g} (sd {v.sd:.2g}) in mode {v.site.text.rpartition(', mode ')[2]}" for v in significant(field)]
    return f"acts at {where}, by a law that is in no library: {', '.join(each)}, {UNITS[LAW]}"


def _most(field: Field) -> str:
    """Where most of it is, if it is anywhere more than its uncertainty.

    >>> from mouse_cli.model.site import Site
    >>> _most(Field(STIFFNESS, (FieldValue(Site("element", (4,)), 2e-10, 0.055),), 0.1, 1.0, "m", 9.0))
    ', but nothing shows where: no value differs from 0 by more than two standard deviations'
    """
    if not field.values:
        return ""
    if not any(each.shown for each in field.values):
        return ", but nothing shows where: no value differs from 0 by more than two standard deviations"
    first, top, last = core(field.values, field.property in (STIFFNESS, MASS))
    largest = field.values[top]
    sized = f"{amount(field, largest.value)}, sd {amount(field, largest.sd)}"
    begin, end = (field.values[i].site for i in (first, last))
    if first == last:
        return f", most of it at {place(begin)} ({sized})"
    plain = begin.kind == end.kind and all(
        len(s.ids) == 1 and s.text in ("", f"{s.kind} {s.ids[0]}") for s in (begin, end)
    )
    about = f"{begin.kind} {begin.ids[0]} to {end.ids[0]}" if plain else f"{place(begin)} to {place(end)}"
    return f", most of it about {about} ({sized} at {place(largest.site)})"


def held_words(held: HeldOut | None) -> str:
    """How all hypotheses together predict what no fit has seen; empty without such data."""
    if held is None or held.revised is None:
        return ""
    before, after = held.baseline, held.revised
    density = (
        f"the log predictive density from {before.log_predictive_density:.1f} to {after.log_predictive_density:.1f}"
    )
    if before.rms_frequency_error != before.rms_frequency_error:
        return f"{_TOGETHER} {density.replace('from', 'of held-out data goes from', 1)}."
    errors = f"from {100 * before.rms_frequency_error:.2g} % to {100 * after.rms_frequency_error:.2g} %"
    if not after.rms_frequency_error > before.rms_frequency_error:
        return f"{_TOGETHER} the rms frequency error of held-out data goes {errors}, and {density}."
    wider = ", as less accuracy is claimed" if after.log_predictive_density > before.log_predictive_density else ""
    return f"{_TOGETHER} held-out data are predicted no better: their rms frequency error goes {errors}, and {density}{wider}."
