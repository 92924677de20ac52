"""A law that records show as another one is weighed once."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from mouse_cli.diagnosis.likelihoods.history.shown import once
from mouse_cli.terms.laws import registry
from mouse_cli.updating.recordings.acting import Part


@dataclass
class Found:
    """What `once` reads of a fit."""

    law: str
    site: str
    log_evidence: float
    sd: tuple[float, ...]

    @property
    def recipes(self):
        law, place = registry()[self.law], SimpleNamespace(site=SimpleNamespace(text=self.site), where=self.site)
        unknowns = tuple(SimpleNamespace(name=name) for name in ("stiffness before slip", "slip force")[: len(self.sd)])
        return (Part(place, law, 0, unknowns),)

    @property
    def groups(self):
        return [self.recipes[0].law.seen_as(np.array(self.sd))]


SPRING = Found("spring", "at 3", 50.0, (0.01,))


@pytest.mark.parametrize(
    ("friction", "kept"),
    [
        (Found("friction", "at 3", 46.0, (0.01, 30.0)), False),  # it never slips: the spring again
        (Found("friction", "at 3", 51.5, (0.01, 30.0)), False),  # their ranges differ, and nothing else
        (Found("friction", "at 3", 46.0, (0.01, 0.1)), True),  # its slip is seen
        (Found("friction", "at 2", 46.0, (0.01, 30.0)), True),  # elsewhere nothing else is that spring
        (Found("friction", "at 3", 54.0, (0.01, 30.0)), True),  # the spring does not do as well
    ],
)
def test_friction_that_never_slips_is_weighed_as_the_spring_that_it_is(friction, kept):
    dropped: dict[str, str] = {}
    found = once([SPRING, friction], dropped)
    assert found == ([SPRING, friction] if kept else [SPRING])
    assert ("slip force" in dropped.get("friction", "")) != kept
