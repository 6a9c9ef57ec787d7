#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A block slides down an incline whose joint dilates: the closed form.

usage: dilation.py KEYBLOCK SCENE OUTPUT RANKS

Friction 30 degrees, dilation 8 degrees up to a slip of 0.05 m, incline of 40
degrees. While it dilates the block moves along a line 8 degrees above the joint,
a_t = g (sin(40) - mu cos(40)) / (1 + mu tan(8)); what is left of the motion across
the joint when dilation ends is thrown off and comes back, and the opening stays.
"""
import csv
import json
import math
import subprocess
import sys

GRAVITY, DIP, FRICTION, DILATION, LIMIT = 9.81, 40., 30., 8., 0.05


def main():
    keyblock, scene, output, ranks = sys.argv[1:]
    subprocess.run(
        ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", ranks,
         keyblock, scene, "--output", output, "--set=Check/Closed form=none",
         # stiff: what it lifts off as it is let go is an error of the opening
         "--set=Materials/rock/Young modulus=2e9",
         f"--set=Joints/base/Dilation angle={DILATION}",
         f"--set=Joints/base/Dilation slip={LIMIT}"], check=True)
    with open(f"{output}/history.csv", encoding="utf-8") as file:
        rows = [{title.split(" ")[0]: float(value)
                 for title, value in row.items()}
                for row in csv.DictReader(file)]
    start = max(row["time"] for row in rows if row["stage"] < rows[-1]["stage"])
    dip, psi = math.radians(DIP), math.tan(math.radians(DILATION))
    friction = math.tan(math.radians(FRICTION))
    acceleration = (GRAVITY * (math.sin(dip) - friction * math.cos(dip))
                    / (1. + friction * psi))
    worst_slip = worst_opening = 0.
    for row in rows:
        time = row["time"] - start
        along = row["block.u_x"] * math.cos(dip) - row["block.u_y"] * math.sin(dip)
        across = row["block.u_x"] * math.sin(dip) + row["block.u_y"] * math.cos(dip)
        if time < 0.1 or row["stage"] < rows[-1]["stage"]:
            continue
        if along < 0.95 * LIMIT:
            worst_slip = max(worst_slip,
                             abs(along / (0.5 * acceleration * time**2) - 1.))
            worst_opening = max(worst_opening, abs(across / along / psi - 1.))
    final = across / (psi * LIMIT) - 1.
    with open(f"{output}/summary.json", encoding="utf-8") as file:
        energy = json.load(file)["energy"]
    print(f"errors: slip {worst_slip:.2e}, opening {worst_opening:.2e}, opening at "
          f"the end {final:.2e}; energy {energy}")
    return not (worst_slip < 5e-4 and worst_opening < 5e-4 and abs(final) < 1e-4
                and energy["dilation"] < 0.
                and abs(energy["relative_residual"]) < 1e-9)


if __name__ == "__main__":
    sys.exit(main())
