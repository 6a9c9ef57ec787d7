#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers that are not finite end a run with 2, and none is written as null.

usage: not_finite.py KEYBLOCK PRM CASE

CASE is the name of a function below, which runs a scene in a folder of its own
and looks at how it ends.
"""
import collections
import json
import os
import pathlib
import subprocess
import sys
import tempfile

KEYBLOCK, PRM = (pathlib.Path(a).resolve() for a in sys.argv[1:3])


def run(scene, *settings):
    """The program, with entries set, and what it says as an error."""
    done = subprocess.run(
        [str(KEYBLOCK), str(PRM / "verification" / scene), "--output", "out"]
        + [word for s in settings for word in ("--set", s)],
        capture_output=True, check=False, text=True)
    print(done.stderr)
    return done.returncode, done.stderr


def fails(code_and_message, *fragments):
    """One sentence, with the fragments, and no summary of a run."""
    code, message = code_and_message
    assert code == 2, code
    assert message.startswith("Failed: ") and message.count("\n") == 1
    for fragment in fragments:
        assert fragment in message, f"'{fragment}' is missing"


def summary():
    """summary.json, which must not hold what is no number of JSON."""
    def refuse(word):
        raise ValueError(word)
    text = pathlib.Path("out/summary.json").read_text("utf-8")
    assert "null" not in text
    return json.loads(text, parse_constant=refuse)


def kinetic_energy():
    """Its velocity is a number, the square is none."""
    fails(run("incline_30.prm", "Initial state/Velocity=1e200; 0"),
          "The energy 'kinetic' is not finite at step 0")
    assert not pathlib.Path("out/summary.json").exists()


def moving_energy():
    """A support that runs away in the course of a stage."""
    fails(run("bond_break.prm", "Supports/pull/Velocity=1e180; 0"),
          "is not finite at step")
    assert not pathlib.Path("out/summary.json").exists()


def static_stage():
    """Forces whose sum is no number, without a step."""
    fails(run("gravity_column.prm", "Initial state/Gravity=0; -1e306"),
          "is not finite")


def check_of_nothing():
    """A measure relative to zero: all others are written."""
    fails(run("incline_30.prm", "Initial state/Gravity=0; 0"),
          "'checks/normal_force_spread'", "not finite")
    found = summary()
    assert "checks/normal_force_spread" in found["not_finite"]
    assert "normal_force_spread" not in found["checks"]
    assert found["checks"]["acceleration"] == 0.
    assert found["stages"][-1]["steps"] > 0


def stable_factors():
    """Infinite factors are outcomes, without a value."""
    code, _ = run("blocks_planes_4.prm", "Block theory/Report=true")
    assert code == 0
    found = summary()
    assert "not_finite" not in found
    pyramids = found["block_theory"]["joint_pyramids"]
    for pyramid in pyramids:
        assert (pyramid["outcome"] == "factor") == ("factor" in pyramid)
        assert (pyramid["outcome"] == "tapered") == (
            pyramid["mode"] == "tapered")
    outcomes = collections.Counter(p["outcome"] for p in pyramids)
    print(outcomes)
    assert set(outcomes) == {"factor", "stable", "tapered"}


def clamped_block():
    """The limit equilibrium of a block that cannot move."""
    code, _ = run("roof_block_falls.prm", "Initial state/Gravity=0; 0",
                  "Initial state/Vertical stress gradient=0",
                  "Initial state/Surface stress=1e5", "Check/Closed form=none",
                  "Safety factor/Blocks=all", "Stages/dig/Maximum steps=100")
    assert code == 0
    factors = [f for block in summary()["blocks"]
               for f in block.get("limit_equilibrium", [])]
    print(factors)
    assert factors and all(f["outcome"] == "stable" and "value" not in f
                           for f in factors)


def main():
    case = globals()[sys.argv[3]]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        case()
        os.chdir(KEYBLOCK.parent)


if __name__ == "__main__":
    main()
