"""How far a stretch of a line may reach: in a frame all along it, in a line that is the whole structure never so far."""

import pytest

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.formats import read_deck


@pytest.mark.parametrize(("deck", "widest"), [("decks/cantilever.yaml", 0.6), ("decks/garteur_smag19.yaml", 1.0)])
@pytest.mark.parametrize("key", ["stiffness-loss", "stiffness-gain"])
def test_a_stretch_reaches_all_along_one_line_of_several(key, deck, widest):
    problem = read_deck(deck)
    model = reduced(problem, problem.prior.mean)
    widths = [unknown for one in registry()[key].recipes(model, registry()[key]) for unknown in one.unknowns
              if unknown.name == "width over length"]  # fmt: skip
    assert widths and {unknown.upper for unknown in widths} == {widest}
