#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Permanent slip of a block that is shaken by a record, as its monitor tells it,
against Newmark's sliding block integrated over the same record.

usage: newmark_block.py KEYBLOCK SCENE OUTPUT RANKS [ENTRY=VALUE...]

The scene is shaken_incline; the base moves horizontally with a velocity of two
frequencies under a bell, so that the block slides in several strokes, downhill
alone. The integration has the pressure that shaking takes away.
"""
import csv
import math
import subprocess
import sys

GRAVITY, DIP, FRICTION = 9.81, math.radians(10.), math.tan(math.radians(30.))
START, LENGTH = 0.05, 1.
PARTS = ((0.27, 3.), (0.07, 5.))  # m/s, Hz


def acceleration(time):
    """Of the base, along its horizontal uphill [m/s2]."""
    t = time - START
    if not 0. < t < LENGTH:
        return 0.
    bell = math.sin(math.pi * t / LENGTH)**2
    slope = math.pi / LENGTH * math.sin(2. * math.pi * t / LENGTH)
    return sum(size * (slope * math.sin(2. * math.pi * f * t)
                       + bell * 2. * math.pi * f * math.cos(2. * math.pi * f * t))
               for size, f in PARTS)


def newmark(step=1e-5):
    """Slip [m] and the number of strokes."""
    slip = speed = 0.
    strokes = 0
    for i in range(round((START + LENGTH + 0.2) / step)):
        base = acceleration((i + 0.5) * step)
        # along the incline, downhill, and across it, out of the base
        drive = GRAVITY * math.sin(DIP) + base * math.cos(DIP)
        limit = FRICTION * max(0., GRAVITY * math.cos(DIP) - base * math.sin(DIP))
        if speed == 0. and abs(drive) <= limit:
            continue
        assert drive > -limit, "the block would slide uphill"
        strokes += speed == 0.
        after = max(0., speed + (drive - limit) * step)
        slip += 0.5 * (speed + after) * step
        speed = after
    return slip, strokes


def main():
    keyblock, scene, output, ranks, *settings = sys.argv[1:]
    terms = " + ".join(f"{size}*sin(2*pi*{f}*(t - {START}))" for size, f in PARTS)
    velocity = (f"if((t > {START})*(t < {START + LENGTH}), "
                f"-sin(pi*(t - {START})/{LENGTH})^2*({terms}), 0)")
    subprocess.run(
        ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", ranks, keyblock, scene, "--output", output,
         "--set=Check/Closed form=none", "--set=Output/Write VTU=false", "--set=Stages/shake/Duration=1.2",
         "--set=Monitors/block/Block=1", "--set=Materials/rock/Young modulus=1e10",
         f"--set=Materials/bed/Rigid velocity=({velocity})*cos(10*pi/180); ({velocity})*sin(10*pi/180)"]
        + [f"--set={setting}" for setting in settings], check=True,
        stdout=subprocess.DEVNULL)
    with open(f"{output}/history.csv", encoding="utf-8") as file:
        rows = [{title.split(" ")[0]: float(value) for title, value in row.items()}
                for row in csv.DictReader(file)]
    expected, strokes = newmark()
    slip, largest, opening = (rows[-1][f"block.{name}"] for name in ("slip", "largest_slip", "opening"))
    error = slip / expected - 1.
    print(f"slip {slip:.6g} m (largest {largest:.6g} m), Newmark {expected:.6g} m in {strokes} strokes, "
          f"error {error:.2e}; opening {opening:.2e} m; monitor of the joint {rows[-1]['base.slip']:.6g} m")
    return not (strokes >= 2 and abs(error) < 2e-3 and slip <= largest < 1.001 * slip
                and abs(opening) < 1e-6 and abs(rows[-1]["base.slip"] / slip - 1.) < 1e-9)


if __name__ == "__main__":
    sys.exit(main())
