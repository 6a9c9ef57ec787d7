#!/usr/bin/env python3
"""Run every verification scene and write doc/verification.md.

usage: contrib/verification.py [KEYBLOCK]        (default: build/keyblock)

All numbers of that file come from here; runs take a quarter of an hour.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import footing

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, f"{ROOT}/tests")
from scene_table import read_scenes  # noqa: E402

KEYBLOCK = sys.argv[1] if len(sys.argv) > 1 else f"{ROOT}/build/keyblock"
FOLDER = tempfile.mkdtemp()


def run(scene, *overrides, ranks=1):
    """Summary of a run of prm/SCENE.prm, or None if it failed."""
    command = [KEYBLOCK, f"{ROOT}/prm/{scene}.prm", "--output", FOLDER]
    for assignment in overrides:
        command += ["--set", assignment]
    if ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe",
                   "-n", str(ranks)] + command
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        return None
    with open(f"{FOLDER}/summary.json", encoding="utf-8") as file:
        return json.load(file)


def gallery(out):
    """The pictures of doc/pictures, three in a row, with titles of scenes.

    They are drawn by contrib/pictures.py."""
    cells = []
    for scene in dict.fromkeys(test.scene for test in read_scenes().values()):
        name = os.path.basename(scene)
        if not os.path.exists(f"{ROOT}/doc/pictures/{name}.png"):
            continue
        with open(f"{ROOT}/prm/{scene}.prm", encoding="utf-8") as file:
            title = re.search(r"set Title = (.*)", file.read())[1]
        cells.append((f"![{title}](pictures/{name}.png)",
                      f"`{name}`: {title}"))
    cells += [("", "")] * (-len(cells) % 3)
    out.write("| | | |\n|---|---|---|\n")
    for i in range(0, len(cells), 3):
        for part in zip(*cells[i:i + 3]):
            out.write("| " + " | ".join(part) + " |\n")


def write_gallery(out):
    """The section of pictures."""
    out.write("## Pictures of the scenes\n\nDrawn by `contrib/pictures.py`: "
              "the last state, or one on the way where that shows more. Where "
              "gravity is tilted the picture is turned so that it points "
              "down. Times, fields and exaggerations are in the pictures; "
              "colours and numbers without a bar are those of blocks.\n\n")
    gallery(out)
    out.write("\n![Measured against fitted stresses]"
              "(pictures/geostress_fit.png)\n\nThe six measured points of "
              "`geostress`, by `contrib/plot_geostress.py`.\n")


def scene_table(out):
    """Each line of each reference file with what was measured."""
    out.write("| scene | quantity | measured | reference | tolerance |\n"
              "|---|---|---|---|---|\n")
    for test in read_scenes().values():
        done = subprocess.run(
            [sys.executable, f"{ROOT}/tests/compare.py", KEYBLOCK,
             f"{ROOT}/prm/{test.scene}.prm",
             f"{ROOT}/tests/scenes/{test.name}.ref",
             (test.ranks + test.nightly_ranks)[0], FOLDER] +
            [f"--set={assignment}" for assignment in test.overrides],
            capture_output=True, text=True)
        lines = re.findall(r"(?m)^(ok|FAIL) +(.+?) (\S+)"
                           r"(?: \(reference (\S+) \+- (\S+), \w+\))?$",
                           done.stdout)
        if not lines:
            out.write(f"| {test.name} | did not run | | | | FAILED\n")
        for state, quantity, value, reference, tolerance in lines:
            out.write(f"| {test.name} | {quantity} | {value} "
                      f"| {reference or value} "
                      f"| {tolerance or 'exact'} |"
                      f"{'' if state == 'ok' else ' FAILED'}\n")


def incline_row(out, label, summary):
    """One line of the table of incline runs."""
    if summary is None:
        out.write(f"| {label} | stopped: not finite | | | | | |\n")
        return
    checks = summary["checks"]
    values = [checks[f"{q}_relative_error"] for q in
              ("acceleration", "slip", "normal_force", "force_offset")]
    out.write(f"| {label} | " + " | ".join(f"{v:+.2e}" for v in values) +
              f" | {checks['energy_residual']:.1e} "
              f"| {summary['run']['loop_time']:.3f} |\n")


def incline_table(out):
    """Meshes, elastic base, sudden gravity, and the published variant."""
    out.write("| run | acceleration | slip | normal force | offset "
              "| energy residual | loop time [s] |\n"
              "|---|---|---|---|---|---|---|\n")
    for method in ("exact", "published"):
        for cells, size in ((8, "40, 10"), (16, "80, 20"), (32, "160, 40")):
            incline_row(out, f"rigid base, {cells} x {cells}, {method}",
                        run("verification/incline_30", f"Mesh/Cells={size}",
                            f"Contact/Method={method}",
                            "Stages/rest/Duration=2"))
        incline_row(out, f"elastic base, 8 x 8, {method}",
                    run("tutorial/sliding_block", f"Contact/Method={method}"))
    for phi in (25, 30, 35):
        incline_row(out, f"sudden gravity, friction {phi}",
                    run(f"verification/incline_{phi}",
                        "Stages/rest/Maximum steps=1"))
        incline_row(out, f"sudden gravity, friction {phi}, undamped",
                    run(f"verification/incline_{phi}",
                        "Stages/rest/Maximum steps=1",
                        "Stages/slide/Damping ratio=0"))


def rank_table(out):
    """The same scene on 1, 2 and 4 ranks."""
    out.write("| scene | quantity | 1 rank | 2 ranks | 4 ranks | largest "
              "relative difference |\n|---|---|---|---|---|---|\n")
    for scene, quantity in (("verification/incline_30", "acceleration"),
                            ("verification/incline_30", "slip"),
                            ("verification/incline_3d", "acceleration"),
                            ("verification/newmark", "slip"),
                            ("verification/bar_impact", "force"),
                            ("tutorial/sliding_block", "acceleration")):
        values = [run(scene, ranks=n)["checks"][quantity] for n in (1, 2, 4)]
        spread = (max(values) - min(values)) / abs(values[0])
        out.write(f"| {os.path.basename(scene)} | {quantity} | " +
                  " | ".join(f"{v:.12g}" for v in values) +
                  f" | {spread:.1e} |\n")


def rock_tables(out):
    """Convergence of the elastic hole, the footing, and the pace of ramps."""
    out.write("Kirsch hole, exact outer displacement, cells of size h at the "
              "wall and 10 h far away:\n\n| h / a | cells | wall closure "
              "| wall displacement | largest stress | mean stress |\n"
              "|---|---|---|---|---|---|\n")
    for h in (0.2, 0.1, 0.05, 0.025):
        checks = run("verification/kirsch", f"Mesh/Size at excavation={h}",
                     f"Mesh/Size={10 * h}")["checks"]
        out.write(f"| {h} | {checks['cells']:.0f} "
                  f"| {checks['wall_closure_relative_error']:+.2e} "
                  f"| {checks['wall_displacement_error']:.2e} "
                  f"| {checks['stress_error']:.2e} "
                  f"| {checks['mean_stress_error']:.2e} |\n")
    out.write("\nStrip footing, psi = phi, rough, cells halved twice around its edge, "
              "relative error of the collapse pressure with cells of 0.1 m and of "
              "0.05 m, extrapolated by order 1 (`contrib/footing.py`):\n\n"
              "| phi | 0.1 m | 0.05 m | extrapolated |\n|---|---|---|---|\n")
    for phi in (10, 20, 30, 35):
        name = f"verification/footing_{phi}"
        finer = footing.finer(pathlib.Path(f"{ROOT}/prm/{name}.prm"), 2)
        errors = [run(name, *changes)["checks"]["collapse_pressure_relative_error"]
                  for changes in ((), [f"{k}={v}" for k, v in finer.items()])]
        out.write(f"| {phi} | {errors[0]:+.2e} | {errors[1]:+.2e} "
                  f"| {2. * errors[1] - errors[0]:+.2e} |\n")
    out.write("\nSpherical cavity in 3D, an octant, cells at the wall 0.16 a wide and "
              "0.015 a thick, relative errors:\n\n| rock | wall closure | hoop stress "
              "at the wall | mean stress | plastic radius |\n|---|---|---|---|---|\n")
    for rock in ("elastic", "mohr_coulomb"):
        checks = run(f"verification/cavity_{rock}")["checks"]
        radius = checks.get("plastic_radius_relative_error")
        out.write(f"| {rock} | {checks['wall_closure_relative_error']:+.2e} "
                  f"| {checks['wall_hoop_stress_relative_error']:+.2e} "
                  f"| {checks['mean_stress_error']:.2e} "
                  f"| {'' if radius is None else f'{radius:+.2e}'} |\n")
    out.write("\nTunnel in dilating rock (psi = phi): where the ramp slows "
              "down:\n\n| unbalanced ratio | steps | wall closure | plastic "
              "radius |\n|---|---|---|---|\n")
    for limit in (1., 5e-3, 1e-3, 3e-4):
        summary = run("verification/salencon_associated",
                      f"Stages/dig/Ramp unbalance={limit}")
        checks = summary["checks"]
        out.write(f"| {limit} | {summary['run']['steps']} "
                  f"| {checks['wall_closure_relative_error']:+.2e} "
                  f"| {checks['plastic_radius_relative_error']:+.2e} |\n")


def toppling_table(out):
    """The quadrants once more, with gravity switched on at once."""
    out.write("| scene | expected | slides | topples | sudden: slides "
              "| sudden: topples |\n|---|---|---|---|---|---|\n")
    for name in sorted(os.listdir(f"{ROOT}/prm/verification")):
        if not name.startswith("toppling_"):
            continue
        scene = "verification/" + name[:-4]
        slow = run(scene)["checks"]
        # time 0 of the sudden run has the final direction of gravity
        with open(f"{ROOT}/prm/{scene}.prm", encoding="utf-8") as file:
            gravity = re.search(r"set Gravity = (.*)", file.read())[1]
        gravity = re.sub(r"\bt\b", "(t + 10)", gravity)
        sudden = run(scene, "Stages/tilt/Maximum steps=1",
                     f"Initial state/Gravity={gravity}")["checks"]
        out.write(f"| {name[9:-4]} | {name[9:-4].replace('_', ' ')} "
                  f"| {slow['slides']:.0f} | {slow['topples']:.0f} "
                  f"| {sudden['slides']:.0f} | {sudden['topples']:.0f} |\n")


def rotation_table(out):
    """Ten turns of a free block, with and without damping."""
    out.write("| damping ratio | angular momentum spread | mean stress over E "
              "| mean stress against centrifugal | energy residual |\n"
              "|---|---|---|---|---|\n")
    for ratio in (0.3, 0.1, 0.):
        summary = run("verification/rotation",
                      f"Stages/spin/Damping ratio={ratio}")
        checks = summary["checks"]
        out.write(f"| {ratio} | {checks['angular_momentum_spread']:.1e} "
                  f"| {checks['mean_stress_over_modulus']:.2e} "
                  f"| {checks['mean_stress_trace_relative_error']:+.1e} "
                  f"| {checks['energy_residual']:.1e} |\n")


def cost_table(out):
    """Share of contact in the time loop; medians of three runs."""
    out.write("| cells | pairs | everything tied | friction only "
              "| contact per pair and step, friction only [ns] |\n"
              "|---|---|---|---|---|\n")
    for n in (128, 256, 512):
        shares, cost = [], 0.
        for tie in ("true", "false"):
            runs = sorted((run("benchmark/interface_cost",
                               f"Mesh/Cells={n}, {n}",
                               f"Contact/Tie all joints={tie}")
                           for _ in range(3)),
                          key=lambda s: s["run"]["contact_time"])
            middle = runs[1]["run"]
            shares.append(middle["contact_time"] / middle["loop_time"])
            pairs = runs[1]["scene"]["pairs"]
            cost = 1e9 * middle["contact_time"] / pairs / middle["steps"]
        out.write(f"| {n * n} | {pairs} | {100 * shares[0]:.2f} % "
                  f"| {100 * shares[1]:.2f} % | {cost:.0f} |\n")


def main():
    with open(f"{ROOT}/doc/verification.md", "w", encoding="utf-8") as out:
        out.write("# Verification\n\nWritten by `contrib/verification.py`; do "
                  "not edit. Errors are relative. Unit tests besides: split "
                  "meshes against unsplit ones, rest under in-situ stress, "
                  "the patch test of inclined joints "
                  "(`tests/unit_tests --log_level=message` prints their "
                  "figures).\n\n## Scenes against closed forms\n\n")
        scene_table(out)
        out.write("\n")
        write_gallery(out)
        out.write("\n## Incline of 40 degrees: mesh, base, contact method\n\n"
                  "Friction 30 degrees unless stated; errors relative to the "
                  "closed form. `exact` is the coupled solution, `published` the "
                  "published one-pass variant with its factor corrected. "
                  "Sudden gravity starts the block unstressed; it is "
                  "reported, not recommended.\n\n")
        incline_table(out)
        out.write("\n## Rock\n\n![Roof wedge on the floor of a room]"
                  "(roof_block_falls.png)\n\n![Mechanism under a strip "
                  "footing, displacements](footing.png)\n\n![Plastic strain "
                  "around a tunnel](salencon.png)\n\n")
        rock_tables(out)
        out.write("\n## Toppling under sudden gravity\n\nThe slow column is "
                  "the test; gravity switched on at once is reported.\n\n")
        toppling_table(out)
        out.write("\n## Free rotation, ten turns\n\n")
        rotation_table(out)
        out.write("\n## Numbers of ranks\n\n")
        rank_table(out)
        out.write("\n## Cost of an interface at rest\n\nShare of contact in "
                  "the time loop.\n\n")
        cost_table(out)


if __name__ == "__main__":
    main()
