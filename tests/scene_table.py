#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of scenes that are compared with references.

usage: scene_table.py

Prints the tests of scenes/scenes.txt for CMake. A scene of the table begins with
  name | scene | ranks | ranks of nightly tests
It is run on the ranks of the third column by every test run (one rank: label quick,
more: label ranks), on those of the last with the label nightly (-: none), and compared with
scenes/NAME.ref. Where the scene is the name of an earlier one, it begins with the
entries of that one. Indented lines Section/Entry=value are set.
"""
import pathlib
from typing import NamedTuple

TESTS = pathlib.Path(__file__).resolve().parent


class Scene(NamedTuple):
    """A scene with entries set."""
    name: str  # of the references
    scene: str  # as in verification/incline_30
    ranks: list
    nightly_ranks: list
    overrides: list


def read_scenes():
    """All scenes of the table by name."""
    scenes = {}
    for line in (TESTS / "scenes" / "scenes.txt").read_text("utf-8").splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        if line.startswith(" "):
            next(reversed(scenes.values())).overrides.append(line.strip())
            continue
        name, scene, ranks, nightly = (part.strip(" -") for part in line.split("|"))
        assert name not in scenes and (ranks or nightly), line
        overrides = []
        if scene in scenes:
            scene, overrides = scenes[scene].scene, list(scenes[scene].overrides)
        scenes[name] = Scene(name, scene, ranks.split(), nightly.split(), overrides)
    return scenes


def main():
    for scene in read_scenes().values():
        for ranks in scene.ranks + scene.nightly_ranks:
            label = ("nightly" if ranks not in scene.ranks
                     else "quick" if ranks == "1" else "ranks")
            test = f"{scene.name}.{ranks}"
            words = " ".join(f"[==[--set={entry}]==]" for entry in scene.overrides)
            print(f"keyblock_test(scenes/{test} {label} RANKS {ranks} COMMAND compare.py\n"
                  f"  ${{keyblock}} ${{prm}}/{scene.scene}.prm\n"
                  f"  {TESTS}/scenes/{scene.name}.ref {ranks} ${{out}}/{test}\n  {words})")


if __name__ == "__main__":
    main()
