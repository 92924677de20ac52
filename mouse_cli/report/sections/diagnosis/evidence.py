"""The evidence of a diagnosis: detection, candidates, localisation, and what to measure next."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import NOTHING, UNKNOWN, Diagnosis, Effort, Explanation
from mouse_cli.report.blocks import Block, Cell, Heading, Table, Text, heads
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._diagnosis_wording import (
    log_evidence_over_none,
    nats,
    p_value,
    place,
    probable,
    separation,
    where,
)
from mouse_cli.report.sections._field import untried_text
from mouse_cli.report.sections._wording import counted, test_table

_LEAST = 1e-3  # probability of explanations that are listed; a few are, however improbable
_EVIDENCE_MOST = 30  # of them
_ALWAYS = 8
_COUNTS, _FEW = 0.01, 5  # the same of a short report
_JUDGED = heads("<candidate | <group | <site | log evidence over none | probability | p-value")
_SIZED = heads("<candidate | <parameter | value | sd | <unit | range from | to")


def evidence(found: Diagnosis, options: Options) -> Iterator[Block]:
    """One line for each explanation, in the order of `Diagnosis.listed`; then the parameters of their mechanisms."""
    if not found.explanations:
        yield Text("No candidate has a meaning for this model.")
        yield from untried_text(found.untried)
        return
    if options.short:
        yield _brief(found)
        return
    likely = sum(one.probability >= _LEAST for one in found.explanations)
    shown = found.listed[: min(max(likely, _ALWAYS), _EVIDENCE_MOST)]
    yield Table(_JUDGED, tuple(_judged(found, one) for one in shown)).without_empty_columns()
    more = len(found.explanations) - len(shown)
    rest = f" {more} less probable ones are left out; --json has all." if more else ""
    yield Text(
        "The log evidence is the logarithm of how many times more probable the data are with the candidate than with none (the "
        f"Bayes factor). {_probability(found)} The p-value is that of the misfit which the candidate leaves, blank where it has as "
        "many parameters as there are data." + rest
    )
    yield from untried_text(found.untried)
    rows = tuple(row for one in shown for row in _sized(one))
    if rows:
        yield Heading("Sizes", 2)
        yield Table(_SIZED, rows, keys=2)


def _brief(found: Diagnosis) -> Table:
    """The most probable explanations; the others are folded."""
    likely = sum(one.probability >= _COUNTS for one in found.explanations)
    rows = tuple(_judged(found, one) for one in found.listed)
    rest = "" if found.kind == UNKNOWN else f"of probability below {_COUNTS:g}"
    table = Table(_JUDGED, rows, kept=_FEW if found.kind == UNKNOWN else max(likely, 2), rest=rest)
    return table.without_empty_columns()


def _probability(found: Diagnosis) -> str:
    if found.kind == UNKNOWN:
        return "No probability is given, as no candidate explains the data."
    return (
        "The probability is that of the hypothesis among all that were tried, none included, with equal prior shares for groups "
        "that data can hardly distinguish."
    )


def _judged(found: Diagnosis, one: Explanation) -> tuple[Cell, ...]:
    misfit = probable(float(one.p)) if one.dof > 0 else None
    probability = None if found.kind == UNKNOWN else probable(one.probability)
    laws = ", ".join(cause.law for cause in one.causes if cause.law)
    name = f"{one.physics} ({laws})" if laws else one.physics
    return name, one.group, where(one), nats(log_evidence_over_none(found, one)), probability, misfit


def _sized(one: Explanation) -> Iterator[tuple[Cell, ...]]:
    for cause in one.causes:
        for size in cause.sizes:
            name = f"{cause.physics}: {size.name}" if len(one.causes) > 1 else size.name
            value, sd, lower, upper = (f"{x:.4g}" for x in (size.value, size.sd, size.lower, size.upper))
            yield one.physics, name, value, sd, size.unit, lower, upper


EFFORTS = {
    Effort.MODES: "a wider band",
    Effort.SENSOR: "one sensor",
    Effort.SHAPES: "a few sensors",
    Effort.MASS: "an added mass",
    Effort.SUPPORT: "a changed support",
}
_COLUMNS = heads("<measurement | <takes | <between | separation | <outlook")


def proposals(found: Diagnosis, options: Options) -> Iterator[Block]:
    """Rivals, and the measurements that would separate them. One line a measurement; nothing where there is none."""
    if not found.proposals:
        return
    rows = (
        (p.text, EFFORTS[p.effort], " and ".join(p.between), separation(p.separation), p.outlook)
        for p in found.proposals
    )
    yield Table(_COLUMNS, rows)
    yield Text(
        "First what separates the two most probable: decisive measurements of least effort first. Separation is "
        "half the squared distance of what the two predict, over what is uncertain in both and in the measurement: above 4 it will "
        "settle it, below 1 it will not. It is predicted to first order, with accuracies like those of this test."
    )


def detection(found: Diagnosis, options: Options) -> Iterator[Block]:
    """The three tests of `run`, and what the noise had to be raised to."""
    result = found.result
    yield test_table((found.innovation, result.residual, result.prior_shift))
    yield Text(f"The model as it is: {result.status.sentence} Form of the model: {result.model_form}.")
    if found.noise_scale > 1 and found.kind != NOTHING:
        yield Text(
            f"The best explanation leaves {found.noise_scale:.3g} times the variance that the test states, and the evidence is "
            "computed with variances larger by that factor. Far above 1, the test is less accurate than stated, or the explanation "
            "is incomplete."
        )


_PLACES_MOST = 15  # sites listed
TIE = 3.0  # nats below the best within which sites are tied


def places(found: Diagnosis, options: Options) -> Iterator[Block]:
    """The most probable sites; nothing where none was looked for."""
    location = found.location
    if location is None or not location.places:
        return
    columns = heads("<site | <channel | probability | log evidence below the best")
    shown = location.places[:_PLACES_MOST]
    yield Table(columns, tuple((place(p.site), p.channel, probable(p.probability), nats(p.deficit)) for p in shown))
    tied, region = sum(p.deficit <= TIE for p in location.places), location.region
    left = "that leaves much more than noise: no single site is it"
    if location.single:
        left = f"the goodness of fit of the best is {p_value(location.p)}"
    yield Text(
        "One force that the model lacks, whatever its law, would make the measured shapes if it acted there. Of "
        f"{counted(len(location.places), 'site')} that were tried, {region} {'holds' if region == 1 else 'hold'} 90 % of the "
        f"probability, and {tied} {'lies' if tied == 1 else 'lie'} within {TIE:g} in log evidence of the "
        f"best, which the shapes hardly distinguish; {left}."
    )


_ENERGY_MOST = 10  # places listed


def energy(found: Diagnosis, options: Options) -> Iterator[Block]:
    """The places with the largest shares; nothing where none was computed."""
    energy = found.energy
    if energy is None:
        return
    shown = energy.order[:_ENERGY_MOST]
    columns = heads("<site | share [per cent]")
    yield Table(columns, tuple((place(energy.sites[i]), f"{100 * energy.share[i]:.3g}") for i in shown))
    errors = ", ".join(
        f"{100 * error:.2g} % in mode {mode}" for mode, error in zip(energy.mode, energy.error, strict=True)
    )
    holds = "site" + (" holds" if energy.half == 1 else "s hold")
    yield Text(
        f"Of the energy by which stresses and strains disagree when the measured shapes are imposed on the model as it is, "
        f"{energy.half} {holds} half, of {len(energy.sites)}: few for a local mechanism, many for a distributed one. It "
        f"shows all that is missing as if it were stiffness. Relative to the strain energy: {errors}."
    )


SECTIONS = (
    Section("diagnosis-evidence", 40, "Evidence", evidence, (Diagnosis,), place=RESULT),
    Section("diagnosis-next", 50, "Next measurement", proposals, (Diagnosis,), place=RESULT),
    Section("diagnosis-detection", 30, "Model against test", detection, (Diagnosis,)),
    Section("diagnosis-places", 60, "Localisation", places, (Diagnosis,)),
    Section("diagnosis-energy", 65, "Energy of the disagreement", energy, (Diagnosis,)),
)
