#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes, blocks and limit equilibrium by the Python module.

usage: geometry.py CASE PRM [KEYBLOCK]     CASE: a function of this file
"""
import contextlib
import io
import math
import pathlib
import re
import subprocess
import sys

import keyblock
import numpy
from tools import captured, check, check_raises, check_that, end

PRM = pathlib.Path(sys.argv[2])
INCLINE = PRM / "verification" / "factor_incline.prm"


def scene():
    """What a scene tells of itself, and of errors."""
    one = keyblock.Scene(INCLINE, overrides={"Joints/base/Friction angle": 35.5,
                                             "Output/Write VTU": False})
    check("dimension", one.dimension, 2)
    check_that("title", one.title == "Safety factor of a block on an incline")
    check_that("names", (one.joints, one.stages, one.materials) ==
               (["base"], ["rest"], ["rock", "bed"]))
    check("friction angle", float(one.entries["Joints/base/Friction angle"]), 35.5)
    check_that("a switch", one.entries["Output/Write VTU"] == "false")
    check_that("a list", one.entries["Mesh/Cells"] == "40, 8")
    other = one.with_overrides({"Mesh/Cells": (20, 4)})
    check_that("a sequence", other.entries["Mesh/Cells"] == "20, 4")
    check("overrides stay", float(other.entries["Joints/base/Friction angle"]), 35.5)
    text = keyblock.Scene(text=INCLINE.read_text(encoding="utf-8"))
    check_that("a text is as good as a file",
               text.entries == keyblock.Scene(INCLINE).entries)
    check_that("and can be changed",
               text.with_overrides({"Title": "new"}).title == "new")
    check_that("leaves_geometry", [keyblock.leaves_geometry(entry) for entry in (
        "Joints/base/Cohesion", "Water/Level", "Joints/base/Dip", "Mesh/Size")] ==
        [True, True, False, False])

    check_that("errors are ValueErrors", issubclass(keyblock.Error, ValueError))
    for words, action in (
            (["no_such.prm", "cannot be read", "check its path"],
             lambda: keyblock.Scene("no_such.prm")),
            (["line 2", "Fiction"],
             lambda: keyblock.Scene(text="subsection Joints\n set Fiction = 1\nend\n")),
            (["Mesh/Sise=1"], lambda: keyblock.Scene(INCLINE, overrides={"Mesh/Sise": 1})),
            (["neither a file nor a text"], keyblock.Scene),
            (["both a file and a text"], lambda: keyblock.Scene(INCLINE, text="")),
            (["Joints/base/Friction angle", "95"], lambda: one.with_overrides(
                {"Joints/base/Friction angle": 95}))):
        check_raises(keyblock.Error, words, action)


def _volume(surface):
    """By the divergence theorem, faces taken as triangles around their mean."""
    total, corners = 0., surface.vertices[surface.faces]
    for face in corners:
        if face.shape[1] == 2:
            total += 0.5 * (face[0][0] * face[1][1] - face[0][1] * face[1][0])
            continue
        mean = face.mean(axis=0)
        for a, b in zip(face, numpy.roll(face, -1, axis=0)):
            total += numpy.dot(mean, numpy.cross(a, b)) / 6.
    return total


def blocks():
    """Blocks in 2D and 3D against closed forms, and their surfaces."""
    e2a = keyblock.find_blocks(keyblock.Scene(PRM / "verification" / "blocks_e2a.prm"))
    check("number of blocks", len(e2a), 5)
    check("wedge", e2a.block(1).volume, 24., 1e-10)
    check_that("its class", e2a.block(1).classes[0] == "exposed" and e2a[0].exposed_in != "")
    check("its weight", e2a[0].weight, 9.81 * e2a[0].mass, 1e-12)
    check_that("arrays", e2a.ids.tolist() == [1, 2, 3, 4, 5] and
               e2a.volumes[0] == e2a[0].volume and
               e2a.centroids.shape == (5, 2) and e2a.exposed[0] and e2a.infinite[-1])
    cube = keyblock.find_blocks(keyblock.Scene(PRM / "verification" / "blocks_cube_3.prm"))
    check("eighths", len(cube), 8)
    check("volume of the cube", cube.volumes.sum(), 1., 1e-12)
    check("of each", abs(cube.volumes - 0.125).max(), 0., absolute=1e-12)
    for found, ids in ((e2a, [1]), (cube, range(1, 9))):
        for number in ids:
            surface, block = found.surface(number), found.block(number)
            check("volume in the surface", _volume(surface), block.volume, 1e-10)
            check("areas of joints", sum(block.joint_areas.values()),
                  sum(_area(surface.vertices[face]) for face, joint in
                      zip(surface.faces, surface.joints) if joint), 1e-10)
    check("volume of the cells", _volume_of_cells(e2a), e2a.volumes.sum(), 1e-10)
    check_raises(keyblock.Error, ["no block 9", "1 to 8"], lambda: cube.block(9))
    check_raises(keyblock.Error, ["no block 0", "1 to 8"], lambda: cube.surface(0))


def _area(face):
    if len(face) == 2:
        return math.dist(*face)
    return 0.5 * numpy.linalg.norm(numpy.cross(face[2] - face[0], face[3] - face[1]))


def _volume_of_cells(found):
    corners = found.vertices[found.cells[found.block_of_cell > 0]]
    a, b = corners[:, 3] - corners[:, 0], corners[:, 2] - corners[:, 1]
    return 0.5 * abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()


def limit():
    """Limit equilibrium and sweeps against closed forms."""
    incline = keyblock.Scene(INCLINE)
    result = keyblock.find_blocks(incline).limit_equilibrium(wanted=1.5)[-1]
    weight = 9.81 * 2000 * 0.5 * 0.1
    tangent = math.tan(math.radians(40))
    check("factor", result.factor, math.tan(math.radians(30)) / tangent, 1e-9)
    check("weight", result.weight, weight, 1e-9)
    check("driving force", result.driving_force, weight * math.sin(math.radians(40)), 1e-9)
    check("normal force", result.normal_forces["base"],
          weight * math.cos(math.radians(40)), 1e-9)
    check_that("mode", result.mode == "sliding on base" and result.block == 1)
    check_that("direction", abs(result.direction[0] - 1) < 1e-9)
    check_that("support", 0 < result.support_force < 2 * weight)
    row = keyblock.find_blocks(keyblock.Scene(
        PRM / "verification" / "leaning_row.prm")).limit_equilibrium(wanted=1.4)
    (first,) = (one for one in row if one.block == 1)
    check_that("blocks that lean", "blocks 2, 3 may lean on it, left out, and ask for "
               "141.4 kN/m more" in first.remarks)

    # friction and cohesion together: (c A + N tan phi) / T
    sweep = keyblock.sweep(incline, {
        "Joints/base/Friction angle": [20, 30, 40],
        ("Joints/base/Cohesion", "Joints/base/Residual cohesion"): [0, 1000.]})
    check_that("shape", sweep.factor.shape == (3, 2) and len(sweep.samples) == 6)
    check_that("a loop gives the samples", list(sweep) == sweep.samples)
    for i, angle in enumerate((20, 30, 40)):
        for j, cohesion in enumerate((0, 1000)):
            check(f"factor at {angle}, {cohesion}", sweep.factor[i, j],
                  math.tan(math.radians(angle)) / tangent +
                  cohesion * 0.5 / (weight * math.sin(math.radians(40))), 1e-9)
    check_that("the least is named", sweep.samples[0].least.mode == "sliding on base")

    # Hoek and Bray's slope: water that presses by a share of the crack's depth
    water = keyblock.sweep(PRM / "verification" / "slope_crack.prm", {
        "Joints/crack/Water pressure": ["9810*max(0, 52.995 - y)"]})
    check_that("water lessens it", water.factor[0] < 1.58)

    # the dip of the base changes the geometry: tan 30 / tan(40 + dip)
    dips = keyblock.sweep(PRM / "verification" / "incline_30.prm",
                          {"Joints/base/Friction angle": [20, 30]}, stage=None)
    check("ratio of factors", dips.factor[1] / dips.factor[0],
          math.tan(math.radians(30)) / math.tan(math.radians(20)), 1e-9)
    check_raises(keyblock.Error, ["stage 'toss'", "start, rest"], lambda: keyblock.sweep(
        incline, {"Joints/base/Friction angle": [20]}, stage="toss"))
    for value in ("30", 30):
        check_raises(keyblock.Error, ["Joints/*/Friction angle", repr(value), "a list"],
                     lambda value=value: keyblock.sweep(
                         incline, {"Joints/*/Friction angle": value}))
    for factor in (-1, math.nan, math.inf):
        check_raises(keyblock.Error, ["a factor of", str(factor)], lambda factor=factor: (
            keyblock.sweep(incline, {"Joints/base/Friction angle": [20]}, wanted=factor)))
    other = keyblock.Scene(PRM / "verification" / "blocks_cube_3.prm")
    check_raises(keyblock.Error, ["blocks_cube_3.prm", "other joints"],
                 lambda: keyblock.find_blocks(incline).limit_equilibrium(other))
    bolted = keyblock.Scene(PRM / "verification" / "bolted_incline.prm")
    found = keyblock.find_blocks(bolted)
    for entry, value in (("Bolts/Names", ""), ("Materials/rock/Density", "1000"),
                         ("Joints/base/Dip", "35")):
        check_raises(keyblock.Error, [entry, "find its own blocks"],
                     lambda: found.limit_equilibrium(bolted.with_overrides({entry: value})))
    check_that("strengths may differ", found.limit_equilibrium(bolted.with_overrides(
        {"Joints/base/Friction angle": 20, "Output/Write VTU": "false"}))[0].factor <
        found.limit_equilibrium()[0].factor)
    with contextlib.redirect_stdout(io.StringIO()) as screen:
        keyblock.validate(incline, verbose=True)
    check_that("what is said goes where Python's output does",
               "The scene is valid." in screen.getvalue())


def program():
    """The same blocks and factors as the program prints, of a mesh of its own."""
    file = PRM / "tutorial" / "first_tunnel.prm"
    printed = subprocess.run([sys.argv[3], str(file), "--validate"], text=True, check=True,
                             stdout=subprocess.PIPE).stdout
    with captured() as text:
        tunnel = keyblock.Scene(file)
        found = keyblock.find_blocks(tunnel)
        judged = found.limit_equilibrium()
    check_that("nothing is printed", text == [""])
    rows = re.findall(r"^ *(\d+)  (?:exposed|hidden|infinite|attached) +(yes|no) +([-\d.e+]+)",
                      printed, re.MULTILINE)
    check("number of rows", len(rows), min(40, len(found)))
    more = re.search(r"and (\d+) more; a run writes all", printed)
    check("number of blocks", len(rows) + (int(more[1]) if more else 0), len(found))
    order = sorted(found, key=lambda b: 2 if b.infinite or b.rigid else not b.exposed_in)
    for (number, removable, volume), block in zip(rows, order):
        check("id", int(number), block.id)
        check_that("removable", (removable == "yes") == block.removable)
        check("volume", block.volume, float(volume), 1e-2)
    factors = re.findall(r"^ *(\d+)  (heading|bench) +([\d.e+-]+)  (\w+)", printed, re.MULTILINE)
    check_that("the program prints factors", len(factors) > 3)
    by_place = {(one.block, one.stage): one for one in judged}
    for number, stage, factor, mode in factors:
        one = by_place[int(number), stage]
        check_that(f"mode of {number}", one.mode.startswith(mode))
        if factor != "-":
            check(f"factor of {number} after {stage}", one.factor, float(factor), 1e-5, 1e-9)
    with captured() as text:
        keyblock.validate(tunnel, verbose=True)
    # but what is measured
    check_that("validate prints what the program does",
               text[0].split("Estimate")[0].split() == printed.split("Estimate")[0].split())
    sweep = keyblock.sweep(tunnel, {"Joint sets/east/Dip": [60, 65]})
    check_that("orientation makes other blocks",
               {one.block for one in sweep.samples[0].results} and
               sweep.samples[0].results[0].weight != sweep.samples[1].results[0].weight)
    check("and the first is that of the scene", sweep.factor[0],
          min(one.factor for one in judged))


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    end()
