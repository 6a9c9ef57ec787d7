# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which triangle is nearest in each pixel of a picture, with numpy alone."""
import numpy

MOST_SAMPLES = 2000000  # pixels tested at a time


def nearest(triangles, size):
    """Number of the nearest triangle in each pixel (height, width), or -1.

    `triangles` (n, 3, 3) are corners in pixels from the upper left, and how
    near they are."""
    width, height = size
    found = numpy.full(width * height, -1)
    depth = numpy.full(width * height, -numpy.inf)
    flat = triangles[:, :, :2]
    low = numpy.maximum(numpy.floor(flat.min(axis=1)).astype(int), 0)
    high = numpy.minimum(numpy.ceil(flat.max(axis=1)).astype(int) + 1,
                         (width, height))
    extent = numpy.maximum(high - low, 0)
    n_samples = extent[:, 0] * extent[:, 1]
    chunk = numpy.cumsum(n_samples) // MOST_SAMPLES
    for part in numpy.unique(chunk):
        mine = numpy.flatnonzero((chunk == part) & (n_samples > 0))
        put_part(triangles, mine, low, extent, width, found, depth)
    return found.reshape(height, width)


def put_part(triangles, mine, low, extent, width, found, depth):
    """Enter some triangles into the picture."""
    counts = extent[mine, 0] * extent[mine, 1]
    which = numpy.repeat(mine, counts)
    begin = numpy.repeat(numpy.cumsum(counts) - counts, counts)
    place = numpy.arange(len(which)) - begin
    x = low[which, 0] + place % extent[which, 0]
    y = low[which, 1] + place // extent[which, 0]
    a, b, c = (triangles[which, k] for k in range(3))
    (ax, ay), (bx, by) = (b - a)[:, :2].T, (c - a)[:, :2].T
    dx, dy = x + 0.5 - a[:, 0], y + 0.5 - a[:, 1]
    area = ax * by - ay * bx
    area = numpy.where(abs(area) < 1e-12, numpy.inf, area)
    u, v = (dx * by - dy * bx) / area, (ax * dy - ay * dx) / area
    near = a[:, 2] + u * (b - a)[:, 2] + v * (c - a)[:, 2]
    pixel = y * width + x
    inside = ((u >= -1e-6) & (v >= -1e-6) & (u + v <= 1. + 1e-6)
              & numpy.isfinite(area) & (near > depth[pixel]))
    order = numpy.flatnonzero(inside)
    order = order[numpy.argsort(near[order], kind="stable")]
    # of several values for one pixel the last, the nearest, stays
    depth[pixel[order]] = near[order]
    found[pixel[order]] = which[order]
