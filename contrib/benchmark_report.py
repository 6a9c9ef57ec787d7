# SPDX-License-Identifier: LGPL-2.1-or-later
"""doc/performance.md from the tables that benchmark.py wrote."""
import csv
import math
import sys

try:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError as error:
    sys.exit(f"benchmark_report.py: Matplotlib cannot be loaded ({error}); "
             "install the package python3-matplotlib and use the system's "
             "Python, /usr/bin/python3.")

TEXT = {
    "rates": """## Rates of the loops

One core, medians of three runs; the yardstick, a hand-written loop with full
integration and nothing else (no damping, energies, or materials), runs
between them. The *cell loop* brings stresses up to date and adds nodal forces;
the *whole step* adds motion of the nodes, energies and contact. Box of 500 x 500
and of 64 x 56 x 56 cells in rows; the Gmsh meshes are those of a square and a
cube, swept front by front.
""",
    "growth": """## Growth

The same boxes from ten thousand to four million cells.
""",
    "ranks": """## Two ranks

Both cores share a memory bandwidth that one core nearly fills in 2D. The last
column is a ceiling: two runs on one rank each at the same time, which never wait
for each other, over one alone. Cores that others use too give ratios above two.
""",
    "accuracy": """## Run time against error

Errors are relative, against closed forms. A run that failed has no numbers.
""",
    "published": """## Against the published way

The article raises the reduction factor in steps of 0.01, each time from the
start, moves the whole model, and treats contact points in one uncoupled pass.
Its trials take 5000 steps. Time and steps are those of the trials alone; the
error is that of the farther end of the bracket. "none": no factor, as the stage
itself ended wrong (uncoupled points at the corners of blocks diverge).
Sweeps of the powerhouse begin at a factor of 0.99.
""",
    "factors": """## Factors of the powerhouse

All stages, all safety factors to 0.5 %, two rank groups on two cores.
""",
    "skips": """## What is skipped, and what that changes

Each shortcut on (as by default) and off, in turn, medians of three runs
(of the powerhouse one): of the trials' time for safety factors, else of the
whole run's.
""",
    "machines": """## Machines

Numbers of sections that different processors ran cannot be compared.
""",
}

CLOSING = """## A billion cells

A model of what is not measured here. What a step exchanges between ranks are
the velocities and forces of the nodes on the rims of their parts. A rank with
n cells of a 3D mesh in Hilbert chunks has about 6 n^(2/3) rim nodes, each sent
once as force and once as velocity: 48 B. At n = 4e6 that is 7 MB per step and
rank; at 12 M cell-steps/s the step takes 0.33 s, at a link of 10 GB/s the
exchange 0.7 ms, and an all-reduce over 250 ranks some 50 us (one per step with
kinetic-energy stops, surface contacts or a far field). By this count 1e9 cells on
250 such ranks lose less than 1 % to communication. What does not scale is the
set-up: every rank holds the whole mesh, so the memory of one machine (its peak
per cell is in the table of growth) ends the size of a model, not its speed.

## Choices that these numbers made

- Full integration for elastic cells up to nu = 0.4, mean dilatation above and in
  rock that yields (theory, section 5).
- Cells are swept front by front inside each rank's part (`mesh/cell_order.h`).
- Stresses are prefetched two batches ahead. Elastic cells in 2D leave the
  out-of-plane stress alone.
- Nodes without joint or support are predicted and moved in one pass, two at a
  time; the nodes of joints are numbered last, so that this pass is not broken
  up, and prefetched.
- Mohr-Coulomb cells test all points of a batch at once, and only those that may
  yield are returned one by one.
- Contact sweeps end when the momentum of the nodes rests (theory, section 7).
"""


def read(path):
    """Columns and rows of a table."""
    with open(path, encoding="utf-8", newline="") as file:
        columns, *rows = csv.reader(file)
    return columns, rows


def number(text):
    """The number in a field, or nan."""
    try:
        return float(text)
    except ValueError:
        return math.nan


def table(columns, rows):
    """A table in Markdown."""
    lines = ["| " + " | ".join(columns) + " |",
             "|" + "---|" * len(columns)]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def draw_accuracy(rows, path):
    """Error over time, one field per case."""
    cases = list(dict.fromkeys(row[0] for row in rows))
    n_columns = 3
    n_lines = -(-len(cases) // n_columns)
    figure, fields = pyplot.subplots(n_lines, n_columns, squeeze=False,
                                     figsize=(10, 3.1 * n_lines))
    for field in fields.flat[len(cases):]:
        field.axis("off")
    for case, field in zip(cases, fields.flat):
        for variant in dict.fromkeys(r[1] for r in rows if r[0] == case):
            points = sorted((number(r[4]), number(r[5])) for r in rows
                            if r[:2] == [case, variant]
                            and number(r[4]) > 0. and number(r[5]) > 0.)
            if points:
                field.loglog(*zip(*points), "o-", markersize=4,
                             label=variant)
        field.set_title(case, fontsize=9)
        field.set_xlabel("time loop [s]", fontsize=8)
        field.set_ylabel("relative error", fontsize=8)
        field.tick_params(labelsize=7)
        field.grid(True, which="major", alpha=0.3)
        field.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=90)
    pyplot.close(figure)


def draw_growth(rows, path):
    """Time and memory per cell over the number of cells."""
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(8, 3))
    for dimension in ("2D", "3D"):
        mine = [r for r in rows if r[0] == dimension]
        cells = [number(r[1]) for r in mine]
        left.loglog(cells, [number(r[3]) for r in mine], "o-",
                    label=dimension)
        right.semilogx(cells, [number(r[5]) for r in mine], "o-",
                       label=dimension)
    left.set_ylabel("step [ns per cell]")
    right.set_ylabel("peak memory [B per cell]")
    right.set_ylim(bottom=0.)
    for field in (left, right):
        field.set_xlabel("cells")
        field.grid(True, which="major", alpha=0.3)
        field.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=90)
    pyplot.close(figure)


BY_HAND = "## Meshes of random joint networks\n"  # from there on


def write(tables, folder):
    """Write FOLDER/performance.md and the plots beside it.

    Sections that are written by hand follow the others, and are kept."""
    page = folder / "performance.md"
    before = page.read_text(encoding="utf-8") if page.exists() else ""
    _, heading, by_hand = before.partition(BY_HAND)
    with open(page, "w", encoding="utf-8") as out:
        out.write("# Performance\n\nWritten by `contrib/benchmark.sh` from "
                  "the tables in `doc/benchmark`; do not edit. Two cores of a "
                  "shared machine: rates drift by 20 to 30 %, so compare "
                  "ratios, which are those of runs made in turn. Where and when "
                  "each section was measured stands under *Machines*, and in "
                  "the sections behind that, which are written by hand.\n\n")
        for name, text in TEXT.items():
            path = tables / f"{name}.csv"
            if not path.exists():
                continue
            columns, rows = read(path)
            out.write(text + "\n" + table(columns, rows) + "\n")
            if name in ("accuracy", "growth"):
                picture = f"pictures/benchmark_{name}.png"
                draw = draw_accuracy if name == "accuracy" else draw_growth
                draw(rows, folder / picture)
                out.write(f"![{name}]({picture})\n\n")
        out.write(CLOSING)
        if heading:
            out.write(f"\n{heading}{by_hand}")
