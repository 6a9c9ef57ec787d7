# SPDX-License-Identifier: LGPL-2.1-or-later
"""Keyblock: do blocks of rock around a tunnel, a cavern or a slope stay in place?

    import keyblock

    scene = keyblock.Scene("first_tunnel.prm", overrides={"Mesh/Size": 2})
    blocks = keyblock.find_blocks(scene)
    for one in blocks.limit_equilibrium():
        print(one.block, one.stage, one.factor, one.mode)
    for stage in keyblock.Run(scene):
        print(stage.name, stage.max_displacement)

SI units; angles in degrees; stress is positive in tension. In 2D (plane strain)
forces are per metre. Nothing is printed unless `verbose=True`, and no file is
written unless `output` names a folder. Other threads go on while the program
computes; one computation runs at a time. The manual has a page about it.
"""
from ._core import (Block, Blocks, ComputationError, Error, Factor,
                    LimitEquilibrium, Progress, Run, Scene, Stage, Surface,
                    __version__, find_blocks, leaves_geometry, rank, size,
                    sum_over_ranks, validate)
from .sweeps import Sample, Sweep, sweep

__all__ = ["Block", "Blocks", "ComputationError", "Error", "Factor",
           "LimitEquilibrium", "Progress", "Run", "Sample", "Scene", "Stage",
           "Surface", "Sweep", "find_blocks", "leaves_geometry", "rank", "size",
           "sum_over_ranks", "sweep", "validate", "__version__"]

# as users know them, in messages and help()
for _name in __all__[:-1]:
    globals()[_name].__module__ = __name__
del _name
