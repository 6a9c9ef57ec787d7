#!/usr/bin/env python3
"""Tells how uncertain the safety factors of a scene are.

usage: contrib/factor_uncertainty.py SCENE.prm [--meshes 2] [--exact FACTOR]
         [--largest 0.05] [--keyblock build/keyblock] [--keep FOLDER]
         [-- arguments for keyblock]

Runs the scene as it is, with smaller cells, with half the time step
(Time stepping/Safety) and with half the damping of trials (Safety factor/Mass
damping and Damping ratio), and prints value, bracket and outcome of each block
and stage. Blocks of two meshes are the same if their centroids are near. Smaller
cells: half the size is asked for. Structured meshes get twice the cells, Gmsh
sizes half as large (Cells across blocks twice as many); cells of a mesh file, and
those of Gmsh where the scene gives no Size, are halved where they are. What was
reached is measured, by the mean size of the cells of each block, and told.

Mesh error: what the finest mesh is still off by. Two meshes cannot tell the order
p of convergence; with order 1 it is their difference over r - 1, where cells are r
times smaller. With --meshes 3 (a quarter of the size besides) the order is estimated
and kept between 0.5 and 2 if the differences have one sign; if not, the larger
difference counts. Of cells that are less than 1.7 times smaller the error is warned
of, of less than 1.2 times none is told. The value is that
of the finest mesh, not an extrapolated one (that is printed beside it), and its
uncertainty the sum of mesh error, half the width of the bracket, and the changes
with time step and damping, which are measured on the scene's own mesh. None of these
tells what a mesh does that gives the block another shape: where its volumes in the
variants, or that between its planes, differ by more than 1 %, or a run warns of moved
faces, that is said, and the interval holds the values of all variants.

Exits with 1 if a run fails, no factor is found, some runs give a block a value and
others do not, its cells are not 1.2 times smaller, the uncertainty of a block is
larger than --largest of the value, or --exact is not within it.
"""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from report.run_files import entries_of
from report.words import count
from script_tools import make_parser, split_arguments

LEAST_RATIO, GOOD_RATIO = 1.2, 1.7  # of cell sizes: to tell an error, without a warning
SAME_VOLUME = 0.01  # what volumes of a block may differ by
FINER = ("smaller cells", "smallest cells")
HALF_DAMPING = ("Safety factor/Mass damping", "Safety factor/Damping ratio")


def read_entries(path):
    """The entries of a used.prm by their path, as in Stages/dig/Kind."""
    return {name: value for name, value, _ in
            entries_of(path.read_text(encoding="utf-8"))}


def finer_mesh(entries, halvings):
    """Entries that are to make all cells 2^halvings times smaller."""
    times = 2 ** halvings
    generator = entries["Mesh/Generator"]
    if generator == "structured":
        cells = [int(n) for n in entries["Mesh/Cells"].split(",")]
        return {"Mesh/Cells": ", ".join(str(times * n) for n in cells)}
    # without a size Gmsh has one of its own; more cells across blocks is no more
    # than a wish, which coarse blocks alone would follow
    if generator == "file" or float(entries["Mesh/Size"]) == 0.:
        levels = entries.get("Mesh/Refinement levels", "").strip()
        return {"Mesh/Refinement levels": f"({levels or 0}) + {halvings}"}
    found = {}
    for name in ("Size", "Size at excavation", "Size at joints", "Least size"):
        size = float(entries[f"Mesh/{name}"])
        if size > 0.:
            found[f"Mesh/{name}"] = f"{size / times:.9g}"
    across = int(entries["Mesh/Cells across blocks"])
    if across > 0:
        found["Mesh/Cells across blocks"] = str(times * across)
    return found


class Runner:
    """Runs variants of one scene."""

    def __init__(self, options, folder, rest):
        self.options, self.folder, self.rest = options, folder, rest

    def run(self, name, changes):
        """Factors (block, its centroid, size, volumes, size of cells, stage entry)
        of a variant, and whether it warns of moved faces."""
        output = self.folder / name.replace(" ", "_")
        command = [str(Path(self.options.keyblock).resolve()), self.options.scene,
                   "--output", str(output), "--set", "Output/Write VTU=false"] + self.rest
        for entry, value in changes.items():
            command += ["--set", f"{entry}={value}"]
        result = subprocess.run(command, text=True, capture_output=True)
        if result.returncode != 0:
            said = (result.stderr.strip() or result.stdout.strip()).splitlines()[-1:]
            sys.exit(f"{name}: exit {result.returncode}: {' '.join(said)}")
        summary = json.loads((output / "summary.json").read_text())
        dim = summary["scene"]["dimension"]
        found = []
        for block in summary["blocks"]:
            place = [float(x) for x in block["centroid"]]
            size = float(block["volume"]) ** (1. / dim)
            volumes = [float(block[name]) for name in ("volume", "exact_volume")
                       if name in block]
            cell = size / int(block["cells"]) ** (1. / dim)
            for factor in block.get("safety_factor", []):
                found.append((int(block["id"]), place, size, volumes, cell, factor))
        print(f"{name}: {summary['scene']['cells']} cells, "
              f"{summary['run']['steps']} steps, {count(len(found), 'factor')}",
              flush=True)
        is_moved = any("has moved faces" in str(warning)
                       for warning in summary.get("warnings") or [])
        return output, found, is_moved


def partner(one, others):
    """Volumes, size of cells and the entry of the same block and stage in another
    run, or None, None, None."""
    _, place, size, *_, factor = one
    near = [other for other in others if other[5]["stage"] == factor["stage"]
            and math.dist(place, other[1]) < 0.25 * size
            and 0.5 < other[2] / size < 2.]
    return (min(near, key=lambda other: math.dist(place, other[1]))[3:] if near
            else (None, None, None))


def describe(factor):
    if factor is None:
        return "no such block"
    if factor["outcome"] != "value":
        return factor["outcome"]
    if not {"lower", "upper"} <= set(factor):
        return f"open bracket, from {float(factor.get('lower', 0.)):.5f}"
    undecided = ""
    if "undecided_upper" in factor:
        undecided = (f", undecided from {float(factor['undecided_lower']):.5f} to "
                     f"{float(factor['undecided_upper']):.5f}")
    return (f"{float(factor['value']):.5f} in [{float(factor['lower']):.5f}, "
            f"{float(factor['upper']):.5f}], {factor['outcome']}{undecided}")


def value_of(factor):
    """The factor; None where the block is immovable, falls freely or is clamped, or
    its bracket is open."""
    is_found = (factor and factor["outcome"] == "value"
                and {"lower", "upper"} <= set(factor))
    return float(factor["value"]) if is_found else None


def mesh_error(values, ratios):
    """Error of the last value, with what it was estimated by; values are those of
    meshes with cells that are each `ratios` times smaller than the one before."""
    last = values[-1] - values[-2]
    if len(values) == 2:
        return last / (ratios[0] - 1.), "order 1 assumed"
    first = values[-2] - values[-3]
    if first * last <= 0.:
        larger = max((first / (ratios[0] - 1.), last / (ratios[1] - 1.)), key=abs)
        return larger, "no order: the larger difference"

    def quotient(order):
        """First over last difference of an error that goes with size^order."""
        return (ratios[0] ** order - 1.) / (1. - ratios[1] ** -order)

    low, high = 0.5, 2.  # the quotient grows with the order
    for _ in range(60):
        order = 0.5 * (low + high)
        low, high = (order, high) if quotient(order) < first / last else (low, order)
    return last / (ratios[1] ** order - 1.), f"order {order:.2f}"


def are_smaller(ratios):
    """Print how much smaller the cells of a block got; whether that is enough."""
    print(f"  cells at the block   {', then '.join(f'{r:.2f}' for r in ratios)} times "
          "smaller")
    if min(ratios) < LEAST_RATIO:
        print("  too little to tell how large the mesh error is; set 'Mesh/Size' and "
              "'Mesh/Size at excavation' for cells that can be halved")
        return False
    if min(ratios) < GOOD_RATIO:
        print(f"  Warning: less than {GOOD_RATIO} times, the mesh error is uncertain")
    return True


def shapes_differ(partners, moved):
    """Print what the meshes of the runs make of a block; whether that matters."""
    volumes = [v for found in partners.values() for v in found[0]]
    spread = (max(volumes) - min(volumes)) / min(volumes)
    if spread > SAME_VOLUME:
        print(f"  Warning: the variants' blocks differ by {100. * spread:.2g} % in "
              "volume: the estimate says little; set 'Mesh/Snap' to 0 or smaller cells")
    elif moved:
        print(f"  Warning: the mesh has moved faces of blocks ({', '.join(moved)}): the "
              "estimate says little; set 'Mesh/Snap' to 0 or smaller cells")
    return spread > SAME_VOLUME or bool(moved)


def assess(one, runs, moved):
    """Print one block and stage. Returns value and uncertainty, or None and whether
    all runs say the same."""
    number, *_, factor = one
    print(f"\nBlock {number} after stage {factor['stage']}")
    partners = {name: partner(one, factors) for name, factors in runs.items()}
    found = {name: other for name, (*_, other) in partners.items()}
    for name, other in found.items():
        print(f"  {name:20} {describe(other)}")
    meshes = [name for name in runs if name == "as it is" or name in FINER]
    values = [value_of(found[name]) for name in meshes]
    if None in [value_of(other) for other in found.values()]:
        outcomes = {describe(other) for other in found.values()}
        is_same = len(outcomes) == 1
        print(f"  {'the same in all runs' if is_same else 'not the same in all runs'}")
        return None, is_same
    sizes = [partners[name][1] for name in meshes]
    ratios = [a / b for a, b in zip(sizes, sizes[1:])]
    if not are_smaller(ratios):
        return None, False
    error, way = mesh_error(values, ratios)
    finest = found[meshes[-1]]
    bracket = 0.5 * (float(finest["upper"]) - float(finest["lower"]))
    changes = [abs(value_of(found[name]) - values[0]) for name in ("half time step",
                                                                   "half damping")]
    value = values[-1]
    whole = abs(error) + bracket + sum(changes)
    if shapes_differ(partners, moved):
        whole = max(whole, *(abs(value_of(other) - value) + bracket
                             for other in found.values()))
    print(f"  mesh error           {error:+.5f} ({way}); extrapolated {value + error:.5f}")
    print(f"  half the bracket     {bracket:.5f}; time step {changes[0]:.5f}; "
          f"damping {changes[1]:.5f}")
    print(f"  factor               {value:.5f} +- {whole:.5f} ({100 * whole / value:.2f} %)")
    return value, whole


def main():
    arguments, rest = split_arguments()
    parser = make_parser(__doc__)
    parser.add_argument("scene")
    parser.add_argument("--meshes", type=int, default=2, choices=(2, 3))
    parser.add_argument("--exact", type=float)
    parser.add_argument("--largest", type=float, default=math.inf)
    parser.add_argument("--keep", default="")
    options = parser.parse_args(arguments)
    folder = Path(options.keep or tempfile.mkdtemp()).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    runner = Runner(options, folder, rest)
    output, base, is_moved = runner.run("as it is", {})
    if not base:
        sys.exit("No safety factor was found; see the entry 'Safety factor/Blocks'.")
    entries = read_entries(output / "used.prm")
    variants = {name: finer_mesh(entries, k) for k, name in
                enumerate(FINER[:options.meshes - 1], 1)}
    variants["half time step"] = {
        "Time stepping/Safety": f"{0.5 * float(entries['Time stepping/Safety']):.9g}"}
    variants["half damping"] = {name: f"{0.5 * float(entries[name]):.9g}"
                                for name in HALF_DAMPING}
    runs, moved = {"as it is": base}, ["as it is"] if is_moved else []
    for name, changes in variants.items():
        _, runs[name], is_moved = runner.run(name, changes)
        moved += [name] if is_moved else []
    is_good = True
    for one in base:
        value, whole = assess(one, runs, moved)
        if value is None:
            is_good = is_good and whole and options.exact is None
            continue
        if whole > options.largest * value:
            print(f"  more than {options.largest:g} of the value")
            is_good = False
        if options.exact is not None and abs(value - options.exact) > whole:
            print(f"  the exact factor {options.exact:.5f} is not within it")
            is_good = False
    sys.exit(0 if is_good else 1)


if __name__ == "__main__":
    main()
