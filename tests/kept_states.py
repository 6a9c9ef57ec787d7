#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Factors from states that a run has kept (--factors) against those of a run.

usage: kept_states.py KEYBLOCK PRM FOLDER RANKS GROUPS

A tunnel is dug in two stages, one block fails in the first. The run keeps its
stages and looks for coarse factors. Then --factors finds finer ones, with other
entries, and they have to be those of a run with these entries, to the last
digit; so has everything else in summary.json. What the first run has written
stays as it is. What cannot be answered is refused with a sentence.
"""
import pathlib
import shutil
import subprocess
import sys
import time

import schema

KEYBLOCK, PRM, FOLDER, RANKS, GROUPS = sys.argv[1:6]
FOLDER = pathlib.Path(FOLDER)
SCENE = pathlib.Path(PRM) / "verification" / "roof_block_falls.prm"
TWO_STAGES = [
    "Excavations/Names=room, floor", "Excavations/floor/Stage=deepen",
    "Excavations/floor/Vertices=-3, -5; 3, -5; 3, -3; -3, -3",
    "Stages/Names=dig, deepen", "Stages/deepen/Kind=quasi-static",
    "Safety factor/Removal slip=0.05", "Check/Closed form=none",
    "Output/Write VTU=false", f"Safety factor/Rank groups={GROUPS}"]
COARSE = ["Safety factor/Blocks=all", "Safety factor/Bracket=0.2"]
FINE = ["Safety factor/Blocks=all", "Safety factor/Bracket=0.02",
        "Safety factor/Wanted=2", "Safety factor/Seismic coefficient=0.1, 0"]
KEEP = ["Output/Keep stages=true"]
# what differs from run to run, or tells the entries
TOLD = {"digest", "overrides", "wall_time", "loop_time", "contact_time",
        "force_time", "seconds", "phase_1_seconds", "peak_memory_bytes",
        "million_element_steps_per_second"}


def call(*arguments, settings=()):
    """Run the program."""
    command = [KEYBLOCK, str(SCENE), *map(str, arguments)]
    for entry in [*TWO_STAGES, *settings]:
        command += ["--set", entry]
    if int(RANKS) > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n",
                   RANKS, *command]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def done(*arguments, settings=()):
    """Run the program, which has to succeed; its summary."""
    result = call(*arguments, settings=settings)
    assert result.returncode == 0, result.stdout + result.stderr
    folder = FOLDER / arguments[arguments.index("--output") + 1]
    summary = schema.read(folder / "summary.json")
    faults = schema.faults_of(summary, "summary")
    assert not faults, faults
    return summary


def refused(words, *arguments, settings=()):
    """Run the program, which has to end with one sentence and write nothing."""
    new = FOLDER / "refused"
    if "--output" not in arguments:
        arguments += ("--output", new)
    result = call(*arguments, settings=settings)
    lines = [line for line in result.stderr.splitlines()
             if line.startswith("Error: ")]
    print("\n".join(lines))
    assert result.returncode == 1, result.stdout + result.stderr
    assert len(lines) == 1 and words in lines[0], result.stderr
    assert not new.exists(), "something was written"


def told(value):
    """A summary without what need not be equal."""
    if isinstance(value, dict):
        return {key: told(entry) for key, entry in value.items()
                if key not in TOLD}
    return [told(v) for v in value] if isinstance(value, list) else value


def factors_of(summary):
    """Factors by block and stage."""
    return {(block["id"], factor["stage"]): told(factor)
            for block in summary["blocks"]
            for factor in block.get("safety_factor", [])}


def main():
    """Compare, and look at what is refused."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    kept, whole = FOLDER / "kept", FOLDER / "whole"
    coarse = done("--output", kept, settings=COARSE + KEEP)
    before = {path.name: path.read_bytes() for path in kept.iterdir()}
    assert {"stage_1.h5", "stage_2.h5"} <= set(before), sorted(before)
    fine = done("--output", whole, settings=FINE)
    again = done("--factors", kept, "--output", FOLDER / "again",
                 settings=FINE)
    assert told(again) == told(fine), "other results than those of a run"
    assert factors_of(fine) != factors_of(coarse), "nothing was to be found"
    assert any(factor["outcome"] == "falls freely" or block["removed_in_stage"]
               for block in fine["blocks"] if "removed_in_stage" in block
               for factor in block["safety_factor"]), "no block failed"
    for name in ("factors.csv", "blocks.csv", "history.csv"):
        assert (FOLDER / "again" / name).read_bytes() == (
            whole / name).read_bytes(), name
    # one stage, and one file of it; earlier factors are guesses of later ones
    one = done("--factors", kept / "stage_1.h5", "--output", FOLDER / "one",
               settings=FINE)
    wanted = {key: factor for key, factor in factors_of(fine).items()
              if key[1] == "dig"}
    assert factors_of(one) == wanted and len(one["stages"]) == 1
    one = done("--factors", kept, "--output", FOLDER / "named",
               settings=FINE + ["Safety factor/Stages=dig"])
    assert factors_of(one) == wanted and len(one["stages"]) == 2
    # without a trial
    begin = time.monotonic()
    static = done("--factors", kept, "--output", FOLDER / "static",
                  settings=FINE + ["Safety factor/Method=limit equilibrium"])
    # no part of it is the time of the run that kept them
    assert static["run"]["wall_time"] < time.monotonic() - begin
    assert any("limit_equilibrium" in block for block in static["blocks"])
    assert not factors_of(static)
    after = {path.name: path.read_bytes() for path in kept.iterdir()}
    assert after == before, "the run's own files have changed"
    if int(RANKS) == 1:
        refusals(kept)


def refusals(kept):
    """What cannot be answered."""
    ask = ("--factors", kept)
    refused("'Safety factor/Removal slip' is '0.05' there", *ask,
            settings=FINE + ["Safety factor/Removal slip=0.1"])
    refused("is of another scene", *ask,
            settings=FINE + ["Joints/*/Friction angle=20"])
    refused("would be lost", *ask, "--output", kept, settings=FINE)
    refused("does not exist", "--factors", FOLDER / "nowhere", settings=FINE)
    (FOLDER / "empty").mkdir()
    refused("has no state of a stage", "--factors", FOLDER / "empty",
            settings=FINE)
    refused("asks for no factor", *ask, settings=["Safety factor/Blocks=none"])
    shutil.copytree(kept, FOLDER / "part")
    (FOLDER / "part" / "stage_2.h5").unlink()
    refused("names 'deepen', whose end is not in", "--factors",
            FOLDER / "part", settings=FINE + ["Safety factor/Stages=deepen"])
    refused("--factors together with", *ask, "--validate", settings=FINE)
    refused("find factors alone by --factors", "--restart",
            kept / "stage_2.h5", settings=FINE)


main()
