"""Long proofs, the tests that `pytest -m proof` adds to the command of the README: tests and parameters of tests."""

from collections.abc import Iterable

import pytest


def proofs(cases: Iterable, *kept: object) -> list:
    """The cases of a parametrised test, all but those `kept` marked as proofs; a tuple is the values of several parameters."""
    values = [each if isinstance(each, tuple) else (each,) for each in cases]
    keep = [each if isinstance(each, tuple) else (each,) for each in kept]
    assert all(each in values for each in keep)
    return [pytest.param(*each, marks=() if each in keep else pytest.mark.proof) for each in values]


# Tests of more than three seconds on a core beside shorter ones in the same file
LONG: dict[str, tuple[str, ...]] = {
    "benchmarks_blind/test_base.py": (
        "test_a_softening_storey_stays_where_its_curve_is_cubic", "test_decks_tell_nothing_of_the_answer", "test_seeds_differ",
    ),
    "benchmarks_blind/test_drives.py": (
        "test_decks_tell_nothing_of_the_answer[3-1]", "test_a_newcomers_drive[1-friction-15]", "test_a_newcomers_drive[1-none-0]",
    ),
    "benchmarks_blind/test_imported.py": ("test_the_exported_job_predicts_modes_that_were_not_fitted",),
    "benchmarks_blind/test_naming.py": (
        "test_the_concealed_cause_is_named_at_its_place[mass]", "test_what_no_candidate_explains_is_not_named[half foundation]",
    ),
    "benchmarks_blind/test_space.py": (
        "test_decks_of_controls_are_the_truth_and_others_say_nothing", "test_a_brace_is_found_among_many_pairs",
        "test_feet_that_are_nearly_pinned_each_its_own_way_are_one_mechanism[feet0]",
        "test_feet_that_are_nearly_pinned_each_its_own_way_are_one_mechanism[feet2]",
    ),
    "benchmarks_fuzz/test_fuzz.py": ("test_what_counts[slow-<lambda>]",),
    "benchmarks_mutants/test_mutants.py": ("test_one_that_changes_nothing_is_alive",),
    "benchmarks_trials/test_trials.py": ("test_decks_are_sound_and_say_nothing",),
    "contracts/test_batch.py": (
        "test_a_batch_that_is_killed_goes_on_where_it_was", "test_only_what_has_changed_is_run_again",
        "test_a_process_that_dies_takes_no_other_job_with_it",
        "test_workers_of_a_cluster_give_the_same_and_one_that_dies_stops_nothing", "test_what_is_expected_of_verdicts_and_endings",
        "test_summaries_hold_any_name",
    ),
    "contracts/test_candidates.py": (
        "test_the_deck_with_the_cause_is_the_reduced_model_with_it[cantilever-added-mass]",
        "test_the_deck_with_the_cause_is_the_reduced_model_with_it[space-eccentric-mass]",
        "test_the_deck_with_the_cause_is_the_reduced_model_with_it[space-ground-spring]",
        "test_the_deck_with_the_cause_is_the_reduced_model_with_it[space-support-rotation]",
        "test_the_deck_with_the_cause_is_the_reduced_model_with_it[tower-floor-mass]",
        "test_the_deck_with_the_cause_is_the_reduced_model_with_it[tower-semi-rigid]",
        "test_the_deck_with_the_cause_is_the_reduced_model_with_it[frame-member]",
        "test_the_deck_with_the_cause_is_the_reduced_model_with_it[frame-rocking]",
        "test_the_deck_with_the_cause_is_the_reduced_model_with_it[frame-support-rotation]",
        "test_the_deck_with_the_cause_is_the_reduced_model_with_it[frame-support-translation]",
    ),
    "contracts/test_diagnose_command.py": (
        "test_the_extended_deck_runs", "test_a_held_out_configuration_is_foreseen",
        "test_a_corrected_sensor_stays_corrected_beside_what_is_held_out[gain]",
        "test_a_corrected_sensor_stays_corrected_beside_what_is_held_out[swap]", "test_reports_beside_the_answer",
        "test_candidates_that_are_considered", "test_the_model_of_a_rival_runs", "test_figures", "test_cards",
    ),
    "contracts/test_ecosystem.py": ("test_shells_complete_what_is_typed[bash]",),
    "contracts/test_last_resort.py": (
        "test_a_mechanism_may_have_no_site_where_parameters_end", "test_a_diagnosis_of_values_beyond_any_algebra",
    ),
    "contracts/test_page.py": (
        "test_structure[nothing]", "test_structure[one-of]", "test_structure[drawn]", "test_structure[arrangements]",
        "test_structure[compared]", "test_structure[sampled]", "test_every_value_of_a_wrong_type_is_told_or_shown",
    ),
    "contracts/test_page_browser.py": (
        "test_a_phone_and_paper", "test_axe_is_clean[drawn]", "test_axe_is_clean[one-of]", "test_axe_is_clean[arrangements]",
    ),
    "contracts/test_raw_folder.py": (
        "test_recordings_that_are_all_clipped_are_taken_with_a_warning",
        "test_one_run_that_is_at_odds_with_the_others_is_named[stood_still-Recording 'run2' alone is at odds with the model:]",
    ),
    "contracts/test_safety.py": (
        "test_pipes_folders_and_devices_are_not_read[batch]", "test_promises_are_refused_before_they_are_believed[matrices]",
        "test_promises_are_refused_before_they_are_believed[recordings]",
        "test_promises_are_refused_before_they_are_believed[decks]",
    ),
    "docs/test_reference.py": ("test_json_of_arrangements",),
    "field/test_public_recordings.py": ("test_a_run_leaves_a_prior_that_is_far_off_and_ends_at_the_truth",),
    "field/test_silverbox.py": ("test_the_hardening_spring_is_named_and_predicts_the_arrow",),
    "importing/test_clamps.py": ("test_a_rotation_of_a_clamp_is_that_of_its_shell",),
    "importing/test_import.py": ("test_two_free_bodies",),
    "importing/test_knots.py": ("test_without_a_set_the_model_is_that_of_the_solver[1.0-0.01]",),
    "importing/test_named_parts.py": (
        "test_few_coordinates_hold_a_set_that_is_soft_and_as_heavy_as_it_was[0.5]",
        "test_few_coordinates_hold_a_set_that_is_soft_and_as_heavy_as_it_was[0.8]",
        "test_few_coordinates_hold_a_set_that_is_soft_and_as_heavy_as_it_was[0.95]",
        "test_what_is_missing_is_named_as_the_model_names_it[brace missing]",
        "test_what_is_missing_is_named_as_the_model_names_it[brace of steel]",
        "test_what_is_missing_is_named_as_the_model_names_it[foot loose]",
        "test_what_is_missing_is_named_as_the_model_names_it[control]",
    ),
    "importing/test_thickness.py": (
        "test_a_thickness_beside_constraints_is_that_of_the_solver[S4-EQUATION]",
        "test_a_thickness_beside_constraints_is_that_of_the_solver[S4-RIGID BODY]",
        "test_a_thickness_beside_constraints_is_that_of_the_solver[S8R-RIGID BODY]",
        "test_a_support_on_springs_leaves_the_thickness_of_sets_in_its_deck",
        "test_another_thickness_is_that_of_the_solver_in_a_diagnosis_its_deck_and_the_job[thinner-0.6]",
        "test_another_thickness_is_that_of_the_solver_in_a_diagnosis_its_deck_and_the_job[stiffness-gain-1.5]",
        "test_curved_shells_go_by_no_powers",
    ),
    "property/test_convergence.py": (
        "test_loop_of_1972_fails_far_from_the_truth", "test_exact_re_solution_reaches_the_truth",
        "test_no_wrong_answer_is_handed_out_as_sound", "test_logarithm_keeps_every_stiffness_positive",
        "test_cost_never_rises_in_anchored_runs",
        "test_second_order_takes_fewer_cycles[anchored-0.1]", "test_false_alarms_are_as_rare_as_claimed",
    ),
    "property/test_damaged_decks.py": ("test_whatever_passes_the_check_runs_to_an_end[5]",),
    "property/test_edit_property.py": ("test_bulk_reading_is_single_reading",),
    "property/test_fuzz_coupled.py": ("test_coupled",),
    "property/test_fuzz_yaml.py": ("test_hostile_decks_are_refused_soon[9]",),
    "property/test_statistics.py": (
        "test_intervals_cover_the_truth", "test_all_runs_converge",
        "test_accuracies_stated_too_small_are_found_out", "test_least_squares_is_unbiased[least-squares]",
    ),
    "property/test_yaml_roundtrip.py": ("test_write_then_read_is_the_same_problem",),
    "reference/test_alternatives.py": ("test_a_chain_seen_in_a_mirror",),
    "reference/test_arrangements.py": ("test_errors_that_all_share_are_no_cause", "test_what_changed_is_sought_in_what_changed"),
    "reference/test_bearings_and_joints.py": (
        "test_a_seized_bearing_below_the_axis_holds_beside_it", "test_a_joint_that_twists_as_well",
        "test_a_sensor_of_three_axes_that_is_mounted_turned[270 degrees]",
        "test_a_sensor_of_three_axes_that_is_mounted_turned[180 degrees]",
    ),
    "reference/test_campaigns.py": ("test_a_sweep_that_is_killed_goes_on_and_ends_like_an_unbroken_one",),
    "reference/test_campaigns_records.py": ("test_stretches_of_a_record_spread_as_its_noise_does",),
    "reference/test_campaigns_sample.py": (
        "test_a_correlated_prior_carries_what_is_measured_over", "test_logarithms_are_sampled_as_the_prior_says",
        "test_two_springs_that_can_be_exchanged", "test_command_writes_samples_without_pickles_the_same_by_processes",
        "test_a_walk_that_is_killed_goes_on_and_ends_like_an_unbroken_one",
        "test_a_walk_of_another_deck_or_a_damaged_one_is_not_gone_on_with",
    ),
    "reference/test_chain_functions.py": (
        "test_report_document_and_figures", "test_a_deck_of_matrices_has_the_damping_as_it_was_found",
    ),
    "reference/test_channel_errors.py": (
        "test_an_error_of_one_channel_is_named_as_that[f-<lambda>-sensor-gain-1.5]",
        "test_an_error_of_one_channel_is_named_as_that[a1-<lambda>-sensor-delay-0.0025390625]",
    ),
    "reference/test_channel_nuisances.py": (
        "test_hum_and_drift_that_are_stated_hide_nothing_and_are_no_physics[cubic-{mains: 50, drift: 1}-added2]",
        "test_what_no_record_has_is_refused[drift: -1-half of the sample rate]",
        "test_what_no_record_has_is_refused[delay_sd: -1-0 or more]",
    ),
    "reference/test_close_modes.py": (
        "test_sound_modes_are_not_doubted[forces1-True]", "test_sound_modes_are_not_doubted[forces1-False]",
    ),
    "reference/test_compliance.py": ("test_soil_that_rocks_is_a_compliance", "test_a_function_beside_the_modes_agrees"),
    "reference/test_coupling.py": (
        "test_variance_is_that_of_drawn_functions", "test_a_function_taken_by_reciprocity_errs_with_its_twin",
    ),
    "reference/test_cracked_bar.py": (
        "test_the_crack_by_modes[bending]", "test_the_crack_by_modes[full]", "test_the_crack_and_its_loss_by_functions",
    ),
    "reference/test_drives_begin.py": ("test_a_law_is_begun_with_all_nuisances_at_their_mean_where_that_costs_less",),
    "reference/test_evidence.py": ("test_of_two_unknowns_it_is_their_integral",),
    "reference/test_excitation_noise.py": ("test_a_law_is_named_beside_noise_in_the_force",),
    "reference/test_extended_mass.py": (
        "test_a_hub[2.0-0.02-False]", "test_a_hub[2.0-0.02-True]", "test_a_mass_without_rotary_inertia_is_a_mass",
    ),
    "reference/test_mass_on_a_slender_part.py": ("test_a_mass_on_a_slender_part_is_named_at_its_node",),
    "reference/test_hammer_records.py": ("test_a_hammer_that_goes_from_place_to_place_is_read_and_used",),
    "reference/test_viscoelastic_records.py": (
        "test_a_damper_behind_a_spring_is_named_and_put_into_the_deck",
        "test_a_magnet_is_a_negative_spring_and_what_softens_further",
    ),
    "reference/test_free_decay_diagnosis.py": ("test_a_cubic_spring_is_found_without_a_force",),
    "reference/test_free_decays.py": ("test_errors_are_as_large_as_stated[0.01]", "test_errors_are_as_large_as_stated[0.1]"),
    "reference/test_frf.py": ("test_basis_against_direct_solutions_with_all_kinds_of_damping[True]",),
    "reference/test_frf_calibration.py": ("test_sds_of_gains_cover",),
    "reference/test_frf_naming.py": ("test_what_is_concealed_is_named_with_its_law_and_size[wrong gain]",),
    "reference/test_frf_updating.py": ("test_large_model_by_its_basis",),
    "reference/test_group_fields.py": ("test_a_wave_over_six_strips_is_a_field_of_them[mass]", "test_one_soft_strip_has_a_name"),
    "reference/test_gyroscopic.py": (
        "test_a_rotor_at_speed_and_its_deck_with_the_coupling", "test_a_dashpot_between_the_planes_is_no_spin",
        "test_the_tilts_of_a_disc_that_nobody_measures_are_coupled_too",
    ),
    "reference/test_identification.py": (
        "test_noise_alone_has_no_modes", "test_three_storey_building", "test_the_three_forces_agree_within_what_is_stated",
        "test_many_modes_and_some_beyond_the_band",
    ),
    "reference/test_lighter.py": ("test_a_full_pipe_lacks_nothing",),
    "reference/test_local_law.py": ("test_a_mount_that_depends_on_frequency_is_a_law_at_its_place[softer with frequency]",),
    "reference/test_losses_by_direction.py": ("test_the_direction_is_named[weaker0]", "test_the_direction_is_named[weaker1]"),
    "reference/test_lost_mass.py": (
        "test_a_mass_that_is_lighter_than_in_the_deck_is_named_with_what_it_lost",
        "test_point_masses_of_a_structure_lose_what_is_lost[0.3-0.7]",
    ),
    "reference/test_missing_members.py": ("test_a_first_look_in_few_coordinates_sees_that_a_diagonal_is_missing",),
    "reference/test_mode_errors.py": ("test_a_frequency_that_was_misread_is_no_physics", "test_a_shape_of_noise_is_no_physics"),
    "reference/test_modes_and_records.py": (
        "test_a_record_tells_the_place_that_two_frequencies_leave_open", "test_a_linear_record_beside_sound_modes_lacks_nothing",
    ),
    "reference/test_modes_of_another_coordinate.py": ("test_modes_that_share_a_shape_are_of_a_motion_that_the_model_lacks",),
    "reference/test_nameless.py": (
        "test_what_is_wavy_is_a_field[stiffness-False]", "test_what_is_wavy_is_a_field[mass-True]",
        "test_a_bed_under_a_half_that_may_not_be_named", "test_what_has_a_name_keeps_it[tension-False]",
        "test_what_has_a_name_keeps_it[ground-spring-False]", "test_what_has_a_name_keeps_it[mass-True]",
        "test_a_field_over_the_springs_of_a_chain", "test_a_field_over_the_masses_of_a_chain",
        "test_fields_are_asked_where_no_candidate_does_better_than_none", "test_a_field_over_storeys",
        "test_a_floor_without_two_of_its_masses_has_names", "test_corrosion_takes_stiffness_and_mass_together",
        "test_an_axial_force_under_an_even_load_is_a_slope",
    ),
    "reference/test_nameless_springs.py": (
        "test_a_spring_between_distant_places[False]", "test_a_spring_against_a_turn", "test_an_axial_force_that_varies",
    ),
    "reference/test_narrow_priors.py": ("test_a_parameter_beyond_its_prior_is_said_beside_what_would_explain_it",),
    "reference/test_partial_bed.py": (
        "test_a_bed_under_a_part_is_named_with_its_extent[0.6-1.0]", "test_a_bed_between_two_places_is_named_with_both[0.3-0.65]",
        "test_a_bed_that_is_lost_in_part_is_named_with_its_extent[0.55-0.85]",
    ),
    "reference/test_plain_fields.py": (
        "test_where_there_is_no_bed_one_is_only_added[truth0--20--2]",
        "test_where_there_is_no_bed_one_is_only_added[truth1-0.6-0.7]",
        "test_a_section_that_changes_linearly_along_a_beam_is_a_taper[inf]",
    ),
    "reference/test_pool.py": (
        "test_answers_are_the_same_whatever_the_number_of_processes", "test_of_a_change_too_and_of_what_theory_errs_with_it",
        "test_processes_go_on_by_other_errors_of_theory",
    ),
    "reference/test_predicted_beyond.py": ("test_density_of_what_was_held_out[1.35]", "test_density_of_what_was_held_out[0.8]"),
    "reference/test_real_structures.py": (
        "test_storeys_free_of_one_another_hide_any_cause", "test_like_storeys_ask_for_gravity",
        "test_gravity_of_four_storeys_is_not_proved", "test_ruler_tower_has_a_softer_foot_and_nobody_knows_why",
        "test_three_storey_building_says_that_it_does_not_know",
    ),
    "reference/test_record_changed.py": ("test_when_it_changed_is_told_with_what_did[2.5]",),
    "reference/test_record_disturbed.py": ("test_no_law_is_sought_for_it_and_once_stated_there_is_nothing_to_say",),
    "reference/test_record_kinks_and_powers.py": (
        "test_a_cable_that_goes_slack", "test_damping_by_another_power_than_the_square",
    ),
    "reference/test_record_beams.py": (
        "test_a_sound_cantilever_lacks_nothing",
        "test_noise_of_the_force_that_shakes_modes_above_its_band_is_nothing_that_is_missing",
        "test_laws_may_act_between_measured_places_of_a_reduced_model",
    ),
    "reference/test_record_diagnosis.py": (
        "test_friction_to_the_ground", "test_the_zero_of_an_accelerometer_is_no_motion",
        "test_a_disturbing_force_that_nobody_measured_is_noise", "test_a_cubic_spring_between_two_masses[sensors0]",
        "test_play_in_a_spring_of_the_model[place0-30600.0-0.0003]", "test_two_masses_that_no_spring_links_pound",
        "test_another_damping_in_one_direction", "test_the_extended_deck_lacks_nothing",
        "test_a_linear_cause_is_written_as_a_deck_that_lacks_nothing", "test_sizes_are_in_the_units_of_the_deck",
        "test_a_stop_much_softer_than_the_structure_is_no_smooth_spring",
    ),
    "reference/test_record_mistakes.py": (
        "test_what_is_misread_is_told_with_what_to_mend[all in g]", "test_what_is_misread_is_told_with_what_to_mend[in ms]",
        "test_what_is_misread_is_told_with_what_to_mend[half the rate]",
        "test_what_is_misread_is_told_with_what_to_mend[force at the other mass]", "test_an_update_is_refused_likewise",
        "test_a_law_is_no_misreading[<lambda>0]", "test_a_law_is_no_misreading[<lambda>1]",
        "test_the_remedy_of_one_channel_names_its_unit",
    ),
    "reference/test_record_update.py": (
        "test_linear_parameters_are_those_of_the_truth", "test_the_size_of_a_law_is_revised_and_the_answer_is_a_prior",
        "test_figures_show_records_and_the_law", "test_options_without_meaning_are_told",
    ),
    "reference/test_record_verdict.py": (
        "test_a_deck_without_damping_is_judged_by_its_stiffness[softer-named]",
        "test_damping_that_a_deck_leaves_out_has_no_name[4000.0-spring]", "test_dry_friction_of_a_mass_that_nothing_holds",
    ),
    "reference/test_restraints.py": ("test_a_pin_that_resists_turning_is_named_with_its_stiffness",),
    "reference/test_rows_of_supports.py": ("test_modes_that_are_held_out_are_predicted_for_a_finer_mesh",),
    "reference/test_several.py": (
        "test_masses_that_are_gone_are_named_one_by_one[gone0]", "test_no_more_than_may_be_sought",
        "test_a_spring_a_mass_and_a_softer_stretch[False]", "test_a_third_is_not_named_where_there_are_two[True]",
        "test_sites_of_sets_that_are_as_good_leave_the_place_open",
        "test_feet_that_give_way_are_named_each_with_a_stiffness_of_its_own[flexible0]",
    ),
    "reference/test_slender.py": (
        "test_sensitivities_of_a_long_beam[2000-1e-06-from nothing]",
        "test_sensitivities_of_a_long_beam[2000-1e-06-from the same modes]",
    ),
    "reference/test_state_before.py": ("test_nothing_is_sought_in_a_model_that_explains_nothing",),
    "reference/test_subspace.py": ("test_of_many_parameters_the_directions_that_data_see_are_kept",),
    "reference/test_support_ranges.py": (
        "test_it_is_named[support-rotation-666.6666666666667-None]", "test_it_is_named[support-translation-None-0.0]",
    ),
    "reference/test_support_sensors.py": (
        "test_a_sound_clamp_is_quiet", "test_a_soft_clamp_is_named_and_its_deck_reads_its_motion",
    ),
    "reference/test_theory.py": (
        "test_a_model_that_is_slightly_wrong_is_accepted_with_its_error_of_theory", "test_a_mechanism_is_right_to_the_stated_share",
        "test_links_of_recordings_are_as_uncertain_as_stated",
        "test_every_kind_of_diagnosis_states_it[functions]", "test_every_kind_of_diagnosis_states_it[configurations]",
        "test_every_kind_of_diagnosis_states_it[recordings]",
        "test_the_common_sd_of_the_command_line_is_used_in_place_of_that_of_the_decks",
    ),
    "reference/test_tube_frame.py": (
        "test_kabe_with_rigid_modes", "test_generic_elements_stay_physical_under_noise[0]",
        "test_generic_elements_stay_physical_under_noise[2]",
    ),
    "reference/test_turned_modes.py": (
        "test_a_ring_is_sound_but_for_a_mass_that_splits_its_modes[0.0]",
        "test_a_ring_is_sound_but_for_a_mass_that_splits_its_modes[0.1]",
    ),
    "reference/test_turned_section.py": ("test_a_part_on_its_side_is_named_with_its_place",),
    "reference/test_yielding.py": ("test_a_spring_that_yields_is_named_with_its_force",),
}  # fmt: skip
