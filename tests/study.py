#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A study's probability, its independence of ranks, and that it goes on.

usage: study.py KEYBLOCK SCENE FOLDER
"""
import json
import math
import pathlib
import shutil
import subprocess
import sys

import schema

# of a normal friction angle, 30 +- 2 degrees, below 28 degrees
PROBABILITY = 0.15865525393145707
SEEDS, LEAST_HITS = 20, 17


def study(keyblock, scene, folder, *more, ranks=1):
    """Run a study; the text of its table, and its results."""
    command = [keyblock, scene, "--study", "--output", str(folder)]
    for entry in more:
        command += ["--set", entry]
    if ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n",
                   str(ranks), *command]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    table = (folder / "samples.csv").read_text(encoding="utf-8")
    results = schema.read(folder / "study.json")
    faults = schema.faults_of(results, "study")
    if faults:
        sys.exit("; ".join(faults))
    return table, results


def first_sample(table):
    """The first row of samples.csv by its columns."""
    header, row = table.splitlines()[1:3]
    return dict(zip(header.split(","), row.split(",")))


def faults_of_runs(keyblock, scene, folder):
    """What is wrong where samples with critical blocks are run."""
    more = ["Study/Level=full", "Study/Samples=8",
            "Stages/rest/Kind=quasi-static", "Safety factor/Bracket=0.002",
            "Safety factor/Critical factor=1.1"]
    table, results = study(keyblock, scene, folder / "full", *more)
    faults = []
    for row in table.splitlines()[2:]:
        values = row.split(",")
        friction, found, rigid = (float(values[i]) for i in (1, 2, 8))
        factor = math.tan(math.radians(friction)) / math.tan(math.radians(28))
        is_run = (folder / "full" / "samples" / values[0]
                  / "summary.json").exists()
        if abs(rigid / factor - 1) > 1e-6:
            faults.append(f"limit equilibrium of row '{row}' is wrong")
        if is_run != (factor < 1.1) or (is_run and found == rigid):
            faults.append(f"row '{row}' was {'' if is_run else 'not '}run")
        if abs(found / factor - 1) > 2e-3:
            faults.append(f"strength reduction of row '{row}' is wrong")
    if results["level"] != "full" or results["rigid_probability"] is None:
        faults.append("the level is not told")
    if study(keyblock, scene, folder / "full_2", *more, ranks=2)[0] != table:
        faults.append("runs on 2 ranks have other samples")
    return faults


def faults_of_stages(keyblock, scene, folder):
    """What is wrong where bolts that are there in stage rest alone hold a block."""
    results = study(
        keyblock, str(pathlib.Path(scene).with_name("bolted_incline.prm")),
        folder / "stages", "Study/Names=friction", "Study/Samples=20",
        "Study/friction/Entry=Joints/base/Friction angle",
        "Study/friction/Mean=30", "Study/friction/Deviation=0.001")[1]
    # of bolts of 0.1 W at 30 degrees from the normal of a plane of 40 degrees
    exact = 0.830442
    mean = results["least_factor"]["mean"]
    return [] if math.isclose(mean, exact, rel_tol=1e-3) else [
        f"a bolted block has {mean} for {exact}"]


def faults_of_groups(keyblock, scene, folder):
    """What is wrong where two blocks fail together, one of them not critical."""
    # statics of both, as tests/scenes/factor_group.ref has it
    together = 1.1882053
    table, results = study(
        keyblock, str(pathlib.Path(scene).with_name("factor_group.prm")),
        folder / "group", "Study/Level=full", "Study/Names=friction",
        "Study/Samples=1", "Study/friction/Entry=Joints/upper/Friction angle",
        "Study/friction/Distribution=sequence", "Study/friction/Minimum=20",
        "Study/Threshold=1.25", "Safety factor/Wanted=0.9")
    values = first_sample(table)
    faults = []
    for name in ("factor", "factor_1", "factor_2"):
        if abs(float(values[name] or "inf") - together) > 2e-3:
            faults.append(f"{name} of blocks that fail together: {values[name]}")
    if "rank_correlation" in results["variables"][0]:
        faults.append("a sequence has a rank correlation")
    if values["failed_blocks"] != "2" or results["probability"]["value"] != 1:
        faults.append("of blocks that fail together not both failed")
    return faults


def faults_of_leaning(keyblock, scene, folder):
    """What is wrong where a block fails that a failing one has held."""
    table, results = study(
        keyblock, str(pathlib.Path(scene).with_name("factor_group.prm")),
        folder / "leaning", "Study/Names=friction", "Study/Samples=1",
        "Study/friction/Entry=Joints/lower/Friction angle",
        "Study/friction/Distribution=sequence", "Study/friction/Minimum=25")
    values = first_sample(table)
    faults = []
    # each by itself, 25 and 20 degrees on 30
    exact = [math.tan(math.radians(phi)) / math.tan(math.radians(30))
             for phi in (20, 25)]
    found = sorted(float(values[name] or "inf") for name in ("factor_1", "factor_2"))
    if max(abs(f - e) for f, e in zip(found, exact)) > 1e-6:
        faults.append(f"blocks that fall one after the other have {found}")
    if values["failed_blocks"] != "2" or any(
            block["probability"]["value"] != 1 for block in results["blocks"]):
        faults.append("a block that falls after another one has not failed")
    return faults


def faults_of_notch(keyblock, scene, folder):
    """What is wrong where a block that no way is free for turns."""
    results = study(
        keyblock, str(pathlib.Path(scene).with_name("leaning_notch.prm")),
        folder / "notch", "Study/Names=friction", "Study/Samples=20",
        "Study/friction/Entry=Joints/a/Friction angle",
        "Study/friction/Mean=15", "Study/friction/Deviation=0.001")[1]
    exact, mean = 0.6252148, results["least_factor"]["mean"]
    return [] if (math.isclose(mean, exact, rel_tol=1e-3)
                  and results["probability"]["value"] == 1) else [
        f"a block that leans in a notch has {mean} for {exact}"]


def faults_of_uncovered(keyblock, scene, folder):
    """What is wrong where a hidden block fails that a failing one uncovers."""
    results = study(
        keyblock, str(pathlib.Path(scene).with_name("uncovered_block.prm")),
        folder / "uncovered", "Study/Names=strength", "Study/Samples=1",
        "Study/strength/Entry=Joints/left above/Cohesion",
        "Study/strength/Distribution=sequence", "Study/strength/Minimum=5e3")[0]
    values = first_sample(results)
    # (5 + 12) / 20 of the weight on the sides of the upper one
    if (values["failed_blocks"] != "2"
            or abs(float(values["factor_2"] or "inf") - 0.85) > 1e-6):
        return ["a hidden block that falls after another one has not failed"]
    return []


def faults_of_joints(keyblock, folder):
    """What is wrong where variables are strengths of a set, of a bent joint and
    of a pattern, which are changed in place: samples are those of scenes that
    are read anew, as another variable demands."""
    scene = str(pathlib.Path(__file__).with_name("scenes")
                / "study_joints.prm")
    table, results = study(keyblock, scene, folder / "joints")
    faults = []
    if results["seconds"] > 2:
        faults.append(f"1000 samples of strengths took {results['seconds']} s")
    slow = study(keyblock, scene, folder / "joints_read", "Study/Samples=40",
                 "Study/Names=set, bent, pattern, idle",
                 "Study/idle/Entry=Safety factor/Bracket",
                 "Study/idle/Distribution=uniform", "Study/idle/Minimum=0.01",
                 "Study/idle/Maximum=0.02")[0]
    for row, expected in zip(table.splitlines()[1:42], slow.splitlines()[1:]):
        values = expected.split(",")
        if row.split(",") != values[:4] + values[5:]:
            faults.append(f"row '{row}' is not '{expected}'")
            break
    if study(keyblock, scene, folder / "joints_2", ranks=2)[0] != table:
        faults.append("2 ranks have other samples of strengths")
    if [block["id"] for block in results["blocks"]] != [1, 2]:
        faults.append("infinite rock is among the blocks of a study")
    return faults


def faults_of_going_on(keyblock, scene, folder):
    """What is wrong where there are more or fewer samples, another threshold,
    or other settings."""
    faults, there, counts = [], 0, {}
    for samples in (30, 50, 20, 60):
        table, results = study(keyblock, scene, folder / "more",
                               "Study/Sampling=random",
                               f"Study/Samples={samples}")
        if results["resumed_samples"] != min(there, samples) or (
                results["samples"] != samples):
            faults.append(f"{results['resumed_samples']} of {there} samples "
                          f"taken over for {samples}")
        there = max(there, samples)
        counts[samples] = results["probability"]["value"]
        if len(table.splitlines()) != 2 + there:
            faults.append(f"{len(table.splitlines()) - 2} rows of {there}")
    fresh, results = study(keyblock, scene, folder / "fresh",
                           "Study/Sampling=random", "Study/Samples=60")
    if fresh != table or counts[60] != results["probability"]["value"]:
        faults.append("samples in pieces are others than those in one go")
    # the strengths of the scene, not those of a sample
    used = (folder / "fresh" / "used.prm").read_text(encoding="utf-8")
    if used != (folder / "more" / "used.prm").read_text(encoding="utf-8"):
        faults.append("used.prm depends on the samples that were there")
    # rows have the failures of the threshold that counts now
    higher = ["Study/Sampling=random", "Study/Samples=60",
              "Study/Threshold=1.1"]
    table, results = study(keyblock, scene, folder / "more", *higher)
    other, expected = study(keyblock, scene, folder / "higher", *higher)
    if results["resumed_samples"] != 60 or table != other or (
            results["probability"] != expected["probability"]):
        faults.append("another threshold has taken no or wrong samples over")
    # samples of other settings are not lost
    done = subprocess.run(
        [keyblock, scene, "--study", "--output", str(folder / "more"), "--set",
         "Study/Sampling=random", "--set", "Study/Samples=20", "--set",
         "Study/Seed=2"], check=True, capture_output=True, text=True)
    kept = folder / "more" / "earlier_1"
    if (kept / "samples.csv").read_text(encoding="utf-8") != table or (
            schema.read(kept / "study.json") != results):
        faults.append("results of other settings are lost")
    if "earlier_1" not in done.stdout or "'Study/Seed = 2'" not in done.stdout:
        faults.append(f"not said that results are moved: {done.stdout}")
    again, results = study(keyblock, scene, kept, *higher)
    if again != table or results["resumed_samples"] != 60:
        faults.append("results that were moved do not go on")
    return faults


def faults_of_networks(keyblock, scene, folder):
    """What is wrong where each sample draws discs of its own."""
    networks = str(pathlib.Path(scene).parents[1] / "benchmark"
                   / "networks_3d.prm")
    table, results = study(keyblock, networks, folder / "networks",
                           "Study/Samples=60")
    faults = []
    if not 0 < results["probability"]["value"] < 0.2:
        faults.append(f"of 60 networks {results['probability']} fail")
    if study(keyblock, networks, folder / "networks_2", "Study/Samples=60",
             ranks=2)[0] != table:
        faults.append("networks on 2 ranks are others")
    # each sample is read by itself where a variable is not of joint sets
    more = study(keyblock, networks, folder / "read", "Study/Samples=60",
                 "Study/Names=a, b, c, depth", "Study/depth/Entry=Ground/Depth",
                 "Study/depth/Distribution=sequence",
                 "Study/depth/Minimum=120")[0]
    figures = [[row.split(",")[-8:] for row in text.splitlines()[2:]]
               for text in (table, more)]
    if figures[0] != figures[1]:
        faults.append("joints drawn anew are not those that are read")
    # the blocks of a sample have the numbers of those of its run
    traces = str(pathlib.Path(networks).with_name("networks_2d.prm"))
    table = study(keyblock, traces, folder / "networks_full", "Study/Samples=2",
                  "Study/Level=full", "Safety factor/Wanted=0")[0]
    values = dict(zip(table.splitlines()[1].split(","),
                      table.splitlines()[3].split(",")))
    run = json.loads((folder / "networks_full" / "samples" / "2"
                      / "summary.json").read_text(encoding="utf-8"))
    block = run["blocks"][int(values["block"]) - 1]
    for name, found in (("rigid_factor", block["limit_equilibrium"]),
                        ("factor", block["safety_factor"])):
        if abs(found[0]["value"] / float(values[name]) - 1) > 1e-9:
            faults.append(f"{name} of a sample is {values[name]}, in its run "
                          f"{found[0]['value']}")
    return faults


def main():
    """Exit with 1 and a sentence for what is wrong."""
    keyblock, scene, folder = sys.argv[1:]
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    table, results = study(keyblock, scene, folder / "one")
    p = results["probability"]
    faults = []
    # a Latin hypercube has the share to one sample
    if abs(p["value"] - PROBABILITY) > 1.001e-3:
        faults.append(f"probability {p['value']}")
    if results["resumed_samples"] != 0 or len(table.splitlines()) != 1002:
        faults.append("not 1000 new samples")
    if results["seconds"] > 2:
        faults.append(f"1000 samples took {results['seconds']} s")
    if study(keyblock, scene, folder / "two", ranks=2)[0] != table:
        faults.append("2 ranks have other samples")

    # killed within a row
    cut = table[:len(table) // 3]
    (folder / "one" / "samples.csv").write_text(cut, encoding="utf-8")
    again, results = study(keyblock, scene, folder / "one")
    if again != table:
        faults.append("a study that goes on has other samples")
    if results["resumed_samples"] != len(cut.splitlines()) - 3:
        faults.append(f"{results['resumed_samples']} samples taken over")
    # another scene does not go on from it
    if study(keyblock, scene, folder / "one",
             "Study/Seed=2")[1]["resumed_samples"] != 0:
        faults.append("samples of another seed taken over")

    hits = 0
    for seed in range(1, SEEDS + 1):
        p = study(keyblock, scene, folder / "seeds", f"Study/Seed={seed}",
                  "Study/Sampling=random")[1]["probability"]
        hits += p["lower"] <= PROBABILITY <= p["upper"]
    if hits < LEAST_HITS:
        faults.append(f"the band has the probability for {hits} of {SEEDS} seeds")
    # a new mesh and strengths by entries of other sections give the same
    drawn = study(keyblock, scene, folder / "mesh",
                  "Study/Names=friction, density", "Study/Samples=20",
                  "Study/density/Entry=Materials/rock/Density",
                  "Study/density/Distribution=uniform",
                  "Study/density/Minimum=1000", "Study/density/Maximum=3000")[0]
    for row in drawn.splitlines()[2:]:
        values = row.split(",")
        factor = (math.tan(math.radians(float(values[1])))
                  / math.tan(math.radians(28)))
        if abs(float(values[3]) / factor - 1) > 1e-6:
            faults.append(f"row '{row}' is not tan(phi) / tan(28)")
            break
    # what limit equilibrium does not take is told of
    warnings = study(keyblock, scene, folder / "idle", "Study/Samples=4",
                     "Study/friction/Entry=Materials/rock/Young modulus",
                     "Study/friction/Mean=20e6",
                     "Study/friction/Deviation=1e6")[1]["warnings"]
    if not any("'friction' changes nothing" in text for text in warnings):
        faults.append(f"no warning of stiffness: {warnings}")
    # the weaker of two joints at one place rules, whichever that is in a sample
    drawn = study(keyblock, scene, folder / "shared", "Study/Samples=8",
                  "Joints/Names=base, again", "Joints/again/Point=0, 0",
                  "Joints/again/Friction angle=29")[0]
    for row in drawn.splitlines()[2:]:
        values = row.split(",")
        factor = (math.tan(math.radians(min(29., float(values[1]))))
                  / math.tan(math.radians(28)))
        if abs(float(values[2]) / factor - 1) > 1e-6:
            faults.append(f"row '{row}' does not have the weaker joint")
            break
    # what moves a joint needs a mesh for each sample, without columns by block
    drawn = study(keyblock, scene, folder / "moved", "Study/Samples=1",
                  "Study/friction/Entry=Joints/base/Dip",
                  "Study/friction/Distribution=sequence",
                  "Study/friction/Minimum=0")[0].splitlines()
    factor = math.tan(math.radians(30)) / math.tan(math.radians(28))
    if "factor_1" in drawn[1] or abs(float(drawn[2].split(",")[2]) / factor - 1) > 1e-6:
        faults.append(f"a dip that varies has '{drawn[1]}' and '{drawn[2]}'")
    faults += faults_of_going_on(keyblock, scene, folder)
    faults += faults_of_joints(keyblock, folder)
    faults += faults_of_runs(keyblock, scene, folder)
    faults += faults_of_stages(keyblock, scene, folder)
    faults += faults_of_networks(keyblock, scene, folder)
    faults += faults_of_groups(keyblock, scene, folder)
    faults += faults_of_leaning(keyblock, scene, folder)
    faults += faults_of_notch(keyblock, scene, folder)
    faults += faults_of_uncovered(keyblock, scene, folder)
    if faults:
        sys.exit("; ".join(faults))


if __name__ == "__main__":
    main()
