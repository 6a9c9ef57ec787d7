# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a study: probabilities, distributions, convergence, variables."""
import time
import warnings

from . import study_plots, style
from .html import escape, facts, seconds
from .page import assemble, settings_section, warnings_box
from .words import number


def band(probability):
    """A probability and its interval of 95 %."""
    return (f"<td class=n>{number(probability['value'])}</td><td class=n>"
            f"{number(probability['lower'])} – {number(probability['upper'])}"
            "</td>")


def head(study):
    """Title, the probability, and how samples were drawn."""
    results, p = study.results, study.results["probability"]
    full = results.get("level") == "full"
    verdict = (f"With the probability {number(p['value'])} (95 %: "
               f"{number(p['lower'])} to {number(p['upper'])}) a block fails: "
               f"its factor is below {number(results['threshold'])}.")
    if results.get("immovable_share"):
        verdict += (f" In {number(100. * results['immovable_share'], 3)} % of "
                    "the samples no block can move.")
    if results.get("held_share"):
        verdict += (f" In {number(100. * results['held_share'], 3)} % every "
                    "block holds at the highest factor tried; means and "
                    "percentiles leave these out.")
    return (f"<h1>{escape(study.title)}</h1><p>{escape(verdict)}</p>" + facts([
        ("scene", escape(results.get("scene", ""))),
        ("folder", escape(study.folder.resolve().name)),
        ("results written", time.strftime("%Y-%m-%d %H:%M", study.written)),
        ("samples", f"{results['samples']}, {escape(results['sampling'])}, "
         f"seed {results['seed']}"),
        ("judged by", "limit equilibrium; samples with critical blocks are "
         "run and judged by strength reduction" if full else
         "limit equilibrium of rigid blocks"),
        ("wall time", seconds(results.get("seconds")))]))


def probability_section(study):
    """Probabilities of failure with their bands, and what fails on average."""
    results = study.results
    rows = [("some block", "", results["probability"])]
    if results.get("level") == "full":
        rows.append(("some block, by limit equilibrium alone", "",
                     results["rigid_probability"]))
    unit = "m²" if study.is_plane else "m³"
    rows += [(f"block {block['id']}", number(block["volume"]),
              block["probability"]) for block in sorted(
                  results.get("blocks", []),
                  key=lambda b: -b["probability"]["value"])]
    text = "".join(f"<tr><td>{name}</td><td class=n>{size}</td>{band(p)}</tr>"
                   for name, size, p in rows)
    means = facts([
        ("failed blocks per sample, with those that fall once others have gone",
         number(results.get("failed_blocks_per_sample"))),
        (f"failed {'area' if study.is_plane else 'volume'} per sample",
         f"{number(results.get('failed_volume_per_sample'))} {unit}"),
        ("failed blocks per metre of tunnel",
         number(results["failed_blocks_per_metre"])
         if not study.is_plane and "failed_blocks_per_metre" in results
         else ""),
        ("failed volume per metre of tunnel",
         f"{number(results['failed_volume_per_metre'])} m³"
         if not study.is_plane and "failed_volume_per_metre" in results
         else "")])
    return ("<h2 id=probability>Probability of failure</h2>"
            '<div class="wide tall"><table><thead><tr><th>what fails</th>'
            f"<th class=n>{'area' if study.is_plane else 'volume'} ({unit})"
            "</th><th class=n>P(F &lt; "
            f"{number(results['threshold'])})</th><th class=n>95 %</th></tr>"
            f"</thead><tbody>{text}</tbody></table></div>{means}")


def are_equal(statistics):
    """Whether all values are one, but for rounding."""
    least, greatest = statistics["least"], statistics["greatest"]
    return greatest - least <= 1e-9 * max(abs(least), abs(greatest))


def statistics_table(rows):
    """Mean, deviation and percentiles of quantities."""
    percents = ("1", "5", "50", "95", "99")
    text = "".join(
        f"<tr><td>{escape(name)}</td>" + "".join(
            f"<td class=n>{number(value)}</td>" for value in (
                s["samples"], s["mean"], 0. if are_equal(s) else s["deviation"],
                s["least"],
                *(s["percentiles"][p] for p in percents), s["greatest"]))
        + "</tr>" for name, s in rows)
    return ('<div class="wide"><table><thead><tr><th></th>' + "".join(
        f"<th class=n>{name}</th>" for name in (
            "samples", "mean", "deviation", "least",
            *(f"{p} % below" for p in percents), "greatest"))
            + f"</tr></thead><tbody>{text}</tbody></table></div>")


def figures_in(*figures):
    """Figures under each other; those that there are."""
    return "".join(f"<figure>{f}</figure>" for f in figures if f)


def distributions_section(study, figures):
    """Histograms of least factors and of what fails."""
    size = "area" if study.is_plane else "volume"
    unit = "m²" if study.is_plane else "m³"
    rows = [(name, study.results[key]) for key, name in (
        ("least_factor", "least factor of a sample [-]"),
        ("failed_volume", f"failed {size} of a sample in which a block fails "
         f"[{unit}]")) if key in study.results]
    if not rows:
        return ("<h2 id=factors>Factors</h2><p>"
                + ("No sample has a least factor below the highest one tried."
                   if study.results.get("held_share") else
                   "In no sample a block can move.") + "</p>")
    return ("<h2 id=factors>Factors and sizes of failures</h2>"
            + figures_in(figures.get("factors"), figures.get("volumes"))
            + "".join(f"<p>The {escape(name.replace(' [-]', ''))} is the same in "
                      f"all: {number(s['mean'])}.</p>"
                      for name, s in rows if are_equal(s))
            + statistics_table(rows))


def convergence_section(study, figures):
    """The probability as the first of the samples tell it."""
    rows = "".join(f"<tr><td class=n>{p['samples']}</td>{band(p)}</tr>"
                   for p in study.results["convergence"])
    return ("<h2 id=convergence>Convergence</h2>"
            + figures_in(figures.get("convergence"))
            + "<details><summary>As a table</summary><table><thead><tr>"
            "<th class=n>samples</th><th class=n>probability</th><th class=n>"
            f"95 %</th></tr></thead><tbody>{rows}</tbody></table></details>")


def variables_section(study, figures):
    """What varies, and what of it matters."""
    rows = "".join(
        f"<tr><td>{escape(v['name'])}</td><td><code>{escape(v['entry'])}"
        f"</code></td><td>{escape(v['distribution'])}</td>"
        # (a sequence, as of seeds, has none of these)
        + "".join(f"<td class=n>{number(v.get(key), digits)}</td>"
                  for key, digits in (("mean", 4), ("deviation", 4),
                                      ("rank_correlation", 3)))
        + "</tr>"
        for v in sorted(study.results["variables"],
                        key=lambda v: -abs(v.get("rank_correlation", 0.))))
    return ("<h2 id=variables>Variables</h2>"
            + figures_in(figures.get("correlations"))
            + '<div class="wide"><table><thead><tr><th>variable</th><th>entry'
            "</th><th>distribution</th><th class=n>mean of the samples</th>"
            "<th class=n>deviation</th><th class=n>rank correlation</th></tr>"
            f"</thead><tbody>{rows}</tbody></table></div>")


def make_figures(study, attempt):
    """Figures by name, as far as they can be made."""
    if not style.pyplot:
        return {}
    results = study.results
    size = ("failed area [m²]" if study.is_plane else "failed volume [m³]")
    spread = {key: results[key] for key in ("least_factor", "failed_volume")
              if key in results and not are_equal(results[key])}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of Matplotlib's layout
        return {
            "factors": attempt("histogram of factors", None,
                               study_plots.histogram,
                               spread.get("least_factor"),
                               "least factor of a sample [-]",
                               results["threshold"]),
            "volumes": attempt("histogram of sizes", None,
                               study_plots.histogram,
                               spread.get("failed_volume"), size),
            "convergence": attempt("figure of convergence", None,
                                   study_plots.convergence,
                                   results["convergence"]),
            "correlations": attempt("figure of correlations", None,
                                    study_plots.correlations,
                                    results["variables"])}


def write_page(study, attempt):
    """The whole page as text; sections that fail are left out."""
    figures = make_figures(study, attempt)
    sections = [
        ("probability", "probability", probability_section),
        ("factors", "factors", distributions_section, figures),
        ("convergence", "convergence", convergence_section, figures),
        ("variables", "variables", variables_section, figures),
        ("settings", "settings", settings_section)]
    made = [(key, name, attempt(f"section on {name}", "", make, study,
                                *arguments))
            for key, name, make, *arguments in sections]
    top = attempt("head", f"<h1>{escape(study.title)}</h1>", head, study)
    return assemble(study.title, [
        top, warnings_box("What this report lacks", attempt.lost),
        warnings_box("What the study warns of",
                     study.results.get("warnings"))], made)
