"""Faults of the numeric core: estimators, convergence, the normal density of the answer."""

from benchmarks.mutants.faults import Mutant

_ESTIMATORS, _TABLES = "tests/reference/test_estimators.py", "tests/reference/test_report_tables.py"
_ROWS = f"{_ESTIMATORS}::test_rows_of_table_3_1"
_FEWER = f"{_ESTIMATORS}::test_bayes_with_fewer_data_than_properties"
_ACCURATE = f"{_ESTIMATORS}::test_accurate_data_and_columns_over_four_decades"
_SUM = f"{_ESTIMATORS}::test_accurate_data_and_fewer_of_them_than_properties"
_ONLY_SUM = f"{_ESTIMATORS}::test_accurate_data_that_tell_only_a_sum"
_NOISY = f"{_TABLES}::test_exceedances_of_the_noisy_run"
_BAYES, _LINEAR = "estimators/bayes.py", "estimators/linear.py"
_CONVERGENCE, _POSTERIOR = "updating/convergence.py", "updating/posterior.py"
_DENSITY = "tests/reference/test_alternatives.py::test_the_density_at_its_mode"
_LIMITS = "tests/reference/test_convergence_rule.py"

CORE = (
    Mutant("bayes-no-prior", _BAYES, "gram[np.diag_indices(k)] += 1.0", "gram[np.diag_indices(k)] += 0.5", (_ROWS,)),
    Mutant("bayes-no-qr", _BAYES, "stacked[q:, :k] = B, r, np.eye(k)", "stacked[q:, :k] = B, r, 2 * np.eye(k)", (_ACCURATE,)),
    Mutant("bayes-never-qr", _BAYES, "_LARGE = 1e3", "_LARGE = 1e30", (_ACCURATE, _SUM, _ONLY_SUM)),
    Mutant(
        "bayes-few-data",
        _BAYES,
        "gram[np.diag_indices(len(gram))] += 1.0",
        "gram[np.diag_indices(len(gram))] += 2.0",
        (_FEWER,),
    ),
    Mutant("bayes-few-accurate", _BAYES, "return Q @ _mode(F.T, r)[0]", "return Q @ _mode(F.T, 2 * r)[0]", (_SUM,)),
    Mutant("least-squares-weighed", "estimators/least_squares.py", "weighted=False", "weighted=True", (_ROWS,)),
    Mutant("weighted-unweighed", "estimators/weighted_least_squares.py", "weighted=True", "weighted=False", (_ROWS,)),
    Mutant("covariance-of-half", _LINEAR, "return U @ U.T", "return 0.5 * U @ U.T", (_ROWS,)),
    Mutant("z-90-one-sided", _CONVERGENCE, "90: 1.645", "90: 1.282", (f"{_LIMITS}::test_limits_hold_the_stated_share",)),
    Mutant("z-99", _CONVERGENCE, "99: 2.576", "99: 2.326", (f"{_LIMITS}::test_limits_hold_the_stated_share",)),
    Mutant("z-95", _CONVERGENCE, "95: 1.960", "95: 1.645", (_NOISY,)),
    Mutant("exceeding-one-side", _CONVERGENCE, "np.abs(residual) >", "residual >", (_NOISY,)),
    Mutant(
        "ratio-is-fraction",
        _CONVERGENCE,
        "alpha / (1 + alpha) if",
        "alpha if",
        (f"{_TABLES}::test_one_exceedance_in_twenty_meets_only_the_fraction_rule",),
    ),
    Mutant(
        "allowed-rounded-up",
        _CONVERGENCE,
        "np.floor(share * q + _ROUNDING)",
        "np.ceil(share * q - _ROUNDING)",
        (f"{_TABLES}::test_one_exceedance_in_twenty_meets_only_the_fraction_rule",),
    ),
    Mutant("allowed-by-rounding", _CONVERGENCE, "_ROUNDING = 1e-9", "_ROUNDING = 0.0", (f"{_LIMITS}::test_a_share_that_is_whole",)),
    Mutant("posterior-no-prior", _POSTERIOR, "(precision), state.chi2 + float(z @ z)", "(precision), state.chi2", (_DENSITY,)),
    Mutant("posterior-volume", _POSTERIOR, "-0.5 * self.cost +", "-0.5 * self.cost -", (_DENSITY,)),
)  # fmt: skip
