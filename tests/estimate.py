#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What --validate says a run will take, against what it takes.

usage: estimate.py KEYBLOCK PRM FOLDER [SCENE...]

Steps of stages that have an end are exact, those of others within the range,
which may not be wider than 6; the peak of memory is within 30 %, processor
seconds per step within a factor of 2.5. With scenes, they are compared instead.
"""
import json
import pathlib
import re
import resource
import subprocess
import sys

KEYBLOCK, PRM, FOLDER = sys.argv[1:4]
SCENES = sys.argv[4:] or ["tutorial/sliding_block", "verification/lined_roof_3d",
                          "verification/incline_3d"]
LARGEST = 2.5
NUMBER = r"[\d.]+(?:e[+-]?\d+)?"


def said(scene):
    """Steps (least, most) by stage, seconds per step, and bytes."""
    done = subprocess.run([KEYBLOCK, scene, "--validate"], check=True,
                          capture_output=True, text=True)
    text = done.stdout[done.stdout.index("Estimate "):]
    steps = {name: (float(low), float(high or low)) for name, low, high in
             re.findall(rf"(?:Estimate |; )(\w+): ({NUMBER})(?: to ({NUMBER}))?"
                        r" steps", text)}
    each = re.search(rf"({NUMBER}) ms each", text)
    memory = re.search(rf"memory at most about ({NUMBER}) MB", text)
    return steps, 1e-3 * float(each[1]), 1e6 * float(memory[1])


def run(scene, folder, settings=()):
    """Run a scene: its summary, and the processor's seconds that it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([KEYBLOCK, scene, "--output", folder, "--set",
                    "Safety factor/Blocks=none", *settings], check=True,
                   stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    return json.loads((folder / "summary.json").read_text()), after - before


def main():
    """Exit with 1 and a line for what is wrong."""
    faults = []
    for name in SCENES:
        scene = f"{PRM}/{name}.prm"
        folder = pathlib.Path(FOLDER) / pathlib.Path(name).name
        steps, seconds, memory = said(scene)
        summary, taken = run(scene, folder)
        few = [word for stage in summary["stages"] for word in
               ("--set", f"Stages/{stage['name']}/Maximum steps=1")]
        short, taken_by_few = run(scene, folder, few)
        n_steps, peak = (summary["run"][key] for key in
                         ("steps", "peak_memory_bytes"))
        found = (taken - taken_by_few) / (n_steps - short["run"]["steps"])
        print(f"{name:30} {1e3 * seconds:9.3g} ms {1e3 * found:9.3g} ms "
              f"{1e-6 * memory:7.0f} MB {1e-6 * peak:7.0f} MB",
              *(f"{s['name']} {s['steps']} {steps.get(s['name'])}"
                for s in summary["stages"][:4]))
        if not 1. / LARGEST < seconds / found < LARGEST:
            faults.append(f"{name}: {seconds} s per step, not {found}")
        if abs(memory / peak - 1.) > 0.3:
            faults.append(f"{name}: {memory} bytes, not {peak}")
        for stage in summary["stages"]:
            if stage["name"] not in steps:
                continue
            low, high = steps[stage["name"]]
            # two digits are printed of a range
            if not 0.94 * low <= stage["steps"] <= 1.06 * high:
                faults.append(f"{name}: {stage['name']} takes {stage['steps']} "
                              f"steps, not {low} to {high}")
            if high > 6. * low:
                faults.append(f"{name}: {low} to {high} steps say nothing")
    print("\n".join(faults))
    return 1 if faults else 0


sys.exit(main())
