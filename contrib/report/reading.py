# SPDX-License-Identifier: LGPL-2.1-or-later
"""The output folder of a run: its files, read and arranged."""
import csv
import json
import math
import pathlib
import re
import time

import numpy

from .run_files import entries_of, groups_of, last_states, states_of

MOST_STATES = 30  # a face says in one number in which of them it is seen


class ReportError(Exception):
    """A sentence that says why something of a report cannot be made."""


def read_summary(folder):
    """The content of summary.json."""
    path = folder / "summary.json"
    if not folder.is_dir():
        raise ReportError(f"There is no folder '{folder}'; name the output "
                          "folder of a run or a study.")
    try:
        with open(path, encoding="utf-8") as file:
            summary = json.load(file)
    except OSError as error:
        raise ReportError(f"'{path}' cannot be read ({error.strerror}); name "
                          "the output folder of a run or a study that has "
                          "ended."
                          ) from None
    except ValueError as error:
        raise ReportError(f"'{path}' is damaged ({error}); run the scene "
                          "again.") from None
    kinds = {"scene": dict, "blocks": list, "stages": list}
    if not isinstance(summary, dict) or not all(
            isinstance(summary.get(key), kind) for key, kind in kinds.items()):
        raise ReportError(f"'{path}' lacks scene, blocks or stages; is it "
                          "that of a run of keyblock?")
    return summary


def read_entries(folder):
    """Entries of used.prm by path, and those that differ from defaults.

    The program writes the default behind what differs from it."""
    entries, changed = {}, []
    try:
        text = (folder / "used.prm").read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return entries, changed
    for path, value, comment in entries_of(text):
        entries[path] = value
        if comment.startswith("default:"):
            default = comment.split("default:", 1)[1].strip()
            changed.append((path, value, default))
    return entries, changed


def read_history(folder):
    """Columns of history.csv by name without units; {} if there are none."""
    try:
        with open(folder / "history.csv", encoding="utf-8") as file:
            names = [name.split(" [")[0] for name in
                     file.readline().strip().split(",")]
            values = numpy.loadtxt(file.readlines(), delimiter=",", ndmin=2)
    except (OSError, ValueError):
        return {}
    if values.ndim != 2 or values.shape[1] != len(names) or not {
            "stage", "step", "time"} <= set(names):
        return {}
    return dict(zip(names, values.T))


def read_rows(path):
    """The rows of a CSV file, names of columns without units; [] without it."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            return [{name.split(" (")[0]: value for name, value in
                     row.items() if name} for row in csv.DictReader(file)]
    except (OSError, csv.Error, UnicodeDecodeError):
        return []


def read_joints(folder):
    """The rows of joints.csv, names of columns without units."""
    return read_rows(folder / "joints.csv")


def read_states(folder):
    """Time, file of the rock and file of the joints of each state."""
    path = folder / "solution.pvd"
    if not path.exists():
        return []
    try:
        return states_of(path)
    except ValueError as error:
        raise ReportError(str(error)) from None


class Run:
    """The results in the output folder of one run."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.summary = read_summary(self.folder)
        self.entries, self.changed = read_entries(self.folder)
        self.history = read_history(self.folder)
        self.joints = read_joints(self.folder)
        self.block_rows = {row.get("block"): row for row in
                           read_rows(self.folder / "blocks.csv")}
        self.stages = [s["name"] for s in self.summary["stages"]]
        self.blocks = {b["id"]: b for b in self.summary["blocks"]}
        self.is_plane = self.summary["scene"].get("dimension") == 2
        self.written = time.localtime(
            (self.folder / "summary.json").stat().st_mtime)
        self.why_no_states = ""
        self.states = self.states_of_stages()

    def scene(self, key, otherwise=""):
        """An entry of the section scene of summary.json."""
        return self.summary["scene"].get(key, otherwise)

    def numbers(self, entry):
        """The numbers of an entry such as 1, 2; [] if they are formulas."""
        words = self.entries.get(entry, "").replace(";", ",").split(",")
        try:
            return [float(word) for word in words if word.strip()]
        except ValueError:
            return []

    def down(self):
        """Unit vector of gravity, or None if it is zero or a formula.

        Left out, it follows from the section Ground."""
        if (self.numbers("Ground/Depth") or [0.])[0] > 0. and not (
                self.entries.get("Initial state/Gravity")):
            return numpy.array([0., -1., 0.] if self.is_plane else
                               [0., 0., -1.])
        gravity = numpy.array((self.numbers("Initial state/Gravity")
                               + [0., 0.])[:3])
        size = numpy.linalg.norm(gravity)
        return gravity / size if size > 0. else None

    def takes_steps(self):
        """Whether the run moves anything, and not only judges blocks."""
        return self.entries.get("Safety factor/Method") != "limit equilibrium"

    def digs(self):
        """Whether the scene has excavations."""
        return bool(self.entries.get("Excavations/Names", "").strip())

    def finite_blocks(self):
        """The numbers of the blocks that could move, in order."""
        return [number for number, block in sorted(self.blocks.items())
                if not {"infinite", "rigid"} & set(block.get("class", []))]

    def stage_name(self, number):
        """Name of a stage as summary.json counts: 1 is before the first."""
        return (self.stages[number - 2] if 2 <= number < len(self.stages) + 2
                else "the start")

    def states_of_stages(self):
        """State before the first stage, and at the end of each that has one.

        Of a stage that takes blocks away the state before the end, too. A list
        of (name of the stage or "start", index of the stage or -1, file of the
        rock, file of the joints)."""
        states = read_states(self.folder)
        if not states:
            self.why_no_states = (
                "There are no pictures, as the run wrote no solution.pvd "
                "(Output/Write VTU = false, or the folder is not complete).")
            return []
        times = numpy.array([state[0] for state in states])
        ends, last = self.stage_ends("time"), 0
        by_name = last_states(self.folder / "solution.pvd")
        # --factors writes the states of its stages alone
        found = ([("start", -1, *states[0][1:])]
                 if "start" in by_name or not by_name else [])
        for k, name in enumerate(self.stages if by_name or ends else []):
            if by_name:
                if name in by_name:
                    end = by_name[name]
                    if (name in self.removed().values()
                            and end > 0 and end - 1 not in by_name.values()):
                        found.append((name, k, *states[end - 1][1:]))
                    found.append((name, k, *states[end][1:]))
                continue
            # times are written with six digits; static stages take none
            near = abs(times - ends[k]) <= 1e-5 * max(ends[-1], 1e-300)
            near[:last + 1] = False
            if near.any():
                last = int(near.argmax())
                found.append((name, k, *states[last][1:]))
        if not found or (found[0][1] < 0 and len(found) == 1 < len(states)):
            name = self.stages[-1] if self.stages else "end"
            found.append((name, len(self.stages) - 1, *states[-1][1:]))
        if len(found) > MOST_STATES:
            keep = numpy.linspace(0, len(found) - 1, MOST_STATES).astype(int)
            found = [found[i] for i in sorted(set(keep))]
        return found

    def is_within_stage(self, k):
        """Whether a state comes before that at the end of its stage."""
        return self.states[k][1] in [state[1] for state in self.states[k + 1:]]

    def stage_ends(self, column):
        """Value of a column of the history at the end of each stage."""
        if not self.history:
            return None
        stage = self.history["stage"]
        return [self.history[column][stage <= k][-1]
                if (stage <= k).any() else 0. for k in range(len(self.stages))]

    def removed(self):
        """Stage in which each block was taken away, by its number."""
        return {n: b["removed_in_stage"] for n, b in self.blocks.items()
                if b.get("removed_in_stage")}

    def moved_off(self):
        """Blocks that moved off, by the remarks of stages, and the stage."""
        found = {}
        for stage in self.summary["stages"]:
            for n in re.findall(r"block (\d+) moved off",
                                stage.get("remark", "")):
                found.setdefault(int(n), stage["name"])
        return found

    def moving(self):
        """Blocks that still moved at the end of a stage, and the last such.

        Not far: those that have gone are the ones that moved off."""
        return {int(n): stage["name"] for stage in self.summary["stages"]
                for n in re.findall(r"block (\d+) is moving off",
                                    stage.get("remark", ""))}

    def joint_groups(self):
        """Names of sets, or of what joints share, and the group of each joint."""
        return groups_of(self.joints)

    def orientation(self, row):
        """Dip and dip direction of a joint in degrees, or None."""
        try:
            return float(row["dip"]), float(row["dip direction"])
        except (KeyError, ValueError):
            pass
        corners = [[float(x) for x in corner.split(",")] for corner in
                   (row.get("vertices") or "").split(";") if corner.strip()]
        normal = [row.get(f"normal {axis}") or "0" for axis in "xyz"]
        if self.is_plane:
            normal = [normal[0], "0", normal[1]]
        normal = numpy.array([float(x) for x in normal])
        if self.is_plane and len(corners) == 2:
            (x, y), (u, v) = (corner[:2] for corner in corners)
            normal = numpy.array([y - v, 0., u - x])
        elif not self.is_plane and len(corners) >= 3:
            corners = numpy.array(corners)
            normal = numpy.cross(corners, numpy.roll(corners, -1, 0)).sum(0)
        size = numpy.linalg.norm(normal)
        if size == 0.:
            return None
        normal *= (1. if normal[2] >= 0. else -1.) / size
        return (math.degrees(math.acos(min(1., normal[2]))),
                math.degrees(math.atan2(normal[0], normal[1])) % 360.)
