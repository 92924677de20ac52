"""A Draft becomes a Problem, or one DeckError with all that is wrong."""

from dataclasses import replace

import numpy as np

from mouse_cli._errors import WARNING
from mouse_cli._span import Span
from mouse_cli.formats.draft import Draft
from mouse_cli.formats.rules import (
    hold_out,
    hold_out_records,
    laws,
    matrices,
    modal_test,
    model,
    partials,
    plausible,
    prior,
    records,
    refusal,
)
from mouse_cli.model.geometry import Geometry
from mouse_cli.model.problem import Problem


@np.errstate(all="ignore")  # what numbers of a deck make that are not finite is found by the rules
def assemble(draft: Draft) -> Problem:
    """Apply the rules to `draft` and build the Problem.

    Raises DeckError with every error found, warnings included, in the order of the file.
    """
    draft, unread = replace(draft), draft.has_errors  # the rules set what only the model can tell
    found = model.model(draft)
    elements, A = partials.elements(draft), partials.partials(draft)
    believed = prior.prior(draft)
    geometry = found[0].geometry if found else None
    test, held, frf, recordings, kept = _measured(draft, geometry)
    acting = laws.laws(draft, geometry) if draft.order else ()
    matrices.total_mass_dofs(draft)
    plausible.plausible(draft)
    if draft.has_errors:
        raise refusal(draft, unread)
    return Problem(
        title=draft.title,
        structure=found[0],
        elements=elements,
        A=A,
        parameters=tuple(draft.parameters),
        prior=believed,
        test=held.fitted if held else test,
        run=draft.run,
        source=draft.source,
        warnings=tuple(d for d in draft.diagnostics if d.severity == WARNING),
        places=_places(draft),
        terms=found[1],
        **({"mesh": draft.mesh.mesh, "bindings": tuple(draft.mesh.bindings)} if draft.mesh else {}),
        hold_out=held,
        frf=frf,
        recordings=recordings,
        held_records=kept,
        laws=acting,
        **{name: getattr(draft, name) for name in ("units", "modal_damping", "theory", "held", "groups")},
    )


def _measured(draft: Draft, geometry: Geometry | None) -> tuple:
    """The modal test and what of it is held out; functions and recordings, and what of them is."""
    test = modal_test.modal_test(draft, geometry) if draft.order else None
    held = hold_out.hold_out(draft, test, geometry)
    frf, recordings = records.records(draft, geometry) if draft.order else ((), ())
    return test, held, *hold_out_records.divided(draft, frf, recordings)


def _places(draft: Draft) -> dict[str, Span]:
    """Where the things stand that only a run can judge."""
    found = {"order": draft.where_order, "estimator": draft.where_estimator, "theory": draft.where_theory}
    if draft.test is not None:
        found |= {f"mode {number}": draft.test.where_number(i) for i, number in enumerate(draft.test.number.tolist())}
    found |= {f"recording '{each.recording.title}'": each.where for each in draft.recordings}
    return {key: span for key, span in found.items() if span is not None}
