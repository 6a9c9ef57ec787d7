# SPDX-License-Identifier: LGPL-2.1-or-later
"""Histograms, convergence and correlations of a study, as SVG."""
import numpy

from .style import GROUP_COLOURS, as_svg, beside, new_figure, plain

FAILED, HELD, BAND = "#d55e00", "#56b4e9", "#bbbbbb"


def draw_histogram(axes, statistics, threshold=None):
    """Bars of the bins; those that lie below a threshold in another colour."""
    bins, counts = statistics["histogram"], statistics["histogram"]["counts"]
    left, width = bins["from"], bins["width"]
    left = left + width * numpy.arange(len(counts))
    if threshold is None:
        colours = HELD
    else:
        colours = [FAILED if x + 0.5 * width < threshold else HELD
                   for x in left]
    axes.bar(left, counts, width, align="edge", color=colours,
             edgecolor="white", linewidth=0.4)


def histogram(statistics, label, threshold=None):
    """How values of samples are distributed, with mean and 5 and 95 %; or
    None."""
    if not statistics:
        return None
    figure, axes = new_figure((8.4, 3.4))
    plain(axes)
    draw_histogram(axes, statistics, threshold)
    if threshold is not None:
        axes.axvline(threshold, color="0.2", linewidth=1.2,
                     label=f"threshold {threshold:g}")
    axes.axvline(statistics["mean"], color="0.2", linewidth=1.,
                 linestyle="--", label=f"mean {statistics['mean']:.4g}")
    percentiles = statistics["percentiles"]
    for percent in ("5", "95"):
        axes.axvline(percentiles[percent], color="0.45", linewidth=0.9,
                     linestyle=":",
                     label=f"{percent} % below {percentiles[percent]:.4g}")
    axes.set(xlabel=label, ylabel="samples")
    beside(axes)
    return as_svg(figure, f"Histogram: {label}")


def convergence(points):
    """Probability against the number of samples, with its interval of 95 %."""
    figure, axes = new_figure((8.4, 3.4))
    plain(axes)
    n = [p["samples"] for p in points]
    axes.fill_between(n, [p["lower"] for p in points],
                      [p["upper"] for p in points], color=BAND, alpha=0.6,
                      linewidth=0, label="interval of 95 %")
    axes.plot(n, [p["value"] for p in points], "o-", color=FAILED,
              markersize=3.5, linewidth=1.4, label="probability of failure")
    axes.set(xlabel="samples", ylabel="probability [-]", xlim=(0., None),
             ylim=(0., None))
    beside(axes)
    return as_svg(figure, "Convergence of the probability")


def correlations(variables):
    """Rank correlations with the least factor, the strongest on top; or
    None. Sequences, as of seeds, have none."""
    variables = [v for v in variables if "rank_correlation" in v]
    if not variables:
        return None
    ordered = sorted(variables, key=lambda v: abs(v["rank_correlation"]))
    figure, axes = new_figure((6.4, 1.2 + 0.34 * len(ordered)))
    plain(axes)
    axes.barh([v["name"] for v in ordered],
              [v["rank_correlation"] for v in ordered], 0.6,
              color=[GROUP_COLOURS[0] if v["rank_correlation"] >= 0. else
                     GROUP_COLOURS[1] for v in ordered])
    axes.axvline(0., color="0.3", linewidth=0.9)
    axes.set(xlim=(-1., 1.),
             xlabel="rank correlation with the least factor [-]")
    return as_svg(figure, "Rank correlations")
