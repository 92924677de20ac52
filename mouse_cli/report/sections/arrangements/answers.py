"""What the model of several configurations lacks, in the order of its identification, in plain sentences."""

from collections.abc import Iterator

from mouse_cli.model.arrangements import ArrangementsDiagnosis
from mouse_cli.report.arrangements_sentences import sentences
from mouse_cli.report.blocks import Block, Heading, Text
from mouse_cli.report.section import VERDICT, Options, Section
from mouse_cli.report.sections._diagnosis_wording import p_value
from mouse_cli.report.sections._field import field_blocks


def answers(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """The verdict, one paragraph a mechanism, what is left, whether it is true."""
    yield from map(Text, sentences(found))
    yield from field_blocks(found.field, found.problem.units)
    if found.refuted:
        yield Text(
            f"Refuted by the configurations held out, which are predicted worse with it than without: {found.refuted}."
        )
    yield Heading("Remainder", 2)
    yield Text(
        f"Chi-square {found.chi2:.1f} on {found.dof}, goodness of fit {p_value(found.p)}. "
        "Sizes with all mechanisms in the model are under Parameters; those above are as each was identified."
    )
    yield Heading("Validated?", 2)
    yield Text(_true(found))


def _true(found: ArrangementsDiagnosis) -> str:
    held = found.held_out
    if held is None:
        return "Not proved: no configuration was held out (`--held-out`)."
    base, after = held.baseline, held.revised
    errors = f"the root mean square error of {len(held.labels)} frequencies is {100 * base.rms_frequency_error:.2g} %"
    seen = "Configurations that no fit has seen"
    if after is None:
        return f"{seen}: {errors}, and {100 * base.covered:.0f} % lie within their 90 % intervals."
    return (
        f"{seen}: {errors} without any mechanism, and {100 * after.rms_frequency_error:.2g} % with all; the log predictive "
        f"density goes from {base.log_predictive_density:.1f} to {after.log_predictive_density:.1f}, and "
        f"{100 * after.covered:.0f} % lie within their 90 % intervals. Parameters and errors of theory are revised in both."
    )


SECTION = Section("arrangements-answers", 10, "Diagnosis", answers, (ArrangementsDiagnosis,), place=VERDICT)
