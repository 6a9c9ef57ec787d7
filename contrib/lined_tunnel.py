#!/usr/bin/env python3
"""Liner of a circular tunnel in an elastic plane: thrust, moment and displacements.

usage: contrib/lined_tunnel.py VERTICAL RATIO E NU RADIUS E_LINER NU_LINER THICKNESS [--mesh FILE.ucd]

The liner is there before the rock is taken away, bonded to it, and lies on its
wall. Prints thrust and moment by a thin ring that stretches and turns, harmonic
by harmonic (exact for that ring), and by Einstein and Schwartz (1979), who count
stretch over radius as a part of the curvature; and what the rock moves by. With
--mesh writes a quarter of a slice of rock, the mesh of
prm/verification/lined_tunnel_3d.prm.
"""
import argparse
import itertools
import math


def einstein_schwartz(vertical, ratio, young, nu, radius, liner_young, liner_poisson, thickness):
    """Mean thrust [N/m], its part with cos(2 angle) [N/m], and the moment's [N]."""
    c = young * radius * (1 - liner_poisson**2) / (liner_young * thickness * (1 - nu**2))
    f = c * radius**2 * 12 / thickness**2
    a0 = c * f * (1 - nu) / (c + f + c * f * (1 - nu))
    beta = ((6 + f) * c * (1 - nu) + 2 * f * nu) / (3 * f + 3 * c + 2 * c * f * (1 - nu))
    b2 = c * (1 - nu) / (2 * (c * (1 - nu) + 4 * nu - 6 * beta - 3 * beta * c * (1 - nu)))
    a2 = beta * b2
    mean = 0.5 * vertical * radius * (1 + ratio) * (1 - a0)
    part = 0.5 * vertical * radius * (1 - ratio) * (1 + 2 * a2)
    moment = 0.25 * vertical * radius**2 * (1 - ratio) * (1 - 2 * a2 + 2 * b2)
    return mean, part, moment


class Ring:
    """A thin ring and the plane around it; angles from the horizontal."""

    def __init__(self, vertical, ratio, young, nu, radius, liner_young, liner_poisson, thickness):
        shear = young / 2 / (1 + nu)
        kappa = 3 - 4 * nu
        membrane = liner_young * thickness / (1 - liner_poisson**2)
        bending = membrane * thickness**2 / 12
        # the mean: the rock gives way to what the ring does not bear
        mean = 0.5 * vertical * (1 + ratio)
        pressure = mean / (2 * shear * radius / membrane + 1)
        self.closure = (mean - pressure) * radius**2 / (2 * shear)  # times 1 / r [m2]
        self.mean = pressure * radius
        # Airy's functions (a / r^2 + b) cos 2t, each with its displacements
        deviator = 0.5 * vertical * (1 - ratio)

        def missing(a, b):
            out = (2 * a / radius**3 + (kappa + 1) * b / radius) / (2 * shear)
            round_ = (2 * a / radius**3 - (kappa - 1) * b / radius) / (2 * shear)
            thrust = membrane * (2 * round_ + out) / radius
            moment = bending * 2 * (round_ + 2 * out) / radius**2
            normal = -6 * a / radius**4 - 4 * b / radius**2
            tangential = -6 * a / radius**4 - 2 * b / radius**2
            return (thrust / radius + 4 * moment / radius**2 - normal,
                    2 * thrust / radius + 2 * moment / radius**2 - tangential, thrust, moment)

        first, second = missing(1, 0), missing(0, 1)
        determinant = first[0] * second[1] - first[1] * second[0]
        self.a = deviator * (second[1] + second[0]) / determinant
        self.b = -deviator * (first[0] + first[1]) / determinant
        self.part, self.moment = (-missing(self.a, self.b)[2], missing(self.a, self.b)[3])
        self.out = (self.a / shear, (kappa + 1) * self.b / (2 * shear))
        self.round = (self.a / shear, -(kappa - 1) * self.b / (2 * shear))


def write_mesh(file, radius, cells=20, layers=13, slices=2, first=0.15, outer=10., height=0.3):
    """A quarter around the y axis; the innermost layer is material 1."""
    low, high = 1. + 1e-9, 10.
    for _ in range(100):  # growth of the thickness, by bisection
        growth = 0.5 * (low + high)
        if first * (growth ** layers - 1.) / (growth - 1.) < outer - 1.:
            low = growth
        else:
            high = growth
    radii = [1. - first] + [1. + first * (growth ** i - 1.) / (growth - 1.)
                            for i in range(layers)] + [outer]
    index = {key: i + 1 for i, key in enumerate(itertools.product(
        range(slices + 1), range(layers + 2), range(cells + 1)))}
    with open(file, "w", encoding="utf-8") as out:
        out.write(f"{len(index)} {slices * (layers + 1) * cells} 0 0 0\n")
        for (k, j, i), number in index.items():
            angle = 0.5 * math.pi * i / cells
            x, z = (radius * radii[j] * f for f in (math.cos(angle), math.sin(angle)))
            out.write(f"{number} {abs(round(x, 9)):.9g} {height * k:.9g} {abs(round(z, 9)):.9g}\n")
        number = 0
        for k, j, i in itertools.product(range(slices), range(layers + 1), range(cells)):
            number += 1
            ring = ((j, i), (j, i + 1), (j + 1, i + 1), (j + 1, i))
            corners = [index[(k + up, a, b)] for up in (0, 1) for a, b in ring]
            out.write(f"{number} {1 if j == 0 else 0} hex {' '.join(map(str, corners))}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("values", type=float, nargs=8)
    parser.add_argument("--mesh")
    options = parser.parse_args()
    ring = Ring(*options.values)
    mean, part, moment = einstein_schwartz(*options.values)
    for name, values in (("ring", (ring.mean, ring.part, ring.moment)),
                         ("Einstein and Schwartz", (mean, part, moment))):
        print(f"{name}: thrust at the sides {values[0] + values[1]:.6g} N/m, at roof and floor "
              f"{values[0] - values[1]:.6g} N/m, moment {values[2]:.6g} N")
    print(f"displacement outward at r: -{ring.closure:.10g} / r + ({ring.out[0]:.10g} / r^3 + "
          f"{ring.out[1]:.10g} / r) cos 2t,\nround: ({ring.round[0]:.10g} / r^3 + "
          f"{ring.round[1]:.10g} / r) sin 2t")
    if options.mesh:
        write_mesh(options.mesh, options.values[4])


if __name__ == "__main__":
    main()
