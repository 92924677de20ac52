"""A lumped mass and mass along bars that cover its place: forms of one added mass, where the lumped one is the more probable."""

from dataclasses import dataclass

import pytest
from made_up_rankings import ranked

from mouse_cli.diagnosis.search.spread import with_forms
from mouse_cli.model.diagnosis import EVERYWHERE, Site


@dataclass(frozen=True)
class Made:
    """A fit of mechanisms of those groups at those sites."""

    groups: tuple[str, ...]
    sites: tuple[Site, ...]
    elsewhere: tuple = ()
    taken: tuple[str, ...] = ()
    recipes: tuple = (None,)
    nameless: None = None


LUMPED = Made(("mass",), (Site("element", (5,)),))
ALONG = Made(("added-mass",), (Site("element", (4, 5, 6)),))
NONE = Made((), (), recipes=())
ASIDE = Made(("added-mass",), (Site("element", (7, 8)),))
FOOT = Site("node", (1,))


@pytest.mark.parametrize(
    ("fits", "taken"),
    [
        ((LUMPED, ALONG), ("mass",)),
        ((ALONG, LUMPED), ()),  # what is shown to be spread is not lumped
        ((LUMPED, ASIDE), ()),
        ((LUMPED, Made(("added-mass",), (EVERYWHERE,))), ()),
        ((LUMPED, Made(("added-mass",), ALONG.sites, ((ASIDE, 0.04),))), ("mass",)),
        ((LUMPED, Made(("added-mass",), ALONG.sites, ((ASIDE, 0.06),))), ()),
        ((LUMPED, Made(("added-mass", "support"), (*ALONG.sites, FOOT))), ()),
        (
            (
                Made(("mass", "support"), (*LUMPED.sites, FOOT)),
                Made(("support", "added-mass"), (FOOT, *ALONG.sites)),
            ),
            ("support", "mass"),
        ),
    ],
)
def test_mass_along_bars_is_a_form_of_the_lumped_mass_that_it_covers(fits, taken):
    found = with_forms(ranked(*fits, NONE, p=(0.6, 0.38, 0.02))).fits
    along = next(one for one in found if "added-mass" in one.groups)
    assert along.taken == taken
    assert all(one.taken == () for one in found if one is not along)
