#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wedge over a vault of chords: its exact volume, or none.

usage: outline_chords.py KEYBLOCK FOLDER DIMENSION CHORDS [--infinite]

CHORDS like 6,9,12. Two joints meet above the vault and end inside it; in 3D two
more cut a length off. Cells are so coarse that the mesh, where it bends joints,
has their traces on chords beside those that they cross. What the summary has as
exact volume has to be that of the planes within 1 %; where the mesh follows the
joints it has one, and that to 1e-6. With --infinite the joints go on, so that the rest of what they enclose
is known, and each wedge has to have an exact volume.
"""
import json
import math
import pathlib
import subprocess
import sys

KEYBLOCK, FOLDER = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
DIM = int(sys.argv[3])
IS_INFINITE = "--infinite" in sys.argv
TOP = (1., 13.)
DIPS = (60., -55.)  # of the joints, to the right and to the left
ENDS = (2.1, 4.9)  # of the wedge in 3D
RADIUS, SPRINGLINE = 6., 4.
TOLERANCE, TOLERANCE_BENT = 1e-6, 1e-2


def chord_points(n):
    """The corners of the vault, from right to left."""
    return [(RADIUS * math.cos(math.pi * i / n),
             SPRINGLINE + RADIUS * math.sin(math.pi * i / n)) for i in range(n + 1)]


def direction(dip):
    """Down a joint."""
    return (math.copysign(math.cos(math.radians(dip)), dip),
            -math.sin(math.radians(abs(dip))))


def crossing(dip, points):
    """Where a joint enters the vault, and on which chord."""
    d, found = direction(dip), []
    for i, (a, b) in enumerate(zip(points, points[1:])):
        e, r = (b[0] - a[0], b[1] - a[1]), (a[0] - TOP[0], a[1] - TOP[1])
        det = -d[0] * e[1] + e[0] * d[1]
        t, s = (-r[0] * e[1] + e[0] * r[1]) / det, (d[0] * r[1] - d[1] * r[0]) / det
        if t > 0. and 0. <= s <= 1.:
            found.append((t, i, (TOP[0] + t * d[0], TOP[1] + t * d[1])))
    return min(found)[1:]


def area(n):
    """Of the wedge's section."""
    points = chord_points(n)
    (right, at_right), (left, at_left) = (crossing(dip, points) for dip in DIPS)
    corners = [TOP, at_left] + [points[k] for k in range(left, right, -1)] + [at_right]
    return 0.5 * abs(sum(a[0] * b[1] - a[1] * b[0]
                         for a, b in zip(corners, corners[1:] + corners[:1])))


def joints():
    """Entries of all joints, by name."""
    def text(*points):
        return "set Vertices = " + "; ".join(
            ", ".join(f"{x:.12g}" for x in p) for p in points)
    result = {}
    for name, dip in zip(("right", "left"), DIPS):
        d = direction(dip)
        normal = (-d[1], d[0])
        if IS_INFINITE:
            result[name] = [f"set Point = {TOP[0]}, {'0, ' * (DIM - 2)}{TOP[1]}",
                            f"set Normal = {normal[0]:.15g}, "
                            f"{'0, ' * (DIM - 2)}{normal[1]:.15g}"]
        else:
            end = (TOP[0] + 5. * d[0], TOP[1] + 5. * d[1])
            result[name] = [text(TOP, end) if DIM == 2 else
                            text((TOP[0], ENDS[0], TOP[1]), (end[0], ENDS[0], end[1]),
                                 (end[0], ENDS[1], end[1]), (TOP[0], ENDS[1], TOP[1]))]
    if IS_INFINITE:
        result["base"] = [f"set Point = 0, {'0, ' * (DIM - 2)}8.5",
                          f"set Normal = 0, {'0, ' * (DIM - 2)}1"]
    if DIM == 3:
        for name, y in zip(("front", "back"), ENDS):
            result[name] = ([f"set Point = 0, {y}, 0", "set Normal = 0, 1, 0"] if IS_INFINITE
                            else [text((-3., y, 8.), (5., y, 8.), (5., y, 14.), (-3., y, 14.))])
    return result


def write_scene(path, n, is_bent):
    """Blocks are found and measured; nothing is computed."""
    lines = [f"set Dimension = {DIM}", "subsection Domain",
             f"  set Corner = -14, {'0, ' * (DIM - 2)}-4",
             f"  set Size = 28, {'7, ' * (DIM - 2)}24", "  set Truncated boundaries = all",
             "end", "subsection Mesh", "  set Generator = gmsh", "  set Size = 3",
             "  set Size at excavation = 1.3", *([] if is_bent else ["  set Snap = 0"]),
             "end", "subsection Excavations",
             "  set Names = vault", "  subsection vault", "    set Shape = horseshoe",
             "    set Width = 12", "    set Height = 10", f"    set Segments = {n}",
             *["    set From = -1", "    set To = 8"][:2 * (DIM - 2)], "  end", "end", "subsection Joints", "  set Names = " + ", ".join(joints())]
    for name, entries in joints().items():
        lines += [f"  subsection {name}"] + ["    " + entry for entry in entries] + ["  end"]
    lines += ["end", "subsection Materials", "  set Names = rock", "end",
              "subsection Output", "  set Write VTU = false", "end"]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def check(n, is_bent):
    """Whether the wedge over n chords is known, and whether it is wrong."""
    scene = FOLDER / f"{n}.prm"
    write_scene(scene, n, is_bent)
    run = subprocess.run([str(KEYBLOCK), str(scene), "--output", str(FOLDER / "output")],
                         capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout[-1000:] + run.stderr
    exact = area(n) * (ENDS[1] - ENDS[0] if DIM == 3 else 1.)
    blocks = json.loads((FOLDER / "output" / "summary.json").read_text(
        encoding="utf-8"))["blocks"]
    # that which is over the crown
    wedges = [b for b in blocks if "infinite" not in b["class"][0] and
              10. < b["centroid"][-1] < 13. and b["volume"] < 2. * exact]
    known = [b["exact_volume"] for b in wedges if "exact_volume" in b]
    tolerance = TOLERANCE_BENT if is_bent and not IS_INFINITE else TOLERANCE
    wrong = [v for v in known if abs(v / exact - 1.) > tolerance]
    print(f"{n} chords: {exact:.5f}, in the mesh "
          f"{[round(b['volume'], 5) for b in wedges]}, exact {known}", flush=True)
    return len(known), len(wrong)


def main():
    """Exit with 1 if a wedge has another volume than it is said to have."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    chords = [int(n) for n in sys.argv[4].split(",")]
    bent = [check(n, True) for n in chords]
    straight = [] if IS_INFINITE else [check(n, False) for n in chords[:1]]
    assert sum(wrong for _, wrong in bent + straight) == 0
    for found in bent if IS_INFINITE else straight:
        assert found[0] == 1


if __name__ == "__main__":
    main()
