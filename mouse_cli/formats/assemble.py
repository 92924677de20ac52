"""A Draft becomes a Problem, or one DeckError with all that is wrong."""

from mouse_cli._errors import WARNING
from mouse_cli._span import Span
from mouse_cli.formats.draft import Draft
from mouse_cli.formats.rules import matrices, modal_test, partials, prior, refusal
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import Structure


def assemble(draft: Draft) -> Problem:
    """Apply the rules to `draft` and build the Problem.

    Raises DeckError with every error found, warnings included, in the order of the file.
    """
    unread = draft.has_errors
    K = matrices.matrix(draft, draft.K, "K")
    M = matrices.matrix(draft, draft.M, "M")
    if not draft.has_errors:
        matrices.positive_masses(draft, M)
    elements = partials.elements(draft)
    A = partials.partials(draft)
    believed = prior.prior(draft)
    test = modal_test.modal_test(draft)
    matrices.total_mass_dofs(draft)
    if draft.has_errors:
        raise refusal(draft, unread)
    return Problem(
        title=draft.title,
        structure=Structure(K, M, draft.labels),
        elements=elements,
        A=A,
        parameters=tuple(draft.parameters),
        prior=believed,
        test=test,
        run=draft.run,
        source=draft.source,
        warnings=tuple(d for d in draft.diagnostics if d.severity == WARNING),
        places=_places(draft),
    )


def _places(draft: Draft) -> dict[str, Span]:
    """Where the things stand that only a run can judge."""
    found = {"order": draft.where_order, "estimator": draft.where_estimator}
    if draft.test is not None:
        found |= {f"mode {number}": draft.test.where_number(i) for i, number in enumerate(draft.test.number.tolist())}
    return {key: span for key, span in found.items() if span is not None}
