#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reports of what test scenes do not come to, by contrib/keyblock-report.

usage: report_altered.py KEYBLOCK REPORT PRM FOLDER

The summary.json of a run is changed: open brackets, blocks that move, support
beyond its strength, parts that cannot be made, ...; the report has to say so.
"""
import csv
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys

KEYBLOCK, REPORT, PRM, FOLDER = sys.argv[1:5]
FOLDER = pathlib.Path(FOLDER)


def altered(change):
    """What is said and the page, of a run with a summary.json that is changed."""
    folder = FOLDER / "altered"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(FOLDER / "output", folder)
    summary = json.loads((folder / "summary.json").read_text())
    change(summary, next(b for b in summary["blocks"]
                         if not {"infinite", "rigid"} & set(b["class"])))
    (folder / "summary.json").write_text(json.dumps(summary))
    path = FOLDER / "altered.html"
    done = subprocess.run([REPORT, folder, "-o", path], capture_output=True,
                          text=True)
    assert done.returncode == 0 and not done.stderr, done.stderr
    return done.stdout, path.read_text(encoding="utf-8")


def row_of(page, block):
    """The row of a block in the table of blocks."""
    return re.search(rf'<tr data-block="{block}">(.*?)</tr>', page)[1]


def set_factor(block, **changes):
    """Give the last strength reduction of a block other results."""
    factor = block["safety_factor"][-1]
    for key in ("value", "lower", "upper", "group"):
        factor.pop(key, None)
    factor.update({"outcome": "value", **changes})


def check_open():
    """A bracket without an upper end: the factor is at least the lower."""
    _, page = altered(lambda _, block: set_factor(
        block, lower=1.25, value=0.625))
    assert "at least 1.25" in row_of(page, 1), row_of(page, 1)
    assert "This report has no" not in page and "Arrows: " in page


def check_support():
    """Warnings of the run, and shotcrete that bears more than it can."""
    warning = "The mesh has moved faces of blocks <far> off."
    liner = {"name": "crown", "stage": "dig", "area": 24.9,
             "trace_length": 2., "shear_resistance": 3e5,
             "largest_load_ratio": 0.99, "sheared_length": 0.}
    bends = {**liner, "name": "shell", "largest_compression": 3.015e6,
             "largest_tension": 0., "largest_moment": 5690.,
             "largest_shear_force": 12600., "safety_factor": 0.959,
             "governed_by": "compression", "place_of_least_factor": [-4., 2.],
             "exceeded_area": 0.602}

    def change(summary, _):
        summary.update(warnings=[warning], shotcrete=[liner, bends])

    page = altered(change)[1]
    assert html.escape(warning) in page and "This report has no" not in page
    section = re.search(r"<h2 id=shotcrete>.*?(?=<h2)", page, re.DOTALL)[0]
    for text in ("<td>crown</td>", "<td class=n>300</td>",
                 "<td class=n>3015</td>", "<td class=bad>0.959</td>",
                 "<td class=bad>0.602</td>", "<td>-4, 2</td>"):
        assert text in section, (text, section)
    assert section.count("class=bad") == 2
    assert "Thrust and moment of liner shell are beyond its strength" in page


def check_moving():
    """A block that moves has not failed, and one that moved off has."""
    def change(remark, **factor):
        def apply(summary, block):
            summary["stages"][-1]["remark"] = remark
            set_factor(block, **factor)
        return apply

    moves, gone = "block 1 is moving off (0.0006 m)", "block 1 moved off (2 m)"
    wanted = {"outcome": "above 1.5, as wanted", "lower": 1.5}
    for remark, factor, state, words in (
            (moves, wanted, "moves", "Still moving at the end"),
            (moves, {"value": 0.8, "lower": 0.79, "upper": 0.81}, "fails", ""),
            (gone, wanted, "fails", "moved off</td>"),
            ("", wanted, "holds", "None has failed"),
            ("", {**wanted, "lower": 1.2}, "low", ""),
            ("", {"outcome": "above 100, held by clamping", "lower": 100.},
             "firm", ""), ("", {"outcome": "immovable"}, "firm", "")):
        page = altered(change(remark, **factor))[1]
        assert blocks_of(page)["1"]["state"] == state, (remark, factor)
        assert words in page and "This report has no" not in page
        assert ("Failed in a stage, fall" in page) == (state == "fails")


def blocks_of(page):
    """What the view says of blocks."""
    return json.loads(re.search(r'id="view-meta">(.*?)</script>',
                                page)[1])["blocks"]


def check_held():
    """A block below 1 by limit equilibrium that strength reduction holds.

    By what the run says, or else by nothing that is named."""
    for held, remark, words, clamped in (
            ("clamping", "", "is held by clamping: without", "yes"),
            ("bolts and clamping", "", "is held by bolts and", "yes"),
            ("bolts", "", "is held by bolts: without", "no"),
            ("", "held by the support sym, left out; meets the rock",
             "is held by the support sym: without", "no"),
            ("", "", "holds by strength reduction, but without", "yes")):
        def change(_, block):
            limit = block["limit_equilibrium"][-1]
            limit.update(outcome="factor", value=0., mode="falling",
                         remark=remark)
            set_factor(block, **({
                "outcome": f"above 100, held by {held}", "lower": 100.}
                if held else {"value": 1.2, "lower": 1.19, "upper": 1.21}))

        page = altered(change)[1]
        assert f"Block 1 {words}" in page, words
        assert f"<td>{clamped}</td>" in row_of(page, 1), (held, remark)
        assert "alone: without" not in page

        def three(summary, block):
            change(summary, block)
            summary["blocks"] += [{**block, "id": 98}, {**block, "id": 99}]

        page = altered(three)[1]
        verb = f"are held by {held}" if "is held" in words and held else (
            "are held by the support sym" if remark else "hold by strength")
        assert f"Blocks 1, 98 and 99 {verb}" in page, verb


def check_demand():
    """The largest support of all stages; bolts in rings."""
    def change(summary, block):
        one = block["limit_equilibrium"][-1]
        demand = {"factor": 1.5, "outcome": "support", "force": 9e3,
                  "pressure": 4e3, "bolts": {"roof": 3}}
        block["limit_equilibrium"] = [
            {**one, "stage": "early", "support_demand": demand},
            {**one, "support_demand": {**demand, "force": 8e3}}]

    row = html.unescape(row_of(altered(change)[1], 1))
    assert ("9 kN/m, 4 kPa or 3 bolts of set 'roof' in each ring for 1.5 after "
            "early") in row, row


def check_tried_demand():
    """Support by trials beside that by limit equilibrium, the largest."""
    def change(_, block):
        one = block["safety_factor"][-1]
        demand = {"factor": 1.5, "outcome": "support", "force": 9e3,
                  "lower": 3.9e3, "upper": 4.1e3, "pressure": 4e3,
                  "bolts": {"roof": 1}, "trials": []}
        if is_found:
            block["safety_factor"] = [
                {**one, "stage": "early", "support_demand": demand},
                {**one, "support_demand": {"factor": 1.5, "outcome": "met",
                                           "trials": []}}]
        else:
            one["support_demand"] = {"factor": 1.5, "trials": [],
                                     "outcome": "out of reach"}

    for is_found, words in (
            (True, "9 kN/m, 4 [3.9, 4.1] kPa by trials or 1 bolt of set 'roof' "
             "in each ring for 1.5 after early"),
            (False, "no pressure is enough for 1.5 after")):
        row = html.unescape(row_of(altered(change)[1], 1))
        assert words in row, row


def check_tie():
    """Of stages with equal factors the row has the most dangerous one."""
    def change(_, block):
        limit, = block["limit_equilibrium"]
        factor, = block["safety_factor"]
        set_factor(block, outcome="above 1.2, as wanted", lower=1.2)
        falls = {**limit, "outcome": "factor", "value": 0., "mode": "falling"}
        stable = {**limit, "outcome": "stable", "mode": "stable"}
        del stable["value"]
        block["limit_equilibrium"] = [{**falls, "stage": "early"}, stable]
        block["safety_factor"] = [{**factor, "stage": "early"}, factor]

    row = row_of(altered(change)[1], 1)
    assert all(text in row for text in (
        "0 (falls)", "as wanted after early", "<td>yes</td>")), row


def check_lost():
    """A part that cannot be made is told; the rest and the tables are there."""
    def change(summary, _):
        del summary["bolts"][0]["head"]

    text, page = altered(change)
    assert "no bolts.csv, as" in text and "no section on bolts" in text, text
    assert "What this report lacks" in page and 'id="view"' in page
    assert "<h2 id=blocks>" in page and "<h2 id=bolts>" not in page


def check_unjudged():
    """Factors that were asked for, but of no block."""
    def leave_infinite(summary, _):
        summary["blocks"] = [b for b in summary["blocks"]
                             if {"infinite", "rigid"} & set(b["class"])]

    _, page = altered(leave_infinite)
    assert "they were asked for (Safety factor/Blocks = " in page
    assert "but there is no finite block." in page
    assert "No safety factors were looked for" not in page


def check_taken_away():
    """The view opens while there still is a block with a factor."""
    folder, path = FOLDER / "failed", FOLDER / "failed.html"
    settings = ("Output/Write VTU=true", "Safety factor/Bracket=0.1",
                "Stages/rest/Friction angle override=-1")
    subprocess.run([KEYBLOCK, f"{PRM}/verification/factor_incline.prm",
                    "--output", folder]
                   + [word for s in settings for word in ("--set", s)],
                   check=True, stdout=subprocess.DEVNULL)
    within = FOLDER / "within"  # with one more state, before the block goes
    shutil.copytree(folder, within)
    text = (within / "solution.pvd").read_text()
    first = re.search(r' *<DataSet[^>]*file="rock_0000.vtu"/>\n', text)[0]
    (within / "solution.pvd").write_text(text.replace(
        first, first + first.replace('group="start"', 'group="rest"'), 1))
    start, rest = "before the first stage", "after rest"
    for folder, stages, opens in ((folder, [start, rest], 0),
                                  (within, [start, "in rest", rest], 1),
                                  (FOLDER / "output", [start, rest], 1)):
        subprocess.run([REPORT, folder, "-o", path], check=True,
                       stdout=subprocess.DEVNULL)
        page = path.read_text(encoding="utf-8")
        assert "This report has no" not in page
        meta = json.loads(re.search(r'id="view-meta">(.*?)</script>', page)[1])
        assert (meta["stages"], meta["opens"]) == (stages, opens), meta
        assert page.count('src="data:image/png;base64,') == 2


def check_where():
    """Roof, wall or floor as in blocks.csv, and the same where that is not there.

    Of a slope in a polygon, whose bare sides are no truncated boundaries."""
    folder, path = FOLDER / "slope", FOLDER / "slope.html"
    settings = ("Output/Write VTU=true", "Mesh/Size=20",
                "Safety factor/Method=limit equilibrium")
    subprocess.run([KEYBLOCK, f"{PRM}/verification/slope_crack.prm",
                    "--output", folder]
                   + [word for s in settings for word in ("--set", s)],
                   check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    table = folder / "blocks.csv"
    (place,) = (row["place"] for row in csv.DictReader(
        table.read_text().splitlines()))
    assert place == "floor", place
    for there in "as it is", "another", "":
        if there == "another":
            table.write_text(table.read_text().replace(",floor,", ",roof,"))
        elif not there:
            table.unlink()
        subprocess.run([REPORT, folder, "-o", path], check=True,
                       stdout=subprocess.DEVNULL)
        row = row_of(path.read_text(encoding="utf-8"), 1)
        wanted = "roof" if there == "another" else "floor"
        assert f"<td>{wanted}</td>" in row, (there, row)
    # the water table, which has a place of its own in the legend
    used = folder / "used.prm"
    for level in "none", "1":
        used.write_text(re.sub(r"(subsection Water\n.*?set Level *=)[^\n]*",
                               rf"\1 {level}", used.read_text(), count=1,
                               flags=re.DOTALL))
        subprocess.run([REPORT, folder, "-o", path], check=True,
                       stdout=subprocess.DEVNULL)
        page = path.read_text(encoding="utf-8")
        assert ("water table" in page) == (level == "1"), level
        assert "This report has no" not in page


def check_states():
    """Without a state before the first stage, as of factors of kept states."""
    def change(*_):
        path = FOLDER / "altered" / "solution.pvd"
        path.write_text("\n".join(
            line for line in path.read_text().splitlines()
            if 'group="start"' not in line))

    title = "<h3>Before the first stage</h3>"
    assert title in altered(lambda *_: None)[1]
    page = altered(change)[1]
    assert title not in page and "<figure><img" in page
    assert "No state was written" not in page


def check_pipe():
    """A reader that has gone away is no error."""
    done = subprocess.run(
        f'"{REPORT}" "{FOLDER}/output" -o "{FOLDER}/r.html" | true',
        shell=True, capture_output=True, text=True)
    assert done.stderr == "" and (FOLDER / "r.html").exists(), done.stderr


def main():
    """Exit with 1 at the first case that is not as it should be."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    subprocess.run([KEYBLOCK, f"{PRM}/verification/bolted_incline.prm",
                    "--output", FOLDER / "output", "--set",
                    "Output/Write VTU=true"],
                   check=True, stdout=subprocess.DEVNULL)
    for case in (check_open, check_support, check_moving, check_held,
                 check_demand, check_tried_demand, check_tie, check_lost,
                 check_unjudged, check_taken_away, check_where, check_states,
                 check_pipe):
        case()
        print(f"{case.__name__}: as it should be")


if __name__ == "__main__":
    main()
