#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is written first is the state before the first step.

usage: first_state.py KEYBLOCK PRM FOLDER

With an initial equilibrium, joints bear the initial stress in the first VTU and
in the first row of history.csv, at time 0; without one the row has the initial
velocity and its energy.
"""
import csv
import subprocess
import sys

from vtu_reader import Grid

KEYBLOCK, PRM, FOLDER = sys.argv[1:4]


def run(scene, folder, *settings):
    """The first and second row of a run, by column."""
    subprocess.run([KEYBLOCK, f"{PRM}/{scene}.prm", "--output", folder]
                   + [word for s in settings for word in ("--set", s)],
                   check=True, stdout=subprocess.DEVNULL)
    with open(f"{folder}/history.csv", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    names = [name.split(" [")[0] for name in names]
    first, second = (dict(zip(names, map(float, row))) for row in rows[:2])
    assert (first["stage"], first["step"], first["time"]) == (0., 0., 0.)
    assert second["step"] == 1. and second["time"] > 0.
    return first, second


def assert_equilibrium():
    """A roof wedge at 3 to 7 m depth, below rock of 26487 N/m3."""
    folder = FOLDER + "_equilibrium"
    first, second = run("roof_block_falls", folder, "Monitors/Names=block, all",
                        "Monitors/all/Kind=joint", "Monitors/all/Joint=all",
                        "Stages/dig/Maximum steps=20",
                        "Check/Closed form=none")
    assert first["block.u_x"] == first["block.u_y"] == 0.
    assert first["energy.kinetic"] == 0. and first["energy.residual"] == 0.
    assert first["energy.elastic"] > 0.
    assert first["unbalanced_ratio"] < 1e-8
    # 2 x 4.717 m of joint under a hydrostatic stress, but for what the mesh makes
    # of them
    hydrostatic = 26487. * 5. * 2. * 4.717
    assert abs(first["all.normal_force"] / hydrostatic - 1.) < 0.05, first
    # where a joint ends in rock that is dug later its sides are still welded
    joints = Grid(f"{folder}/interface_0000.vtu")
    pressure = [p for p, state in zip(joints.at_points["pressure (Pa)"],
                                      joints.called("state"))
                if state in ("sticking", "sliding")]
    print(f"{len(pressure)} points, pressure {min(pressure):.6g} to "
          f"{max(pressure):.6g} Pa")
    assert min(pressure) > 26487. * 3. / 4. and max(pressure) < 26487. * 7.
    # the room is there still
    cells = [Grid(f"{folder}/rock_{i:04d}.vtu").n_cells for i in (0, 1)]
    print(f"cells in the first and in the second output: {cells}")
    assert cells[0] > cells[1]


def assert_motion():
    """A bar that flies towards a wall."""
    first, _ = run("bar_impact", FOLDER + "_motion")
    assert first["energy.kinetic"] > 0. and first["energy.elastic"] == 0.
    speeds = [abs(v) for name, v in first.items() if ".v_" in name]
    assert max(speeds) > 0.


assert_equilibrium()
assert_motion()
