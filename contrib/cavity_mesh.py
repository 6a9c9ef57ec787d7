#!/usr/bin/env python3
"""Writes the mesh of an octant of rock around a spherical cavity of radius 1.

usage: contrib/cavity_mesh.py FILE.ucd [--cells 8] [--layers 24] [--first 0.015] [--outer 5]

An octant of a sphere is three quadrilaterals that meet on its diagonal: each
has CELLS x CELLS cells, in LAYERS layers whose thickness grows geometrically from
FIRST at the wall, and which end at the radius OUTER. One more layer, material 1, lies inside the cavity and is what
is dug; the rock is material 0. The planes x = 0, y = 0 and z = 0 bound it.
"""
import argparse
import itertools
import math


def on_sphere(x, y):
    """Direction of the point (x, y, 1) of the cube's face, 0 <= x, y <= 1;
    angles, not tangents, are divided evenly."""
    p = (math.tan(x * math.pi / 4), math.tan(y * math.pi / 4), 1.)
    length = math.hypot(*p)
    return [c / length for c in p]


def radii_of_layers(n, first, outer):
    """Radii from 1 to OUTER, and one inside the cavity before them."""
    low, high = 1. + 1e-9, 10.
    for _ in range(100):  # growth of the thickness, by bisection
        growth = 0.5 * (low + high)
        if first * (growth ** n - 1.) / (growth - 1.) < outer - 1.:
            low = growth
        else:
            high = growth
    inner = [1. + first * (growth ** i - 1.) / (growth - 1.) for i in range(n)]
    return [1. - first] + inner + [outer]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--cells", type=int, default=8)
    parser.add_argument("--layers", type=int, default=24)
    parser.add_argument("--first", type=float, default=0.015)
    parser.add_argument("--outer", type=float, default=5.)
    options = parser.parse_args()
    n = options.cells
    radii = radii_of_layers(options.layers, options.first, options.outer)
    number, vertices, cells = {}, [], []

    def vertex(face, i, j, layer):
        direction = on_sphere(i / n, j / n)
        # cyclic permutations keep the orientation
        p = tuple(0. if abs(c) < 1e-12 else c * radii[layer]
                  for c in direction[face:] + direction[:face])
        key = tuple(round(c, 9) for c in p)
        if key not in number:
            vertices.append(p)
            number[key] = len(vertices)
        return number[key]

    for layer, face, j, i in itertools.product(range(len(radii) - 1), range(3),
                                               range(n), range(n)):
        ring = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
        cells.append((1 if layer == 0 else 0,
                      [vertex(face, a, b, layer + up) for up in (0, 1) for a, b in ring]))
    with open(options.file, "w", encoding="utf-8") as out:
        out.write(f"{len(vertices)} {len(cells)} 0 0 0\n")
        for k, p in enumerate(vertices):
            out.write(f"{k + 1} {p[0]:.8g} {p[1]:.8g} {p[2]:.8g}\n")
        for k, (material, corners) in enumerate(cells):
            out.write(f"{k + 1} {material} hex {' '.join(map(str, corners))}\n")


if __name__ == "__main__":
    main()
