"""Fields over the parts of a model that move: what is as good as held has no share in them, nor in the deck that holds them."""

import numpy as np
import pytest

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.nameless import registry
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

N, HELD = 7, 3  # masses of a chain; the one on ground that is as good as rigid, from 0


def chain():
    """Springs of 1000 N/m from the ground to the first of seven masses and on, one of the masses held by 1e15 N/m."""
    drift = np.eye(N) - np.eye(N, k=-1)
    K = 1000 * drift.T @ drift
    listed = lambda K: ", ".join(f"[{i + 1}, {j + 1}, {K[i, j]:.17g}]" for i, j in np.argwhere(np.triu(K)))
    own = listed(K)
    K[HELD, HELD] += 1e15
    deck = f"""mouse: 1
model: {{stiffness: {{order: {N}, entries: [{listed(K)}]}}, mass: {{identity: {N}}}}}
parameters: [{{name: all, nominal: 1, sd: 3 %, stiffness: [{own}]}}]
test: {{modes: {{frequency: [3.9, 5.0], frequency_sd: 1 %}}}}
"""
    return assemble(yaml_deck.read(deck, "chain.yaml"))


def full(problem) -> tuple[np.ndarray, np.ndarray]:
    """K and M (n, n) of a deck at the means of its parameters."""
    from mouse_cli.model.arrays import dense
    from mouse_cli.terms.assembly import assembly

    return tuple(dense(each) for each in assembly(problem).matrices(problem.prior.mean))


@pytest.mark.parametrize("key", ["force", "field-bed", "field-mass"])
def test_a_deck_holds_the_field_of_what_moves(key):
    """K + b b', K + v k or M + v M of the six that move, and nothing at the one that does not."""
    problem = chain()
    model = reduced(problem, problem.prior.mean)
    cells, moving = registry()[key].cells(model), np.delete(np.arange(N), HELD)
    assert len(cells) == N - 1
    values = np.linspace(0.1, 0.6, N - 1)
    before, after = full(problem), full(cells.extend(problem, values, 1.0, *((1,) if key == "force" else ())))
    into = 1 if key == "field-mass" else 0
    change = (after[into] - before[into])[np.ix_(moving, moving)]
    true = np.outer(values, values) if key == "force" else np.diag(values)
    unit = change[0, 0] / true[0, 0]
    assert unit == pytest.approx(1.0) if key == "field-mass" else unit > 0
    assert np.allclose(change, unit * true, rtol=1e-9, atol=1e-9 * abs(change).max())
    assert (after[into] == before[into])[HELD].all() and np.array_equal(after[1 - into], before[1 - into])
