#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compliant joints against closed forms.

usage: compliant_joints.py CASE KEYBLOCK SCENES OUTPUT RANKS

wave     compression and shear waves pass a joint with |T| = 1 / sqrt(1 + x^2),
         x = omega rho c / (2 k) (Schoenberg 1980); x from 0 to 3, 1 % asked for
box      shear stress is ks times slip up to c + sigma tan(phi), and back
block    a block sinks by W / (kn A), and swings with 2 pi sqrt(m / (kn A))
dilates  a block that slides off its partners opens by tan(psi) times slip, also rigid
rigid    as the stiffness grows a block slides, and is loaded, as on a rigid joint
"""
import csv
import json
import math
import subprocess
import sys

FAULTS = []


def check(what, value, reference, tolerance):
    error = abs(value - reference)
    print(f"{what}: {value:.10g}, reference {reference:.10g}, error {error:.2e} of {tolerance:.2e}")
    if not error <= tolerance:
        FAULTS.append(what)


def run(keyblock, scene, output, ranks, settings):
    subprocess.run(["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", ranks, keyblock,
                    scene, "--output", output] + [f"--set={setting}" for setting in settings],
                   check=True, stdout=subprocess.DEVNULL)
    with open(f"{output}/history.csv", encoding="utf-8") as file:
        rows = [{title.split(" ")[0]: float(value) for title, value in row.items()}
                for row in csv.DictReader(file)]
    with open(f"{output}/summary.json", encoding="utf-8") as file:
        summary = json.load(file)
    check("energy residual", summary["energy"]["relative_residual"], 0., 1e-12)
    return rows, summary


def amplitude(rows, column, omega):
    """Of a harmonic motion, by least squares."""
    step = rows[-1]["time"] - rows[-2]["time"]
    sums = [0.] * 5
    for row in rows:
        time, value = row["time"] - step / 2., row[column]
        s, c = math.sin(omega * time), math.cos(omega * time)
        sums = [a + b for a, b in zip(sums, (s * s, s * c, c * c, s * value, c * value))]
    ss, sc, cc, sv, cv = sums
    return math.hypot(sv * cc - cv * sc, cv * ss - sv * sc) / (ss * cc - sc * sc)


def wave(keyblock, scenes, output, ranks):
    omega, density, shear = 2. * math.pi * 20., 2500., 1e10
    for axis, modulus in (("y", 3. * shear), ("x", shear)):
        for x in (0., 0.1, 0.3, 1., 3.):
            stiffness = omega * math.sqrt(density * modulus) / 2. / max(x, 1e-9)
            settings = [f"Joints/joint/Normal stiffness={stiffness!r}",
                        f"Joints/joint/Shear stiffness={stiffness!r}"]
            if axis == "x":
                settings += ["Supports/base/Velocity=0.02*sin(2*pi*20*t); 0",
                             "Supports/sides/Directions=y"]
            rows, summary = run(keyblock, f"{scenes}/compliant_wave.prm", output, ranks, settings)
            check(f"transmission along {axis}, x = {x}",
                  amplitude([row for row in rows if row["time"] > 0.2], f"above.v_{axis}", omega) / 0.02,
                  1. / math.hypot(1., x), 1e-3)
            # the spring keeps energy
            check("closure", summary["energy"]["contact_closure"] / summary["energy"]["start"], 0., 1e-9)


def box(keyblock, scenes, output, ranks):
    normal, shear, cohesion, tangent, area = 1e10, 4e9, 1e5, math.tan(math.radians(30.)), 0.4
    rows, _ = run(keyblock, f"{scenes}/shear_box.prm", output, ranks, [])
    # forces are those in the middle of three places, at the start of a step
    def mean(i, column):
        return (rows[i - 2][column] + 2. * rows[i - 1][column] + rows[i][column]) / 4.

    errors = {"normal force": 0., "shear force, elastic": 0., "shear force, slipping": 0.}
    for i, row in enumerate(rows):
        if i < 2:
            continue
        limit = cohesion * area + tangent * row["joint.normal_force"]
        if 0.002 < row["time"] < 0.026:
            force = -normal * area * mean(i, "joint.opening")
            errors["normal force"] = max(errors["normal force"], abs(row["joint.normal_force"] / force - 1.))
        if 0.012 < row["time"] < 0.026:
            force = shear * area * mean(i, "joint.slip")
            errors["shear force, elastic"] = max(errors["shear force, elastic"],
                                                 abs(row["joint.shear_force"] / force - 1.))
        if 0.03 < row["time"] < 0.049:
            errors["shear force, slipping"] = max(errors["shear force, slipping"],
                                                  abs(row["joint.shear_force"] / limit - 1.))
    for what, error in errors.items():
        check(what, error, 0., 1e-6)
    first, last = (min(range(len(rows)), key=lambda i: abs(rows[i]["time"] - time)) for time in (0.052, 0.078))
    slope = ((rows[last]["joint.force_x"] - rows[first]["joint.force_x"])
             / (mean(last, "joint.slip") - mean(first, "joint.slip")) / area)
    check("unloading over ks", slope / -shear, 1., 1e-6)
    limit = cohesion * area + tangent * rows[-1]["joint.normal_force"]
    check("slips backwards at", max(row["joint.force_x"] for row in rows) / limit, 1., 1e-3)


def block(keyblock, scenes, output, ranks):
    mass, stiffness, gravity = 500., 1e8, 9.81
    rows, _ = run(keyblock, f"{scenes}/compliant_block.prm", output, ranks, [])
    sunk = mass * gravity / stiffness
    check("sunk over W / K", -rows[-1]["base.opening"] / sunk, 1., 1e-6)
    check("energy of the joint over W^2 / 2 K", rows[-1]["energy.joints"] / (mass * gravity * sunk / 2.), 1., 1e-6)
    # let go on springs without force it falls by twice that and comes back
    rows, summary = run(keyblock, f"{scenes}/compliant_block.prm", output, ranks,
                        ["Stages/rest/Kind=dynamic", "Stages/rest/Duration=0.1"])
    period = 2. * math.pi * math.sqrt(mass / stiffness)
    check("deepest over W / K", -min(row["base.opening"] for row in rows) / sunk, 2., 2e-3)
    upward = [i for i in range(1, len(rows)) if rows[i]["block.v_y"] <= 0. < rows[i - 1]["block.v_y"]]

    def crossing(i):
        a, b = rows[i - 1], rows[i]
        return a["time"] + (b["time"] - a["time"]) * a["block.v_y"] / (a["block.v_y"] - b["block.v_y"])

    check("period", (crossing(upward[-1]) - crossing(upward[0])) / (len(upward) - 1) / period, 1., 1e-3)
    check("closure", summary["energy"]["contact_closure"], 0., 1e-6)


def dilates(keyblock, scenes, output, ranks):
    # to the end the joint opens by more than half of the smallest cell
    dip, tangent = math.radians(40.), math.tan(math.radians(8.))
    for stiffness in (None, 1e10, 1e12):
        settings = [] if stiffness is None else [f"Joints/base/Normal stiffness={stiffness}",
                                                 f"Joints/base/Shear stiffness={stiffness}"]
        rows, _ = run(keyblock, f"{scenes}/incline_30.prm", output, ranks, [
            "Check/Closed form=none", "Materials/rock/Young modulus=2e9",
            "Joints/base/Dilation angle=8"] + settings)
        x, y = rows[-1]["block.u_x"], rows[-1]["block.u_y"]
        along = x * math.cos(dip) - y * math.sin(dip)
        across = x * math.sin(dip) + y * math.cos(dip)
        check(f"opening over slip {along:.3f} m, stiffness {stiffness}",
              across / along / tangent, 1., 1e-3)


def rigid(keyblock, scenes, output, ranks):
    # what opens takes along what is stored: the softer the more
    results = []
    for stiffness in (None, 1e16, 1e13):
        settings = [] if stiffness is None else [f"Joints/base/Normal stiffness={stiffness}",
                                                 f"Joints/base/Shear stiffness={stiffness}"]
        rows, summary = run(keyblock, f"{scenes}/incline_30.prm", output, ranks, settings)
        results.append((rows[-1]["block.u_x"], summary["checks"]["acceleration"],
                        summary["run"]["time_step"]))
    for of_stiff in results[1:]:
        check("way", of_stiff[0] / results[0][0], 1., 1e-4)
        check("acceleration", of_stiff[1] / results[0][1], 1., 1e-4)
        check("time step", of_stiff[2], results[0][2], 0.)


def main():
    case = {"wave": wave, "box": box, "block": block, "dilates": dilates, "rigid": rigid}[sys.argv[1]]
    case(*sys.argv[2:])
    if FAULTS:
        print("Wrong:", ", ".join(FAULTS))
    return len(FAULTS) > 0


if __name__ == "__main__":
    sys.exit(main())
