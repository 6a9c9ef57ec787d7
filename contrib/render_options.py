# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a picture of render.py shows and how: the options of its command line."""
import argparse
import dataclasses
import pathlib

BLOCK_COLOURS = [(0.90, 0.89, 0.84), (0.55, 0.74, 0.86), (0.96, 0.74, 0.47),
                 (0.64, 0.80, 0.55), (0.90, 0.58, 0.55), (0.77, 0.69, 0.87),
                 (0.97, 0.89, 0.52), (0.55, 0.80, 0.76), (0.80, 0.66, 0.53),
                 (0.94, 0.72, 0.83), (0.72, 0.75, 0.78)]
RED, DARK = (0.75, 0.15, 0.1), (0.15, 0.15, 0.15)
PARTS = ("rock", "blocks", "tunnel", "joints")


@dataclasses.dataclass
class View:
    """What a picture shows and how; the options of the command line."""

    time_index: int = -1
    field: str = "displacement"
    exaggeration: float = 1.  # 0: automatic
    size: tuple = (1000, 800)
    dpi: float = 100.
    box: tuple = ()
    tilt: float = 0.
    stretch: float = 1.
    explode: float = 0.
    mesh: str = "auto"
    eye: tuple = (-1., -1.6, 1.)  # direction in which the viewer is (3D)
    block_colours: tuple = tuple(BLOCK_COLOURS)  # of block 1, 2, ...
    parts: tuple = ("rock",)
    cut: tuple = ()  # axes and places of planes
    inside: bool = False

    def has_depth(self):
        """Whether more than the outside of the rock is seen."""
        return bool(self.cut) or self.inside or self.parts != ("rock",)

    def has_side(self):
        """Whether a colour bar or a legend stands beside the picture."""
        return self.field != "block" or "joints" in self.parts

    def in_pixels(self):
        """The view with its size at its resolution."""
        factor = self.dpi / 100.
        return dataclasses.replace(self, size=tuple(
            factor * n for n in self.size))


def numbers(text):
    """The numbers of an option such as 480,400."""
    return tuple(float(word) for word in text.split(","))


def names(text):
    """The parts of an option such as blocks,tunnel."""
    found = tuple(word.strip() for word in text.split(","))
    if not set(found) <= set(PARTS):
        raise ValueError
    return found


def planes(text):
    """Axes and places of an option such as x=0,y."""
    found = []
    for word in text.split(","):
        axis, _, place = word.strip().partition("=")
        if axis not in ("x", "y", "z"):
            raise ValueError
        found.append((axis, float(place) if place else None))
    return tuple(found)


def read_arguments(description):
    """The command line: collection, picture and view."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("collection", help="solution.pvd of a run")
    parser.add_argument("picture", help="PNG, PDF or SVG file to write")
    parser.add_argument("--time-index", type=int, default=-1,
                        help="0: first; -1: last (default)")
    parser.add_argument("--field", default="displacement",
                        help="a field of the output, or its component x, y or "
                        "z, as in velocity_x; block: one colour for each; "
                        "stress_major, stress_minor; joint_state")
    parser.add_argument("--exaggeration", type=float, default=1.,
                        help="factor of the displacement (default 1; 0: such "
                        "that the largest is 6 %% of the size of what is shown, "
                        "at most 1000)")
    parser.add_argument("--size", type=numbers, default=(1000, 800),
                        help="greatest width and height in pixels, at 100 dpi")
    parser.add_argument("--dpi", type=float, default=100.,
                        help="pixels per inch (default 100): 300 has three "
                        "times as many")
    parser.add_argument("--box", type=numbers, default=(),
                        help="least, then greatest coordinates to show")
    parser.add_argument("--tilt", type=float, default=0.,
                        help="turn the picture clockwise [degrees]")
    parser.add_argument("--stretch", type=float, default=1.,
                        help="factor of all heights (y)")
    parser.add_argument("--explode", type=float, default=0.,
                        help="move each block away from the middle by this "
                        "share of its distance")
    parser.add_argument("--mesh", default="auto",
                        choices=("auto", "on", "off"), help="edges of cells "
                        "(auto: if ten pixels long, and not of blocks)")
    parser.add_argument("--eye", type=numbers, default=View.eye,
                        help="direction in which the viewer is (3D)")
    parser.add_argument("--parts", type=names, default=View.parts,
                        help="what to show in 3D: some of rock, blocks (finite "
                        "ones), tunnel (surface of what is dug), joints")
    parser.add_argument("--cut", type=planes, default=(),
                        help="planes that cut the rock open, as in x=0 or x,y "
                        "(in the middle); what all leave towards the viewer "
                        "goes (3D)")
    parser.add_argument("--inside", action="store_true",
                        help="look along what is dug from one of its ends (3D)")
    options = vars(parser.parse_args())
    for name, counts in (("size", (2,)), ("box", (0, 4, 6)), ("eye", (3,))):
        if len(options[name]) not in counts:
            parser.error(f"--{name} takes {' or '.join(map(str, counts[-2:]))}"
                         f" numbers, not {len(options[name])}.")
    if not 10. <= options["dpi"] <= 2400.:
        parser.error("--dpi takes a number from 10 to 2400.")
    if pathlib.Path(options["picture"]).suffix not in (".png", ".pdf", ".svg"):
        parser.error("the picture's name ends with .png, .pdf or .svg.")
    collection, picture = options.pop("collection"), options.pop("picture")
    return collection, picture, View(**options)
