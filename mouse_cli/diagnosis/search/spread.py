"""Mass along bars that covers the place of a lumped mass: one added mass in two forms, where the data do not tell them apart.

Of a column that sways as a whole they feel how much mass it carries, and hardly along how much of it.
"""

from dataclasses import replace

from mouse_cli.diagnosis.gates import SURE
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.rank import Ranking

_LUMPED, _ALONG = "mass", "added-mass"  # groups


def with_forms(ranking: Ranking) -> Ranking:
    """The ranking with each mass along bars in the group of a more probable lumped mass that it covers, beside the same others.

    A lumped mass is none of the forms of a mass along bars that is more probable: what is shown to be spread is not lumped.
    """
    fits = ranking.fits
    return replace(ranking, fits=tuple(_taken(one, fits[:i]) for i, one in enumerate(fits)))


def _taken(one: Fit, before: tuple[Fit, ...]) -> Fit:
    """`one`, its groups those that it has with a lumped mass in place of one along bars, where a fit `before` has these."""
    for i in (i for i, group in enumerate(one.groups) if group == _ALONG):
        groups = (*one.groups[:i], _LUMPED, *one.groups[i + 1 :])
        if any(sorted(each.groups) == sorted(groups) and _covered(one, i, each) for each in before):
            return replace(one, taken=groups)
    return one


def _covered(along: Fit, i: int, lumped: Fit) -> bool:
    """Whether the bars of mechanism number i hold the element of a lumped mass, wherever they are as surely as a name takes."""
    parts = zip(lumped.sites, lumped.groups, strict=True)
    places = [set(site.ids) for site, group in parts if group == _LUMPED and site.kind == "element"]
    holds = lambda each: any(ids <= set(each.sites[i].ids) for ids in places)
    return holds(along) and 1 - sum(share for each, share in along.elsewhere if not holds(each)) >= SURE
