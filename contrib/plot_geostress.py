#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Measured against fitted stresses of an inversion, as a picture.

usage: contrib/plot_geostress.py FOLDER/geostress.csv OUT.png

The file is in the output folder of a scene with measured points; coefficients,
standard errors and R2 are taken from summary.json beside it, if it is there.
Needs the package python3-matplotlib.
"""
import csv
import json
import math
import pathlib
import sys

try:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError as error:
    sys.exit(f"plot_geostress.py: Matplotlib cannot be loaded ({error}); "
             "install the package python3-matplotlib and use the system's "
             "Python, /usr/bin/python3.")

HEADER = ["measurement", "measured [Pa]", "fitted [Pa]", "residual [Pa]"]
MARKERS = "osD^v<>ph*"


def read_stresses(path):
    """Measured and fitted stresses [MPa] of each component."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            header, *rows = list(csv.reader(file)) or [[]]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or error
        sys.exit(f"plot_geostress.py: '{path}' cannot be read: {reason}.")
    if header != HEADER:
        sys.exit(f"plot_geostress.py: '{path}' is not a geostress.csv of "
                 f"keyblock: its first line is '{','.join(header)[:60]}' "
                 f"instead of '{','.join(HEADER)}'.")
    components = {}
    for number, row in enumerate(rows, 2):
        try:
            name, measured, fitted, _ = row
            pair = float(measured) / 1e6, float(fitted) / 1e6
            if not all(map(math.isfinite, pair)):
                raise ValueError
        except ValueError:
            sys.exit(f"plot_geostress.py: line {number} of '{path}' is not a "
                     "quoted name and three finite numbers.")
        # names end with the component, as in 120,80,-80,xx
        components.setdefault(name.split(",")[-1], []).append(pair)
    if not components:
        sys.exit(f"plot_geostress.py: '{path}' holds no measurement.")
    return components


def read_fit(path):
    """Lines with R2 and the coefficients; none without summary.json."""
    if not path.exists():
        return []
    try:
        with open(path, encoding="utf-8") as file:
            fit = json.load(file)["geostress"]
        lines = [f"R$^2$ = {fit['r_squared']:.6g}"]
        for name, value in fit["coefficients"].items():
            wide = fit["standard_errors"][name]
            lines.append(f"{name}: {value:.4g} $\\pm$ {wide:.1g}")
    except (OSError, ValueError, KeyError, TypeError) as error:
        sys.exit(f"plot_geostress.py: '{path}' has no readable result of the "
                 f"inversion ({type(error).__name__}: {error}); move it away "
                 "to plot without it.")
    return lines


def plot(components, lines, path):
    """Draw the points, the line of equal stresses and the legend."""
    figure, axes = pyplot.subplots(figsize=(4.8, 4.), dpi=100)
    values = [v for pairs in components.values() for pair in pairs
              for v in pair]
    ends = min(values), max(values)
    margin = 0.05 * (ends[1] - ends[0]) or 1.
    ends = ends[0] - margin, ends[1] + margin
    axes.plot(ends, ends, color="0.4", linewidth=1., label="1:1")
    for i, (name, pairs) in enumerate(components.items()):
        axes.plot(*zip(*pairs), MARKERS[i % len(MARKERS)], markersize=5,
                  fillstyle="none", label=name)
    axes.set(xlim=ends, ylim=ends, aspect="equal",
             xlabel="measured stress [MPa], tension positive",
             ylabel="fitted stress [MPa]")
    axes.grid(color="0.9")
    axes.legend(loc="lower right", fontsize=8)
    if lines:
        axes.text(0.03, 0.97, "\n".join(lines), transform=axes.transAxes,
                  verticalalignment="top", fontsize=8)
    figure.tight_layout()
    try:
        figure.savefig(path)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        sys.exit(f"plot_geostress.py: '{path}' cannot be written: {reason}.")


def main():
    """Read, draw, write."""
    if len(sys.argv) != 3:
        sys.exit("usage: contrib/plot_geostress.py FOLDER/geostress.csv "
                 "OUT.png")
    source = pathlib.Path(sys.argv[1])
    components = read_stresses(source)
    lines = read_fit(source.parent / "summary.json")
    plot(components, lines, sys.argv[2])


if __name__ == "__main__":
    main()
