keyblock_scene(tutorial/sliding_block)
keyblock_scene(tutorial/joint_network)
# as the manual's page has it
keyblock_scene(tutorial/roof_wedge RANKS 1 SLOW REFERENCES tutorial_roof_wedge)
keyblock_scene(tutorial/first_tunnel RANKS 1 SLOW
  SET "Safety factor/Blocks=critical" "Safety factor/Stages=heading"
  "Safety factor/Bracket=0.02")
keyblock_scene(verification/resting)
keyblock_scene(verification/incline_25 ALIKE)
keyblock_scene(verification/incline_30)
keyblock_scene(verification/incline_35 ALIKE)
# one cell of the block, at the top, is quartered and does not set the step
keyblock_scene(verification/incline_30 REFERENCES incline_30_scaled ALIKE RANKS 1 2
  SET "Mesh/Refinement levels=(x > 0.325)*(x < 0.36)*(y > 0)*(y < 0.04)"
  "Time stepping/Least step=1.3e-4")
keyblock_scene(verification/incline_3d RANKS 1 2 4)
keyblock_scene(verification/bar_impact)
keyblock_scene(verification/oblique_impact)
keyblock_scene(verification/oblique_impact_stick ALIKE)
keyblock_scene(verification/newmark)
keyblock_scene(verification/newmark_rectangular ALIKE)
keyblock_scene(verification/shaken_incline)
keyblock_scene(verification/shaken_incline REFERENCES shaken_incline_8 RANKS 1
  SET "Domain/Corner=-1, -0.0625" "Domain/Size=3, 0.5625" "Mesh/Cells=48, 9")
keyblock_scene(verification/shaken_incline REFERENCES shaken_incline_damped
  RANKS 1 SET "Stages/shake/Damping ratio=1")
keyblock_scene(verification/shaken_incline_full_sine RANKS 1 SLOW)
foreach(case e3c tunnel_20 sets_3d planes_6)
  keyblock_scene(verification/blocks_${case})
endforeach()
foreach(case e1 e2a e2b e3a e3b e3d sets_2d lines tunnel_15 tunnel_25 tunnel_30 cube_3
    cube_4 planes_4 planes_5)
  keyblock_scene(verification/blocks_${case} ALIKE)
endforeach()
keyblock_scene(verification/blocks_pyramid RANKS 1 2)
# the same about an axis that plunges by 20 degrees towards 30 degrees
keyblock_scene(verification/blocks_pyramid REFERENCES blocks_pyramid_turned RANKS 1
  SET "Excavations/tunnel/Trend=30" "Excavations/tunnel/Plunge=20"
  "Joints/*/Point=1.19707050163984, 2.073386929082167, 6.577848345501359"
  "Joints/left/Normal=-0.664494964168583, 0.581111768255231, 0.469846310392954"
  "Joints/right/Normal=0.835505035831417, -0.284913635529207, 0.469846310392954"
  "Joints/front/Normal=-0.286788218175523, -0.496731764892154, 0.819152044288992"
  "Joints/back/Normal=0.482962913144534, 0.836516303737808, 0.258819045102521")
keyblock_scene(verification/rotation)
# what small kinematics leave out
keyblock_scene(verification/rotation REFERENCES rotation_small RANKS 1 2
  SET "Time stepping/Kinematics=small" "Stages/spin/Duration=0.5"
  "Check/Closed form=none")
keyblock_scene(verification/turned_column RANKS 1 2)
foreach(case slides_and_topples topples_rough)
  keyblock_scene(verification/toppling_${case})
endforeach()
foreach(case topples_steep slides_and_topples_steep stays_friction slides_friction
    stays_slender topples_slender slides_slender)
  keyblock_scene(verification/toppling_${case} ALIKE)
endforeach()
keyblock_scene(verification/crossing RANKS 1 2 4)
keyblock_scene(verification/pile)
# cells at rest: left out or not, with a tolerance, in large displacements; the
# values of "regression" are those without skips
keyblock_scene(verification/pulse RANKS 1 2)
keyblock_scene(verification/pulse REFERENCES pulse_awake RANKS 1
  SET "Time stepping/Skip cells at rest=false")
keyblock_scene(verification/pulse REFERENCES pulse_tolerance ALIKE
  RANKS 1 2 SET "Time stepping/Rest speed=1e-3")
keyblock_scene(verification/pulse REFERENCES pulse_large RANKS 1
  SET "Time stepping/Kinematics=large")
keyblock_scene(verification/quiet_column RANKS 1 2)
keyblock_scene(verification/quiet_column REFERENCES quiet_column_shear RANKS 1
  SET "Supports/sides/Directions=y"
  "Initial state/Velocity=if(abs(y - 200) < 20, (1 + cos(pi*(y - 200)/20))/2, 0)@ 0")
# rock that a stage changes: the dashpots are those of the new rock
keyblock_scene(verification/quiet_column REFERENCES quiet_column_changed ALIKE
  RANKS 1 2 SET "Materials/Names=rock, hard" "Materials/hard/Stage=run"
  "Materials/hard/Young modulus=1e11" "Materials/hard/Poisson ratio=0.25"
  "Materials/hard/Density=2500" "Stages/run/Duration=0.13")
# waves from both ends, which are let in and out again; what is left of them
# when they are over drives nothing
keyblock_scene(verification/quiet_column REFERENCES quiet_column_wave RANKS 1
  SET "Initial state/Velocity=" "Supports/sides/Directions=y"
  "Supports/ends/Velocity=exp(-((t - 0.05)/0.01)^2)@ 0"
  "Stages/run/Duration=0.6")
# the dead load of what was held, and nothing moves
keyblock_scene(verification/quiet_column REFERENCES quiet_column_at_rest ALIKE
  RANKS 1 2 SET "Initial state/Velocity=" "Initial state/Gravity=0@ -9.81"
  "Initial state/Equilibrium=static")
keyblock_scene(verification/free_field RANKS 1 2)
keyblock_scene(verification/free_field REFERENCES free_field_pressure RANKS 1
  SET "Supports/bottom/Velocity=0@ if(t < 0.1, 0.05 * (1 - cos(20 * pi * t)), 0)")
keyblock_scene(verification/free_field REFERENCES free_field_doubled RANKS 1
  SET "Materials/soft/Young modulus=2.5e9" "Materials/soft/Density=2500"
  "Materials/soft/Poisson ratio=0.25" "Mesh/Cells=20, 60"
  "Stages/shake/Duration=0.144868329805")
keyblock_scene(verification/free_field REFERENCES free_field_gmsh ALIKE RANKS 1 2
  SET "Mesh/Generator=gmsh" "Mesh/Size=2.5")
keyblock_scene(verification/free_field REFERENCES free_field_held RANKS 1
  SET "Supports/bottom/Kind=held")
# the same, held along each axis by a support of its own
keyblock_scene(verification/free_field REFERENCES free_field_held_twice RANKS 1
  SET "Supports/bottom/Kind=held" "Supports/bottom/Directions=x"
  "Supports/Names=bottom, floor, sides" "Supports/floor/Boundaries=bottom"
  "Supports/floor/Directions=y")
keyblock_scene(verification/free_field_3d RANKS 1 2)
keyblock_scene(verification/rayleigh RANKS 1 2)
keyblock_scene(verification/rayleigh REFERENCES rayleigh_mass RANKS 1
  SET "Stages/swing/Rayleigh terms=mass")
keyblock_scene(verification/rayleigh REFERENCES rayleigh_stiffness RANKS 1
  SET "Stages/swing/Rayleigh terms=stiffness")
keyblock_scene(verification/joint_wave RANKS 1 2)
keyblock_scene(verification/joint_wave REFERENCES joint_wave_tenth RANKS 1
  SET "Joints/joint/Cohesion=1e4")
# the same from every fourth step
keyblock_scene(verification/joint_wave REFERENCES joint_wave_rows RANKS 1
  SET "Output/History interval=4")
# friction alone, and nodes of the joint held along its normal beside others
keyblock_scene(verification/joint_wave REFERENCES joint_wave_friction RANKS 1 2
  SET "Domain/Size=1.6, 80" "Mesh/Cells=4, 200"
      "Joints/joint/Friction angle=2.8624052261" "Joints/joint/Cohesion=0")
keyblock_scene(verification/joint_wave REFERENCES joint_wave_fiftieth RANKS 1
  SET "Joints/joint/Cohesion=2e3")
keyblock_scene(verification/joint_wave REFERENCES joint_wave_sticks RANKS 1
  SET "Joints/joint/Cohesion=1.01e5")
keyblock_scene(verification/slip_weakening RANKS 1 2)
keyblock_scene(verification/slip_weakening REFERENCES slip_weakening_early
  RANKS 1 SET "Stages/slip/Duration=0.2" "Check/Reference=0.0488366147")
# pairs that slide a hundredth of a face before they are contacts on surfaces
keyblock_scene(verification/slip_weakening REFERENCES slip_weakening_late ALIKE
  RANKS 1 2 SET "Contact/Slip tolerance=1e-2")
keyblock_scene(verification/cavern_at_depth RANKS 1 2)
keyblock_scene(verification/bond_break)
keyblock_scene(verification/bond_break_fast ALIKE)
keyblock_scene(verification/gravity_column)
keyblock_scene(verification/kirsch)
keyblock_scene(verification/kirsch_refined)
keyblock_scene(verification/kirsch_far_field RANKS 1 2 4)
keyblock_scene(verification/salencon RANKS 1 2)
keyblock_scene(verification/salencon_associated RANKS 2)
keyblock_scene(verification/footing RANKS 2)
keyblock_scene(verification/cavity_elastic RANKS 1 2)
keyblock_scene(verification/cavity_mohr_coulomb RANKS 1 SLOW)
keyblock_scene(verification/friction_rod)
# factors of the same slope by strength reduction
keyblock_scene(verification/slope_crack REFERENCES slope_weak_dry RANKS 1)
keyblock_scene(verification/slope_crack REFERENCES slope_weak_full_shaken RANKS 1
  SET "Joints/crack/Water pressure=9810*max(0, 60 - y)"
  "Joints/plane/Water pressure=9810*14.01*max(0, min(1, x/65.680527))"
  "Stages/rest/Seismic coefficient=-0.08, 0")
keyblock_scene(verification/slope_crack REFERENCES slope_strong_half_shaken RANKS 1
  SET "Joints/crack/Water pressure=9810*max(0, 52.995 - y)"
  "Joints/plane/Water pressure=9810*7.005*max(0, min(1, x/65.680527))"
  "Joints/plane/Friction angle=45" "Joints/plane/Cohesion=196200"
  "Joints/plane/Residual cohesion=196200"
  "Stages/rest/Seismic coefficient=-0.08, 0")
# the same by the level of the water that stands in the crack
keyblock_scene(verification/slope_crack REFERENCES slope_crack_filled RANKS 1
  SET "Joints/crack/Water level=60"
  "Joints/plane/Water pressure=9810*14.01*max(0, min(1, x/65.680527))"
  "Stages/rest/Seismic coefficient=-0.08, 0")
# a slab up to the surface of the ground
keyblock_scene(verification/ground_slope RANKS 1)
# and by a formula in t, which changes nothing, with all water on one rank of two
keyblock_scene(verification/slope_crack REFERENCES slope_crack_filled RANKS 2
  SET "Joints/crack/Water level=60 + 0*t"
  "Joints/plane/Water pressure=9810*14.01*max(0, min(1, x/65.680527)) + 0*t"
  "Stages/rest/Seismic coefficient=-0.08, 0")
keyblock_scene(verification/material_change)
keyblock_scene(verification/geostress RANKS 1 2 4)
keyblock_scene(verification/order_at_once ALIKE RANKS 1 2)
keyblock_scene(verification/order_left_first ALIKE)
keyblock_scene(verification/order_stepped)
keyblock_scene(verification/roof_block_falls)
# (several meshes: it hung on which node came to lie where)
foreach(size 0.2 0.3)
  keyblock_scene(verification/slides_past_ledge
    REFERENCES slides_past_ledge_${size} ALIKE RANKS 1 2
    SET "Mesh/Size at joints=${size}" "Mesh/Size at excavation=${size}")
endforeach()
keyblock_scene(verification/roof_block_stays ALIKE
  SET "Stages/dig/Unbalanced ratio=1e-7")
keyblock_scene(verification/gravity_column REFERENCES gravity_column_relaxed ALIKE
  SET "Stages/settle/Kind=quasi-static" "Stages/settle/Unbalanced ratio=1e-7")
keyblock_scene(verification/bar_impact REFERENCES bar_impact_refined ALIKE
  SET "Mesh/Refinement levels=(x < -6) + 2*(x > -3)*(y > 0.2)")
# half of the base's faces halved: nodes hang on the joint itself
keyblock_scene(verification/incline_3d REFERENCES incline_3d_refined
  SET "Mesh/Refinement levels=(0.389948096*x + 0.713134173*y - 0.582563416*z < 0.125)")
keyblock_scene(verification/roof_block_falls REFERENCES roof_block_removed
  SET "Safety factor/Removal slip=0.05")
# one that lies on another which fails has the factor of both
keyblock_scene(verification/carried_slab RANKS 1 2)
keyblock_scene(verification/carried_slab REFERENCES carried_slab_wanted RANKS 1
  SET "Safety factor/Wanted=0.7")
# the model is in balance while so light a block still falls
keyblock_scene(verification/light_wedge RANKS 1 2)
# and where it may not be taken away, the stage does not end in balance
keyblock_scene(verification/light_wedge REFERENCES light_wedge_falls RANKS 1
  SET "Safety factor/Removal slip=0" "Safety factor/Blocks=all"
  "Stages/dig/Maximum steps=5000")
# where it has fallen it stays, and not because stress clamps it
keyblock_scene(verification/roof_block_falls REFERENCES roof_block_fallen ALIKE
  RANKS 1 2 SET "Safety factor/Blocks=all")
# what starts in the corners of an opening does not hang on its tips
keyblock_scene(verification/roof_corners RANKS 1 2)
keyblock_scene(verification/roof_corners REFERENCES roof_corners_fine RANKS 1
  SET "Mesh/Size at excavation=0.2")
keyblock_scene(verification/roof_corners REFERENCES wall_corner RANKS 1
  SET "Joints/left/Vertices=3, 0@ 5, 2" "Joints/right/Vertices=5, 2@ 3, 5")
# one that creeps under damping, and one that would only just
keyblock_scene(verification/creeping_slide RANKS 1 2)
keyblock_scene(verification/creeping_slide REFERENCES creeping_slide_holds
  RANKS 1 SET "Joints/plane/Friction angle=35.3")
# blocks that weigh little beside what is set free, and have only begun to fall
keyblock_scene(verification/fall_seen RANKS 1 2)
keyblock_scene(tutorial/roof_wedge REFERENCES roof_wedge_falls RANKS 1 SLOW
  SET "Ground/Depth=100" "Ground/K0=0.2" "Joints/*/Friction angle=10"
  "Mesh/Cells across blocks=2" "Safety factor/Blocks=none"
  "Stages/dig/Unbalanced ratio=1e-3")
# of two blocks that slide past each other the one that moves is taken away
foreach(friction 10 20 25)
  keyblock_scene(verification/passing_slab REFERENCES passing_slab_${friction}
    ALIKE RANKS 1 2 SET "Joints/top/Friction angle=${friction}")
endforeach()
# blocks that hang on bolts; with plates weaker than their weight, without bolts,
# and where the upper one is dug from between: none is left to fall for ever, and
# the ramp after it has a length
keyblock_scene(verification/hanging_blocks RANKS 1 2)
keyblock_scene(verification/hanging_blocks REFERENCES hanging_blocks_weak
  RANKS 1 SET "Bolts/b/Plate strength=19e3")
# plates of 60 kN/m in all that yield to both: passive, both have 60/1.8/40
keyblock_scene(verification/hanging_blocks REFERENCES hanging_blocks_passive ALIKE
  RANKS 1 2 SET "Bolts/b/Spacing=1, 1.8" "Safety factor/Blocks=all"
  "Safety factor/Bolt convention=passive")
# plates and grout that slip have their share in the energy, but for round-off
keyblock_scene(verification/hanging_blocks REFERENCES hanging_blocks_slip
  RANKS 1 2 SET "Bolts/b/Plate strength=5e3" "Bolts/b/Bond strength=20e3"
  "Bolts/b/Free length=0")
keyblock_scene(verification/hanging_blocks REFERENCES hanging_blocks_bare
  RANKS 1 SET "Bolts/Names=")
keyblock_scene(verification/hanging_blocks REFERENCES hanging_blocks_dug ALIKE
  RANKS 1 2 SET "Bolts/Names=" "Excavations/Names=left, right, below, gap"
  "Excavations/gap/Shape=box" "Excavations/gap/Corner=-1, -1"
  "Excavations/gap/Size=2, 1" "Excavations/gap/Stage=later"
  "Stages/Names=rest, later" "Stages/later/Kind=quasi-static")
# safety factors of blocks on inclines: friction angle, dip
# the toe of a block has its joint's friction, where the joint ends there
keyblock_scene(verification/crack_water REFERENCES crack_water_rim RANKS 1 2
  SET "Joints/base/Friction angle=15" "Joints/crack/Water level=1.2"
  "Contact/Default friction angle=45")
keyblock_scene(verification/factor_incline)
keyblock_scene(verification/factor_incline REFERENCES factor_incline_rank_groups
  RANKS 2 SET "Safety factor/Rank groups=2")
# stages whose balance says nothing of factor 1: cut short, tied, coarse
foreach(case short,quasi-static,0.02,1e-6 static,static,0,1e-6
    coarse,quasi-static,0,1 dynamic,dynamic,0.02,1e-6)
  string(REPLACE "," ";" case ${case})
  list(GET case 0 name)
  list(GET case 1 kind)
  list(GET case 2 duration)
  list(GET case 3 ratio)
  keyblock_scene(verification/factor_incline REFERENCES factor_incline_${name}
    RANKS 1 SET "Stages/rest/Friction angle override=-1"
    "Stages/rest/Kind=${kind}" "Stages/rest/Duration=${duration}"
    "Stages/rest/Unbalanced ratio=${ratio}")
endforeach()
# the first guesses are undecided, and neither end of the bracket is known
keyblock_scene(verification/factor_incline REFERENCES factor_incline_undecided
  RANKS 1 SET "Safety factor/Maximum periods=2" "Safety factor/Bracket=1e-4"
  "Safety factor/Seismic coefficient=-0.000217, 0")
# a slot between two blocks, one for each rank group
keyblock_scene(verification/factor_incline REFERENCES factor_incline_two_blocks
  RANKS 2 4 SET "Safety factor/Rank groups=2"
  "Excavations/Names=uphill, downhill, slot" "Excavations/slot/Shape=box"
  "Excavations/slot/Corner=-0.05, 0" "Excavations/slot/Size=0.1, 0.1")
# two blocks that lean on each other, and the factor of both
keyblock_scene(verification/factor_group RANKS 1 2)
# an active wedge and a passive block, which moves half as far and sideways
keyblock_scene(verification/two_wedges RANKS 1 2)
keyblock_scene(verification/two_wedges REFERENCES two_wedges_upper RANKS 1
  SET "Safety factor/Blocks=2")
keyblock_scene(verification/two_wedges REFERENCES two_wedges_wanted ALIKE RANKS 1 2
  SET "Safety factor/Wanted=2" "Safety factor/Blocks=2"
  "Joints/plane/Friction angle=30")
# one that others catch at what is wanted, and that slides at less
keyblock_scene(verification/leaning_row RANKS 1 2 SET "Safety factor/Blocks=3")
# blocks whose faces the mesh must not bend, nor lead onto a corner
keyblock_scene(verification/daylight_wedge RANKS 1)
keyblock_scene(verification/dug_bed RANKS 1)
foreach(size 0.4 0.6)
  keyblock_scene(verification/bent_roof REFERENCES bent_roof_${size} RANKS 1
    SET "Mesh/Size at excavation=${size}" "Safety factor/Blocks=3")
endforeach()
# bent faces under hydrostatic stress, while nothing shakes them
keyblock_scene(verification/still_network RANKS 1 2)
# a hidden one that another uncovers as it falls
keyblock_scene(verification/uncovered_block RANKS 1)
# blocks that others push, which reach farther or move more slowly
keyblock_scene(verification/toe_block RANKS 1 SET "Safety factor/Blocks=2")
keyblock_scene(verification/column_on_block RANKS 1 SET "Safety factor/Blocks=2")
# support that a wanted factor asks for by trials: of a block that slides, also with a
# bolt, or bolts to come; of a wedge that falls; and pushed by others, where limit
# equilibrium asks for none
keyblock_scene(verification/factor_incline REFERENCES factor_incline_demand RANKS 1 2
  SET "Safety factor/Wanted=1.4" "Safety factor/Wanted by=strength reduction"
  "Safety factor/Bracket=0.002" "Joints/base/Friction angle=50"
  "Initial state/Gravity=9.81*sin(60*pi/180)@ -9.81*cos(60*pi/180)")
keyblock_scene(verification/factor_incline REFERENCES factor_incline_met RANKS 1
  SET "Safety factor/Wanted=0.65" "Safety factor/Wanted by=strength reduction")
keyblock_scene(verification/factor_incline REFERENCES factor_incline_demands RANKS 2
  SET "Safety factor/Wanted=1.1" "Safety factor/Wanted by=strength reduction"
  "Safety factor/Rank groups=2" "Safety factor/Bracket=0.002"
  "Excavations/Names=uphill, downhill, slot" "Excavations/slot/Shape=box"
  "Excavations/slot/Corner=-0.05, 0" "Excavations/slot/Size=0.1, 0.1")
keyblock_scene(verification/bolted_incline REFERENCES bolted_incline_demand RANKS 1
  SET "Safety factor/Wanted=1.5" "Safety factor/Wanted by=strength reduction"
  "Safety factor/Bracket=0.002")
keyblock_scene(verification/bolted_incline REFERENCES bolted_incline_to_come RANKS 1
  SET "Safety factor/Wanted=1.5" "Safety factor/Wanted by=strength reduction"
  "Safety factor/Bracket=0.002" "Safety factor/Stages=rest"
  "Stages/Names=rest, later" "Stages/later/Kind=quasi-static"
  "Stages/later/Friction angle override=84.2894" "Bolts/anchor/Stage=later")
# passive bolts that a pressure by trials stands for
keyblock_scene(verification/passive_bolts RANKS 1)
keyblock_scene(verification/falling_wedge RANKS 1 2)
keyblock_scene(verification/falling_wedge REFERENCES falling_wedge_3 ALIKE RANKS 1
  SET "Safety factor/Wanted=3")
keyblock_scene(verification/slanted_wedge REFERENCES slanted_wedge_demand RANKS 1
  SET "Safety factor/Wanted=2.2" "Safety factor/Wanted by=strength reduction")
keyblock_scene(verification/toe_block REFERENCES toe_block_demand RANKS 1 2
  SET "Safety factor/Wanted=1.25" "Safety factor/Wanted by=strength reduction"
  "Safety factor/Blocks=2" "Safety factor/Bracket=0.004")
keyblock_scene(verification/column_on_block REFERENCES column_on_block_demand
  RANKS 1 SET "Safety factor/Wanted=1.6" "Safety factor/Blocks=2"
  "Safety factor/Wanted by=strength reduction" "Safety factor/Bracket=0.004")
# both of a group ask for what both need, pressed wherever each is free, under stress
keyblock_scene(verification/carried_slab REFERENCES carried_slab_demand RANKS 1
  SET "Safety factor/Wanted=1.2" "Safety factor/Wanted by=strength reduction"
  "Safety factor/Bracket=0.01")
keyblock_scene(verification/two_wedges REFERENCES two_wedges_demand ALIKE RANKS 1
  SET "Safety factor/Wanted=2" "Safety factor/Wanted by=strength reduction"
  "Safety factor/Blocks=2" "Safety factor/Bracket=0.005")
# nothing ties what only met through rock that is dug
keyblock_scene(verification/wedges_at_point RANKS 1 2)
# rock that yields where its strength is reduced, too
keyblock_scene(verification/yielding_column RANKS 1)
keyblock_scene(verification/yielding_column REFERENCES yielding_column_friction
  RANKS 1 SET "Materials/rock/Friction angle=20" "Materials/rock/Cohesion=20e3")
keyblock_scene(verification/dilating_cohesion RANKS 1)
keyblock_scene(verification/bolted_shaft RANKS 1)
# a block at rest under one that slides off
keyblock_scene(verification/passed_block RANKS 1 2)
keyblock_scene(verification/passed_block REFERENCES passed_block_soft RANKS 1
  SET "Materials/rock/Young modulus=1e8")
keyblock_scene(verification/row RANKS 1)
keyblock_scene(verification/oblique_slide RANKS 1)
keyblock_scene(verification/row_3d RANKS 1)
keyblock_scene(verification/row_3d REFERENCES row_3d_leans RANKS 1
  SET "Joints/upper/Friction angle=10" "Joints/lower/Friction angle=30"
  "Safety factor/Blocks=none")
foreach(case 10_40 68_40 25_50 60_40 50_25 75_68 77_76 80_75)
  string(REPLACE "_" ";" angles ${case})
  list(GET angles 0 friction)
  list(GET angles 1 dip)
  keyblock_scene(verification/factor_incline REFERENCES factor_incline_${case}
    RANKS 1
    SET "Joints/base/Friction angle=${friction}"
    "Initial state/Gravity=9.81*sin(${dip}*pi/180)@ -9.81*cos(${dip}*pi/180)")
endforeach()
# a flat slab on a rough joint at the dip at which its strength is used up
keyblock_scene(verification/factor_incline REFERENCES factor_incline_rough ALIKE RANKS 1 2
  SET "Domain/Size=1, 0.12" "Mesh/Cells=40, 12" "Materials/rock/Density=265035.678"
  "Joints/base/Law=barton-bandis" "Joints/base/JRC=10" "Joints/base/JCS=50e6"
  "Joints/base/Residual friction angle=30" "Safety factor/Bracket=0.002"
  "Initial state/Gravity=9.81*sin(63.305*pi/180)@ -9.81*cos(63.305*pi/180)")
# bolts at three angles from the plane's normal, in both conventions
set(end_0 "0.05, -0.08")
set(end_30 "-0.0539230485, -0.08")
set(end_60 "-0.2617691454, -0.08")
set(free_0 0.12)
set(free_30 0.14)
set(free_60 0.22)
keyblock_scene(verification/bolted_incline RANKS 1 2)
# a weak dowel slips beside a strong one; what it dissipates is in the energy but for
# round-off
keyblock_scene(verification/bolted_incline REFERENCES bolted_incline_slip ALIKE RANKS 1 2
  SET "Safety factor/Blocks=none" "Stages/rest/Friction angle override=-1"
  "Bolts/Names=anchor, pin" "Bolts/anchor/Ends=0.05, -0.08"
  "Bolts/anchor/Free length=0.12" "Bolts/anchor/Dowel stiffness=1e6"
  "Bolts/anchor/Dowel strength=30" "Bolts/pin/Stage=rest"
  "Bolts/pin/Heads=-0.05, 0.1" "Bolts/pin/Ends=-0.05, -0.08"
  "Bolts/pin/Area=1e-9" "Bolts/pin/Young modulus=200e9" "Bolts/pin/Yield force=1e3"
  "Bolts/pin/Bond stiffness=1e6" "Bolts/pin/Bond strength=1e5"
  "Bolts/pin/Dowel stiffness=1e6" "Bolts/pin/Dowel strength=1e3")
foreach(angle 0 60)
  keyblock_scene(verification/bolted_incline REFERENCES bolted_incline_${angle}
    RANKS 1 SET "Bolts/anchor/Ends=${end_${angle}}"
    "Bolts/anchor/Free length=${free_${angle}}")
endforeach()
foreach(angle 0 30 60)
  keyblock_scene(verification/bolted_incline
    REFERENCES bolted_incline_passive_${angle} RANKS 1
    SET "Bolts/anchor/Ends=${end_${angle}}"
    "Bolts/anchor/Free length=${free_${angle}}"
    "Safety factor/Bolt convention=passive")
endforeach()
# a bolt across a gap, between two blocks that share no joint there
keyblock_scene(verification/bolted_gap RANKS 1 2)
keyblock_scene(verification/bolted_gap REFERENCES bolted_gap_active RANKS 1
  SET "Safety factor/Bolt convention=active" "Bolts/anchor/Yield force=30e3")
# a water table that rises in a stage and is drained in the next
keyblock_scene(verification/factor_incline REFERENCES water_table RANKS 1 2
  SET "Stages/Names=rest, wet, drained" "Stages/wet/Kind=quasi-static"
  "Stages/wet/Friction angle override=84.2894"
  "Stages/wet/Unbalanced ratio=1e-7" "Stages/wet/Water level=0.02"
  "Stages/drained/Kind=quasi-static"
  "Stages/drained/Friction angle override=84.2894"
  "Stages/drained/Unbalanced ratio=1e-7" "Stages/drained/Water level=none")
# water that rises with t stands still in trials
keyblock_scene(verification/factor_incline REFERENCES water_rises ALIKE RANKS 1 2
  SET "Stages/rest/Kind=dynamic" "Stages/rest/Duration=0.05"
  "Joints/base/Water pressure=8000*t")
# the same by joints that are drained under the water table that stays
keyblock_scene(verification/factor_incline REFERENCES water_drained RANKS 1
  SET "Stages/Names=rest, wet, drained" "Stages/wet/Kind=quasi-static"
  "Stages/wet/Friction angle override=84.2894"
  "Stages/wet/Unbalanced ratio=1e-7" "Stages/wet/Water level=0.02"
  "Stages/drained/Kind=quasi-static"
  "Stages/drained/Friction angle override=84.2894"
  "Stages/drained/Unbalanced ratio=1e-7" "Stages/drained/Drained joints=base")
keyblock_scene(verification/friction_rod_400 RANKS 2)
foreach(angle 10 20 30 35)
  keyblock_scene(verification/footing_${angle} RANKS 1)
endforeach()
# what supports move is not taken away
keyblock_scene(verification/dragged_block RANKS 1 2)
keyblock_scene(verification/wedge_3d RANKS 2)
# the factor divides the friction of one of its planes
keyblock_scene(verification/wedge_3d REFERENCES wedge_3d_reduced_a RANKS 2
  SET "Safety factor/Joints=A")
keyblock_scene(verification/wedge_slides RANKS 2)
keyblock_scene(verification/roof_wedge RANKS 2)
# its weight grows to 0.98 and 1.02 of what pulls it out
foreach(case bears,1.97 pulled_out,2.05)
  string(REPLACE "," ";" case ${case})
  list(GET case 0 name)
  list(GET case 1 load)
  keyblock_scene(verification/roof_wedge REFERENCES roof_wedge_${name} RANKS 1
    SET "Safety factor/Blocks=none" "Stages/rest/Kind=dynamic"
    "Stages/rest/Unbalanced ratio=0" "Stages/rest/Duration=0.6"
    "Stages/rest/Mass damping=40" "Stages/rest/Damping ratio=0.3"
    "Initial state/Gravity=0@ -9.81*(1 + (${load} - 1)*0.5*(1 - cos(pi*min(1, t/0.4))))")
endforeach()
keyblock_scene(verification/roof_wedge REFERENCES roof_wedge_ratio_10 RANKS 1
  SET "Materials/layer/Poisson ratio=0.444444444444")
# cohesion [Pa], friction angle; the last with a tensile strength besides
keyblock_scene(verification/cohesive_incline RANKS 1 2)
foreach(case 200_40 4000_20 500_10)
  string(REPLACE "_" ";" strength ${case})
  list(GET strength 0 cohesion)
  list(GET strength 1 friction)
  keyblock_scene(verification/cohesive_incline
    REFERENCES cohesive_incline_${case} RANKS 1
    SET "Joints/base/Cohesion=${cohesion}"
    "Joints/base/Friction angle=${friction}")
endforeach()
keyblock_scene(verification/cohesive_incline
  REFERENCES cohesive_incline_tension RANKS 1
  SET "Joints/base/Tensile strength=1000")
# clamped: pressure, friction angle
keyblock_scene(verification/roof_clamped RANKS 1 2)
# blocks that supports hold, and blocks with an edge and nothing else in common
keyblock_scene(verification/block_at_wall RANKS 1 2)
keyblock_scene(verification/half_trough RANKS 1)
keyblock_scene(verification/blocks_at_edge RANKS 1 2)
# a block that rocks slowly until it stands
keyblock_scene(verification/leaning_column RANKS 1)
keyblock_scene(verification/lined_roof RANKS 1 2)
keyblock_scene(verification/lined_roof REFERENCES lined_roof_weight RANKS 1
  SET "Shotcrete/shell/Density=2400")
keyblock_scene(verification/lined_roof REFERENCES lined_roof_thin RANKS 1
  SET "Shotcrete/shell/Thickness=0.02")
keyblock_scene(verification/lined_roof REFERENCES lined_roof_bends RANKS 1 2
  SET "Shotcrete/shell/Young modulus=10e9")
keyblock_scene(verification/lined_roof REFERENCES lined_roof_active RANKS 1
  SET "Safety factor/Bolt convention=active")
# a second shell in a stage that does nothing else
keyblock_scene(verification/lined_roof REFERENCES lined_roof_twice ALIKE RANKS 1 2
  SET "Stages/Names=dig, again" "Stages/again/Kind=quasi-static"
  "Stages/again/Unbalanced ratio=1e-6" "Shotcrete/Names=shell, more"
  "Shotcrete/more/Stage=again" "Shotcrete/more/Excavations=room"
  "Shotcrete/more/Thickness=0.05" "Shotcrete/more/Shear strength=0.4e6"
  "Shotcrete/more/Shear modulus=1e8" "Shotcrete/more/Density=0")
# a weak layer slips until another one holds, the same
keyblock_scene(verification/lined_roof REFERENCES lined_roof_slip ALIKE RANKS 1 2
  SET "Safety factor/Blocks=none" "Shotcrete/Names=shell, more"
  "Shotcrete/shell/Shear strength=0.05e6" "Shotcrete/more/Stage=dig"
  "Shotcrete/more/Excavations=room" "Shotcrete/more/Thickness=0.05"
  "Shotcrete/more/Shear strength=0.4e6" "Shotcrete/more/Shear modulus=1e8"
  "Shotcrete/more/Density=0")
# seismic forces act on its mass, too
keyblock_scene(verification/lined_roof REFERENCES lined_roof_shaken ALIKE RANKS 1 2
  SET "Shotcrete/shell/Density=2400" "Stages/dig/Seismic coefficient=0, -0.5")
keyblock_scene(verification/lined_roof_3d RANKS 1 2)
# thrust and moment of structural liners
# a structural liner of which the next stage takes a wall
keyblock_scene(verification/lined_roof REFERENCES lined_roof_cut RANKS 1 2
  SET "Shotcrete/shell/Young modulus=1e9" "Stages/Names=dig, again"
  "Excavations/Names=room, side" "Excavations/side/Stage=again"
  "Excavations/side/Vertices=1, -1@ 1.5, -1@ 1.5, 0@ 1, 0"
  "Stages/again/Kind=quasi-static" "Stages/again/Unbalanced ratio=1e-6"
  "Safety factor/Blocks=none")
keyblock_scene(verification/lined_tunnel RANKS 1 2)
keyblock_scene(verification/lined_tunnel_3d RANKS 1 2)
# a pattern of bolts in 3D that a gallery cuts, or passes above
keyblock_scene(verification/bolted_roof_3d RANKS 1 2)
# slabs one under the other on the same bolts
keyblock_scene(verification/hanging_slabs RANKS 1 2)
# both ask for what their group does
keyblock_scene(verification/hanging_slabs REFERENCES hanging_slabs_demand RANKS 1 2
  SET "Safety factor/Wanted=2" "Safety factor/Wanted by=strength reduction")
# hard rock on soft bolts: a swing takes much longer than waves through the block
keyblock_scene(verification/hanging_slabs REFERENCES hanging_slabs_hard RANKS 1 2
  SET "Materials/rock/Young modulus=1e11")
keyblock_scene(verification/hanging_slabs REFERENCES hanging_slabs_soft ALIKE RANKS 1 2
  SET "Materials/rock/Young modulus=1e11" "Bolts/hanger/Area=1e-5")
keyblock_scene(verification/hanging_slabs REFERENCES hanging_slabs_softer RANKS 1
  SET "Materials/rock/Young modulus=1e11" "Bolts/hanger/Area=5e-6"
  "Safety factor/Blocks=1")
keyblock_scene(verification/hanging_chain REFERENCES hanging_chain_hard RANKS 1
  SET "Materials/rock/Young modulus=1e11")
# blocks judged by statics alone, without a step
keyblock_scene(verification/road_wedge REFERENCES road_wedge_statics RANKS 1 2
  SET "Safety factor/Method=limit equilibrium")
# on bolts that end in the upper one, but for one: critical as one body only
keyblock_scene(verification/hanging_pair RANKS 1 SET "Safety factor/Blocks=critical"
  "Safety factor/Wanted=0")
# or each on bolts that end in the one above it
keyblock_scene(verification/hanging_chain RANKS 1 2)
# blocks one behind the other on an incline, each on a bolt into the one behind it
keyblock_scene(verification/bolted_row ALIKE RANKS 1 2)
keyblock_scene(verification/bolted_row REFERENCES bolted_row_active RANKS 1
  SET "Safety factor/Bolt convention=active")
# hard rock: the lower block is in balance before the upper one's load comes on it
keyblock_scene(verification/bolted_row REFERENCES bolted_row_hard RANKS 1
  SET "Materials/rock/Young modulus=2e10" "Safety factor/Blocks=2")
keyblock_scene(verification/hanging_slabs REFERENCES hanging_slabs_all RANKS 1
  SET "Safety factor/Reduced joints=all")
# a bolt that breaks counts no more, and lets nothing go without a trace
keyblock_scene(verification/broken_bolt RANKS 1 2)
keyblock_scene(verification/broken_bolt REFERENCES broken_bolt_energy RANKS 1
  SET "Stages/Names=shake" "Safety factor/Stages=shake" "Safety factor/Blocks=none"
  "Time stepping/Safety=0.1")
keyblock_scene(verification/bolted_roof_3d REFERENCES bolted_roof_3d_above ALIKE
  RANKS 1 2 SET "Excavations/gallery/Corner=-3, -5, 7"
  "Excavations/gallery/Size=6, 10, 1" "Safety factor/Stages=gallery")
keyblock_scene(verification/roof_clamped REFERENCES roof_clamped_20 RANKS 1
  SET "Tractions/push/Traction=-20e3@ 0"
  "Initial state/Stress=-20e3@ 0@ -4e3@ 0")
keyblock_scene(verification/roof_clamped REFERENCES roof_clamped_45 RANKS 1
  SET "Joints/left/Friction angle=45" "Joints/right/Friction angle=45")
# joints whose friction is that of the pressure on them
keyblock_scene(verification/roof_clamped REFERENCES roof_clamped_rough RANKS 1
  SET "Joints/*/Law=barton-bandis" "Joints/*/JRC=10" "Joints/*/JCS=50e6"
  "Joints/*/Residual friction angle=25")
# blocks that cannot move, and that nothing holds
keyblock_scene(verification/factor_incline REFERENCES factor_level RANKS 1
  SET "Initial state/Gravity=0@ -9.81")
keyblock_scene(verification/roof_pinned RANKS 1 2)
keyblock_scene(verification/roof_pinned REFERENCES roof_flat_wedge RANKS 1
  SET "Mesh/Size=0.1"
  "Joints/left/Vertices=-0.6, 1@ 0, 1.2"
  "Joints/right/Vertices=0.6, 1@ 0, 1.2"
  "Materials/abutment/Region=if(y > 1 && 3*(y - 1) > 0.6 - abs(x), 1, -1)")
keyblock_scene(verification/roof_pinned REFERENCES roof_plumb RANKS 1
  SET "Joints/left/Vertices=-0.6, 1@ -0.6, 3" "Joints/left/Friction angle=5"
  "Joints/right/Vertices=0.6, 1@ 0.6, 3" "Joints/right/Friction angle=5"
  "Joints/back/Vertices=-0.6, 3@ 0.6, 3"
  "Materials/abutment/Region=if(y > 3 || (y > 1 && abs(x) > 0.6), 1, -1)")
# a toe that passes the crossing of two joints: acute or not, bed of one body or two
set(overhang "Domain/Corner=-0.536397023427, -0.1"
  "Domain/Edges=1.25, 0@ 0.0727940468532, 0.2"
  "Excavations/uphill/Formula=if(y > 0 && x - 0.363970234266*y < -0.25, 1, -1)"
  "Excavations/downhill/Formula=if(y > 0 && x - 0.363970234266*y > 0, 1, -1)"
  "Joints/front/Vertices=0, 0@ 0.0363970234266, 0.1")
set(crossing "Excavations/downhill/Stage=start" "Materials/bed/Model=rigid"
  "Contact/Weld infinite blocks=false" "Joints/front/Extent=infinite"
  "Joints/front/Vertices=")
keyblock_scene(verification/corner RANKS 1 2)
keyblock_scene(verification/corner REFERENCES corner_overhang RANKS 1
  SET ${overhang})
keyblock_scene(verification/corner REFERENCES corner_crossing RANKS 1
  SET ${crossing} "Joints/front/Normal=1, 0.363970234266")
keyblock_scene(verification/corner REFERENCES corner_crossing_overhang RANKS 1
  SET ${overhang} ${crossing} "Joints/front/Normal=1, -0.363970234266")
# the study in the plane, all stages and factors: one to two minutes
keyblock_scene(study/powerhouse RANKS 2 SLOW SET "Safety factor/Rank groups=2")
# blocks of the powerhouse in 3D and when they are exposed; nothing is computed
set(without_motion "Contact/Method=none" "Initial state/Equilibrium=none"
  "Safety factor/Blocks=none" "Output/Write VTU=false")
foreach(i 1 2 3 4 5 6 7 8)
  list(APPEND without_motion "Stages/stage_${i}/Kind=dynamic"
    "Stages/stage_${i}/Duration=1e-9" "Stages/stage_${i}/Unbalanced ratio=0"
    "Stages/stage_${i}/Maximum steps=1")
endforeach()
keyblock_scene(study/powerhouse_3d RANKS 1 SET ${without_motion})
# the same crown from files: as millimetres of a CAD program, and as triangles
foreach(suffix step stl)
  keyblock_scene(study/powerhouse_3d REFERENCES powerhouse_3d_${suffix} RANKS 2
    SET ${without_motion} "Excavations/crown/Shape=file"
    "Excavations/crown/File=${CMAKE_CURRENT_SOURCE_DIR}/shapes/crown.${suffix}")
endforeach()
keyblock_scene(verification/blocks_e3a REFERENCES blocks_e3a_dxf ALIKE RANKS 1 2
  SET "Excavations/opening/Shape=file" "Excavations/opening/Scale=0.001"
  "Excavations/opening/File=${CMAKE_CURRENT_SOURCE_DIR}/shapes/opening.dxf")

# bent joints: from points, from a drawing in millimetres, and from triangles
keyblock_scene(verification/kinked_joint RANKS 1 2)
keyblock_scene(verification/kinked_joint REFERENCES kinked_joint_dxf RANKS 1
  SET "Joints/fault/Shape=file" "Joints/fault/Vertices=" "Joints/fault/Scale=0.001"
  "Joints/fault/File=${CMAKE_CURRENT_SOURCE_DIR}/shapes/kinked.dxf")
# traces of a drawing that cross each other above the wedge that they bound
keyblock_scene(verification/roof_block_falls RANKS 1 2
  SET "Joints/Names=traces" "Joints/traces/Shape=file"
  "Joints/traces/Friction angle=40"
  "Joints/traces/File=${CMAKE_CURRENT_SOURCE_DIR}/shapes/crossing_traces.dxf"
  REFERENCES roof_block_traced)
keyblock_scene(verification/slip_circle RANKS 1)
