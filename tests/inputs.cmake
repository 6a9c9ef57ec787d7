# inputs that need files, pipes or full disks: the functions of errors/inputs.py
foreach(case byte_order_mark utf_16 latin_1 number_sign carriage_returns
    from_a_pipe a_pipe_without_end includes_itself includes_beside_it
    full_disk damaged_msh
    small_memory huge_normal joint_outside joint_twice joints_welded
    monitor_outside monitor_in_a_large_cell some_tension shape_file_changed
    too_many_triangles names_taken_out derived_entries coarse_mesh small_ledge
    free_field_warnings blocks_that_lean monitor_of_all_joints oblique_stress
    places_without_round_off written_out decimal_comma coarse_steps_of_stl
    surface_of_many_triangles joint_group_missing boundary_groups
    table_without_rows table_without_friction other_units attached_block lost_cohesion
    strength_lost_by_slip rock_by_default told_and_kept used_folder written_wrongly
    hardly_meant long_values)
  keyblock_test(errors/input_${case} quick
    COMMAND errors/inputs.py ${keyblock} ${prm} ${case})
endforeach()

# numbers that are not finite
foreach(case kinetic_energy moving_energy static_stage check_of_nothing
    stable_factors clamped_block)
  keyblock_test(errors/not_finite_${case} quick
    COMMAND errors/not_finite.py ${keyblock} ${prm} ${case})
endforeach()

# damaged scenes and meshes of each kind (contrib/fuzz.py), and checkpoints
set(no_limit $<BOOL:${SANITIZE}>) # of memory [GB]: the sanitizers need all
foreach(case "validate quick" "run nightly" "mesh nightly")
  string(REGEX MATCH "(.*) (.*)" case ${case})
  keyblock_test(fuzz/${CMAKE_MATCH_1} ${CMAKE_MATCH_2}
    COMMAND ${contrib}/fuzz.py --keyblock ${keyblock} --kinds ${CMAKE_MATCH_1}
      --number 24 --seeds 7 --memory $<IF:${no_limit},0,6>)
endforeach()
foreach(case "checkpoints 1 10 quick" "more_checkpoints 1 30 nightly"
    "checkpoints_2 2 8 nightly") # ranks, number
  string(REGEX MATCH "(.*) (.*) (.*) (.*)" case ${case})
  keyblock_test(fuzz/${CMAKE_MATCH_1} ${CMAKE_MATCH_4} RANKS ${CMAKE_MATCH_2}
    COMMAND ${contrib}/damaged_checkpoints.py --keyblock ${keyblock}
      --number ${CMAKE_MATCH_3} --seeds 7 --ranks ${CMAKE_MATCH_2}
      --memory $<IF:${no_limit},0,2>)
endforeach()
