"""What a law counts as, and a field that no deck can hold."""

import sys
from types import SimpleNamespace

import pytest
from made_up_rankings import made_up, ranked

import mouse_cli.diagnosis.diagnose  # noqa: F401  the name in the package is that of its function
from mouse_cli._errors import NumericalError
from mouse_cli.diagnosis.search import rank
from mouse_cli.model.diagnosis import LAW

DIAGNOSE = sys.modules["mouse_cli.diagnosis.diagnose"]


@pytest.mark.parametrize(("suffices", "counted"), [(True, 0.9), (False, 0.8)])
def test_a_law_counts_as_the_oscillator_at_its_site(monkeypatch, suffices, counted):
    monkeypatch.setattr(rank, "_suffices", lambda known, *given: suffices and known.groups == ["oscillator"])
    fits = made_up("oscillator@0.4"), made_up(nameless=LAW, even="ground-spring"), made_up()
    groups = dict(ranked(*fits, p=(0.8, 0.1, 0.1)).groups)
    assert groups["oscillator"] == pytest.approx(counted)
    assert groups.get(LAW, 0.0) == pytest.approx(0.9 - counted, abs=1e-12)


def test_a_deck_without_masses_is_left_out_with_a_word(monkeypatch):
    """The mean of fields of which each leaves a mass at every place may leave none."""

    def unphysical(deck):
        raise NumericalError([])

    monkeypatch.setattr(DIAGNOSE, "extended", lambda problem, put: SimpleNamespace())
    monkeypatch.setattr(DIAGNOSE, "related", unphysical)
    deck, kept, said = DIAGNOSE._extended(SimpleNamespace(), SimpleNamespace())
    assert deck is None and kept is None and "no deck with the change in it" in said[0]
