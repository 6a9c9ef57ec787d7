#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random infinite joints: exact volumes of blocks against those of the planes.

usage: arrangement.py KEYBLOCK FOLDER DIMENSION JOINTS SEEDS [--excavation]

SEEDS like 1,4-6. In a cube with cells too coarse for all the corners between
the joints, maybe with an excavation, whatever has an exact volume in the summary
has to have that of the cell of the arrangement around its centroid, which is
computed here from all the corners where dim planes meet. The same of its areas on
joints. Most blocks have to have one.
"""
import itertools
import json
import math
import pathlib
import random
import subprocess
import sys

KEYBLOCK, FOLDER = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
DIM = int(sys.argv[3])
EXTENT, SIZE = (20., 0.6) if DIM == 2 else (10., 1.)
# (no joint is parallel to a face)
BOX = [(8.1, 11.3), (8.7, 11.2)] if DIM == 2 else [(3.6, 6.4), (3.2, 6.8), (4.1, 6.3)]
TOLERANCE = 1e-6


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def solve(rows, values):
    """The point where dim planes meet, by Cramer's rule; None: nowhere."""
    def det(m):
        if DIM == 2:
            return m[0][0] * m[1][1] - m[0][1] * m[1][0]
        return dot(m[0], cross(m[1], m[2]))
    whole = det(rows)
    if abs(whole) < 1e-10:
        return None
    return [det([[values[i] if k == d else row[k] for k in range(DIM)]
                 for i, row in enumerate(rows)]) / whole for d in range(DIM)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def measure(planes):
    """Volume of what lies behind all (normal, offset), and areas of its faces."""
    corners = []
    for some in itertools.combinations(range(len(planes)), DIM):
        x = solve([planes[i][0] for i in some], [planes[i][1] for i in some])
        if x and all(dot(n, x) <= c + 1e-9 for n, c in planes):
            corners.append(x)
    if len(corners) <= DIM:
        return 0., [0.] * len(planes)
    middle = [sum(x) / len(corners) for x in zip(*corners)]
    areas = [area_on(n, [x for x in corners if abs(dot(n, x) - c) < 1e-8])
             for n, c in planes]
    return sum(a * (c - dot(n, middle)) for a, (n, c) in zip(areas, planes)) / DIM, areas


def area_on(normal, corners):
    """Of the convex face with these corners, in any order."""
    if len(corners) < DIM:
        return 0.
    if DIM == 2:
        return max(math.dist(a, b) for a in corners for b in corners)
    middle = [sum(x) / len(corners) for x in zip(*corners)]
    first = [a - b for a, b in zip(corners[0], middle)]
    second = cross(normal, first)
    arms = sorted(([a - b for a, b in zip(x, middle)] for x in corners),
                  key=lambda r: math.atan2(dot(r, second), dot(r, first)))
    return 0.5 * abs(sum(dot(normal, cross(a, b))
                         for a, b in zip(arms, arms[1:] + arms[:1])))


def box_planes(box):
    """The planes of a box, facing out."""
    planes = []
    for d, (low, high) in enumerate(box):
        axis = [float(k == d) for k in range(DIM)]
        planes += [([-a for a in axis], -low), (axis, high)]
    return planes


def part_beside_box(planes, inner):
    """Volume of the part of a cell beside the excavation that has a point in it,
    and the faces of the box that it lies outside of."""
    beyond = [([-x for x in n], -c) for n, c in box_planes(BOX)]
    # (the centroid of a block around the box may lie in it)
    part = {i for i, (n, c) in enumerate(beyond) if dot(n, inner) < c} or \
        set(range(len(beyond)))
    volume = {s: measure(planes + [beyond[i] for i in s])[0]
              for k in range(1, DIM + 1)
              for s in itertools.combinations(range(len(beyond)), k)}
    for _ in beyond:
        part |= {i for s, v in volume.items() if v > 1e-12 and part & set(s) for i in s}
    return (sum(v * (-1) ** (len(s) + 1) for s, v in volume.items() if set(s) <= part),
            tuple(sorted(part)))


def write_scene(path, joints, is_dug):
    """Joints: (point, normal)."""
    def text(numbers):
        return ", ".join(map(repr, numbers))
    dig = f""" subsection hole
  set Shape = box
  set Corner = {text([a for a, _ in BOX])}
  set Size = {text([b - a for a, b in BOX])}
  set Stage = s
 end
"""
    names = ", ".join(f"j{i}" for i in range(len(joints)))
    listed = "".join(f" subsection j{i}\n  set Point = {text(p)}\n"
                     f"  set Normal = {text(n)}\n end\n" for i, (p, n) in enumerate(joints))
    path.write_text(f"""set Dimension = {DIM}
subsection Domain
 set Corner = {text([0.] * DIM)}
 set Size = {text([EXTENT] * DIM)}
 set Truncated boundaries =
end
subsection Mesh
 set Generator = gmsh
 set Size = {SIZE}
end
subsection Joints
 set Names = {names}
{listed}end
subsection Excavations
 set Names = {"hole" if is_dug else ""}
{dig if is_dug else ""}end
subsection Materials
 set Names = rock
end
subsection Stages
 set Names = s
 subsection s
  set Kind = quasi-static
  set Maximum steps = 1
 end
end
subsection Supports
 set Names = q
 subsection q
  set Boundaries = all
 end
end
subsection Output
 set Write VTU = false
end
""", encoding="utf-8")


def check(seed, n_joints, is_dug):
    """Number of blocks, of those with an exact volume, and of those cut."""
    draw = random.Random(seed)
    joints = []
    for _ in range(n_joints):
        normal = [draw.gauss(0., 1.) for _ in range(DIM)]
        length = math.hypot(*normal)
        joints.append(([draw.uniform(0.2 * EXTENT, 0.8 * EXTENT) for _ in range(DIM)],
                       [x / length for x in normal]))
    scene = FOLDER / f"{seed}.prm"
    write_scene(scene, joints, is_dug)
    run = subprocess.run([str(KEYBLOCK), str(scene), "--output", str(FOLDER / "output")],
                         capture_output=True, text=True, check=False)
    if run.returncode:
        print(run.stdout[-1000:], run.stderr)
    assert run.returncode == 0, f"seed {seed}: {run.returncode}"
    blocks = json.loads((FOLDER / "output" / "summary.json").read_text(
        encoding="utf-8"))["blocks"]
    outer = box_planes([(0., EXTENT)] * DIM)
    claims, wrong, n_known, n_off = {}, [], 0, 0
    for block in blocks:
        if "exact_volume" not in block:
            continue
        n_known += 1
        n_off += abs(block["exact_volume"] / block["volume"] - 1.) > TOLERANCE
        sides = tuple(dot(n, block["centroid"]) > dot(n, p) for p, n in joints)
        claims.setdefault(sides, []).append(block)
    for sides, several in claims.items():
        planes = [([-x for x in n] if side else n, (-1. if side else 1.) * dot(n, p))
                  for side, (p, n) in zip(sides, joints)] + outer
        volume, areas = measure(planes)
        is_whole = not is_dug or measure(planes + box_planes(BOX))[0] == 0.
        parts = []
        for block in several:
            if not is_whole:
                volume, part = part_beside_box(planes, block["centroid"])
                parts.append(part)
            if abs(block["exact_volume"] - volume) > TOLERANCE * volume:
                wrong.append((block["id"], block["volume"], block["exact_volume"], volume))
            for i, area in enumerate(areas[:n_joints] if is_whole else []):
                own = block.get("exact_joint_areas", {}).get(f"j{i}", 0.)
                if abs(own - area) > TOLERANCE * max(areas):
                    wrong.append((block["id"], f"j{i}", own, area))
        if len(several) > (1 if is_whole else len(set(parts))):
            wrong.append([block["id"] for block in several])
    print(f"seed {seed}: {len(blocks)} blocks, {n_known} exact, {n_off} of them not in "
          "the mesh; wrong:", wrong, flush=True)
    return len(blocks), n_known, n_off, len(wrong)


def main():
    """Exit with 1 if a block is not what it is said to be."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    totals = [0] * 4
    for part in sys.argv[5].split(","):
        first, _, last = part.partition("-")
        for seed in range(int(first), int(last or first) + 1):
            found = check(seed, int(sys.argv[4]), "--excavation" in sys.argv)
            totals = [a + b for a, b in zip(totals, found)]
    n_blocks, n_known, n_off, n_wrong = totals
    print(f"{n_blocks} blocks, {n_known} exact, {n_off} of them not in the mesh, "
          f"{n_wrong} wrong")
    # (around an excavation many are not convex)
    least = (0.3 if "--excavation" in sys.argv else 0.6) * n_blocks
    assert n_wrong == 0 and n_known > least


if __name__ == "__main__":
    main()
