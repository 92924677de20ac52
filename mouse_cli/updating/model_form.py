"""Can this model, with any plausible values of its parameters, give these data? Tests of the model's form.

Before the cycles, the innovation d'(R + T S T')^-1 d: were model, prior and accuracies right, it would be chi-square with
as many degrees of freedom as data. After the cycles it splits exactly in two (T taken at the revised model): the *residual*,
what no values of the parameters can explain, and the *prior shift*, how improbable the values are that explain the rest.
"""

import numpy as np

from mouse_cli.estimators import bayes
from mouse_cli.estimators.linear import LinearProblem
from mouse_cli.model.result import ChiSquareTest
from mouse_cli.updating.chi_square import upper_tail
from mouse_cli.updating.state import Setting, State

_WORTH_LOADING = 500  # order of a triangle from which on scipy is worth loading
_REGULAR = 1e-9  # reciprocal condition of a triangle whose rank is beyond doubt


def innovation(setting: Setting, state: State) -> ChiSquareTest:
    """d'(R + T S T')^-1 d at the prior, as the least value of |d - B z|^2 + |z|^2 (no difference of large numbers)."""
    problem = LinearProblem(state.T, state.residual, setting.sd, setting.coordinates.L)
    z = bayes.solve(problem).z
    rest = problem.whiten(problem.d - problem.in_prior_units() @ z)
    dof = len(setting.y) - setting.observable.scales_fitted
    return _test("innovation", float(rest @ rest + z @ z), dof)


def residual_and_shift(
    setting: Setting, state: State, at_limit: np.ndarray, uses_prior: bool
) -> tuple[ChiSquareTest, ChiSquareTest]:
    """Both parts of the innovation at `state`. Parameters at a limit count as known.

    With B = U s V' and d the data's difference from the prior, linearised at `state`: residual |d - U U'd|^2 on q - rank
    degrees of freedom, shift sum (u'd)^2 / (1 + s^2) on rank. Without a prior in the estimate the shift is not tested.
    """
    shift = np.where(at_limit, 0.0, state.u - setting.coordinates.mean)
    problem = LinearProblem(state.T * ~at_limit, state.residual + state.T @ shift, setting.sd, setting.coordinates.L)
    B, d = problem.whitened()
    outside, moved, rank = _well_determined(B, d) or _split(B, d)
    dof = len(setting.y) - setting.observable.scales_fitted
    rank = min(rank, dof)
    return (
        _test("residual", outside, dof - rank),
        _test("prior shift", moved, rank if uses_prior else 0),
    )


def _split(B: np.ndarray, d: np.ndarray) -> tuple[float, float, int]:
    """|d - U U'd|^2, sum (u'd)^2 / (1 + s^2), and the rank of B = U s V'."""
    U, s, _ = np.linalg.svd(B, full_matrices=False)
    seen = s > 1e-10 * s.max(initial=0.0)
    U, s = U[:, seen], s[seen]
    inside = U.T @ d
    outside = d - U @ inside
    return float(outside @ outside), float(np.sum(inside**2 / (1 + s**2))), len(s)


def _well_determined(B: np.ndarray, d: np.ndarray) -> tuple[float, float, int] | None:
    """The same ten times faster, by a triangle, for large B (q, k) of full rank; None for others."""
    q, k = B.shape
    if min(q, k) < _WORTH_LOADING:
        return None
    from scipy.linalg import cholesky, solve_triangular
    from scipy.linalg.lapack import dtrcon

    if q > k:  # [B d] = Q [R c; 0 e]
        triangle = np.linalg.qr(np.column_stack([B, d]), mode="r")
        R, c, outside = triangle[:k, :k], triangle[:k, k], float(triangle[k, k]) ** 2
        gram = R @ R.T
    else:  # every datum can be met: B' = Q R
        R, c, outside = np.linalg.qr(B.T, mode="r"), d, 0.0
        gram = R.T @ R
    if dtrcon(R)[0] < _REGULAR:
        return None
    gram[np.diag_indices(len(gram))] += 1.0
    y = solve_triangular(cholesky(gram, lower=True, overwrite_a=True), c, lower=True)
    return outside, float(y @ y), len(gram)


def _test(name: str, chi2: float, dof: int) -> ChiSquareTest:
    return ChiSquareTest(name, chi2, dof, upper_tail(chi2, dof))
