#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reports of a plane scene and of a wedge, by contrib/keyblock-report.

usage: report.py KEYBLOCK REPORT PRM FOLDER CASE

plane, wedge, bolts: the tables carry the numbers of summary.json, those that the run
wrote are copied as they are, the page has all its parts, loads nothing from elsewhere and is of a sensible size; a Chromium, if
there is one, opens it without an error on the console and shows the view.
study: the page of a study has its probabilities, figures, variables and settings.
poor: without VTU files, used.prm or joints.csv there is a report with a sentence
that says what is missing; of a folder without a run there is none, and what was
there stays.
"""
import csv
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

KEYBLOCK, REPORT, PRM, FOLDER, CASE = sys.argv[1:6]
PRM, FOLDER = pathlib.Path(PRM), pathlib.Path(FOLDER)
SCENES = {
    "plane": ("tutorial/joint_network", [
        "Safety factor/Blocks=all", "Stages/Names=dig, wait",
        "Stages/wait/Kind=quasi-static", "Output/Write VTU=true"]),
    "wedge": ("verification/wedge_3d", [
        "Safety factor/Bracket=0.05", "Safety factor/Wanted=1.5",
        "Safety factor/Wanted by=strength reduction",
        "Output/Write VTU=true"]),
    "bolts": ("verification/bolted_incline", ["Output/Write VTU=true"]),
    "poor": ("verification/factor_incline", [
        "Safety factor/Bracket=0.1", "Output/Write VTU=false"])}
# what would make a browser load something from elsewhere
OUTSIDE = (r"""(?:src|href|data|poster|action)\s*=\s*["']?\s*(?:https?:)?//""",
           r"""url\(\s*["']?\s*(?:https?:)?//""",
           r"""@import\s""", r"""\bimport\s*\(?\s*["'](?:https?:)?//""",
           r"""\bfrom\s*["'](?:https?:)?//""", r"""<link[^>]+stylesheet""")


def run_scene(folder, *more):
    """Run the scene of the case with more settings; its summary."""
    scene, settings = SCENES[CASE]
    subprocess.run([KEYBLOCK, PRM / f"{scene}.prm", "--output", folder]
                   + [word for s in (*settings, *more) for word in ("--set", s)],
                   check=True, stdout=subprocess.DEVNULL)
    return json.loads((folder / "summary.json").read_text())


def make_report(folder, path):
    """Make a report that has to succeed; what the script says, and the page."""
    done = subprocess.run([REPORT, folder, "-o", path], capture_output=True,
                          text=True)
    assert done.returncode == 0 and not done.stderr, done.stderr
    return done.stdout, path.read_text(encoding="utf-8")


def rows_of(path):
    """The rows of a CSV file."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def finite_blocks(summary):
    """Blocks that could move, by number."""
    return {b["id"]: b for b in summary["blocks"]
            if not {"infinite", "rigid"} & set(b["class"])}


def assert_demand(row, demand):
    """The support that the wanted factor asks for."""
    force, = (value for title, value in row.items()
              if title.startswith("support (N"))
    assert row["support for factor"] == "" if demand is None else (
        float(row["support for factor"]) == demand["factor"])
    if demand and demand["outcome"] == "support":
        assert float(force) == demand["force"]
        assert float(row["support pressure (Pa)"]) == demand["pressure"]
    elif demand and demand["outcome"] == "out of reach":
        assert force == "out of reach"


def assert_tried_demand(row, demand):
    """The same by trials."""
    assert row["support by trials"] == (demand or {}).get("outcome", "")
    force, = (value for title, value in row.items()
              if title.startswith("support by trials (N"))
    for text, key in ((force, "force"),
                      (row["pressure by trials (Pa)"], "pressure"),
                      (row["lower pressure (Pa)"], "lower"),
                      (row["upper pressure (Pa)"], "upper")):
        assert float(text or 0.) == (demand or {}).get(key, 0.), (key, row)


def assert_tables(summary, folder):
    """Every number of the tables is that of summary.json."""
    blocks = finite_blocks(summary)
    for name in ("blocks.csv", "factors.csv"):
        written = (FOLDER / "output" / name).read_bytes()
        assert written == (folder / name).read_bytes(), "not the run's own"
        assert written.count(b"\n") == written.count(b"\r\n") > 0, name
    rows = rows_of(folder / "blocks.csv")
    assert sorted(int(r["block"]) for r in rows) == sorted(blocks)
    for row in rows:
        block = blocks[int(row["block"])]
        per = " per m" if summary["scene"]["dimension"] == 2 else ""
        assert float(row[f"volume (m3{per})"]) == block.get("exact_volume",
                                                            block["volume"])
        assert float(row[f"weight (N{per})"]) == block.get("exact_weight",
                                                           block["weight"])
        assert (row["removable"] == "yes") == block["removable"]
        assert row["class"] == block["class"][-1]
        assert set(row["joints"].split()) == set(block["joint_areas"])
        assert bool(row["exposed since"]) == ("exposed_stage" in block)
        assert (float(row[f"free area (m2{per})"] or 0.) > 0.) == (
            "exposed_stage" in block)
    found = rows_of(folder / "factors.csv")
    wanted = [(n, f) for n, b in blocks.items()
              for f in b.get("safety_factor", [])]
    assert wanted and len(found) == len(wanted)
    for row, (n, factor) in zip(found, wanted):
        assert (int(row["block"]), row["stage"], row["outcome"]) == (
            n, factor["stage"], factor["outcome"])
        for end in ("lower", "upper"):
            assert float(row[end] or 0.) == factor.get(end, 0.), (end, row)
        limit = next(x for x in blocks[n]["limit_equilibrium"]
                     if x["stage"] == factor["stage"])
        assert row["limit equilibrium mode"] == limit["mode"]
        assert row["remark"] == limit["remark"]
        assert row["limit equilibrium"] == "stable" or float(
            row["limit equilibrium"]) == limit["value"]
        assert_demand(row, limit.get("support_demand"))
        assert_tried_demand(row, factor.get("support_demand"))
        if factor["outcome"] == "value":
            assert float(row["factor"]) == factor["value"]
    stages = rows_of(folder / "stages.csv")
    assert [r["stage"] for r in stages] == [s["name"] for s in
                                            summary["stages"]]
    for row, stage in zip(stages, summary["stages"]):
        assert int(row["steps"]) == stage["steps"]
        assert float(row["largest displacement (m)"]) == stage[
            "max_displacement"]
        assert float(row["energy residual (J)"]) == stage["energy"]["residual"]


def assert_bolts(summary, page):
    """The bolts of the run are in their table, and in the page by set."""
    rows, bolts = rows_of(FOLDER / "bolts.csv"), summary["bolts"]
    assert len(rows) == len(bolts) > 0
    for row, bolt in zip(rows, bolts):
        assert row["set"] == bolt["set"]
        assert row["governed by"] == bolt.get("governed_by", "")
        assert float(row["largest axial force (N)"]) == bolt[
            "largest_axial_force"]
        assert float(row["head y (m)"]) == bolt["head"][1]
    section = re.search(r"<h2 id=bolts>.*?</table>", page, re.DOTALL)[0]
    most = 1e-3 * max(b["largest_axial_force"] for b in bolts)
    shown = [float(x) for x in re.findall(r"<td class=n>([\d.]+)<", section)]
    assert any(abs(x - most) <= 1e-3 * most for x in shown), (most, shown)


def assert_page(summary, page):
    """What was computed stands in the page, which needs nothing from elsewhere."""
    for pattern in OUTSIDE:
        hit = re.search(pattern, page)
        assert not hit, f"{hit[0]!r} in {page[hit.start() - 80:hit.end() + 80]}"
    assert f"<h1>{summary['scene']['title']}</h1>" in page
    assert summary["program"]["commit"] in page
    assert summary["scene"]["digest"] in page
    assert "(joints are in joints.csv)" in page
    for n, block in finite_blocks(summary).items():
        row = re.search(rf'<tr data-block="{n}">(.*?)</tr>', page)[1]
        volume = block.get("exact_volume", block["volume"])
        shown = [float(x) for x in re.findall(r">([\d.]+(?:e-?\d+)?)\*?<", row)]
        assert any(abs(x - volume) <= 1e-3 * volume for x in shown), (n, shown)
        assert ("hidden" in row) == ("exposed_stage" not in block)
        values = [f["value"] for f in block.get("safety_factor", [])
                  if f["outcome"] == "value"]
        if values:
            found = re.search(r"([\d.]+)&nbsp;\[", row)
            assert abs(float(found[1]) - min(values)) < 1e-3 * min(values)
    for stage in summary["stages"]:
        assert f"<h3>{stage['name']}</h3>" in page


def assert_pictures(summary, page, n_states):
    """A picture for each state, figures, and a view with its data."""
    n_pictures = page.count('src="data:image/png;base64,')
    assert n_pictures == n_states, n_pictures
    assert page.count("<svg") >= 2
    meta = json.loads(re.search(r'id="view-meta">(.*?)</script>', page)[1])
    assert len(meta["stages"]) == n_states
    assert {int(n) for n in meta["blocks"]} == set(finite_blocks(summary))
    assert meta["arrays"]["triangles"][2] > 0


def open_in_browser(path):
    """Open the page from file:// where there is a Chromium; look at its view."""
    browser = shutil.which("chromium") or shutil.which("chromium-browser")
    if not browser:
        print("skipped: there is no Chromium to open the page with (package "
              "chromium)")
        return
    with tempfile.TemporaryDirectory() as profile:
        done = subprocess.run(
            [browser, "--headless", "--no-sandbox", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", f"--user-data-dir={profile}",
             "--enable-logging=stderr", "--window-size=1200,900",
             "--virtual-time-budget=10000", "--dump-dom",
             path.resolve().as_uri()], capture_output=True, text=True,
            timeout=100)
    console = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    assert not console, "\n".join(console)
    assert re.search(r'<div id="canvas">\s*<canvas', done.stdout), \
        "the view is not there"
    name = re.search(r'id="stage-name">([^<]*)<', done.stdout)[1]
    assert name.startswith("after "), name
    print(f"opened in {browser}: the view is there, {name}")


def check(n_states):
    """The report of a good run."""
    folder, path = FOLDER / "output", FOLDER / "report.html"
    summary = run_scene(folder)
    text, page = make_report(folder, path)
    print(text.strip())
    assert_tables(summary, FOLDER)
    assert_page(summary, page)
    assert_pictures(summary, page, n_states)
    size = path.stat().st_size
    assert 7e5 < size < 3e6, size  # the script of the view has 0.73 MB
    if CASE == "wedge":  # closed form of the scene's head; the free face is up
        row, = rows_of(FOLDER / "blocks.csv")
        assert float(row["lower"]) < 0.877022 < float(row["upper"]), row
        assert row["place"] == "floor"
        check_pyramids()
    if CASE == "bolts":
        assert_bolts(summary, page)
    open_in_browser(path)


PYRAMIDS = """
import sys
sys.path.insert(0, sys.argv[1])
from report.pyramids import find_removable
from report.reading import Run
run = Run(sys.argv[2])
*_, told, by_program = find_removable(run)
del run.summary["block_theory"]
*_, found, otherwise = find_removable(run)
assert by_program and not otherwise and told["roof"], told
for face, factors in told.items():
    assert factors.keys() == found[face].keys(), (face, factors, found)
    for code, factor in factors.items():  # infinite: stable
        assert (factor == found[face][code]
                or abs(factor - found[face][code]) < 1e-5), (face, code)
"""


def check_pyramids():
    """Removable pyramids of four sets: computed by the report as the program does."""
    scene, folder = FOLDER / "pyramids.prm", FOLDER / "pyramids"
    planes = {"A": (62, 40, 30), "B": (58, 160, 25), "C": (65, 280, 35),
              "D": (20, 100, 20)}
    scene.write_text("set Dimension = 3\n")
    settings = ["Domain/Size=4, 4, 4", "Mesh/Generator=gmsh", "Mesh/Size=2",
                "Joints/Names=" + ", ".join(planes), "Materials/Names=rock",
                "Safety factor/Method=limit equilibrium",
                "Block theory/Report=true"]
    settings += [f"Joints/{name}/{key}={value}"
                 for name, plane in planes.items() for key, value in zip(
                     ("Dip", "Dip direction", "Friction angle", "Point"),
                     (*plane, "2, 2, 2"))]
    subprocess.run([KEYBLOCK, scene, "--output", folder] + [
        word for s in settings for word in ("--set", s)], check=True,
        stdout=subprocess.DEVNULL)
    _, page = make_report(folder, FOLDER / "pyramids.html")
    assert "as the program has found" in page and ">0011</text>" in page
    # (by the interpreter of the report, which has what that needs)
    subprocess.run(["/usr/bin/python3", "-c", PYRAMIDS,
                    pathlib.Path(REPORT).resolve().parent, folder], check=True)


def check_poor():
    """Reports of less than a run leaves, and none of a wrong folder."""
    folder, path = FOLDER / "output", FOLDER / "report.html"
    summary = run_scene(folder)
    text, page = make_report(folder, path)
    assert "no pictures" in text and "Write VTU = false" in page
    assert_tables(summary, FOLDER)
    assert_page(summary, page)
    assert "data:image/png" not in page and 'id="view"' not in page
    for name in ("used.prm", "joints.csv", "history.csv"):
        (folder / name).unlink(missing_ok=True)
    _, page = make_report(folder, path)
    assert "There is no used.prm" in page
    before = path.read_bytes()
    (FOLDER / "empty").mkdir(exist_ok=True)
    (FOLDER / "damaged").mkdir(exist_ok=True)
    (FOLDER / "damaged" / "summary.json").write_text('{"scene": ')
    for wrong in ("nothing", "empty", "damaged"):
        done = subprocess.run([REPORT, FOLDER / wrong, "-o", path],
                              capture_output=True, text=True)
        assert done.returncode == 1, wrong
        assert done.stdout == "" and done.stderr.count("\n") == 1, done.stderr
        assert done.stderr.startswith("keyblock-report: "), done.stderr
        print(done.stderr.strip())
    assert path.read_bytes() == before
    # a block that fails at the lowest factor has no value, but where it fails
    summary = run_scene(folder, "Joints/base/Friction angle=2")
    factor, = finite_blocks(summary)[1]["safety_factor"]
    assert factor["outcome"] == "falls freely" and factor["upper"] > 0., factor
    make_report(folder, path)
    assert_tables(summary, FOLDER)


def check_study():
    """The page of a study, and of one in which no block can move."""
    folder, path = FOLDER / "output", FOLDER / "report.html"
    scene = PRM / "verification" / "study_incline.prm"
    subprocess.run([KEYBLOCK, scene, "--study", "--output", folder, "--set",
                    "Study/Samples=200"], check=True,
                   stdout=subprocess.DEVNULL)
    text, page = make_report(folder, path)
    print(text.strip())
    results = json.loads((folder / "study.json").read_text())
    for pattern in OUTSIDE:
        assert not re.search(pattern, page), pattern
    assert "<h1>Probability that a block slides</h1>" in page
    p = results["probability"]
    band = "</td><td class=n>".join((f"{p['value']:.4g}", "{:.4g} – {:.4g}"
                                     .format(p["lower"], p["upper"])))
    # some block, block 1, and the last point of the convergence
    assert page.count(f"<td class=n>{band}</td>") == 3, band
    # the failed area is that of the one block: no histogram of rounding errors
    assert page.count("<svg") == 3
    volume = results["failed_volume"]
    assert volume["greatest"] - volume["least"] < 1e-12, volume
    assert f"is the same in all: {volume['mean']:.4g}.</p>" in page
    for name in ("probability", "factors", "convergence", "variables",
                 "settings"):
        assert f"<h2 id={name}>" in page and f'href="#{name}"' in page
    variable, = results["variables"]
    assert f"<code>{variable['entry']}</code>" in page
    assert f"<td class=n>{variable['rank_correlation']:.3g}</td>" in page
    assert "<code>Study/Samples</code></td><td>200</td><td>1000" in page
    assert "This report has no" not in page and "joints.csv" not in page
    # nothing can slide where cohesion is large enough
    for key in ("least_factor", "failed_volume"):
        results.pop(key, None)
    results["immovable_share"] = 1.
    (folder / "study.json").write_text(json.dumps(results))
    _, page = make_report(folder, path)
    assert "In no sample a block can move." in page and "has no" not in page
    results.update(immovable_share=0.75, held_share=0.25)
    (folder / "study.json").write_text(json.dumps(results))
    _, page = make_report(folder, path)
    assert "In 25 % every block holds at the highest factor tried" in page
    assert "No sample has a least factor below the highest" in page
    (folder / "study.json").write_text("{")
    done = subprocess.run([REPORT, folder, "-o", path], capture_output=True,
                          text=True)
    assert done.returncode == 1 and "study.json' is damaged" in done.stderr


shutil.rmtree(FOLDER, ignore_errors=True)
FOLDER.mkdir(parents=True)
if CASE == "poor":
    check_poor()
elif CASE == "study":
    check_study()
else:
    check({"plane": 3, "wedge": 2, "bolts": 2}[CASE])
