#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The manual's first tunnel in Python: blocks, factors, support, and sweeps.

usage: first_tunnel.py        in a folder that has prm/tutorial

A horseshoe tunnel, 200 m deep, is dug as heading and bench through five joints.
`# %%` begins a cell for editors that run a script cell by cell. Needs the package
keyblock (PYTHONPATH=build/python, if it is not installed) and NumPy.
"""
# %% The scene: that of the tutorial, with joints of our own in place of its sets
import keyblock
import numpy

#          dip, dip direction, point,     half length, friction angle
JOINTS = {"J1": (60, 90, (1, 13), 5, 35),
          "J2": (55, 270, (1, 13), 5, 35),
          "J3": (35, 270, (8, 2.9), 4, 38),
          "J4": (40, 90, (7, 5.24), 4, 35),
          "J5": (70, 90, (-12, 6), 5, 35)}
overrides = {"Mesh/Size at excavation": 0.6,
             "Joint sets/east/Spacing": 0,
             "Joint sets/west/Spacing": 0,
             "Joints/Names": ", ".join(JOINTS),
             "Excavations/tunnel/Segments": 24}
for name, (dip, direction, point, radius, friction) in JOINTS.items():
    overrides.update({f"Joints/{name}/Dip": dip,
                      f"Joints/{name}/Dip direction": direction,
                      f"Joints/{name}/Point": point,
                      f"Joints/{name}/Extent": "disc",
                      f"Joints/{name}/Radius": radius,
                      f"Joints/{name}/Friction angle": friction})
scene = keyblock.Scene("prm/tutorial/first_tunnel.prm", overrides=overrides)
print(scene.title, "with joints", *scene.joints)

# %% What is there: blocks, and limit equilibrium without the in-situ stress
blocks = keyblock.find_blocks(scene)
for block in blocks:
    if not block.infinite:
        print(f"block {block.id}: {block.classes[-1]}, {block.volume:.2f} m2, "
              f"{block.weight / 1e3:.0f} kN/m, on {' '.join(block.joint_areas)}")
for one in blocks.limit_equilibrium(wanted=1.5):
    print(f"block {one.block} after {one.stage}: {one.factor:.4f}, {one.mode}; "
          f"1.5 asks for {one.support_force / 1e3:.1f} kN/m")

# %% What happens: the run, stage by stage
run = keyblock.Run(scene)
for stage in run:
    largest = numpy.linalg.norm(run.displacement, axis=1).max()
    least = numpy.nanmin(numpy.linalg.eigvalsh(run.stress[numpy.isfinite(
        run.stress[:, 0, 0])]))
    print(f"{stage.name}: {stage.steps} steps, largest displacement {largest:.4f} m, "
          f"largest compression {-least / 1e6:.1f} MPa")
for factor in run.factors:
    print(f"block {factor.block} after {factor.stage}: {factor.value:.3f} "
          f"[{factor.lower:.3f}, {factor.upper:.3f}], {factor.failure_mode}")

# %% What if: friction of all joints, by limit equilibrium and by strength reduction
angles = [20, 25, 30, 35, 40]
sweep = keyblock.sweep(scene, {"Joints/*/Friction angle": angles})
for sample in sweep.samples:
    slides = [one for one in sample.results if one.block == 1]
    print(f"{sample.values['Joints/*/Friction angle']} degrees: "
          f"block 1 has {slides[0].factor:.4f}")
# the deeper the tunnel, the better the crown block is clamped
for depth in (100, 200, 400):
    with keyblock.Run(scene.with_overrides({"Ground/Depth": depth,
                                            "Safety factor/Blocks": "none"})) as deeper:
        deeper.run_stage()
        print(f"{depth} m deep: block 2 after heading has "
              f"{deeper.find_factor(2).value:.3f}")
