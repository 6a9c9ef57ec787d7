# bent joints against planes: see surfaces.py
foreach(case "physical_groups_2d quick" "physical_groups_3d quick" "roof_wedge nightly"
    "trough quick" "small_parts quick" "touching_solids quick")
  string(REGEX MATCH "(.*) (.*)" case ${case})
  keyblock_test(surfaces/${CMAKE_MATCH_1} ${CMAKE_MATCH_2} COMMAND surfaces.py
    ${keyblock} ${prm} ${out}/surfaces_${CMAKE_MATCH_1} ${CMAKE_MATCH_1})
endforeach()

# exact volumes between random planes: see arrangement.py
foreach(case "2 12 3-4" "2 6 21-22 --excavation" "3 6 1" "3 4 21 --excavation")
  separate_arguments(arguments UNIX_COMMAND "${case}")
  string(REGEX REPLACE "[^0-9a-z]+" "_" name "${case}")
  keyblock_test(arrangement/${name} quick
    COMMAND arrangement.py ${keyblock} ${out}/arrangement_${name} ${arguments})
endforeach()

# exact volumes over vaults of chords: see outline_chords.py
foreach(case "2 6,16" "2 6,16 --infinite" "3 6" "3 6 --infinite")
  separate_arguments(arguments UNIX_COMMAND "${case}")
  string(REGEX REPLACE "[^0-9a-z]+" "_" name "${case}")
  keyblock_test(outline_chords/${name} quick
    COMMAND outline_chords.py ${keyblock} ${out}/outline_chords_${name} ${arguments})
endforeach()

# two finite joints that are nearer to each other than cells are large
foreach(shift 0.000001 0.001 0.05 0.2)
  keyblock_test(twin_joints/${shift} quick COMMAND twin_joints.py ${keyblock} ${shift})
endforeach()

# keyblock_networks(NAME LABEL ARGUMENT...) meshes random networks: contrib/networks.py
function(keyblock_networks name label)
  keyblock_test(networks/${name} ${label} COMMAND ${contrib}/networks.py
    --keyblock ${keyblock} --keep ${out}/networks_${name} ${ARGN})
endfunction()
keyblock_networks(traces nightly --kinds traces --numbers 20,100 --seeds 1-3 --least 0.05)
keyblock_networks(many_traces nightly --kinds traces --numbers 400 --seeds 1 --least 0.03)
keyblock_networks(discs nightly --kinds discs --numbers 20 --seeds 1-2 --least 0.05)
keyblock_networks(planes nightly --kinds planes --numbers 4 --seeds 1-2 --least 0.05)
keyblock_networks(two_ranks nightly --kinds traces --numbers 50 --seeds 4 --least 0.05
  --ranks 2)
set_property(TEST networks/two_ranks PROPERTY PROCESSORS 2)
keyblock_networks(hydrostatic quick --kinds traces,discs,faces --numbers 5 --seeds 1
  --initial)
keyblock_networks(hydrostatic_more nightly --kinds traces,discs,faces --numbers 20
  --seeds 1 --initial)
keyblock_networks(hydrostatic_planes nightly --kinds planes --numbers 12 --seeds 2
  --initial)
keyblock_networks(hydrostatic_planes_more nightly --kinds planes --numbers 5,20
  --seeds 2-3 --initial)
keyblock_networks(dug quick --kinds traces --numbers 20 --seeds 1-2 --run)
# bent joints that slide: partners lie behind planes of each other's faces
keyblock_networks(dug_discs nightly --kinds discs --numbers 5 --seeds 1 --run
  -- --set "Domain/Truncated boundaries=none" --set "Joints/*/Friction angle=3")
keyblock_networks(lines nightly --kinds lines --numbers 15 --seeds 590-591)
keyblock_networks(more_lines nightly --kinds lines --numbers 5,15 --seeds 590-599)
keyblock_networks(many_lines nightly --kinds lines --numbers 40 --seeds 590-591)
keyblock_networks(faces nightly --kinds faces --numbers 6 --seeds 1)
keyblock_networks(many_faces nightly --kinds faces --numbers 3,8,20 --seeds 1)
keyblock_networks(polylines nightly --kinds polylines --numbers 3,20 --seeds 1)
keyblock_networks(more_polylines nightly --kinds polylines --numbers 3,20 --seeds 2-3)
keyblock_networks(sheets quick --kinds sheets --numbers 2 --seeds 1)
keyblock_networks(more_sheets nightly --kinds sheets --numbers 1,3 --seeds 1-3)
keyblock_networks(for_blocks nightly --kinds traces,lines --numbers 20 --seeds 1
  -- --set "Mesh/Cells across blocks=3")
