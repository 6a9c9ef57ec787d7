#!/usr/bin/env python3
"""Compares the blocks of meshes of random joint networks with those between the planes.

usage: PYTHONPATH=build/python contrib/network_blocks.py [--kinds traces,discs,planes]
         [--numbers 20,50] [--seeds 1-5]

The networks are those of contrib/networks.py. Of each kind and number the table has the
exposed blocks between the planes, how many of them the mesh lacks or has with another
volume (2 %), the same of those of at least two cells of the size at the excavation, and
the finite blocks of the mesh that are none between the planes. Exits with 1 if a network
cannot be meshed.
"""
import math
import os
import sys
import tempfile
from pathlib import Path

import keyblock
from networks import KINDS_IN_2D, NUMBERS, SIZE_AT_EXCAVATION, scene
from script_tools import make_parser, numbers, split_arguments

DIFFERENCE = 0.02


def compare(kind, n, seed):
    """Exposed, wrong, large, large and wrong, and finite blocks of the mesh alone."""
    name = f"{kind}_{n}_{seed}.prm"
    Path(name).write_text(scene(kind, n, seed, Path.cwd()), encoding="utf-8")
    dim = 2 if kind in KINDS_IN_2D else 3
    counts = [0] * 5
    for block in keyblock.find_blocks(keyblock.Scene(name)):
        if block.infinite:
            continue
        if math.isnan(block.exact_volume):
            counts[4] += 1
        elif block.classes[-1] == "exposed":
            wrong = (block.cells == 0
                     or abs(block.volume / block.exact_volume - 1.) > DIFFERENCE)
            large = block.exact_volume >= 2. * SIZE_AT_EXCAVATION[dim]**dim
            for i, counted in enumerate((True, wrong, large, large and wrong)):
                counts[i] += counted
    return counts


def main():
    """Print the table."""
    arguments, _ = split_arguments()
    parser = make_parser(__doc__)
    parser.add_argument("--kinds", default="traces,discs,planes")
    parser.add_argument("--numbers", type=numbers)
    parser.add_argument("--seeds", default="1-5", type=numbers)
    options = parser.parse_args(arguments)
    os.chdir(tempfile.mkdtemp())
    n_failures = 0
    print("kind     joints  networks  exposed  wrong  large  wrong  of the mesh alone")
    for kind in options.kinds.split(","):
        for n in options.numbers or NUMBERS[kind]:
            sums = [0] * 5
            for seed in options.seeds:
                try:
                    sums = [a + b for a, b in zip(sums, compare(kind, n, seed))]
                except keyblock.Error as error:
                    n_failures += 1
                    print(f"  {kind} {n} seed {seed}: {error}", flush=True)
            print(f"{kind:8} {n:6} {len(options.seeds):9} {sums[0]:8} {sums[1]:6} "
                  f"{sums[2]:6} {sums[3]:6} {sums[4]:18}", flush=True)
    return 1 if n_failures else 0


if __name__ == "__main__":
    sys.exit(main())
