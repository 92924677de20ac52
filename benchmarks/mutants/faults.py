"""The faults: where they are, what they change, and which tests must fail."""

from dataclasses import dataclass

_REFERENCE = "tests/reference/"
_EVIDENCE, _NOISE, _GATES, _SEVERAL, _NAMELESS = (
    f"{_REFERENCE}test_{name}.py" for name in ("evidence", "noise", "verdict_gates", "several", "nameless")
)


@dataclass(frozen=True)
class Mutant:
    """file: below mouse_cli; old: text that it has once; new: text in its place; tests: one of which must fail."""

    name: str
    file: str
    old: str
    new: str
    tests: tuple[str, ...]


def _of(file: str, tests: str, **faults: tuple[str, str, str]) -> tuple[Mutant, ...]:
    """Mutants of one file of the engine of diagnosis by name: old text, new text, names of tests in `tests` with spaces between."""
    named = lambda names: tuple(f"{tests}::{name}" for name in names.split())
    return tuple(
        Mutant(name.replace("_", "-"), f"diagnosis/{file}", old, new, named(own))
        for name, (old, new, own) in faults.items()
    )


MUTANTS = (
    *_of(
        "evidence.py",
        _EVIDENCE,
        evidence_uncapped=(
            "found[at, at] += 2 * np.pi / width**2",
            "found[at, at] += 0.0",
            "test_what_the_data_do_not_feel_leaves_it_as_it_is",
        ),
        evidence_sign_of_the_volume=(
            "np.log(2 * np.pi) - 0.5 * size",
            "np.log(2 * np.pi) + 0.5 * size",
            "test_without_causes_it_is_the_density_of_the_data",
        ),
        evidence_without_ranges=(" - np.log(width).sum()", "", "test_of_one_unknown_it_is_its_integral"),
    ),
    *_of(
        "noise.py",
        _NOISE,
        noise_rate=("RATE = 6.0", "RATE = 3.0", "test_it_is_the_integral_over_the_scale"),
        noise_no_series=(
            "share < 1e-200",
            "share < 0.0",
            "test_it_is_finite_where_the_closed_form_underflows test_without_misfit_or_degrees_of_freedom",
        ),
        noise_half_the_misfit=(
            "np.asarray(misfit, float) / 2",
            "np.asarray(misfit, float)",
            "test_it_is_the_integral_over_the_scale",
        ),
        noise_scale_below_one=(
            "return max(1.0, misfit / (max(dof, 0) + RATE))",
            "return misfit / (max(dof, 0) + RATE)",
            "test_the_scale_is_where_the_integrand_is_largest",
        ),
        noise_negative_dof=(
            "return max(1.0, misfit / (max(dof, 0) + RATE))",
            "return max(1.0, misfit / (dof + RATE + 1))",
            "test_more_than_all_degrees_of_freedom_is_none",
        ),
    ),
    *_of(
        "gates.py",
        _SEVERAL,
        prior_of_more=("0.6, 1 / 7", "0.6, 1 / 6", "test_priors_of_numbers_of_mechanisms"),
        prior_without_repetition=(
            "comb(groups + count - 1, count)",
            "comb(groups, count)",
            "test_all_sets_of_groups_share_it",
        ),
    ),
    *_of(
        "gates.py",
        _GATES,
        gate_demanded=("0.1, UNPROVED", "0.1, 1.5 * UNPROVED", "test_demanded_and_likely"),
        gate_likely=("0.1, UNPROVED", "0.05, UNPROVED", "test_demanded_and_likely"),
        gate_sure=("SURE = 0.95", "SURE = 0.9", "test_a_name_is_sure"),
        gate_far=("FAR = 5.0", "FAR = 8.0", "test_a_parameter_far_from_its_prior_takes_the_name"),
    ),
    *_of(
        "gates.py",
        f"{_REFERENCE}test_levelled.py",
        prior_by_groups_alone=(
            "BY_GROUP = 0.5",
            "BY_GROUP = 1.0",
            "test_a_support_of_twelve_is_not_told_from_a_member_of_seven_hundred_by_their_numbers",
        ),
    ),
    *_of(
        "search/fit.py",
        f"{_REFERENCE}test_levelled.py",
        places_of_a_line_forgotten=(
            "np.log(width / (np.sqrt(2 * np.pi) * s))",
            "0.0",
            "test_a_place_along_a_line_is_one_of_as_many_as_fit_in",
        ),
    ),
    *_of(
        "validate/informed.py",
        _GATES,
        held_out_counts_for_nothing=(
            "+= densities - densities.max()",
            "+= 0 * densities",
            "test_held_out_data_settle_what_the_fitted_data_leave_open test_held_out_data_turn_the_odds_of_a_field",
        ),
    ),
    *_of(
        "verdict.py",
        _GATES,
        sure_or_odds=(
            "> ODDS or (probability < SURE",
            "> ODDS and (probability < SURE",
            "test_a_name_is_sure test_a_name_has_its_odds",
        ),
        refuted_and_yet_named=("if gain < -ODDS:", "if False:", "test_held_out_data_strike_a_name"),
        nameless_named=(
            "    if unnamed(first) and name not in",
            "    if False and name not in",
            "test_what_leads_without_a_name_is_unknown_with_a_field",
        ),
        nameless_beats_an_equal=(
            "return ONE_OF if rival else UNKNOWN, ()",
            "return UNKNOWN, ()",
            "test_a_name_stays_beside_what_has_none",
        ),
        far_and_yet_named=(
            "if far := far_parameters(first):",
            "if (far := far_parameters(first)) and False:",
            "test_a_parameter_far_from_its_prior_takes_the_name",
        ),
        own_mode_overlooked=(
            "if not first.telling and (hz",
            "if first.telling and (hz",
            "test_a_mode_of_its_own_is_seen_first",
        ),
        not_believed_and_yet_missing=(
            "(shown and none < DEMANDED)",
            "none < DEMANDED",
            "test_a_test_that_is_not_believed_is_no_reason",
        ),
        prediction_counts_for_nothing=(
            "if asked and not likely and _predicts",
            "if False and _predicts",
            "test_what_predicts_is_likely",
        ),
        likely_is_missing=(
            "if not demanded and gain <= ODDS:",
            "if False:",
            "test_a_model_of_one_in_twenty_may_lack_nothing test_held_out_data_confirm_what_is_likely",
        ),
    ),
    *_of(
        "search/rank.py",
        _SEVERAL,
        no_more_than_two=(
            " or found.noise_scale > LOUD",
            "",
            "test_masses_that_are_gone_are_named_one_by_one[gone1]",
        ),
        sites_in_every_order=(
            "float(np.log(alike)) + orders",
            "float(np.log(alike))",
            "test_a_set_of_sites_is_counted_once",
        ),
        members_share_nothing=(" - float(np.log(alike))", "", "test_members_of_a_group_share_its_prior"),
    ),
    *_of(
        "search/rank.py",
        _NAMELESS,
        nameless_each_in_full=(
            "gates.MORE ** (parts - 1) / alike",
            "gates.MORE ** (parts - 1)",
            "test_rivals_without_a_name_share_their_prior",
        ),
        two_as_likely_as_one=(
            "gates.MORE ** (parts - 1)",
            "gates.MORE ** 0",
            "test_two_rivals_without_a_name_have_the_prior_of_a_second",
        ),
        nameless_never_asked=(
            "if last and (none",
            "if not last and (none",
            "test_a_field_over_the_masses_of_a_chain",
        ),
    ),
    *_of(
        "search/rank.py",
        _GATES,
        several_as_one=(
            "p >= gates.SEVERAL if len(one.recipes) > 1",
            "p >= gates.SEVERAL if len(one.recipes) > 9",
            "test_one_mechanism_may_leave_more_than_several",
        ),
    ),
    *_of(
        "search/found.py",
        _SEVERAL,
        needless_kept=("max(parts) > MATERIAL", "max(parts) > 0.0", "test_what_is_not_needed_is_material_to_nothing"),
        second_of_a_kind_free=(
            "Counter(key(each)) <= own",
            "set(key(each)) <= set(own)",
            "test_what_is_not_needed_is_material_to_nothing",
        ),
    ),
    *_of(
        "search/alike.py",
        _SEVERAL,
        two_of_a_kind_at_most=(
            "while len(one.recipes) < most and",
            "while len(one.recipes) < 2 and",
            "test_several_of_one_kind_and_as_many_as_are_needed",
        ),
    ),
    *_of(
        "search/moves.py",
        _SEVERAL,
        adequate_anyway=("ADEQUATE = 0.05", "ADEQUATE = 0.01", "test_adequate_is_a_p_value_of_a_twentieth"),
    ),
    *_of(
        "search/several.py",
        _SEVERAL,
        held_out_says_nothing_of_enough=(
            "len(one.recipes) <= count and enough(one, FURTHER)",
            "len(one.recipes) <= count and adequate(one, FURTHER)",
            "test_a_pair_that_does_not_predict_what_is_held_out_is_not_enough",
        ),
    ),
    *_of(
        "nameless/_correlated.py",
        _NAMELESS,
        field_not_smooth=(
            "np.exp(-0.5 * ((at - at[i]) ** 2).sum(axis=1) / length**2)",
            "np.exp(-np.sqrt(((at - at[i]) ** 2).sum(axis=1)) / length)",
            "test_its_covariance_is_that_of_a_smooth_field",
        ),
    ),
    *_of(
        "nameless/_averaged.py",
        _NAMELESS,
        field_sd_of_nothing=(
            "field.P, one.covariance[own, own], field.P",
            "field.P, 9 * np.eye(field.P.shape[1]), field.P",
            "test_a_field_over_the_springs_of_a_chain",
        ),
    ),
    *_of(
        "nameless/fit.py",
        _NAMELESS,
        field_of_the_best_spread=(
            " - np.log(len(field.grid))",
            "",
            "test_its_evidence_is_the_mean_over_spreads_and_lengths",
        ),
    ),
    *_of(
        "nameless/stiffness.py",
        _NAMELESS,
        springs_counted_twice=(
            "_apart(listed_springs(model))",
            "listed_springs(model)",
            "test_a_field_over_the_springs_of_a_chain",
        ),
    ),
    *_of(
        "nameless/bed.py",
        _NAMELESS,
        bed_in_other_units=("bars.span**4", "bars.span**3", "test_a_bed_under_a_half_that_may_not_be_named"),
    ),
)
