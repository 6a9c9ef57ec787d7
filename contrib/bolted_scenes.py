"""Scenes of random blocks with bolts whose exact safety factors are known, for
factors.py: functions of a seed as those of factor_scenes.py.

Bolts are tensioned to their yield force and soft, so that this force stays.
"""
import math
import random

GRAVITY, DENSITY = 9.81, 2000.


def bolts(heads, angles, force, turn, height):
    """Entries of bolts from heads (x) on the face of the block to a depth of 0.18 m
    at angles (radians) to its normal, tilted to -x; turn: 1 or -1, the way of y, height:
    y of the face."""
    def ends(depth):
        return [(x - depth * math.tan(a), height + turn * depth)
                for x, a in zip(heads, angles)]
    text = f"subsection Bolts\n  set Names = {', '.join(f'bolt {i}' for i in range(len(heads)))}\n"
    for i, (head, end, angle) in enumerate(zip(ends(0.), ends(0.18), angles)):
        text += (f"  subsection bolt {i}\n    set Stage = rest\n"
                 f"    set Heads = {head[0]:.9g}, {head[1]:.9g}\n"
                 f"    set Ends = {end[0]:.12g}, {end[1]:.12g}\n    set Area = 1e-9\n"
                 f"    set Young modulus = 200e9\n    set Yield force = {force:.9g}\n"
                 f"    set Pretension = {force:.9g}\n    set Plate strength = 1e4\n"
                 f"    set Free length = {0.12 / math.cos(angle):.9g}\n"
                 "    set Bond stiffness = 1e8\n    set Bond strength = 1e5\n  end\n")
    return text + "end\n"


def scene(title, gravity, geometry, joints, friction, more, cells=8):
    """The text of a scene with a stage without sliding."""
    return f"""set Dimension = 2
set Title = {title}
subsection Mesh
  set Generator = structured
  set Cells = 40, {cells}
end
{geometry}{joints}subsection Materials
  set Names = rock, bed
  subsection rock
    set Young modulus = 20e6
    set Poisson ratio = 0.3
    set Density = {DENSITY}
  end
{more}end
subsection Initial state
  set Gravity = {gravity[0]:.12g}; {gravity[1]:.12g}
end
subsection Stages
  set Names = rest
  subsection rest
    set Kind = quasi-static
    set Friction angle override = {friction}
    set Unbalanced ratio = 1e-7
  end
end
"""


def incline(seed, convention):
    """A block of 0.5 m x 0.1 m on a plane of random dip and friction, with one or two
    bolts at random angles to the plane's normal that pull it up, or down."""
    rng = random.Random(f"bolted {seed}")
    dip, friction = (math.radians(rng.uniform(*limits)) for limits in ((20, 65), (10, 50)))
    angles = [math.radians(rng.uniform(-25, 65)) for _ in range(rng.choice([1, 2]))]
    weight = 0.05 * DENSITY * GRAVITY
    force = weight * rng.uniform(0.05, 0.3) / len(angles)
    pressed = weight * math.cos(dip) + sum(force * math.cos(a) for a in angles)
    along = [force * math.sin(a) for a in angles]
    driving, resisting = weight * math.sin(dip), pressed * math.tan(friction)
    if convention == "active":
        driving -= sum(along)
    else:
        driving -= sum(min(0., s) for s in along)
        resisting += sum(max(0., s) for s in along)
    if driving < 0.1 * weight:
        return incline(seed + 1000, convention)
    factor = resisting / driving
    geometry = """subsection Domain
  set Corner = -0.5, -0.1
  set Size = 1, 0.2
  set Truncated boundaries = bottom, left, right
end
subsection Excavations
  set Names = uphill, downhill
  subsection uphill
    set Shape = box
    set Corner = -0.5, 0
    set Size = 0.25, 0.1
  end
  subsection downhill
    set Shape = box
    set Corner = 0.25, 0
    set Size = 0.25, 0.1
  end
end
"""
    joints = ("subsection Joints\n  set Names = base\n  subsection base\n    set Point = 0, 0\n"
              f"    set Dip = 0\n    set Friction angle = {math.degrees(friction):.10g}\n  end\nend\n")
    text = scene(f"Bolted block, {convention}, exact factor {factor:.6g}",
                 (GRAVITY * math.sin(dip), -GRAVITY * math.cos(dip)), geometry, joints, 88,
                 "  subsection bed\n    set Region = -y\n    set Model = rigid\n  end\n")
    heads = [0.05, -0.02][:len(angles)]
    text += bolts(heads, angles, force, -1., 0.1)
    return text + ("subsection Safety factor\n  set Blocks = all\n  set Bracket = 0.0005\n"
                   f"  set Bolt convention = {convention}\nend\n"), factor


def roof(seed):
    """A block between plumb joints without friction that hangs on bolts at random angles
    to the plumb line, passive: its way is down, what they do along it is divided."""
    rng = random.Random(f"bolted roof {seed}")
    angles = [math.radians(rng.choice([0., rng.uniform(-45, 45)]))
              for _ in range(rng.choice([1, 2]))]
    weight = 0.05 * DENSITY * GRAVITY
    factor = rng.uniform(1.05, 3.)
    force = weight * factor / sum(math.cos(a) for a in angles)
    geometry = """subsection Domain
  set Corner = -0.5, -0.05
  set Size = 1, 0.25
  set Truncated boundaries = top, left, right
end
subsection Excavations
  set Names = room
  subsection room
    set Shape = box
    set Corner = -0.5, -0.05
    set Size = 1, 0.05
  end
end
"""
    joints = "subsection Joints\n  set Names = left, right, top\n"
    for name, (x, y), (u, v) in (("left", (-0.25, 0.), (-0.25, 0.1)),
                                 ("right", (0.25, 0.), (0.25, 0.1)),
                                 ("top", (-0.25, 0.1), (0.25, 0.1))):
        joints += (f"  subsection {name}\n    set Extent = polygon\n"
                   f"    set Vertices = {x}, {y}; {u}, {v}\n    set Friction angle = 0\n  end\n")
    joints += "end\n"
    text = scene(f"Roof block on bolts, exact factor {factor:.6g}", (0., -GRAVITY), geometry,
                 joints, -1, "  subsection bed\n    set Region = if(abs(x) < 0.25, y - 0.1, 1)\n"
                 "    set Model = rigid\n  end\n", 10)
    heads = [0., 0.04][:len(angles)]
    text += bolts(heads, angles, force, 1., 0.)
    return text + ("subsection Safety factor\n  set Blocks = exposed\n  set Bracket = 0.0005\n"
                   "  set Bolt convention = passive\nend\n"), factor


KINDS = {"bolted_active": lambda seed, exact: incline(seed, "active"),
         "bolted_passive": lambda seed, exact: incline(seed, "passive"),
         "bolted_roof": lambda seed, exact: roof(seed)}
