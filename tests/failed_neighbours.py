#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Blocks that fail side by side in a stage have factors that agree with that.

None holds at the strength at which it has failed, by itself or in its group, and
a group has one factor, whichever of its blocks tells it.

usage: failed_neighbours.py PROGRAM SCENE FOLDER
"""
import json
import pathlib
import subprocess
import sys


def main():
    program, scene, folder = sys.argv[1:]
    subprocess.run([program, scene, "--output", folder], check=True,
                   stdout=subprocess.DEVNULL)
    text = (pathlib.Path(folder) / "summary.json").read_text(encoding="utf-8")
    failed = [block for block in json.loads(text)["blocks"]
              if block.get("removed_in_stage") == "dig"]
    assert len(failed) == 3, f"{len(failed)} blocks failed"
    groups = {}
    n_again = 0
    for block in failed:
        factor = block["safety_factor"][0]
        n_again += any(trial["phase"] == 0 for trial in factor["trials"])
        if factor["outcome"] == "value":
            assert factor["lower"] < factor["upper"] <= 1.0, factor
        group = factor.get("group")
        if group:
            assert group["lower"] < group["upper"] <= 1.0, group
            known = groups.setdefault(tuple(group["blocks"]), group)
            assert known == group, (known, group)
    assert n_again == 1, "the stage was not run again for one block"
    assert groups, "no group was found"


if __name__ == "__main__":
    main()
