# SPDX-License-Identifier: LGPL-2.1-or-later
"""Polygons of joints within a box, as infinite ones would cover all else."""
import numpy


def clip_polygon(polygon, low, high):
    """The part of a plane polygon, or of a line, within a box."""
    points = [numpy.array(p, float) for p in polygon]
    is_line = len(points) == 2
    for k in range(3):
        for bound, sign in ((low[k], 1.), (high[k], -1.)):
            kept, n = [], len(points)
            for a in range(1 if is_line and n == 2 else n):
                p, q = points[a], points[(a + 1) % n]
                u, v = sign * (p[k] - bound), sign * (q[k] - bound)
                if u >= 0.:
                    kept.append(p)
                if u * v < 0.:
                    kept.append(p + u / (u - v) * (q - p))
                if is_line and v >= 0.:
                    kept.append(q)
            points = kept
            if len(points) < 2:
                return []
    return points
