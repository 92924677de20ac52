"""Rules for laws of local forces: each has its own sizes, and acts on one or two degrees of freedom of this model."""

from mouse_cli.formats.draft import Draft, LawDraft
from mouse_cli.model.geometry import Geometry
from mouse_cli.model.local_law import LocalLaw
from mouse_cli.terms.laws import registry


def laws(draft: Draft, geometry: Geometry | None) -> tuple[LocalLaw, ...]:
    """All of a deck that break no rule."""
    labels = draft.labels if geometry is None else geometry.labels()
    found = [_law(draft, each, list(labels)) for each in draft.laws]
    return tuple(one for one in found if one is not None)


def _law(draft: Draft, each: LawDraft, labels: list[str]) -> LocalLaw | None:
    law = registry()[each.law]
    sizes = law.sizes
    if set(each.values) != set(sizes):
        message = f"law {law.key} has the sizes {', '.join(sizes)}; the deck gives {', '.join(each.values) or 'none'}"
        return draft.error("MD641", message, each.where, help="give each of them once, and no other")
    variant = each.variant or law.words[0]
    if variant not in law.words:
        message = f"law {law.key} has no variant '{variant}'; it has {', '.join(law.words)}"
        return draft.error("MD641", message, each.where, help="give one of them, or none")
    if not all(value > 0 for value in each.values.values()):
        return draft.error(
            "MD641", f"sizes of law {law.key} must be positive", each.where, help="its variant gives the sign"
        )
    dofs = tuple(_dof(draft, each, text, labels) for text in each.dofs)
    if None in dofs:
        return None
    if not 1 <= len(dofs) <= 2 or len(set(dofs)) < len(dofs):
        message = f"law {law.key} acts on {len(dofs)} degrees of freedom, {', '.join(each.dofs)}; expected one, or two different"
        return draft.error("MD641", message, each.where, help="give at: [one] or at: [one, other]")
    if len(dofs) < law.motions:
        message = f"law {law.key} couples {law.motions} degrees of freedom; the deck gives {', '.join(each.dofs)}"
        return draft.error("MD641", message, each.where, help="give at: [one, other]")
    return LocalLaw(law.key, variant, dofs, {sizes[key]: value for key, value in each.values.items()})


def _dof(draft: Draft, each: LawDraft, text: str, labels: list[str]) -> int | None:
    if text in labels:
        return labels.index(text)
    if text.isdecimal() and 1 <= int(text) <= draft.order:
        return int(text) - 1
    message = f"law {each.law} acts at '{text[:40]}', which is no degree of freedom of the model"
    return draft.error("MD641", message, each.where, help="give a number from 1, or a label such as 12TY")
