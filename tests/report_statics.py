#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reports of runs that judge blocks by limit equilibrium alone.

usage: report_statics.py KEYBLOCK REPORT PRM FOLDER

Of two blocks, one of which leans on the other: a block that fails once the other
has gone is said to, one that is not critical has no grey, and nothing is shown of
steps that were not taken.
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
SHAFT = """set Dimension = 3
subsection Domain
  set Corner = -3, -3, -10
  set Size = 6, 6, 10
  set Truncated boundaries = left, right, front, back, bottom
end
subsection Mesh
  set Generator = structured
  set Cells = 6, 6, 10
end
subsection Excavations
  set Names = shaft
  subsection shaft
    set Shape = box
    set Corner = -1, -1, -8
    set Size = 2, 2, 8
    set Stage = sink
  end
end
subsection Materials
  set Names = rock
end
subsection Initial state
  set Gravity = 0; 0; -9.81
end
subsection Supports
  set Names = base
  subsection base
    set Boundaries = bottom
  end
end
subsection Stages
  set Names = sink
  subsection sink
    set Kind = quasi-static
    set Maximum steps = 1
  end
end
"""


def report_of(friction):
    """The page of a run with a friction angle below the lower block."""
    folder, path = FOLDER / f"output_{friction}", FOLDER / f"{friction}.html"
    settings = ["Safety factor/Method=limit equilibrium",
                "Safety factor/Blocks=critical",
                "Safety factor/Critical factor=1.01", "Output/Write VTU=true",
                f"Joints/lower/Friction angle={friction}"]
    subprocess.run([KEYBLOCK, f"{PRM}/verification/factor_group.prm",
                    "--output", folder]
                   + [word for s in settings for word in ("--set", s)],
                   check=True, stdout=subprocess.DEVNULL)
    subprocess.run([REPORT, folder, "-o", path], check=True,
                   stdout=subprocess.DEVNULL)
    page = path.read_text(encoding="utf-8")
    assert "This report has no" not in page
    return page


def blocks_of(page):
    """What the view says of blocks."""
    return json.loads(re.search(r'id="view-meta">(.*?)</script>',
                                page)[1])["blocks"]


def row_of(page, block):
    """The row of a block in the table of blocks."""
    return html.unescape(re.search(rf'<tr data-block="{block}">(.*?)</tr>',
                                   page)[1])


def check_followers():
    """A block that fails only once another has gone."""
    page = report_of(20)
    blocks = blocks_of(page)
    assert (blocks["1"]["state"], blocks["2"]["state"]) == (
        "fails", "follows"), blocks
    assert "Once others have gone fail, too: block 2." in page
    assert "1 of 2 blocks has a factor below 1, and 1 more fails" in page
    summary = json.loads((FOLDER / "output_20" / "summary.json").read_text())
    limit = summary["blocks"][1]["limit_equilibrium"][-1]
    then = limit["once_gone"]
    assert (limit["outcome"], then["blocks"], then["mode"]) == (
        "stable", [1], "sliding on upper"), limit
    assert abs(then["value"] / 0.6304 - 1.) < 1e-4, then
    row = row_of(page, 2)
    assert "stable; 0.6304 once block 1 has gone" in row, row
    assert "sliding on upper, once others have gone" in row, row
    assert len(re.findall(r"<li>Block \d: ", page)) == 2


def check_not_critical():
    """Blocks that limit equilibrium has judged, but written no result of."""
    page = report_of(35)
    for n, block in blocks_of(page).items():
        assert block["state"] == "passed", block
        assert "at least 1.01, not critical" in row_of(page, n)
    assert "0 of 2 blocks have a factor below 1." in page
    assert "The run was asked for no factors" not in page


def check_stable():
    """A block that is stable by limit equilibrium is said to be no more."""
    folder, path = FOLDER / "output_20", FOLDER / "stable.html"
    before = (folder / "summary.json").read_text()
    summary = json.loads(before)
    limit = summary["blocks"][0]["limit_equilibrium"][-1]
    limit.update(outcome="stable", mode="stable")
    del limit["value"]
    (folder / "summary.json").write_text(json.dumps(summary))
    subprocess.run([REPORT, folder, "-o", path], check=True,
                   stdout=subprocess.DEVNULL)
    (folder / "summary.json").write_text(before)
    page = path.read_text(encoding="utf-8")
    assert blocks_of(page)["1"]["state"] == "stable", blocks_of(page)["1"]
    assert "<span>stable by limit equilibrium</span>" in re.sub(
        "<i.*?</i>", "", page)
    assert "</i>immovable, or above" not in page
    # of none and one is spoken as people do
    for n, words in ((0, "The scene has no finite blocks. "),
                     (1, "1 finite block, exposed at some stage. ")):
        kept = [b for b in summary["blocks"] if "infinite" in b["class"]
                or b["id"] <= n]
        (folder / "summary.json").write_text(json.dumps(
            {**summary, "blocks": kept}))
        subprocess.run([REPORT, folder, "-o", path], check=True,
                       stdout=subprocess.DEVNULL)
        page = path.read_text(encoding="utf-8")
        assert words in page and not re.search(r"\b1 blocks|\b0 of 0", page)
    (folder / "summary.json").write_text(before)


def check_ground():
    """In 3D what is dug is seen without the ground around it."""
    folder, path = FOLDER / "shaft", FOLDER / "shaft.html"
    (FOLDER / "shaft.prm").write_text(SHAFT)
    subprocess.run([KEYBLOCK, FOLDER / "shaft.prm", "--output", folder],
                   check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    used = folder / "used.prm"
    for names, side, surface in (
            ("shaft", "the excavation's", 4 * 16 + 4),
            # as if nothing were dug: all that is free, the ground with it
            ("", "its free", 4 * 16 + 4 + 36)):
        used.write_text(re.sub("(subsection Excavations.*?set Names *=)[^\n]*",
                               rf"\1 {names}", used.read_text(),
                               count=1, flags=re.DOTALL))
        subprocess.run([REPORT, folder, "-o", path], check=True,
                       stdout=subprocess.DEVNULL)
        page = path.read_text(encoding="utf-8")
        assert f"is seen from {side} side only." in page
        meta = json.loads(re.search(r'id="view-meta">(.*?)</script>', page)[1])
        # two triangles of three corners for each face
        assert meta["arrays"]["triangles"][2] == 6 * surface, (
            names, meta["arrays"]["triangles"][2] / 6)
        assert "This report has no" not in page
        # before the first stage what will be dug is seen, pale
        assert ("still to be dug" in page) == bool(names), names
    assert meta["inside"]["along"][2] == -1., meta["inside"]


def check_no_steps():
    """What no step has computed is not shown."""
    page = report_of(20)
    for text in ("unbalanced ratio", "converged", "sticking", "moved [mm]</th>",
                 "<h2 id=energy>", "by displacement"):
        assert text not in page, text
    with open(FOLDER / "stages.csv", encoding="utf-8", newline="") as file:
        row, = csv.DictReader(file)
    assert row["stage"] == "rest" and row["cells"] == "79", row
    assert not any(row[name] for name in (
        "converged", "sticking points", "energy residual (J)")), row


shutil.rmtree(FOLDER, ignore_errors=True)
FOLDER.mkdir(parents=True)
for case in (check_followers, check_not_critical, check_stable, check_ground, check_no_steps):
    case()
    print(f"{case.__name__}: as it should be")
