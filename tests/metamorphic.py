#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The comparison of scenes with changes that must not change factors.

usage: metamorphic.py KEYBLOCK FOLDER

Checks the parts of contrib/metamorphic.py (scene files, formulas, units, moves,
comparison), and that it reports changes which do change factors.
"""
import contextlib
import io
import random
import subprocess
import sys
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "contrib"))

import metamorphic  # noqa: E402
import scene_moves  # noqa: E402
from factor_differences import Comparison, is_unsafe  # noqa: E402
from scene_domain import unit  # noqa: E402
from scene_formula import Formula, substitute  # noqa: E402
from scene_moves import Move, turn_about  # noqa: E402
from scene_places import is_in_prism  # noqa: E402
from scene_relations import Mapping, Variant  # noqa: E402
from scene_shapes import Prism  # noqa: E402
from scene_tree import points_of, read_scene, scene_text  # noqa: E402
from scene_units import (factor_of_lengths, factor_of_masses,  # noqa: E402
                         powers_of, read_entries, scale)

KEYBLOCK, FOLDER = sys.argv.pop(1), Path(sys.argv.pop(1))
FOLDER.mkdir(parents=True, exist_ok=True)

# lengths that no move changes
LENGTHS = {
    "Domain/Size", "Mesh/Size", "Mesh/Size at excavation", "Mesh/Size at joints",
    "Mesh/Grading distance", "Mesh/Least size", "Mesh/Refine at excavations",
    "Mesh/Refine at joints", "Block theory/Roof span", "Check/Length",
    "Joints/Bridging", "Joints/NAME/Scale", "Joints/NAME/Radius", "Joints/NAME/Dilation slip",
    "Joints/NAME/Slip distance", "Joints/NAME/Joint length",
    "Joint sets/NAME/Dilation slip", "Joint sets/NAME/Slip distance",
    "Joint sets/NAME/Joint length", "Bolts/NAME/Length", "Bolts/NAME/Spacing",
    "Bolts/NAME/Free length", "Bolts/NAME/Segment length",
    "Shotcrete/NAME/Thickness"}
# places that functions of their own move, or that a plain tree does not have
# (joints of sets are written out, the depth of the ground is undone)
OTHERS = ("Domain/", "Excavations/", "Ground/", "Monitors/", "Initial state/",
          "Joint sets/NAME/Radius", "Joint sets/NAME/Region",
          "Joint sets/NAME/Spacing")


def block(number, **entries):
    """A finite block of a summary."""
    return {"id": number, "class": ["exposed"], "removable": True, "cells": 4,
            "width": 1., "volume": 2., "centroid": [float(number), 0.], **entries}


def summary(*blocks):
    """What the comparison needs of summary.json."""
    return {"scene": {"dimension": 2}, "blocks": list(blocks)}


def compare(old, new, variant=Variant(None)):
    """Texts of the differences of two summaries."""
    return [d.text() for d in Comparison(old, new, variant,
                                         ["dig"]).differences()]


def statics(value, mode="sliding on A"):
    """A factor by limit equilibrium."""
    return {"limit_equilibrium": [{"stage": "dig", "mode": mode, "remark": "",
                                   "outcome": "factor", "value": value}]}


def reduction(lower, upper, outcome="value"):
    """A factor by strength reduction."""
    return {"safety_factor": [{"stage": "dig", "outcome": outcome,
                               "lower": lower, "upper": upper}]}


class Files(unittest.TestCase):
    """Scene files as trees."""

    def test_reads_what_a_scene_may_have(self):
        (FOLDER / "inner.prm").write_text(
            "subsection Mesh\n set Size = 2 # metres\nend\n")
        file = FOLDER / "outer.prm"
        file.write_text("# a scene\nset Dimension = 2\ninclude inner.prm\n"
                        "subsection Mesh\n  set Snap  =  0\nend\n"
                        "subsection Joints\n set Names = a, \\\n   b\n"
                        " subsection  a\n  set Point = 1, 2\n end\nend\n")
        tree = read_scene(file)
        self.assertEqual(tree.get("Mesh/Size"), "2")
        self.assertEqual(tree.get("Mesh/Snap"), "0")
        self.assertEqual(tree.names("Joints"), ["a", "b"])
        again = FOLDER / "again.prm"
        again.write_text(scene_text(tree))
        self.assertEqual(list(read_scene(again).items()), list(tree.items()))

    def test_copies_are_apart(self):
        tree = read_scene(ROOT / "prm" / "verification" / "slip_circle.prm")
        other = tree.copy()
        other.set("Joints/fault/Friction angle", 5)
        self.assertEqual(tree.get("Joints/fault/Friction angle"), "0")


class Formulas(unittest.TestCase):
    """Formulas with other coordinates."""

    def test_replaces_whole_names_only(self):
        self.assertEqual(substitute("exp(x)+max(y, 1e-6*t)", {"x": "y", "t": "2"}),
                         "exp((y))+max(y, 1e-6*(2))")

    def test_values(self):
        text = "if(x > 0 && y < 1 || abs(x) > 3, 2*x^2, -1)"
        self.assertEqual(Formula(text).at([2., 0.]), 8.)
        self.assertEqual(Formula(text).at([-2., 0.]), -1.)

    def test_moved_formula_has_the_same_values(self):
        rng = random.Random(1)
        for dim in (2, 3):
            axis = None if dim == 2 else [1., 2., 3.]
            move = Move(turn_about(axis, 30.), [5., -7., 11.][:dim])
            text = "x*y-3*y" + ("+z^2" if dim == 3 else "")
            moved = Formula(move.scalar_formula(text))
            for _ in range(5):
                p = [rng.uniform(-3., 3.) for _ in range(dim)]
                self.assertAlmostEqual(moved.at(move.point(p)), Formula(text).at(p))


class Units(unittest.TestCase):
    """Units of the list of entries."""

    @classmethod
    def setUpClass(cls):
        listing = subprocess.run([KEYBLOCK, "--print-parameters"], check=True,
                                 capture_output=True, text=True).stdout
        cls.entries = read_entries(listing)

    def test_powers(self):
        self.assertEqual(powers_of("N/m3"), (-2, 1, -2))
        self.assertEqual(powers_of("N/m/m"), powers_of("Pa"))
        self.assertIsNone(powers_of("id N"))

    def test_every_place_is_known_to_moves(self):
        """A new entry with a length, or with a formula, has to be named in
        scene_moves.py, or above."""
        known = (scene_moves.POINTS | scene_moves.VECTORS | LENGTHS
                 | scene_moves.VECTOR_FORMULAS | scene_moves.SCALAR_FORMULAS
                 | scene_moves.ELEVATION_FORMULAS)
        unknown = [path for path, entry in self.entries.items()
                   if (entry.unit == (1, 0, 0) or entry.is_formula)
                   and path not in known and not path.startswith(OTHERS)]
        self.assertEqual(unknown, [])

    def test_lengths(self):
        tree = read_scene(ROOT / "prm" / "verification" / "pushed_block.prm")
        tree.set("Joints/base/Residual cohesion", "-1")
        tree.set("Joints/base/Cohesion", "200")
        tree.set("Stages/rest/Duration", "2")
        large = scale(tree, self.entries, factor_of_lengths(100.))
        self.assertEqual(large.get("Joints/base/Residual cohesion"), "-1")
        self.assertEqual(float(large.get("Joints/base/Cohesion")), 2e4)
        self.assertEqual(float(large.get("Stages/rest/Duration")), 20.)
        self.assertEqual(float(large.get("Materials/rock/Density")), 2000.)
        self.assertEqual(points_of(large.get("Domain/Size")), [[400., 300.]])
        push = Formula(large.get("Tractions/push/Traction").split(";")[0])
        self.assertAlmostEqual(push.at([0., 100.]), 27e5 * 0.5)
        gravity = large.get("Initial state/Gravity").split(";")
        self.assertEqual(Formula(gravity[1]).at([0., 0.]), -10.)

    def test_masses(self):
        tree = read_scene(ROOT / "prm" / "verification" / "pushed_block.prm")
        heavy = scale(tree, self.entries, factor_of_masses(10.))
        self.assertEqual(float(heavy.get("Materials/rock/Density")), 2e4)
        self.assertEqual(float(heavy.get("Materials/rock/Young modulus")), 2e11)
        self.assertEqual(heavy.get("Domain/Size"), tree.get("Domain/Size"))


class Moves(unittest.TestCase):
    """Places and directions after a move."""

    def test_there_and_back(self):
        move = Move(turn_about([1., 2., 3.], 30.), [1., 2., 3.])
        for a, b in zip(move.back(move.point([4., 5., 6.])), [4., 5., 6.]):
            self.assertAlmostEqual(a, b)

    def test_stress_keeps_its_invariants(self):
        move = Move(turn_about([1., 2., 3.], 30.))
        parts = [float(Formula(part).at([0.] * 3)) for part in
                 move.stress_formula("1; 2; 4; 0.5; -0.3; 0.1").split(";")]
        xx, yy, zz, yz, xz, xy = parts
        self.assertAlmostEqual(xx + yy + zz, 7.)
        self.assertAlmostEqual(xx * yy + yy * zz + zz * xx - yz**2 - xz**2 - xy**2,
                               14. - 0.25 - 0.09 - 0.01)

    def test_prisms(self):
        rng = random.Random(2)
        prism = Prism([(0., 0.), (3., 0.), (1., 2.)], -1., 4., 40., 20.,
                      [1., 0., 2.])
        mirror = [unit(3, i) for i in range(3)]
        mirror[0][0] = -1.
        for matrix in (turn_about([1., 2., 3.], 100.), mirror,
                       turn_about([0., 0., 1.], 200.)):
            move = Move(matrix, [7., -3., 2.])
            entries = prism.moved(move)
            moved = Prism([tuple(p) for p in points_of(entries["Vertices"])],
                          entries["From"], entries["To"], entries["Trend"],
                          entries["Plunge"], [0.] * 3)
            n_inside = 0
            for _ in range(2000):
                p = [rng.uniform(-2., 6.) for _ in range(3)]
                inside = is_in_prism(p, prism)
                n_inside += inside
                self.assertEqual(is_in_prism(move.point(p), moved), inside)
            self.assertGreater(n_inside, 10)


class Differences(unittest.TestCase):
    """What counts as a difference."""

    def test_numbers_of_blocks_do_not_matter(self):
        new = [block(7, centroid=[2., 0.], **statics(1.5)),
               block(9, centroid=[1., 0.], **statics(1.2))]
        old = [block(1, **statics(1.2)), block(2, **statics(1.5))]
        self.assertEqual(compare(summary(*old), summary(*new)), [])

    def test_factors(self):
        old = summary(block(1, **statics(1.)))
        self.assertEqual(compare(old, summary(block(1, **statics(1. + 1e-7)))), [])
        self.assertEqual(len(compare(old, summary(block(1, **statics(1.00001))))), 1)
        other_mesh = Variant(None, keeps_mesh=False)
        new = summary(block(1, cells=5, **statics(1.0005)))
        self.assertEqual(compare(old, new, other_mesh), [])
        new = summary(block(1, cells=5, **statics(1.002)))
        self.assertEqual(len(compare(old, new, other_mesh)), 1)

    def test_modes_and_names(self):
        old = summary(block(1, **statics(1., "sliding on A/B")))
        new = summary(block(1, **statics(1., "sliding on Y/X")))
        names = Variant(None, Mapping(names={"X": "A", "Y": "B"}))
        self.assertEqual(compare(old, new, names), [])
        self.assertEqual(len(compare(old, new)), 1)

    def test_facets_of_a_bent_joint(self):
        tree = read_scene(ROOT / "prm" / "verification" / "trough.prm")
        for name in ("bend_1", "bend_2"):
            tree.set(f"Joints/{name}/Surface", "bend")
        old = summary(block(1, **statics(1., "sliding on bend_1")))
        for mode, n_differences in (("sliding on bend_2", 0), ("sliding on bed", 1)):
            new = summary(block(1, **statics(1., mode)))
            self.assertEqual(len(compare(old, new, Variant(tree))), n_differences)

    def test_blocks_of_cut_joints(self):
        old, same = summary(block(1), block(2)), summary(block(1), block(2))
        lost, shrunk = summary(block(1)), summary(block(1), block(2, volume=1.9))
        locked = summary(block(1), block(2, removable=False))
        for way, keeps_mesh in (("cut", False), ("cut", True), ("exact", False)):
            variant = Variant(None, keeps_mesh=keeps_mesh)
            for new in (same, lost, shrunk, locked):
                new["mesh"] = {"way": way}
                self.assertEqual(
                    Comparison(old, new, variant, []).has_cut_blocks(),
                    new is not same and way == "cut" and not keeps_mesh)

    def test_brackets(self):
        old = summary(block(1, **reduction(1., 1.01)))
        self.assertEqual(
            compare(old, summary(block(1, **reduction(1.005, 1.02)))), [])
        self.assertEqual(
            len(compare(old, summary(block(1, **reduction(1.02, 1.03))))), 1)
        self.assertEqual(len(compare(old, summary(
            block(1, **reduction(1., 1.01, "undecided"))))), 1)

    def test_brackets_without_limit_equilibrium(self):
        other_mesh = Variant(None, keeps_mesh=False)
        for limit, is_of_mesh in ((0.4, True), (1.005, False)):
            old = summary(block(1, **reduction(1., 1.01), **statics(limit)))
            new = summary(block(1, cells=5, **reduction(1.02, 1.03),
                                **statics(limit)))
            for variant in (other_mesh, Variant(None)):
                found = Comparison(old, new, variant, ["dig"]).differences()
                self.assertEqual([d.is_of_mesh for d in found],
                                 [is_of_mesh and variant is other_mesh])

    def test_blocks(self):
        old = summary(block(1, **statics(1.)), block(2))
        found = compare(old, summary(block(1, **statics(1.))))
        self.assertEqual(found, ["block 2: block 2 -> none"])
        found = compare(old, summary(block(1), block(2)))
        self.assertEqual(len(found), 1)

    def test_unsafe_side(self):
        old = summary(block(1, **statics(0.4)))
        new = summary(block(1, **statics(4.4)))
        one = Comparison(old, new, Variant(None), ["dig"]).differences()[0]
        self.assertTrue(is_unsafe(one))
        one = Comparison(new, old, Variant(None), ["dig"]).differences()[0]
        self.assertFalse(is_unsafe(one))
        one = Comparison(old, summary(), Variant(None), ["dig"]).differences()[0]
        self.assertTrue(is_unsafe(one))


def stronger(scene):
    """No relation: friction is 5 % larger."""
    tree = scene.tree.copy()
    for name in tree.names("Joints"):
        path = f"Joints/{name}/Friction angle"
        tree.set(path, 1.05 * float(tree.get(path)))
    return Variant(tree)


def turned_without_gravity(scene):
    """No relation: gravity does not turn with the scene."""
    variant = metamorphic.RELATIONS["turned"](scene)
    variant.tree.set("Initial state/Gravity",
                     scene.tree.get("Initial state/Gravity"))
    return variant


class Runs(unittest.TestCase):
    """The whole script, with the program."""

    def run_script(self, relations, scene, *arguments):
        """(exit code, what is printed) of the script."""
        screen = io.StringIO()
        command = ["metamorphic.py", str(ROOT / "prm/verification" / scene),
                   "--keyblock", KEYBLOCK, "--relations", relations,
                   "--keep", str(FOLDER), *arguments]
        with mock.patch.object(sys, "argv", command), \
                contextlib.redirect_stdout(screen):
            code = metamorphic.main()
        return code, screen.getvalue()

    def test_finds_nothing_where_there_is_nothing(self):
        code, text = self.run_script("written-out,mirrored,turned,lengths-10",
                                     "factor_incline.prm")
        self.assertEqual(code, 0, text)
        self.assertIn("1 scenes, 4 variants, 0 violations", text)

    def test_finds_changes_of_factors(self):
        wrong = {"stronger": stronger, "unturned": turned_without_gravity}
        with mock.patch.dict(metamorphic.RELATIONS, wrong):
            for method, kind in (("statics", "limit equilibrium"),
                                 ("reduction", "strength reduction")):
                code, text = self.run_script("stronger", "factor_incline.prm",
                                             "--method", method)
                self.assertEqual(code, 1, text)
                self.assertIn(f"stronger: block 1 after 'rest': {kind}", text)
            code, text = self.run_script("unturned", "factor_incline.prm")
            self.assertEqual(code, 1, text)
            self.assertIn("unturned: block 1 after 'rest'", text)

    def test_reports_refused_variants(self):
        def refused(scene):
            tree = scene.tree.copy()
            tree.set("Joints/A/Friction angle", -1)
            return Variant(tree)
        with mock.patch.dict(metamorphic.RELATIONS, {"refused": refused}):
            code, text = self.run_script("refused", "factor_incline.prm")
        self.assertEqual(code, 1, text)
        self.assertIn("refused: fails, exit 1", text)

    def test_reports_timeouts(self):
        code, text = self.run_script("written-out", "factor_incline.prm",
                                     "--timeout", "0.001")
        self.assertEqual(code, 1, text)
        self.assertIn("1 timeouts", text)


if __name__ == "__main__":
    unittest.main()
