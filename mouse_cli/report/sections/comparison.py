"""What the report says of methods of updating side by side."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.updated import ASPECTS, Compared, Updated
from mouse_cli.report.blocks import Block, Column, Heading, Table, Text, heads
from mouse_cli.report.section import RESULT, VERDICT, Options, Section
from mouse_cli.report.sections._wording import LEFT, counted, deck_table
from mouse_cli.report.sections.update import cleared


def verdict(found: Compared, options: Options) -> Iterator[Block]:
    """Best prediction, then the methods without remarks."""
    errors = {update.about.key: _predicted(update) for update in found.updates}
    known = {key: error for key, error in errors.items() if np.isfinite(error)}
    if known:
        best = min(known, key=known.__getitem__)
        yield Text(f"Least error of predicted frequencies, rms over all configurations: {best}, {known[best]:.3g} %.")
    else:
        yield Text("Nothing was held out: agreement with the modes that were fitted does not rank the methods.")
    sound = [update.about.key for update in found.updates if not update.warnings]
    if sound:
        yield Text(f"No objection to the answers of {', '.join(sound)}.")
    else:
        yield Text(f"There is an objection to the answer of each of {len(found.updates)} methods: see the remarks.")


def _predicted(update: Updated) -> float:
    """Root mean square frequency error in per cent of what was held out; NaN without."""
    held = [np.atleast_1d(one.revised_hz / one.test_hz - 1) for one in update.configurations if not one.fitted]
    off = np.concatenate(held) if held else np.array([np.nan])
    return float(100 * np.sqrt(np.mean(off**2)))


def frequencies(found: Compared, options: Options) -> Iterator[Block]:
    """For each configuration a table: test, prior model, methods; the last line is the root mean square difference."""
    columns = heads("mode | test [Hz] | prior [Hz]", *(Column(update.about.key, "Hz") for update in found.updates))
    for i, first in enumerate(found.updates[0].configurations):
        each = [update.configurations[i] for update in found.updates]
        yield Heading(
            f"{'Fitted modes' if first.fitted else first.title}, {'used' if first.fitted else 'not used'} by the methods",
            2,
        )
        rows = [
            (number, *(v[k] for v in (first.test_hz, first.prior_hz, *(one.revised_hz for one in each))))
            for k, number in enumerate(first.number)
        ]
        before = float(100 * np.sqrt(np.mean((first.prior_hz / first.test_hz - 1) ** 2)))
        rows.append(
            ("off, %", None, *(float(f"{cleared(off):.3g}") for off in (before, *(one.rms_percent for one in each))))
        )
        yield Table(columns, rows, keys=3)
    yield Text(
        "Off: root mean square difference from the test. A blank is a mode that the model does not have. Modes are paired by shape "
        "where shapes were measured, else by number."
    )


def remarks(found: Compared, options: Options) -> Iterator[Block]:
    """What each method's answer is not to be trusted for. One paragraph a method."""
    for update in found.updates:
        if options.short and not update.warnings:
            continue
        text = "; ".join(f"{remark.code}: {remark.message}" for remark in update.warnings)
        yield Text(f"{update.about.key}: {text or 'no remarks'}.")


def heading(found: Compared, options: Options) -> Iterator[Block]:
    """Heading of a comparison of methods: program, deck, and which methods there are."""
    yield deck_table(found.problem)
    test = found.problem.test
    if test is not None:
        yield Text(
            f"Each method was given {counted(test.m, 'measured mode')} at {counted(test.s, 'sensor')}, and predicts the held-out "
            "data."
        )
    columns = heads("<method | <name | iterations | <settled")
    rows = [(u.about.key, u.about.title, u.iterations, "yes" if u.converged else "no") for u in found.updates]
    yield Table(columns, rows)
    for key, why in found.refused.items():
        yield Text(f"{key} has no answer: {why[0].code}: {why[0].message}.")


def guarantees(found: Compared, options: Options) -> Iterator[Block]:
    """Guarantees, one line a method; then what can be counted in its answer."""
    columns = Column("method", align=LEFT), *(Column(aspect, align=LEFT) for aspect in ASPECTS)
    yield Table(columns, tuple((u.about.key, *(g.given for g in u.about.guarantees)) for u in found.updates))
    counted = heads(
        "<method | negative eigenvalues | rigid-body modes | of | new elements in K | force left [of inertia]"
    )
    rows = [
        (u.about.key, u.checked.negative, u.checked.rigid, u.checked.rigid_before, u.checked.filled, u.checked.misfit)
        for u in found.updates
    ]
    yield Table(counted, rows)
    yield Text(
        "Force left: the largest |(K - lambda M) x| of a fitted mode x over |lambda M x|, by the energy of such forces."
    )


SECTIONS = (
    Section("comparison-verdict", 10, "Comparison of methods of updating", verdict, (Compared,), place=VERDICT),
    Section("comparison-frequencies", 30, "Frequencies", frequencies, (Compared,), place=RESULT),
    Section("comparison-remarks", 40, "Remarks", remarks, (Compared,), place=RESULT),
    Section("comparison-heading", 10, "Methods", heading, (Compared,)),
    Section("comparison-guarantees", 20, "What the methods guarantee, and what came of it", guarantees, (Compared,)),
)
