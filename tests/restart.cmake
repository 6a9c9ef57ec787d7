# keyblock_restart(NAME LABEL RANKS SCENE [ARGUMENT...]) breaks runs off and continues
# them: see restart.py. In settings an @ stands for a semicolon.
function(keyblock_restart name label ranks scene)
  keyblock_test(restart/${name} ${label} RANKS ${ranks} TIMEOUT 600 COMMAND restart.py
    ${keyblock} ${prm}/${scene}.prm ${out}/restart_${name} ${ARGN})
endfunction()

# friction, and surface contact once the block slides
keyblock_restart(sliding_block nightly 1 tutorial/sliding_block --breaks 2)
keyblock_restart(sliding_block_2 nightly 2 tutorial/sliding_block --ranks 2)
keyblock_restart(sliding_block_stopped quick 1 tutorial/sliding_block --by stop --breaks 2)
keyblock_restart(sliding_block_full_disk nightly 1 tutorial/sliding_block --by full --breaks 2)
keyblock_restart(sliding_block_20 nightly 1 tutorial/sliding_block --breaks 20)
keyblock_restart(incline_3d_20 nightly 1 verification/incline_3d --breaks 20)
# on other numbers of ranks, scenes without corners, whose history does not
# hang on the last digit
keyblock_restart(newmark_other_ranks nightly 2 verification/newmark
  --ranks 1 2 --tolerance 1e-8 --set "Check/Closed form=none"
  --set "Stages/shake/Duration=0.4")
keyblock_restart(friction_rod_other_ranks nightly 2 verification/friction_rod
  --ranks 2 1 --tolerance 1e-8)
# large kinematics
keyblock_restart(toppling nightly 1 verification/toppling_slides_and_topples)
# two stages of excavation in plastic rock
keyblock_restart(order_stepped quick 1 verification/order_stepped
  --set "Materials/rock/Model=mohr_coulomb"
  --set "Materials/rock/Cohesion=1e5")
# elastic rock, whose stresses are kept in another form than they are written
keyblock_restart(order_elastic nightly 1 verification/order_stepped)
# joints and two stages of excavation, a block that is taken away, factors
set(two_stages --set "Excavations/Names=room, floor"
  --set "Excavations/floor/Stage=deepen"
  --set "Excavations/floor/Vertices=-3, -5@ 3, -5@ 3, -3@ -3, -3"
  --set "Stages/Names=dig, deepen" --set "Stages/deepen/Kind=quasi-static"
  --set "Safety factor/Removal slip=0.05" --set "Safety factor/Blocks=all"
  --set "Safety factor/Bracket=0.02" --set "Check/Closed form=none")
keyblock_restart(two_stages nightly 1 verification/roof_block_falls ${two_stages})
keyblock_restart(two_stages_2 nightly 2 verification/roof_block_falls --ranks 2 ${two_stages})
# springs of the far field and what couples them
keyblock_restart(far_field nightly 2 verification/kirsch_far_field
  --ranks 2 --set "Stages/dig/Kind=quasi-static" --set "Mesh/Size at excavation=0.1")
# a block that fails in the stage and is taken away, and its safety factor
keyblock_restart(roof_block nightly 1 verification/roof_block_falls
  --set "Safety factor/Removal slip=0.05"
  --set "Safety factor/Blocks=all" --set "Safety factor/Bracket=0.02"
  --set "Materials/rock/Model=mohr_coulomb"
  --set "Materials/rock/Cohesion=1e5")
keyblock_restart(factor_incline nightly 1 verification/factor_incline)
# and the support that it asks for by trials, where it falls freely
keyblock_restart(demand nightly 1 verification/roof_block_falls
  --breaks 2 --set "Safety factor/Removal slip=0.05"
  --set "Safety factor/Blocks=all" --set "Safety factor/Bracket=0.02"
  --set "Safety factor/Wanted=1.3" --set "Safety factor/Wanted by=strength reduction"
  --set "Joints/*/Friction angle=2" --set "Check/Closed form=none")
# a bolt that yields, and one installed in a later stage
set(bolted --set "Stages/Names=rest, again" --set "Stages/again/Kind=quasi-static"
  --set "Stages/again/Friction angle override=84.2894"
  --set "Stages/again/Unbalanced ratio=1e-7" --set "Bolts/Names=anchor, late"
  --set "Bolts/late/Stage=again" --set "Bolts/late/Heads=-0.1, 0.1"
  --set "Bolts/late/Ends=-0.1, -0.08" --set "Bolts/late/Area=1e-6"
  --set "Bolts/late/Yield force=50" --set "Bolts/late/Bond stiffness=1e8"
  --set "Bolts/late/Bond strength=1e5" --set "Bolts/late/Dowel stiffness=1e5"
  --set "Bolts/late/Dowel strength=2")
keyblock_restart(bolted quick 1 verification/bolted_incline ${bolted})
keyblock_restart(bolted_2 nightly 2 verification/bolted_incline --ranks 2 ${bolted})
# long enough for a signal to arrive before the end
keyblock_restart(factor_incline_stopped nightly 1 verification/factor_incline
  --by stop --breaks 2 --set "Safety factor/Bracket=0.003"
  --set "Mesh/Cells=80, 16")
# factors by rank groups, each of a block, after two stages
set(two_rank_groups --ranks 2 --set "Safety factor/Rank groups=2" --set "Mesh/Cells=80, 16"
  --set "Excavations/Names=uphill, downhill, slot"
  --set "Excavations/slot/Shape=box" --set "Excavations/slot/Corner=-0.05, 0"
  --set "Excavations/slot/Size=0.1, 0.1" --set "Stages/Names=rest, again"
  --set "Stages/again/Kind=quasi-static"
  --set "Stages/again/Friction angle override=84.2894"
  --set "Stages/again/Unbalanced ratio=1e-7")
keyblock_restart(rank_groups ranks 2 verification/factor_incline ${two_rank_groups})
keyblock_restart(rank_groups_stopped nightly 2 verification/factor_incline
  --by stop --breaks 2 ${two_rank_groups})
keyblock_restart(rank_groups_20 nightly 2 verification/factor_incline
  --breaks 20 ${two_rank_groups})
# cells at rest
keyblock_restart(pulse nightly 2 verification/pulse
  --ranks 2 --set "Time stepping/Rest speed=1e-3")
# shotcrete that yields under a block that moves off, and is sprayed with the stage
keyblock_restart(lined_roof quick 1 verification/lined_roof
  --set "Shotcrete/shell/Thickness=0.02" --set "Stages/dig/Maximum steps=3000")
# a structural liner, on one rank and two, and what a later stage leaves of it
set(structural --set "Shotcrete/shell/Young modulus=1e9" --set "Stages/Names=dig, again"
  --set "Excavations/Names=room, side" --set "Excavations/side/Stage=again"
  --set "Excavations/side/Vertices=1, -1@ 1.5, -1@ 1.5, 0@ 1, 0"
  --set "Stages/again/Kind=quasi-static" --set "Stages/dig/Maximum steps=2000"
  --set "Stages/again/Maximum steps=2000" --set "Safety factor/Blocks=none")
keyblock_restart(structural_liner nightly 1 verification/lined_roof ${structural})
keyblock_restart(structural_liner_2 nightly 2 verification/lined_roof --ranks 2 ${structural})
# ground beside the model that moves
keyblock_restart(free_field quick 1 verification/free_field --set "Stages/shake/Duration=0.3")
keyblock_restart(free_field_2 nightly 2 verification/free_field
  --ranks 2 --set "Stages/shake/Duration=0.3")
# springs of pairs, and of nodes that have slid
set(compliant --set "Joints/*/Normal stiffness=1e9"
  --set "Joints/*/Shear stiffness=5e8")
keyblock_restart(compliant_joints nightly 1 verification/incline_3d ${compliant})
keyblock_restart(compliant_joints_2 nightly 2 verification/incline_3d --ranks 2 ${compliant})
keyblock_restart(compliant_joints_other_ranks nightly 2 verification/newmark
  --ranks 1 2 --tolerance 1e-8 ${compliant})
# with turning normals, and born under stress, with stages and factors
keyblock_restart(compliant_joints_large nightly 1 verification/toppling_slides_and_topples
  ${compliant})
keyblock_restart(compliant_joints_two_stages quick 1 verification/roof_block_falls
  ${two_stages} ${compliant})

# slip that a weakening joint remembers
keyblock_restart(slip_weakening_2 nightly 2 verification/incline_30
  --ranks 2 --set "Check/Closed form=none"
  --set "Joints/base/Law=slip weakening" --set "Joints/base/Slip distance=0.1"
  --set "Joints/base/Residual friction angle=20")

# factors from states that a run has kept are those of a run
foreach(case "1.1 quick" "2.1 nightly" "2.2 nightly") # ranks and rank groups
  string(REGEX MATCH "((.)[.](.)) (.*)" case ${case})
  keyblock_test(restart/kept_states.${CMAKE_MATCH_1} ${CMAKE_MATCH_4}
    RANKS ${CMAKE_MATCH_2} COMMAND kept_states.py ${keyblock} ${prm}
      ${out}/kept_states.${CMAKE_MATCH_1} ${CMAKE_MATCH_2} ${CMAKE_MATCH_3})
endforeach()
