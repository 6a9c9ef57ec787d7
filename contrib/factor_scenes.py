"""Scenes of random blocks whose exact safety factors are known, for factors.py.

Each kind is a function of a seed that gives the text of a scene and its exact
factor.
"""
import math
import random

GRAVITY, WATER = 9.81, 9810.


def incline(seed, dim, is_exact):
    """The text of a scene and the exact factor."""
    rng = random.Random(f"incline {dim} {seed}")
    dip = rng.uniform(15, 50)
    factor = rng.uniform(1.05, 2.2)
    friction = math.degrees(math.atan(factor * math.tan(math.radians(dip))))
    foot = rng.uniform(1.5, 6.)
    turn = rng.uniform(-20, 20) if dim == 3 else 0.  # of the dip direction
    size = rng.uniform(0.4, 0.9) if dim == 2 else rng.uniform(0.8, 1.2)
    a, t = math.radians(dip), math.radians(turn)
    normal = [math.sin(a) * math.cos(t), math.sin(a) * math.sin(t), math.cos(a)]
    if dim == 2:
        normal = [math.sin(a), math.cos(a)]
    end = [10., 2., foot] if dim == 3 else [10., foot]
    edge = 2.6 * size if dim == 2 else 3. * size

    def joint(name, place, normal, friction, more=""):
        return (f"  subsection {name}\n    set Point = {', '.join(f'{x:.9g}' for x in place)}\n"
                f"    set Normal = {', '.join(f'{n:.12g}' for n in normal)}\n"
                f"    set Friction angle = {friction:.10g}\n{more}  end\n")

    def plane(name, shift):
        return joint(name, end[:-1] + [foot + shift], normal, friction)

    def crossing(i):
        """A short joint near the plane that no other one meets."""
        bend = math.radians(rng.choice([-1, 1]) * rng.uniform(3, 12))
        length = min(10., (10. - foot) / math.tan(a))
        x = length * (1 + i) / 4
        up = x * math.tan(a) + rng.uniform(-0.3, 0.3) * edge
        place = [10. - x * math.cos(t), 2. - x * math.sin(t), foot + up]
        n = [math.sin(a + bend) * math.cos(t), math.sin(a + bend) * math.sin(t),
             math.cos(a + bend)]
        if dim == 2:
            place, n = [10. - x, foot + up], [math.sin(a + bend), math.cos(a + bend)]
        return joint(f"strong {i}", place, n, 80.,
                     f"    set Extent = disc\n    set Radius = {0.1 * length:.4g}\n"
                     "    set Cohesion = 1e9\n    set Tensile strength = 1e8\n"
                     "    set Residual cohesion = 1e9\n")

    zeros = ["0"] * (dim - 1)
    names = "plane" if is_exact else "plane, again, strong 0, strong 1, strong 2"
    joints = plane("plane", 0.)
    if not is_exact:
        joints += plane("again", 1e-6) + "".join(crossing(i) for i in range(3))
    text = f"""set Dimension = {dim}
set Title = Incline of {dip:.4g} degrees, exact factor {factor:.6g}
subsection Domain
  set Size = {'10, 10' if dim == 2 else '10, 4, 10'}
  set Truncated boundaries = bottom
end
subsection Mesh
  set Generator = gmsh
  set Size = {size:.4g}
end
subsection Joints
  set Names = {names}
{joints}end
subsection Materials
  set Names = rock
  subsection rock
    set Young modulus = 10e9
    set Poisson ratio = 0.25
    set Density = 2500
  end
end
subsection Initial state
  set Gravity = {'; '.join(zeros + ['-9.81'])}
  set Equilibrium = static
end
subsection Supports
  set Names = bottom
  subsection bottom
    set Boundaries = bottom
  end
end
subsection Stages
  set Names = rest
  subsection rest
    set Kind = quasi-static
    set Unbalanced ratio = 1e-5
  end
end
subsection Safety factor
  set Blocks = all
  set Bracket = 0.001
end
subsection Output
  set Write VTU = false
end
"""
    return text, factor


def numbers(values):
    return ", ".join(f"{value:.12g}" for value in values)


def joint_entries(name, vertices, friction, cohesion, pressure=""):
    """A joint through two points (2D) or three (3D)."""
    if len(vertices) == 2:
        (x0, y0), (x1, y1) = vertices
        normal = (y0 - y1, x1 - x0)
    else:
        u, v = (([b - a for a, b in zip(vertices[0], w)]) for w in vertices[1:])
        normal = cross(u, v)
    length = math.sqrt(dot(normal, normal))
    return (f"  subsection {name}\n    set Point = {numbers(vertices[0])}\n"
            f"    set Normal = {numbers(n / length for n in normal)}\n"
            f"    set Friction angle = {friction:.12g}\n    set Cohesion = {cohesion:.12g}\n"
            + (f"    set Water pressure = {pressure}\n" if pressure else "") + "  end\n")


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(dot(a, a))
    return [x / length for x in a]


def scene(dim, title, domain, size, joints, names, bed, truncated, more="", poisson=0.25):
    """The parts that the kinds below share: rock on a bed, at rest."""
    zeros = "0; " * (dim - 1)
    return f"""set Dimension = {dim}
set Title = {title}
subsection Domain
{domain}
  set Truncated boundaries = {truncated}
end
subsection Mesh
  set Generator = gmsh
  set Size = {size:.4g}
end
subsection Joints
  set Names = {names}
{joints}end
subsection Materials
  set Names = rock, bed
  subsection rock
    set Young modulus = 10e9
    set Poisson ratio = {poisson}
    set Density = 2500
  end
  subsection bed
    set Region = {bed}
{more}  end
end
subsection Initial state
  set Gravity = {zeros}-{GRAVITY}
  set Equilibrium = static
end
subsection Supports
  set Names = ends
  subsection ends
    set Boundaries = {truncated}
  end
end
subsection Stages
  set Names = rest
  subsection rest
    set Kind = quasi-static
    set Unbalanced ratio = 1e-5
    set Maximum steps = 40000
  end
end
subsection Safety factor
  set Blocks = all
  set Bracket = 0.002
end
subsection Output
  set Write VTU = false
end
"""


def water(seed):
    """A block in front of a tension crack, with water in crack and plane; its
    base is under pressure all over, so that limit equilibrium is exact."""
    rng = random.Random(f"water {seed}")
    foot, top = rng.uniform(1., 4.), 10.
    dip = math.radians(rng.uniform(20, 45))
    length_along = rng.uniform(3.5, 7.)  # horizontally
    crack = 10. - length_along
    toe, back = (10., foot), (crack, foot + length_along * math.tan(dip))
    if back[1] > 0.85 * top:
        return water(seed + 1000)
    depth = top - back[1]
    head = rng.uniform(0.2, 1.) * depth
    length = length_along / math.cos(dip)
    weight = 2500. * GRAVITY * length_along * (depth + 0.5 * length_along * math.tan(dip))
    uplift, thrust = 0.5 * WATER * head * length, 0.5 * WATER * head**2
    driving = weight * math.sin(dip) + thrust * math.cos(dip)
    normal = weight * math.cos(dip) - uplift - thrust * math.sin(dip)
    factor = rng.uniform(1.05, 2.2)
    share = rng.uniform(0.3, 1.)  # of the resistance that friction has
    tangent = share * factor * driving / normal
    cohesion = (1. - share) * factor * driving / length
    # effective pressure on the plane, were it linear: moments about the toe
    # of weight, thrust and uplift
    slope = math.tan(dip)
    moment = 2500. * GRAVITY * (depth * length_along * 0.5 * length_along
                                + 0.5 * length_along**2 * slope * length_along / 3.)
    moment -= thrust * (length_along * slope + head / 3.) + uplift * 2. / 3. * length
    place = moment / (normal * length)  # of its resultant, over the length, from the toe
    if normal < 0.1 * weight or tangent > 1.7 or not 0.4 < place < 0.6:
        return water(seed + 1000)
    in_plane = f"{WATER * head:.12g} * max(0, (10 - x) / {length_along:.12g})"
    in_crack = f"max(0, {WATER:.12g} * ({back[1] + head:.12g} - y))"
    joints = (joint_entries("plane", (back, toe), math.degrees(math.atan(tangent)), cohesion,
                            in_plane).replace("    set Friction", "    set Extent = polygon\n"
                            f"    set Vertices = {numbers(toe)}; {numbers(back)}\n    set Friction")
              + joint_entries("crack", (back, (crack, top)), 0., 0., in_crack).replace(
                  "    set Friction", "    set Extent = polygon\n"
                  f"    set Vertices = {numbers(back)}; {crack:.12g}, {top:.12g}\n    set Friction"))
    joints = "\n".join(line for line in joints.splitlines()
                       if " Point " not in line and " Normal " not in line) + "\n"
    slope = math.tan(dip)
    bed = f"if(x < {crack:.12g} || y < {foot:.12g} + (10 - x) * {slope:.12g}, 1, -1)"
    text = scene(2, f"Plane of {math.degrees(dip):.4g} degrees with water, exact factor {factor:.6g}",
                 "  set Size = 10, 10", rng.uniform(0.35, 0.8), joints, "plane, crack", bed,
                 "bottom, left", "    set Model = rigid\n")
    return text, factor


def wedge(seed, poisson=0.):
    """A tetrahedral wedge in the front (y = 0) and top of a box, on two planes
    so much alike that it does not turn. Statics takes shear along the line where
    they meet, and is exact for a wedge that does not spread across it under its
    own weight (Poisson ratio 0): one that does (kind wedging) locks stress across
    the line and can rest at up to 1.4 % above."""
    rng = random.Random(f"wedge {seed}")
    top = 10.
    foot = (0., 0., rng.uniform(2., 5.))
    plunge, trend = math.radians(rng.uniform(25, 55)), math.radians(rng.uniform(-8, 8))
    back = (top - foot[2]) / math.tan(plunge)
    apex = (back * math.sin(trend), back * math.cos(trend), top)
    width = rng.uniform(0.5, 1.1) * (top - foot[2])
    widths = [rng.uniform(0.85, 1.15) * width for _ in range(2)]
    corners = [(-widths[0], 0., top), (widths[1], 0., top)]
    along = unit([a - b for a, b in zip(foot, apex)])
    edges = [[b - a for a, b in zip(foot, p)] for p in (apex, *corners)]
    volume = abs(dot(edges[0], cross(edges[1], edges[2]))) / 6.
    load = (0., 0., -2500. * GRAVITY * volume)
    inward, areas = [], []
    for corner, other in (corners, corners[::-1]):
        n = cross(edges[0], [b - a for a, b in zip(foot, corner)])
        areas.append(0.5 * math.sqrt(dot(n, n)))
        n = unit(n)
        inward.append(n if dot(n, [b - a for a, b in zip(foot, other)]) > 0 else [-x for x in n])
    # load across the line = -(N0 n0 + N1 n1)
    cosine = dot(inward[0], inward[1])
    right = [-dot(load, n) for n in inward]
    forces = [(right[i] - cosine * right[1 - i]) / (1. - cosine**2) for i in range(2)]
    driving = dot(load, along)
    if min(forces) < 0.05 * abs(load[2]):
        return wedge(seed + 1000, poisson)
    angle = rng.uniform(15, 40)
    tangents = [math.tan(math.radians(angle + rng.uniform(-3, 3))) for _ in range(2)]
    # by the forces on the planes, so that cohesion does not turn the wedge
    share = rng.choice([0., 1.]) * rng.uniform(0., 0.8)
    cohesions = [share * t * f / a for t, f, a in zip(tangents, forces, areas)]
    factor = rng.uniform(1.05, 2.2)
    now = sum(t * f + c * a for t, f, c, a in zip(tangents, forces, cohesions, areas)) / driving
    tangents = [t * factor / now for t in tangents]
    cohesions = [c * factor / now for c in cohesions]
    if max(tangents) > 1.2:
        return wedge(seed + 1000, poisson)
    joints, sides = "", []
    for i, (name, corner) in enumerate(zip("AB", corners)):
        joints += joint_entries(name, (foot, apex, corner),
                                math.degrees(math.atan(tangents[i])), cohesions[i])
        n = inward[i]
        sides.append(f"{n[0]:.12g} * x + {n[1]:.12g} * y + {n[2]:.12g} * (z - {foot[2]:.12g}) < 0")
    width, depth = 1.4 * max(widths), 1.4 * back
    text = scene(3, f"Wedge, exact factor {factor:.6g}",
                 f"  set Corner = {-width:.6g}, 0, 0\n  set Size = {2 * width:.6g}, {depth:.6g}, 10",
                 rng.uniform(1.2, 2.2), joints, "A, B", f"if({' || '.join(sides)}, 1, -1)",
                 "bottom, back, left, right", "    set Model = rigid\n", poisson)
    return text, factor


KINDS = {"incline": lambda seed, exact: incline(seed, 2, exact),
         "incline_3d": lambda seed, exact: incline(seed, 3, exact),
         "water": lambda seed, exact: water(seed),
         "wedge": lambda seed, exact: wedge(seed),
         "wedging": lambda seed, exact: wedge(seed, 0.25)}
