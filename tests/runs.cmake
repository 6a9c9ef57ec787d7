# bitwise the same history when repeated on equal ranks
foreach(case "incline_30 1 quick" "incline_3d 2 ranks" "incline_30 2 nightly"
    "incline_3d 1 nightly" "toppling_slides_and_topples 1 nightly"
    "toppling_slides_and_topples 2 nightly")
  string(REGEX MATCH "(.*) (.*) (.*)" case ${case})
  keyblock_test(repeat/${CMAKE_MATCH_1}.${CMAKE_MATCH_2} ${CMAKE_MATCH_3}
    RANKS ${CMAKE_MATCH_2} COMMAND repeat.py ${keyblock}
      ${verification}/${CMAKE_MATCH_1}.prm ${CMAKE_MATCH_2}
      ${out}/repeat_${CMAKE_MATCH_1}.${CMAKE_MATCH_2})
endforeach()
foreach(ranks 1 2)
  keyblock_test(repeat/sliding_block.${ranks} nightly RANKS ${ranks} COMMAND repeat.py
    ${keyblock} ${prm}/tutorial/sliding_block.prm ${ranks}
    ${out}/repeat_sliding_block.${ranks})
endforeach()

# history.csv of a run that goes on
keyblock_test(history quick COMMAND history.py ${keyblock} ${verification}/incline_30.prm
  ${out}/history)
# the state before the first step is the first that is written
keyblock_test(first_state quick COMMAND first_state.py ${keyblock} ${verification}
  ${out}/first_state)
# what a terminal shows while a run goes on
foreach(case factors stage)
  keyblock_test(progress/${case} quick COMMAND progress.py ${keyblock} ${verification}
    ${out}/progress_${case} ${case})
endforeach()
# displacements, records and ramps of supports, by closed forms
keyblock_test(moving_supports quick COMMAND moving_supports.py ${keyblock}
  ${out}/moving_supports)
# time and memory of a run as --validate prints them
keyblock_test(estimate quick COMMAND estimate.py ${keyblock} ${prm} ${out}/estimate)
# summary.json and study.json are as doc/*.schema.json say, what is damaged is not
keyblock_test(schema quick COMMAND schema.py ${keyblock} ${prm} ${out}/schema
  bolted_incline)
keyblock_test(schema_of_more_scenes nightly COMMAND schema.py ${keyblock} ${prm}
  ${out}/schema_of_more_scenes)
# blocks that fail side by side, one of which trials alone would call safe
keyblock_test(failed_neighbours quick COMMAND failed_neighbours.py ${keyblock}
  ${verification}/failed_neighbours.prm ${out}/failed_neighbours)
keyblock_test(study/incline ranks RANKS 2 COMMAND study.py ${keyblock}
  ${verification}/study_incline.prm ${out}/study_incline)

# joint laws with a memory, compliant joints, the slip of a block by its monitor, and
# bolts in static solutions
foreach(ranks 1 2)
  set(label nightly)
  if(ranks EQUAL 1)
    set(label quick)
  endif()
  foreach(law slip_weakening dilation)
    keyblock_test(law/${law}.${ranks} ${label} RANKS ${ranks} COMMAND law/${law}.py
      ${keyblock} ${verification}/incline_30.prm ${out}/${law}.${ranks} ${ranks})
  endforeach()
  foreach(case "wave nightly" "box ${label}" "block ${label}" "dilates nightly"
      "rigid ${label}")
    string(REGEX MATCH "(.*) (.*)" case ${case})
    keyblock_test(law/compliant_${CMAKE_MATCH_1}.${ranks} ${CMAKE_MATCH_2} RANKS ${ranks}
      COMMAND law/compliant_joints.py ${CMAKE_MATCH_1} ${keyblock} ${verification}
        ${out}/compliant_${CMAKE_MATCH_1}.${ranks} ${ranks})
  endforeach()
  keyblock_test(law/newmark_block.${ranks} ${label} RANKS ${ranks}
    COMMAND law/newmark_block.py ${keyblock} ${verification}/shaken_incline.prm
      ${out}/newmark_block.${ranks} ${ranks})
  keyblock_test(static_bolts.${ranks} ${label} RANKS ${ranks} COMMAND static_bolts.py
    ${keyblock} ${prm} ${out}/static_bolts.${ranks} ${ranks})
endforeach()

# factors of random blocks against exact ones: see contrib/factors.py
function(keyblock_factors name label kind seeds)
  keyblock_test(factors/${name} ${label} COMMAND ${contrib}/factors.py
    --keyblock ${keyblock} --kinds ${kind} --seeds ${seeds}
    --keep ${out}/factors_${name} ${ARGN})
endfunction()
keyblock_factors(incline quick incline 1-4)
keyblock_factors(incline_3d nightly incline_3d 1-2)
# its plane was bent at free faces, too, which then caught each other
keyblock_factors(incline_3d_bent_edge nightly incline_3d 17)
# a side face that ended at its joint's upper edge held the node there
keyblock_factors(incline_3d_edge nightly incline_3d 103,132)
# traces moved across free faces and turned them over, corners of the box stayed
# off the plane, edges slid on the joint that they did not share
keyblock_factors(incline_3d_trace nightly incline_3d 107,117,134,139)
keyblock_factors(water nightly water 101-102)
# a point at the heel that took its cohesion and let go in turns: 2.3 % too low
keyblock_factors(water_heel nightly water 2411,2421,2440 --tolerance 1e-3)
# cohesion on the two planes of a wedge: areas, and what pairs hand on as they slide
keyblock_factors(wedge nightly wedge 102)
keyblock_factors(wedge_exact nightly wedge 129 -- --set Mesh/Snap=0)
# faces that the mesh has bent by 7 cm: with other time steps the trial at 0.08 %
# above may slide by 2.5 mm and hold there
keyblock_factors(wedge_bent quick wedge 129 --tolerance 1e-3)
# bolts in both conventions
keyblock_factors(bolted nightly bolted_active,bolted_passive,bolted_roof 1-4)
# limit equilibrium of the same, bent and not, as --validate prints it
keyblock_factors(statics quick incline,incline_3d,wedge 1-2 --statics --tolerance 1e-4)
keyblock_factors(more_statics nightly incline,incline_3d,wedge 3-6 --statics
  --tolerance 1e-4)
# strong discs and traces that end beside the plane, nearer than cells are large:
# they closed against it and held the block, factor 11531 for 1.95
keyblock_factors(statics_beside quick incline,incline_3d 1026,1063 --statics
  --tolerance 1e-4)
keyblock_factors(more_statics_beside nightly incline,incline_3d
  1038,1066,1068,1071,1079,1080 --statics --tolerance 1e-4)

# a finer mesh for the spherical cavity
foreach(case elastic mohr_coulomb)
  set(mesh ${out}/cavity_${case}_fine.ucd)
  keyblock_test(cavity_fine/${case} nightly RANKS 2 COMMAND sh -c
    "\"$0\" ${contrib}/cavity_mesh.py ${mesh} --cells 12 --layers 30 --first 0.01 && \
      exec \"$0\" \"$@\"" ${Python3_EXECUTABLE}
    ${CMAKE_CURRENT_SOURCE_DIR}/compare.py ${keyblock}
    ${verification}/cavity_${case}.prm
    ${CMAKE_CURRENT_SOURCE_DIR}/scenes/cavity_${case}_fine.ref 2
    ${out}/cavity_${case}_fine.2 --set=Domain/File=${mesh})
endforeach()

# collapse of footings, extrapolated over two meshes: see contrib/footing.py
foreach(case "10 1" "20 1" "30 2" "35 2") # friction angle, tolerance
  string(REGEX MATCH "(.*) (.*)" case ${case})
  keyblock_test(footing/${CMAKE_MATCH_1} nightly COMMAND ${contrib}/footing.py
    --keyblock ${keyblock} --angles ${CMAKE_MATCH_1} --tolerances ${CMAKE_MATCH_2}
    --keep ${out}/footing_${CMAKE_MATCH_1})
endforeach()
keyblock_test(quiet_beam nightly COMMAND ${contrib}/quiet_beam.py --keyblock ${keyblock})

# how uncertain a factor is: see contrib/factor_uncertainty.py
function(keyblock_factor_uncertainty scene label exact largest)
  keyblock_test(factor_uncertainty/${scene} ${label} COMMAND
    ${contrib}/factor_uncertainty.py ${verification}/${scene}.prm --keyblock ${keyblock}
    --exact ${exact} --largest ${largest} ${ARGN}
    --keep ${out}/factor_uncertainty_${scene})
endfunction()
keyblock_factor_uncertainty(factor_incline nightly 0.6880592575 0.001 --meshes 3)
keyblock_factor_uncertainty(cohesive_incline nightly 2.0193680 0.001)
keyblock_factor_uncertainty(wedge_3d nightly 0.8770217778 0.01)
keyblock_test(factor_uncertainty/ratios quick COMMAND factor_uncertainty.py
  ${CMAKE_SOURCE_DIR} ${out}/factor_uncertainty_ratios)
