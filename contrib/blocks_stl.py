#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finite blocks of a run in 3D as closed surfaces, one STL file for each.

usage: contrib/blocks_stl.py OUTPUT FOLDER [--state I] [--exposed]

OUTPUT is the output folder of a run with VTU files. Writes FOLDER/block_N.stl,
binary, in metres, of block N as the mesh has it before it moves, or, with
--state, displaced as in a state of solution.pvd (0: first, -1: last). Cells that
share corners share faces; what is left are triangles, each of whose edges is one
of two triangles, outward normals by the right hand. Needs python3-numpy.
"""
import argparse
import pathlib
import sys

try:
    import numpy
    from report.geometry import FACES
    from report.reading import ReportError, Run, read_states
    from report.vtu import read_cells
except ImportError as error:
    sys.exit(f"blocks_stl.py: numpy cannot be loaded ({error}); install the "
             "package python3-numpy and use the system's Python, "
             "/usr/bin/python3.")


def fail(sentence):
    """End the program with a sentence and exit code 1."""
    sys.exit(f"blocks_stl.py: {sentence}")


def read_arguments():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.error = lambda message: fail(f"{message}; see --help.")
    parser.add_argument("output", metavar="OUTPUT",
                        help="output folder of a run in 3D")
    parser.add_argument("folder", metavar="FOLDER", help="where the files go; "
                        "made if it is not there")
    parser.add_argument("--state", type=int, metavar="I", help="displaced as "
                        "in this state (default: before any motion)")
    parser.add_argument("--exposed", action="store_true",
                        help="exposed blocks only")
    return parser.parse_args()


def surface(corners):
    """Triangles (n, 3, 3) around cells (m, 8, 3) that share corners.

    A quadrilateral is cut along the diagonal from its corner with the least
    number, so that two cells cut the one they share alike."""
    places, number = numpy.unique(corners.reshape(-1, 3) + 0., axis=0,
                                  return_inverse=True)
    quads = number.reshape(len(corners), 8)[:, numpy.array(FACES[8])]
    quads = quads.reshape(-1, 4)
    _, first, counts = numpy.unique(numpy.sort(quads, axis=1), axis=0,
                                    return_index=True, return_counts=True)
    quads = quads[numpy.sort(first[counts == 1])]
    turn = quads.argmin(axis=1)[:, None] + numpy.arange(4)
    quads = numpy.take_along_axis(quads, turn % 4, axis=1)
    triangles = numpy.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return places[triangles]


def write_stl(path, triangles, number):
    """Write triangles to a binary STL file."""
    kind = numpy.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)),
                        ("rest", "<u2")])
    normals = numpy.cross(triangles[:, 1] - triangles[:, 0],
                          triangles[:, 2] - triangles[:, 0]).astype(float)
    size = numpy.linalg.norm(normals, axis=1)[:, None]
    rows = numpy.zeros(len(triangles), kind)
    rows["normal"] = normals / numpy.where(size > 0., size, 1.)
    rows["corners"] = triangles
    head = f"keyblock: block {number}, metres".encode().ljust(80)
    try:
        path.write_bytes(head + numpy.uint32(len(rows)).tobytes()
                         + rows.tobytes())
    except OSError as error:
        fail(f"'{path}' cannot be written: {error.strerror}.")


def read_state(run, state):
    """Corners, block and displacements of the cells of a state."""
    states = read_states(run.folder)
    if not states:
        fail(f"'{run.folder}' has no solution.pvd; set Output/Write VTU = true "
             "and run again.")
    if not -len(states) <= (state or 0) < len(states):
        fail(f"there is no state {state}; the run wrote {len(states)}.")
    corners, fields = read_cells(states[state or 0][1],
                                 ["block", "displacement"])
    if not len(corners):
        fail("the state has no cells.")
    block = numpy.rint(fields["block"][:, 0]).astype(int)
    return corners, block, fields["displacement"]


def main():
    """Read a state, write the blocks."""
    arguments = read_arguments()
    try:
        run = Run(arguments.output)
        if run.is_plane:
            fail("the run is of a plane scene; only blocks in 3D have closed "
                 "surfaces.")
        corners, block, moved = read_state(run, arguments.state)
    except ReportError as error:
        fail(str(error))
    if arguments.state is not None:
        corners = corners + moved
    numbers = [n for n in run.finite_blocks() if not arguments.exposed
               or "exposed_stage" in run.blocks[n]]
    folder = pathlib.Path(arguments.folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        fail(f"the folder '{folder}' cannot be made: {error.strerror}.")
    for number in numbers:
        mine = block == number
        if not mine.any():
            print(f"block {number} is not there in this state")
            continue
        triangles = surface(corners[mine])
        path = folder / f"block_{number}.stl"
        write_stl(path, triangles, number)
        print(f"{path}  {len(triangles)} triangles")
    if not numbers:
        print("the run has no finite blocks")


if __name__ == "__main__":
    main()
