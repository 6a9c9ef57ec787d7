# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page: its head, its sections in turn, and the settings, as one text."""
import pathlib
import time

from .html import download, escape, facts, seconds, source
from .page_blocks import blocks_section, factors_section, why_no_factors
from .page_stages import energy_section, joints_section, stages_section
from .page_support import bolts_section, shotcrete_section
from .page_view import view_section
from .tables import warnings_of
from .words import count, number


def title_of(run):
    """The title of the scene, or its name."""
    return run.scene("title") or pathlib.Path(run.scene("name", "run")).stem


def named(numbers):
    """Blocks by their numbers."""
    if len(numbers) == 1:
        return f"block {numbers[0]}"
    names = [str(n) for n in numbers[:30]]
    last = f"{len(numbers) - 30} more" if len(numbers) > 30 else names.pop()
    return f"blocks {', '.join(names)} and {last}"


def further_verdict(rows):
    """Blocks that fail after others, that still move, and those that something
    but joints holds."""
    text = ""
    later = [row["block"] for row in rows if row["state"] == "follows"]
    if later:
        text += f" Once others have gone fail, too: {named(later)}."
    moving = [row["block"] for row in rows if row["state"] == "moves"]
    if moving:
        text += (" Still moving at the end of the last stage: "
                 f"{named(moving)}.")
    held = {}
    for row in rows:
        if row["held_by"] is not None:
            held.setdefault(row["held_by"], []).append(row["block"])
    for what, numbers in held.items():
        several = len(numbers) > 1
        text += (f" {named(numbers).capitalize()} "
                 + (f"{'are' if several else 'is'} held by {what}: " if what else
                    f"hold{'' if several else 's'} by strength reduction, but ")
                 + "without in-situ stress, as "
                 + ("rigid blocks, factors are" if several else
                    "a rigid block, its factor is") + " below 1.")
    return text


def head(run, rows):
    """Title, what was run by what, and how it went."""
    summary = run.summary
    program, facts_of_run = summary.get("program", {}), summary.get("run", {})
    exposed = sum(row["exposed"] for row in rows)
    failed = [row["block"] for row in rows if row["state"] == "fails"]
    verdict = (f"{count(len(rows), 'finite block')}, {exposed} of them exposed "
               "at some stage. " if len(rows) > 1 else
               f"1 finite block, {'exposed at some stage' if exposed else 'never exposed'}"
               ". " if rows else "The scene has no finite blocks. ")
    if failed:
        verdict += ("Failed in a stage, fall freely, or have a factor below "
                    "1: "
                    + named(failed) + ".")
    elif any(row["factor"] for row in rows):
        verdict += "None has failed or has a factor below 1."
    elif rows:
        verdict += why_no_factors(run, rows)
    verdict += further_verdict(rows)
    versions = f"keyblock {program.get('version', '')}".strip()
    if program.get("commit"):
        versions += f", commit {program['commit']}"
    if program.get("build_type"):
        versions += f", {program['build_type']} build"
    libraries = ", ".join(text for text in (
        f"deal.II {program['deal_ii_version']}" if program.get(
            "deal_ii_version") else "", program.get("compiler", "")) if text)
    n = run.scene("dimension")
    size = (f"{n}D, {count(run.scene('cells'), 'cell')}, "
            f"{count(run.scene('nodes'), 'node')}, "
            f"{count(run.scene('joints'), 'joint')}, "
            f"{run.scene('pairs')} pairs of joint faces")
    way = summary.get("mesh", {})
    mesh = None
    if way.get("way"):
        mesh = escape({"cut": "joints are cut into the mesh",
                       "exact": "joints are followed exactly"}.get(
                           way["way"], way["way"])
                      + (f" ({way['reason']})" if way.get("reason") else ""))
        if way.get("largest_shift", 0.) > 1e-9:
            mesh += (f", moved by up to {number(way['largest_shift'], 3)} m, "
                     "99 % of their points by less than "
                     f"{number(way.get('percentile_99'), 3)} m")
    seeds = ", ".join(f"{name} {seed}" for name, seed in
                      (run.scene("seeds", {}) or {}).items())
    return (f"<h1>{escape(title_of(run))}</h1><p>{escape(verdict)}</p>"
            + facts([
                ("scene", escape(run.scene("name"))),
                ("folder", escape(run.folder.resolve().name)),
                ("results written", time.strftime("%Y-%m-%d %H:%M",
                                                  run.written)),
                ("program", escape(versions)), ("built with",
                                                escape(libraries)),
                ("digest of the entries", escape(run.scene("digest"))),
                ("seeds of joint sets", escape(seeds)),
                ("model", escape(size)), ("mesh", mesh),
                ("run", ", ".join(t for t in (
                    count(facts_of_run.get("steps"), "step") if run.takes_steps()
                    else "no step, limit equilibrium alone",
                    f"{program.get('ranks', 1)} rank"
                    + ("s" if program.get("ranks", 1) != 1 else ""),
                    f"wall time {seconds(facts_of_run.get('wall_time'))}"
                    if "wall_time" in facts_of_run else "") if t))]))


def warnings_box(title, warnings):
    """Sentences in a box; nothing without any."""
    if not warnings:
        return ""
    return (f'<div class="warnings"><b>{escape(title)}</b><ul>'
            + "".join(f"<li>{escape(w)}</li>" for w in warnings)
            + "</ul></div>")


def settings_section(run):
    """The entries of the scene that are not the defaults."""
    if not run.entries:
        return ("<h2 id=settings>Settings</h2><p>There is no used.prm in the "
                "folder.</p>")

    def shorten(text):
        return text if len(text) <= 300 else text[:300] + " …"

    text = ["<h2 id=settings>Settings</h2>"]
    if run.changed:
        rows = "".join(
            f"<tr><td><code>{escape(path)}</code></td><td>"
            f"{escape(shorten(value))}</td><td>"
            f"{escape(shorten(default)) or '–'}</td></tr>"
            for path, value, default in run.changed)
        elsewhere = (" (joints are in joints.csv)" if (
            run.folder / "joints.csv").exists() else "")
        n = len(run.changed)
        differ = ("1 entry of used.prm that differs from its default" if n == 1 else
                  f"{n} entries of used.prm that differ from their defaults")
        text.append(f"<details><summary>{differ}{elsewhere}"
                    '</summary><div class="wide tall"><table><thead><tr><th>'
                    "entry</th><th>value</th><th>default</th></tr></thead>"
                    f"<tbody>{rows}</tbody></table></div></details>")
    else:
        rows = "\n".join(f"{path} = {shorten(value)}"
                         for path, value in run.entries.items())
        text.append(f"<details><summary>All {len(run.entries)} entries of "
                    f"used.prm</summary><pre>{escape(rows)}</pre></details>")
    checks = run.summary.get("checks", {})
    if checks:
        rows = "".join(f"<tr><td>{escape(k)}</td><td class=n>"
                       f"{number(v, 6) if isinstance(v, (int, float)) else escape(v)}"
                       "</td></tr>" for k, v in checks.items())
        text.append(f"<details><summary>{count(len(checks), 'check')} of the "
                    f"scene</summary><table>{rows}</table></details>")
    return "\n".join(text)


def assemble(title, top, sections):
    """The page of its top, links, and sections: key, name and text of each."""
    links = "".join(f'<a href="#{key}">{name}</a>' for key, name, text in
                    sections if text)
    body = "\n".join([*top, f"<nav>{links}</nav>",
                      *(text for *_, text in sections if text)])
    page = source("page.html")
    for name, text in (("title", escape(title)),
                       ("style", source("page.css")), ("body", body)):
        page = page.replace(f"@{name}@", text, 1)
    return page


def write_page(run, rows, parts, csvs, attempt):
    """The whole page as text; sections that fail are left out."""
    links = {name: download(name, text) for name, text in csvs.items()}
    files = ", ".join(links[name] for name in ("blocks.csv", "factors.csv")
                      if name in links)
    sections = [
        ("blocks", "blocks", blocks_section, rows, bool(parts["view"]), files),
        ("in-space", "view", view_section, parts["view"]),
        ("factors", "factors", factors_section, rows, *parts["factors"]),
        ("stages", "stages", stages_section, parts["pictures"],
         parts["legend"], parts["why"], links["stages.csv"]),
        ("bolts", "bolts", bolts_section, links.get("bolts.csv")),
        ("shotcrete", "shotcrete", shotcrete_section),
        ("joints", "joints", joints_section, parts["net"],
         *parts["pyramids"]),
        ("energy", "energy", energy_section, parts["energy"]),
        ("settings", "settings", settings_section)]
    made = [(key, name, attempt(f"section on {name}", "", make, run,
                                *arguments))
            for key, name, make, *arguments in sections]
    top = attempt("head", f"<h1>{escape(title_of(run))}</h1>", head, run, rows)
    warned = attempt("list of warnings", [], warnings_of, run)
    return assemble(title_of(run), [
        top, warnings_box("What this report lacks", attempt.lost),
        warnings_box("What the run warns of", warned)], made)
