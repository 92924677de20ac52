"""The rules that every deck obeys, whatever its format; one file for each part of a deck."""

from mouse_cli._errors import ERROR, DeckError
from mouse_cli.formats.draft import Draft, Entries
from mouse_cli.formats.rules import matrices, mesh, modal_test, partials, prior


def review(draft: Draft) -> DeckError:
    """The error for a draft with gaps: what its reader found, and what the rules find in the parts that are there."""
    prior.prior(draft)
    mesh.mesh(draft)
    if draft.order:
        for name, source in (("K", draft.K), ("M", draft.M), ("C", draft.C), ("D", draft.D)):
            if isinstance(source, Entries):
                matrices.matrix(draft, source, name)
        partials.elements(draft)
        if draft.mesh is None:
            modal_test.modal_test(draft)
    return refusal(draft, unread=True)


def refusal(draft: Draft, unread: bool) -> DeckError:
    """The error with all that was found, in the order of the file.

    unread: something could not be read and seems to be missing; remarks on that would only mislead.
    """
    reported = [
        d for d in draft.diagnostics if d.severity == ERROR or not (unread and d.code.startswith(("MD3", "MD4")))
    ]
    return DeckError(sorted(reported, key=lambda d: (d.span.line, d.span.column) if d.span else (0, 0)))
