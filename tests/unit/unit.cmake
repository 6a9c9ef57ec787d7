file(GLOB unit_files CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cc)
# (its main() defines macros before Boost's headers)
set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/main.cc PROPERTIES
  SKIP_UNITY_BUILD_INCLUSION ON)
add_executable(unit_tests ${unit_files})
target_compile_definitions(unit_tests PRIVATE
  KEYBLOCK_VERIFICATION_SCENES="${verification}"
  KEYBLOCK_TEST_SHAPES="${CMAKE_CURRENT_SOURCE_DIR}/shapes")
target_link_libraries(unit_tests keyblock_library)
set_up_code(unit_tests)
compile_quickly(unit_tests)
use_precompiled(unit_tests)

# but for many random meshes and large files
set(long joint_cut/random_planes_make_their_blocks joint_cut/mesh_stays_sound_3d
  shape_files/cylinder_from_step scene_joints/ten_thousand_rows)
list(JOIN long ":!" long)
keyblock_test(unit_tests.1 quick COST 50
  COMMAND unit_tests --log_level=message --run_test=!${long})
# suites whose results could depend on ranks
set(suites cell_order contact_search dispersion excavation_marks far_field
  force_element loads mass_scaling patch quiet_boundary rank_groups refinement
  split_equals_merged stability state_file state_seal step_spread
  structural_liner supports time_series vtu_file)
list(JOIN suites ":" suites)
set(mpirun mpirun --allow-run-as-root --oversubscribe -n)
keyblock_test(unit_tests.2 ranks RANKS 2
  COMMAND ${mpirun} 2 $<TARGET_FILE:unit_tests> --log_level=message --run_test=${suites})
foreach(ranks 1 2 4)
  keyblock_test(unit_tests_all.${ranks} nightly RANKS ${ranks}
    COMMAND ${mpirun} ${ranks} $<TARGET_FILE:unit_tests> --log_level=message)
endforeach()
keyblock_test(step_bounds_of_all_scenes nightly COMMAND unit_tests
  --run_test=step_bounds/bounds_of_all_scenes --log_level=message)
