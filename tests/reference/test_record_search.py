"""Which starts of laws are followed in recordings, on two masses whose records scipy integrates."""

from dataclasses import replace

import numpy as np
import pytest
from two_masses import record

from mouse_cli.diagnosis.likelihoods.history.order import varied, where
from mouse_cli.diagnosis.likelihoods.history.search import _again, _looked
from mouse_cli.formats import read_deck
from mouse_cli.updating.recordings.adequacy import adequate
from mouse_cli.updating.recordings.records import records
from mouse_cli.updating.recordings.study import fitted, study

CUBIC = lambda u, v: 4e9 * (u[1] - u[0]) ** 3 * np.array([-1.0, 1.0])


@pytest.mark.proof
def test_a_law_behind_others_of_its_group_is_followed_where_none_of_them_does(tmp_path):
    """Quadratic stiffness came first at a place, the law of another group elsewhere was next, and the cubic one never was."""
    problem = read_deck(record(tmp_path, CUBIC))
    own = study(problem, records(problem))
    order = varied(_looked(own, own.at, None))
    cubic = next(one for one in order if where(one)[0] == "cubic")
    like = next(one for one in order if where(one) == ("quadratic", where(cubic)[1]))
    near = fitted(own, like)
    assert not adequate(near)
    found = _again(own, [near], order, [one for one in order if where(one)[0] != "cubic"])
    (named,) = [one for one in found if adequate(one)]
    assert where(named) == where(cubic) and abs(np.exp(named.x[-1]) / 4e9 - 1) < 0.05


def _sound(folder, levels):
    """The fit of a sound deck to records of these levels of the force (N), one after the other."""
    read = []
    for level in levels:
        problem = read_deck(record(folder, lambda u, v: np.zeros(2), level=level))
        read += [replace(one, title=f"{level:g} N") for one in problem.recordings]
    problem = replace(problem, recordings=tuple(read))
    return fitted(study(problem, records(problem)), None)


def test_records_of_different_loudness_may_come_in_any_order(tmp_path):
    """States of the louder one were held within those of the first, so that a wrong offset of the force was fitted."""
    quiet, loud = _sound(tmp_path, (10.0, 80.0)), _sound(tmp_path, (80.0, 10.0))
    offset = quiet.hypothesis.offsets
    assert quiet.log_evidence == pytest.approx(loud.log_evidence, abs=1.0)
    np.testing.assert_allclose(quiet.x, loud.x, atol=0.1)
    assert (np.abs(quiet.x[offset]) < 2).all()
