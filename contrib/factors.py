#!/usr/bin/env python3
"""Finds safety factors of random blocks whose exact factors are known.

usage: contrib/factors.py [--kinds incline,incline_3d,water,wedge,wedging,bolted_...]
         [--seeds 1-20] [--exact] [--tolerance 0] [--statics] [--keyblock build/keyblock] [--keep FOLDER]
         [-- arguments for keyblock]

incline, incline_3d: a block slides on a plane through a square (box) of random
dip, place and friction: tan(friction) / tan(dip). The plane is given twice,
1 um apart, and crossed by three short strong joints at a few degrees, so that it
has to be cut into the mesh, which bends it; with --exact it stands alone.
water: a block before a tension crack, water in crack and plane. wedge: a
tetrahedron on two planes with friction and cohesion, Poisson ratio 0; wedging: the
same with 0.25, which locks stress across the line of sliding, so that statics is
a little low. bolted_active, bolted_passive: a block on a plane with bolts at random
angles; bolted_roof: one that hangs on them.

A trial that holds at 1.005 of the exact factor or above, or fails at 0.995 or
below, is wrong; undecided ones are counted. Exits with 1 if an exact factor lies
outside its bracket by more than --tolerance of it, there is more than one block
(but for lenses below 5 % of it between bent planes), limit equilibrium of a bolted
block is off, a trial is wrong, or a run fails. --statics: nothing is run, limit
equilibrium as --validate prints it is compared instead.
"""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from bolted_scenes import KINDS as BOLTED_KINDS
from factor_scenes import KINDS
from script_tools import make_parser, numbers, split_arguments
from statics_table import read_statics, read_volumes


# of the block that slides: what coincident planes that are bent may have between them
LARGEST_LENS = 0.05


def are_one_and_lenses(volumes):
    """Whether there is one block, first, and besides only lenses."""
    return bool(volumes) and all(v < LARGEST_LENS * volumes[0] for v in volumes[1:])


def main():
    arguments, rest = split_arguments()
    parser = make_parser(__doc__)
    parser.add_argument("--kinds", default="incline,incline_3d,water,wedge")
    parser.add_argument("--seeds", default="1-20", type=numbers)
    parser.add_argument("--exact", action="store_true")
    parser.add_argument("--tolerance", type=float, default=0.)
    parser.add_argument("--statics", action="store_true")
    parser.add_argument("--keep", default="")
    options = parser.parse_args(arguments)
    folder = Path(options.keep or tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    program = str(Path(options.keyblock).resolve())
    n_failures = n_trials = n_undecided = n_wrong = 0
    for kind in options.kinds.split(","):
        for seed in options.seeds:
            text, factor = {**KINDS, **BOLTED_KINDS}[kind](seed, options.exact)
            name = f"{kind}_{seed}"
            (folder / f"{name}.prm").write_text(text)
            what = ["--validate"] if options.statics else ["--output", name]
            result = subprocess.run([program, f"{name}.prm"] + what + rest,
                                    cwd=folder, text=True, capture_output=True)
            if result.returncode != 0:
                last_line = (result.stderr.strip() or result.stdout.strip()).splitlines()[-1:]
                print(f"{kind} seed {seed}: exit {result.returncode}: {last_line}", flush=True)
                n_failures += 1
                continue
            if options.statics:
                rows = read_statics(result.stdout)
                found = [row.factor for row in rows]
                sizes = read_volumes(result.stdout)
                is_good = (are_one_and_lenses([sizes[row.block] for row in rows])
                           and abs(found[0] / factor - 1.) <= options.tolerance)
                n_failures += not is_good
                print(f"{kind} seed {seed}: exact {factor:.5f}, limit equilibrium {found}"
                      f"{'' if is_good else '  <-- wrong'}", flush=True)
                continue
            summary = json.loads((folder / name / "summary.json").read_text())
            judged = [block for block in summary["blocks"] if "safety_factor" in block]
            found = [f for block in judged for f in block["safety_factor"]]
            if not are_one_and_lenses([block["volume"] for block in judged]):
                print(f"{kind} seed {seed}: {len(judged)} blocks, not one and lenses",
                      flush=True)
                n_failures += 1
                continue
            lower, upper = found[0].get("lower", 0.), found[0].get("upper", math.inf)
            for trial in found[0]["trials"]:
                n_trials += 1
                n_undecided += trial["undecided"]
                is_wrong = (trial["stable"] and trial["factor"] >= 1.005 * factor
                            or not trial["stable"] and not trial["undecided"]
                            and trial["factor"] <= 0.995 * factor)
                n_wrong += is_wrong
                if is_wrong:
                    print(f"{kind} seed {seed}: {'holds' if trial['stable'] else 'fails'} at "
                          f"{trial['factor'] / factor:.5f} of the exact factor", flush=True)
            off = max(lower - factor, factor - upper, 0.) / factor
            is_good = off <= options.tolerance
            if kind in BOLTED_KINDS:
                limit = summary["blocks"][0]["limit_equilibrium"][-1]["value"]
                is_good = is_good and abs(limit / factor - 1.) < 1e-5
            n_failures += not is_good
            way = summary.get("mesh", {}).get("largest_shift_in_cells", 0.)
            print(f"{kind} seed {seed}: exact {factor:.5f} in [{lower:.5f}, {upper:.5f}], off by "
                  f"{100 * off:.3f} %; joints moved by {way:.2g} cells"
                  f"{'' if is_good else '  <-- wrong'}", flush=True)
    if not options.statics:
        print(f"{n_trials} trials: {n_wrong} wrong by more than 0.5 %, {n_undecided} undecided")
    sys.exit(1 if n_failures or n_wrong else 0)


if __name__ == "__main__":
    main()
