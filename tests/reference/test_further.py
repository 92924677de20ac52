"""A second mechanism is looked for where what the first one leaves could be chance, and could be the second one as well."""

import numpy as np
from scipy.linalg import eigh

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search.rank import rank
from mouse_cli.formats import read_deck
from mouse_cli.updating.chi_square import upper_tail

N = 10


def _problem(folder, spring: float):
    """A row of springs of 1 N/m and masses of 1 kg; its test is that of one with 1.3 kg at 4 and a spring to the ground at 1."""
    K = 2 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1)
    true, M = K.copy(), np.eye(N)
    true[0, 0] += spring
    M[3, 3] += 0.3
    eigenvalues, X = eigh(true, M)
    rng = np.random.default_rng(6)
    hz = np.sqrt(eigenvalues) / (2 * np.pi) * (1 + 0.002 * rng.standard_normal(N))
    shapes = X + 0.01 * rng.standard_normal((N, N))
    entries = [[i + 1, j + 1, float(K[i, j])] for i in range(N) for j in range(i, N) if K[i, j]]
    (folder / "deck.yaml").write_text(f"""\
mouse: 1
model: {{stiffness: {{dense: {K.tolist()}}}, mass: {{identity: {N}}}}}
parameters: [{{name: k, nominal: 1, sd: 1 %, stiffness: {entries}}}]
test:
  modes:
    frequency: {hz.tolist()}
    frequency_sd: 0.2 %
    dofs: {list(range(1, N + 1))}
    shapes: {shapes.tolist()}
    shape_sd: 0.01
""")
    return read_deck(folder / "deck.yaml")


def test_a_second_one_is_weighed_beside_an_adequate_first(tmp_path):
    """The mass alone leaves a p-value of 0.14, by which no fit is refuted; with the spring eleven nats less are left."""
    problem = _problem(tmp_path, 0.03)
    known = {name: registry()[name] for name in ("ground-spring", "mass")}
    found = rank(reduced(problem, problem.prior.mean), known, 2)
    alone = next(one for one in found.fits if [recipe.candidate.key for recipe in one.recipes] == ["mass"])
    assert 0.05 < upper_tail(alone.misfit, alone.dof) < 0.2
    assert found.groups[0][0] == "ground-spring + mass"
    assert 0.01 < dict(found.groups)["mass"] < 0.3
