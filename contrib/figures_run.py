# SPDX-License-Identifier: LGPL-2.1-or-later
"""What figures.py needs to know of a run: its files, read and arranged."""
import json
import math
import pathlib
import sys

import numpy

from render_data import (magnitudes_of, read_grid, values_of,
                         vtk_to_numpy)
from report.reading import read_joints
from report.run_files import groups_of, last_states, states_of
from report.tables import least, size_of


def fail(sentence):
    """End the program with a sentence and exit code 1."""
    sys.exit(f"figures.py: {sentence}")


def read_summary(folder):
    """The content of summary.json."""
    path = folder / "summary.json"
    try:
        with open(path, encoding="utf-8") as file:
            summary = json.load(file)
    except OSError as error:
        fail(f"'{path}' cannot be read ({error.strerror}); name the output "
             "folder of a run that has ended.")
    except ValueError as error:
        fail(f"'{path}' is damaged ({error}); run the scene again.")
    needed = {"scene", "blocks", "stages"}
    if not isinstance(summary, dict) or not needed <= set(summary):
        fail(f"'{path}' lacks one of {', '.join(sorted(needed))}; is it that "
             "of a run of keyblock?")
    return summary


def read_entries(folder):
    """The entries of used.prm by their path, as in Stages/dig/Kind."""
    path = folder / "used.prm"
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        fail(f"'{path}' cannot be read: {error}.")
    entries, above = {}, []
    for line in lines:
        words = line.partition("#")[0].split(maxsplit=1)
        if words[:1] == ["subsection"]:
            above.append(words[1].strip())
        elif words == ["end"]:
            above.pop()
        elif words[:1] == ["set"] and "=" in words[1]:
            name, value = words[1].split("=", 1)
            entries["/".join([*above, name.strip()])] = value.strip()
    return entries


def read_history(folder):
    """The columns of history.csv by their names without units; or {}."""
    path = folder / "history.csv"
    if not path.exists():
        return {}
    try:
        with open(path, encoding="utf-8") as file:
            names = [name.split(" [")[0] for name in
                     file.readline().strip().split(",")]
            lines = file.readlines()
        values = numpy.loadtxt(lines, delimiter=",", ndmin=2) if lines else []
    except OSError as error:
        fail(f"'{path}' cannot be read: {error.strerror}.")
    except ValueError:
        fail(f"'{path}' is damaged: its lines are not all of numbers, as many "
             "in each; run the scene again.")
    if not lines:
        return {}
    if len(names) != values.shape[1] or not {"stage", "step",
                                             "time"} <= set(names):
        fail(f"'{path}' is not a history of keyblock: {len(names)} names in "
             f"its first line, {values.shape[1]} columns below.")
    return dict(zip(names, values.T))


def read_states(folder):
    """Time, file of the rock and file of the joints of each state; or []."""
    path = folder / "solution.pvd"
    if not path.exists():
        return []
    try:
        return states_of(path)
    except ValueError as error:
        fail(str(error))


class Run:
    """The results in the output folder of one run."""

    def __init__(self, folder, label=""):
        """Read everything but the states, which are read when drawn."""
        self.folder = pathlib.Path(folder)
        self.summary = read_summary(self.folder)
        self.entries = read_entries(self.folder)
        self.history = read_history(self.folder)
        self.states = read_states(self.folder)
        self.last_states = last_states(self.folder / "solution.pvd")
        self.label = label or self.folder.resolve().name
        self.stages = [stage["name"] for stage in self.summary["stages"]]
        self.blocks = {b["id"]: b for b in self.summary["blocks"]}
        self.joint_rows = read_joints(self.folder)
        self.groups, self.group = groups_of(self.joint_rows)
        self.is_plane = self.summary["scene"].get("dimension") == 2

    def names(self, section):
        """The names listed in a section of the scene, as in Joints."""
        words = self.entries.get(f"{section}/Names", "").split(",")
        return [word.strip() for word in words if word.strip()]

    def numbers(self, entry):
        """The numbers of an entry such as 1, 2; [] if they are formulas."""
        words = self.entries.get(entry, "").replace(";", ",").split(",")
        try:
            return [float(word) for word in words if word.strip()]
        except ValueError:
            return []

    def takes_steps(self):
        """Whether the run moves anything, and not only judges blocks."""
        return self.entries.get("Safety factor/Method") != "limit equilibrium"

    def finite_blocks(self):
        """The numbers of the blocks that could move, in order."""
        return [number for number, block in sorted(self.blocks.items())
                if not {"infinite", "rigid"} & set(block.get("class", []))]

    def exposed_blocks(self):
        """The finite blocks that are exposed or taken away, the most dangerous
        first: those taken away, then by the least factor, then by size."""
        def danger(number):
            block = self.blocks[number]
            worst = least(block.get("safety_factor", [])) or least(
                block.get("limit_equilibrium", []))
            return ("removed_in_stage" not in block,
                    size_of(worst) if worst else math.inf,
                    -block.get("volume", 0.))

        return sorted((n for n in self.finite_blocks()
                       if {"exposed_stage", "removed_in_stage"} & set(
                           self.blocks[n])), key=danger)

    def named_blocks(self, most=30):
        """The finite blocks that have numbers and colours of their own.

        Of many those that are exposed, the most dangerous first."""
        finite = self.finite_blocks()
        return finite if len(finite) <= 12 else self.exposed_blocks()[:most]

    def group_of(self, name):
        """The number of the group of a joint, by its set or name."""
        names = [row.get("name") for row in self.joint_rows]
        return self.group[names.index(name)] if name in names else 0

    def group_name(self, name):
        """The name of the group of a joint; its own without joints.csv."""
        return self.groups[self.group_of(name)] if self.groups else name

    def removal_stage(self, number):
        """Index of the stage in which a block was taken away, or None."""
        name = self.blocks[number].get("removed_in_stage")
        return self.stages.index(name) if name in self.stages else None

    def monitors(self, kind):
        """The names of the monitors of a kind."""
        return [name for name in self.names("Monitors")
                if self.entries.get(f"Monitors/{name}/Kind") == kind]

    def stage_ends(self, column):
        """Value of a column of the history at the end of each stage."""
        stage = self.history["stage"]
        return [self.history[column][stage <= k][-1]
                if (stage <= k).any() else 0. for k in range(len(self.stages))]

    def axis_kind(self):
        """What curves are drawn over: time of motion, stages or steps."""
        kinds = {self.entries.get(f"Stages/{name}/Kind")
                 for name in self.stages}
        if kinds <= {"dynamic"}:
            return "time"
        return "stage" if len(self.stages) > 1 else "step"

    def positions(self, kind):
        """Where the lines of the history stand on an axis of a kind.

        On that of stages the steps of stage k, from 0, lie between k and
        k + 1."""
        if kind != "stage":
            return self.history[kind]
        stage = self.history["stage"].astype(int)
        ends = numpy.array([0., *self.stage_ends("step")])
        steps = numpy.maximum(ends[1:] - ends[:-1], 1.)
        return stage + (self.history["step"] - ends[stage]) / steps[stage]

    def state_of_stage(self, index):
        """Index of the state that was written at the end of a stage.

        By the stage's name; by time in files of old that do not have it."""
        if self.stages[index] in self.last_states:
            return self.last_states[self.stages[index]]
        if not self.history:
            return len(self.states) - 1
        end = self.stage_ends("time")[index]
        times = numpy.array([time for time, _, _ in self.states])
        return int(abs(times - end).argmin())

    def rock(self, index):
        """The rock of a state as a VTK grid."""
        return read_grid(self.states[index][1])

    def joints(self, index):
        """Faces of a state: end points (n, 2, 3), fields (n, 2) by name."""
        grid = read_grid(self.states[index][2])
        order = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
        points = vtk_to_numpy(grid.GetPoints().GetData())[order]
        fields = {name: magnitudes_of(grid, name)[order].reshape(-1, 2)
                  for name in ("state", "slip", "shear", "joint")}
        for name in ("gap", "pressure"):
            fields[name] = values_of(grid, name)[order].reshape(-1, 2)
        return points.reshape(-1, 2, 3), fields

    def block_at(self, monitor):
        """The number of the block that a block monitor watches.

        The one of the entry Block, or, as in the program, that of the cell whose
        centre is nearest to the Location."""
        number = self.numbers(f"Monitors/{monitor}/Block")
        if number and number[0] > 0.:
            return int(number[0])
        location = self.numbers(f"Monitors/{monitor}/Location")
        if not self.states or len(location) < 2:
            return None
        grid = self.rock(0)
        n = 4 if self.is_plane else 8
        block = values_of(grid, "block")[::n]
        centres = vtk_to_numpy(grid.GetPoints().GetData())
        centres = centres.reshape(-1, n, 3).mean(axis=1)
        location = numpy.array([*location, 0.])[:3]
        far = numpy.linalg.norm(centres - location, axis=1)
        far[block == 0] = numpy.inf  # belongs to no block
        return int(block[far.argmin()])
