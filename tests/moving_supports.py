#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Supports that move: displacements are reached once, each support moves its own
directions, records begin with their stage and leave their last velocity, those of stress drive as velocities do,
free fields follow rock that changes, damping takes nothing of prescribed motions,
ramps go on; and a stage that changes nothing is in balance.

usage: moving_supports.py KEYBLOCK FOLDER
"""
import csv
import json
import math
import pathlib
import subprocess
import sys

KEYBLOCK, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])

PLATE = """set Dimension = 2
subsection Domain
  set Size = 1, 1
  set Truncated boundaries = none
end
subsection Mesh
  set Cells = 8, 8
end
subsection Materials
  set Names = rock
  subsection rock
    set Young modulus = 1e9
    set Poisson ratio = 0.25
    set Density = 2500
  end
end
subsection Monitors
  set Names = corner, right
  subsection corner
    set Location = 1, 1
  end
  subsection right
    set Location = 1, 0.5
  end
end
subsection Output
  set Write VTU = false
  set History interval = 1
end
"""


def section(name, items):
    """A section of named items with their entries."""
    text = f"subsection {name}\n  set Names = {', '.join(items)}\n"
    for item, entries in items.items():
        text += f"  subsection {item}\n"
        for entry, value in entries.items():
            text += f"    set {entry} = {value}\n"
        text += "  end\n"
    return text + "end\n"


ROLLERS = {"left": {"Boundaries": "left", "Directions": "x"},
           "bottom": {"Boundaries": "bottom", "Directions": "y"}}
PRESS = {"Boundaries": "right", "Directions": "x", "Displacement": "-0.001; 0"}
DOWN = {"Boundaries": "top", "Directions": "y", "Displacement": "0; -0.001"}


def start(name, text, *arguments):
    """Run a scene; returns what it printed, its exit code and its folder."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    scene = FOLDER / (name + ".prm")
    scene.write_text(text)
    done = subprocess.run([KEYBLOCK, scene, "--output", FOLDER / name,
                           *arguments], capture_output=True, text=True,
                          check=False)
    return done.stdout + done.stderr, done.returncode, FOLDER / name


def run(name, text, *arguments):
    """Run a scene that has to end well: its history by column and summary."""
    said, code, folder = start(name, text, *arguments)
    if code != 0:
        sys.exit(f"{name}: {said}")
    with open(folder / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    columns = {key.split(" [")[0]: [float(row[key]) for row in rows]
               for key in rows[0]}
    return columns, json.loads((folder / "summary.json").read_text())


class Checks:
    """Counts what is wrong."""

    def __init__(self):
        self.n_faults = 0

    def near(self, what, value, wanted, tolerance):
        """A value is the one wanted, within an absolute tolerance."""
        fault = not abs(value - wanted) <= tolerance
        self.n_faults += fault
        print(f"{what}: {value:.9g}, {wanted:.9g} wanted"
              + ("  <-- WRONG" if fault else ""))


def displacements(checks):
    """Reached once and kept, whatever stages there are."""
    supports = section("Supports", {**ROLLERS, "right": PRESS})
    cases = {
        "static": (["static"] * 3, ""),
        "quasi": (["quasi-static"] * 3, ""),
        "mixed": (["quasi-static", "static", "quasi-static"], ""),
        "later": (["dynamic", "quasi-static", "quasi-static"], ""),
        "initial": (["static", "static"],
                    "subsection Initial state\n  set Equilibrium = static\nend\n")}
    for name, (kinds, more) in cases.items():
        stages = {f"s{i}": {"Kind": kind, "Duration": 0.01}
                  if kind == "dynamic" else {"Kind": kind}
                  for i, kind in enumerate(kinds)}
        history, _ = run(name, PLATE + supports + more +
                         section("Stages", stages))
        checks.near(f"{name}: displacement", history["right.u_x"][-1], -1e-3,
                    1e-12 if "quasi" not in str(kinds) else 1e-9)
    said, code, _ = start("never", PLATE + supports + section(
        "Stages", {"shake": {"Duration": 0.01}}))
    checks.near("no stage to reach it in: exit code", code, 1, 0)
    checks.near("and a sentence on it", "quasi-static or static stage" in said,
                1, 0)


def directions(checks):
    """Two supports at a corner, in each order; and boundaries that slope."""
    for names in (["left", "bottom", "right", "top"],
                  ["top", "right", "bottom", "left"]):
        every = {**ROLLERS, "right": PRESS, "top": DOWN}
        history, _ = run("both", PLATE + section(
            "Supports", {name: every[name] for name in names})
            + section("Stages", {"press": {"Kind": "static"}}))
        for column, wanted in (("corner.u_x", -1e-3), ("corner.u_y", -1e-3),
                               ("right.u_x", -1e-3), ("right.u_y", -5e-4)):
            checks.near(f"{names[0]} first: {column}", history[column][-1],
                        wanted, 1e-12)
    # a box turned by 30 degrees: normals and what moves along them
    c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
    turned = PLATE.replace("set Size = 1, 1", "set Shape = parallelepiped\n"
                           f"  set Edges = {c}, {s}; {-s}, {c}")
    turned = turned.replace("Location = 1, 1", f"Location = {c - s}, {s + c}")
    turned = turned.replace("Location = 1, 0.5",
                            f"Location = {c - s / 2}, {s + c / 2}")
    supports = {name: {"Boundaries": name, "Directions": "normal"}
                for name in ("left", "bottom", "right", "top")}
    supports["right"]["Displacement"] = f"{-1e-3 * c}; {-1e-3 * s}"
    supports["top"]["Displacement"] = f"{2e-3 * s}; {-2e-3 * c}"
    history, _ = run("turned", turned + section("Supports", supports)
                     + section("Stages", {"press": {"Kind": "static"}}))
    ux, uy = history["corner.u_x"][-1], history["corner.u_y"][-1]
    checks.near("turned: along", c * ux + s * uy, -1e-3, 1e-12)
    checks.near("turned: across", -s * ux + c * uy, -2e-3, 1e-12)


def ledger(checks):
    """Damping of prescribed motions is none."""
    moved = {**ROLLERS,
             "right": {"Boundaries": "right", "Directions": "x",
                       "Velocity": "-0.01; 0"},
             "top": {"Boundaries": "top", "Directions": "y",
                     "Velocity": "0; -0.01"}}
    for entry, value in (("Local damping", 0.5), ("Mass damping", 500)):
        _, summary = run("damped", PLATE + section("Supports", moved) + section(
            "Stages", {"press": {"Duration": 0.1, "Damping ratio": 0.3,
                                 entry: value}}))
        checks.near(f"{entry}: residual of the ledger",
                    summary["energy"]["relative_residual"], 0, 1e-12)
    # a plate that moves as a whole: nothing is damped but for that
    rigid = {"all": {"Boundaries": "all", "Velocity": "0.01; 0"}}
    _, summary = run("carried", PLATE + section("Supports", rigid) + section(
        "Stages", {"go": {"Duration": 0.01, "Local damping": 0.8}})
        + "subsection Initial state\n  set Velocity = 0.01; 0\nend\n")
    checks.near("carried along: residual of the ledger",
                summary["energy"]["relative_residual"], 0, 1e-12)


def records(checks):
    """A record begins with its stage, however long the stages before took."""
    rows = [(i * 1e-3, 0.01 * math.sin(math.pi * i / 50) ** 2 if i < 50 else 0.)
            for i in range(60)]
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, factor in (("record", 1), ("other", 3)):
        (FOLDER / f"{name}.csv").write_text("time,vx,vy\n" + "".join(
            f"{t},{factor * v},0\n" for t, v in rows))
    base = {"Boundaries": "bottom", "History file": "record.csv"}
    shake = {"Duration": 0.06}
    settle = {"Kind": "quasi-static"}
    gravity = "subsection Initial state\n  set Gravity = 0; -9.81\nend\n"
    peaks = {}
    for kind in ("held", "quiet"):
        for name, stages in (("alone", {"shake": shake}),
                             ("after", {"settle": settle, "shake": shake}),
                             ("named", {"wait": {"Duration": 0.03},
                                        "shake": shake})):
            support = {**base, "Kind": kind}
            if kind == "quiet" and name != "alone":
                support["Stage"] = "shake"
            if name == "named":
                support["History stage"] = "shake"
            history, _ = run(f"{kind}_{name}", PLATE + gravity * (
                name == "after") + section("Supports", {"base": support})
                + section("Stages", stages))
            peaks[name] = max(map(abs, history["corner.v_x"]))
            if name == "named":
                before = [abs(v) for v, t in zip(history["corner.v_x"],
                                                 history["time"]) if t < 0.03]
                checks.near(f"{kind}: nothing moves before", max(before), 0, 0)
            checks.near(f"{kind}, {name}: peak velocity", peaks[name],
                        peaks["alone"], 0.01 * peaks["alone"])
    # a checkpoint knows the record
    text = (PLATE + section("Supports", {"base": base})
            + section("Stages", {"shake": shake}))
    run("whole", text, "--set", "Output/Checkpoint interval=1e-3")
    kept = ["--restart", FOLDER / "whole" / "checkpoint.h5"]
    _, code, _ = start("again", text, *kept)
    checks.near("restart with the same record: exit code", code, 0, 0)
    (FOLDER / "record.csv").write_text((FOLDER / "other.csv").read_text())
    said, code, _ = start("again", text, *kept)
    checks.near("with another record: exit code", code, 1, 0)
    checks.near("and a sentence on it", "History file" in said, 1, 0)
    said, code, _ = start("no_stage", PLATE + section(
        "Supports", {"base": base}) + section("Stages", {"settle": settle}))
    checks.near("a record without a dynamic stage: exit code", code, 1, 0)
    checks.near("and a sentence on it", "no stage shakes it" in said, 1, 0)


def ends_of_records(checks):
    """A record of acceleration that ends before its stage leaves its velocity,
    to the end of the shaking; one of velocity leaves none."""
    rate, lasts, stage = (3., -2.), 0.02, 0.05  # m/s2, s
    FOLDER.mkdir(parents=True, exist_ok=True)
    n = 21
    times = [i * lasts / (n - 1) for i in range(n)]
    for name, header, rows in (
            ("acceleration", "ax,ay", [(t, *rate) for t in times]),
            ("velocity", "vx,vy", [(t, *(a * t for a in rate)) for t in times])):
        (FOLDER / f"{name}.csv").write_text(f"time,{header}\n" + "".join(
            f"{t!r},{x!r},{y!r}\n" for t, x, y in rows))
        support = {"Region": "1", "History file": f"{name}.csv",
                   "History quantity": name}
        text = PLATE + section("Supports", {"all": support}) + section(
            "Stages", {"shake": {"Duration": stage},
                       "rest": {"Kind": "quasi-static", "Maximum steps": 5}})
        history, _ = run(f"end_of_{name}", text)
        said, _, _ = start(f"end_of_{name}", text, "--validate")
        goes_on = stage - lasts if name == "acceleration" else 0.
        for axis, a in zip("xy", rate):
            way = a * lasts ** 2 / 2 + a * lasts * goes_on
            # a step is 1e-4 s
            checks.near(f"{name} along {axis}: displacement",
                        history[f"corner.u_{axis}"][-1], way,
                        abs(a) * lasts * 2e-4)
            checks.near("and a sentence on the velocity",
                        f"ends with a velocity of {a * lasts:.3g} m/s along "
                        f"{axis}" in said, 1, 0)


def stresses(checks):
    """A record of stress is one of velocity times rho c, at a quiet bottom and
    at the feet of free fields beside it, which know the same wave."""
    density, young, poisson = 2500., 1e9, 0.25
    shear = young / (2 + 2 * poisson)
    along = shear * (2 - 2 * poisson) / (1 - 2 * poisson)
    factors = [math.sqrt(density * modulus) for modulus in (shear, along)]
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, (fx, fy) in (("waves", (1, 1)), ("stresses", factors)):
        (FOLDER / f"{name}.csv").write_text("time,x,y\n" + "".join(
            f"{i * 1e-4!r},{fx * 0.01 * pulse!r},{-0.02 * fy * pulse!r}\n"
            for i, pulse in enumerate(
                math.sin(math.pi * i / 50) ** 2 for i in range(51))))
    for kind in ("quiet", "free field"):
        histories = []
        for name, quantity in (("waves", "velocity"), ("stresses", "stress")):
            supports = {"base": {"Boundaries": "bottom", "Kind": "quiet",
                                 "History file": f"{name}.csv",
                                 "History quantity": quantity},
                        "sides": {"Boundaries": "left, right", "Kind": kind}}
            histories.append(run(name, PLATE + section("Supports", supports)
                                 + section("Stages",
                                           {"shake": {"Duration": 6e-3}}))[0])
        for column, peak in (("corner.v_x", 0.02), ("corner.v_y", 0.04)):
            wave, stress = (history[column] for history in histories)
            if kind == "free field":
                # twice that of the wave, at the free top
                checks.near(f"stress, {column}: peak", max(map(abs, stress)),
                            peak, 0.01 * peak)
            checks.near(f"stress and velocity, sides {kind}: {column}",
                        max(abs(a - b) for a, b in zip(wave, stress)), 0,
                        1e-12 * peak)


def rock_that_changes(checks):
    """Half of the rock is another one from a stage on that begins as waves are
    under way: stresses stay, and the ground beside free fields goes on as the
    model does."""
    text = PLATE.replace("Location = 1, 0.5", "Location = 0.5, 1").replace(
        "Names = rock\n", "Names = rock, other\n  subsection other\n"
        "    set Region = 0.5 - y\n    set Young modulus = 3e9\n"
        "    set Poisson ratio = 0.4\n    set Density = 2000\n"
        "    set Stage = after\n  end\n")
    text += section("Supports", {
        "base": {"Boundaries": "bottom", "Kind": "quiet",
                 "Velocity": "0.01*sin(900*t); 0.02*sin(700*t)"},
        "sides": {"Boundaries": "left, right", "Kind": "free field"}})
    stages = section("Stages", {"before": {"Duration": 3e-3},
                                "after": {"Duration": 5e-3}})
    history, _ = run("changed", text + stages)
    for axis in "xy":
        side, middle = history[f"corner.v_{axis}"], history[f"right.v_{axis}"]
        checks.near(f"rock that changes: v_{axis} at the side",
                    max(abs(a - b) for a, b in zip(side, middle)), 0,
                    1e-12 * max(map(abs, middle)))
    run("kept", text + stages, "--set", "Output/Checkpoint interval=1e-3")
    again, _ = run("again", text + stages, "--restart",
                   FOLDER / "kept" / "checkpoint.h5")
    for axis in "xy":
        checks.near(f"the same from a checkpoint: v_{axis}",
                    again[f"corner.v_{axis}"][-1],
                    history[f"corner.v_{axis}"][-1], 0)


def ramps(checks):
    """What a stage has not ramped out goes on in the next; and a stage that
    changes nothing is in balance at once."""
    text = PLATE.replace("set Cells = 8, 8", "set Cells = 16, 16")
    text = text.replace("Location = 1, 0.5", "Location = 0.625, 0.5")
    text += section("Supports", {**ROLLERS, "right": {
        "Boundaries": "right", "Directions": "x"}})
    text += section("Excavations", {"hole": {
        "Shape": "box", "Corner": "0.375, 0.375", "Size": "0.25, 0.25",
        "Stage": "dig"}})
    text += ("subsection Initial state\n  set Stress = -1e6; -1e6; -1e6; 0\n"
             "end\n" + section("Tractions", {"lid": {
                 "Boundaries": "top", "Traction": "0; -1e6"}}))
    damped = {"Duration": 0.02, "Damping ratio": 0.3, "Mass damping": 2000}
    history, _ = run("ramps", text + section(
        "Stages", {"dig": {**damped, "Ramp duration": 0.08}, "idle": damped,
                   "rest": {"Kind": "quasi-static"}}))
    wall, time = history["right.u_x"], history["time"]
    at = [min(range(len(time)), key=lambda i, t=t: abs(time[i] - t))
          for t in (0.018, 0.02, 0.022)]
    before, after = (abs(wall[b] - wall[a]) for a, b in zip(at, at[1:]))
    print(f"wall: {before:.3g} m before the stage ends, {after:.3g} m after")
    checks.near("no jump where the stage ends", after < 3 * before, 1, 0)
    _, summary = run("unchanged", text + section(
        "Stages", {"dig": {"Kind": "quasi-static"},
                   "same": {"Kind": "quasi-static",
                            "Seismic coefficient": "0, 0"}}))
    dig, same = summary["stages"]
    checks.near("a stage without a change converges", same["converged"], 1, 0)
    checks.near("when its ramp ends", same["steps"] < 0.5 * dig["steps"], 1, 0)


def main():
    """Exit with the number of what is wrong."""
    checks = Checks()
    for part in (displacements, directions, ledger, records,
                 ends_of_records, stresses,
                 rock_that_changes, ramps):
        part(checks)
    sys.exit(checks.n_faults)


if __name__ == "__main__":
    main()
