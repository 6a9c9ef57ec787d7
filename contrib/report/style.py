# SPDX-License-Identifier: LGPL-2.1-or-later
"""Matplotlib, colours and the ways in which figures go into the page."""
import base64
import io
import re

try:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    WHY_NOT = ""
except ImportError as error:
    pyplot = None
    WHY_NOT = (f"Matplotlib cannot be loaded ({error}), so there are no "
               "figures; install the package python3-matplotlib and use the "
               "system's Python, /usr/bin/python3.")

# of groups of joints: Tol's "muted", told apart also by dashes and symbols
GROUP_COLOURS = ["#332288", "#cc6677", "#117733", "#ddaa33", "#88ccee",
                 "#882255", "#44aa99", "#777777"]
DASHES = ["-", (0, (6, 2)), (0, (2, 1.5)), (0, (7, 2, 2, 2)), "-",
          (0, (6, 2)), (0, (2, 1.5)), (0, (7, 2, 2, 2))]
MARKERS = "os^Dv<>P"
ROCK = "#eceae4"


def new_figure(size, **options):
    """A figure with one pair of axes and readable type."""
    with pyplot.rc_context({"font.size": 10, "axes.titlesize": 10,
                            "svg.fonttype": "none"}):
        figure, axes = pyplot.subplots(figsize=size, layout="constrained",
                                       **options)
    return figure, axes


def plain(axes):
    """Axes without a frame above and on the right, with a faint grid."""
    axes.grid(color="0.92")
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def beside(axes, **options):
    """A legend on the right of the axes, where it covers nothing."""
    axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), fontsize=9,
                frameon=False, handlelength=2.6, **options)


def as_svg(figure, title):
    """A figure as an SVG element for the page, with a title for readers."""
    text = io.StringIO()
    with pyplot.rc_context({"svg.fonttype": "none"}):
        figure.savefig(text, format="svg", metadata={"Date": None},
                       bbox_inches="tight")
    pyplot.close(figure)
    svg = text.getvalue()
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = svg[svg.index("<svg"):]
    # the same names in two figures would be one thing to the page
    as_svg.count += 1
    for name in set(re.findall(r'\bid="([\w.-]+)"', svg)):
        svg = re.sub(rf'(id="|url\(#|href="#){re.escape(name)}(?=["\)])',
                     rf"\g<1>f{as_svg.count}_{name}", svg)
    svg = re.sub(r'(<svg[^>]*?) width="[\d.]+pt"',
                 lambda m: m[0].replace(" height", " data-height"), svg, 1)
    return svg.replace("<svg", f'<svg role="img" aria-label="{title}"', 1)


as_svg.count = 0


def as_png(figure, dpi):
    """A figure as the address of a PNG picture with few colours."""
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=dpi, bbox_inches="tight")
    pyplot.close(figure)
    try:
        from PIL import Image
        with Image.open(data) as image:
            small = image.convert("RGB").quantize(
                128, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
        data = io.BytesIO()
        small.save(data, format="png", optimize=True)
    except ImportError:
        pass
    return "data:image/png;base64," + base64.b64encode(
        data.getvalue()).decode()
