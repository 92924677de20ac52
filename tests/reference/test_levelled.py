"""What is named must stand whether groups are equally probable beforehand, or places are."""

from types import SimpleNamespace

import numpy as np
import pytest
from made_up_rankings import made_up

from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.levelled import levelled


def placed(group: str, places: int, **more):
    """A fit of one mechanism that could be at so many places."""
    one = made_up(group, **more)
    one.recipes[0].log_prior, one.recipes[0].seldom = -np.log(places), 0.0
    one.model.width = np.ones(1)
    one.log_places = log_places(one)
    return one


log_places = Fit.log_places.fget


def test_a_support_of_twelve_is_not_told_from_a_member_of_seven_hundred_by_their_numbers():
    """As well explained, it has 58 times the probability of the other by groups, and as much by places."""
    fits = [placed("support", 12), placed("member", 696), made_up()]
    p = np.array([1 / 12, 1 / 696, 0.0])
    p[:2] *= 0.9 / p.sum()
    p[2] = 0.1
    found = levelled(p, fits)
    assert found[2] == 0.1 and found.sum() == pytest.approx(1)
    np.testing.assert_allclose(found[:2], 0.5 * p[:2] + 0.5 * 0.45)


def test_what_is_seldom_stays_so_wherever_it_may_be():
    """A stiffer spring of four has a tenth of the prior of a softer one of four, by places too."""
    fits = [placed("local-stiffness", 4), placed("added-stiffness", 4)]
    fits[1].recipes[0].log_prior, fits[1].recipes[0].seldom = np.log(0.1 / 4), np.log(0.1)
    fits[1].log_places = log_places(fits[1])
    p = np.array([10 / 11, 1 / 11])
    np.testing.assert_allclose(levelled(p, fits), p)


def test_what_the_data_tell_apart_stays_so():
    fits = [placed("support", 12), placed("member", 696)]
    found = levelled(np.array([1 - 1e-6, 1e-6]), fits)
    assert found[0] > 0.9999


def test_sets_of_equally_many_share_among_themselves_and_what_has_no_name_keeps_its_own():
    pair = made_up("support", "member")
    pair.model.width = np.ones(2)
    for one in pair.recipes:
        one.log_prior, one.seldom = -1.0, 0.0
    pair.log_places = log_places(pair)
    fits = [placed("support", 2), pair, made_up(nameless="field-stiffness")]
    p = np.array([0.5, 0.3, 0.2])
    np.testing.assert_allclose(levelled(p, fits), p)
    np.testing.assert_array_equal(levelled(np.array([0.0, 0.0, 1.0]), fits), [0, 0, 1])


def test_a_place_along_a_line_is_one_of_as_many_as_fit_in():
    """Its range over sd and root of 2 pi, as a uniform prior of sd-wide places has it; a size is no place."""
    one = placed("crack", 1, covariance=np.diag([1.0, 1.0, 0.01**2]))
    assert one.log_places == 0.0
    one.recipes[0].unknowns = (SimpleNamespace(name="place"),)
    assert log_places(one) == pytest.approx(np.log(100 / np.sqrt(2 * np.pi)))
