# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes the report of a run or a study: reads first, writes last.

A part that fails is left out, and the report says so: the rest is still worth
reading."""
import warnings

from . import (page, page_study, pictures, plots, pyramids, style, tables,
               view)
from .geometry import Geometry
from .reading import ReportError, Run
from .study import Study, is_study


class Attempts:
    """Makes parts of a report, and keeps a sentence for each that fails."""

    def __init__(self):
        self.lost = []

    def __call__(self, name, otherwise, make, *arguments):
        """What a function makes of its arguments; `otherwise` if it fails."""
        try:
            return make(*arguments)
        except Exception as error:  # whatever it is, the rest is made
            self.lost.append(
                f"This report has no {name}, as making that failed "
                f"({type(error).__name__}: {error}); please report it with "
                "summary.json.")
            return otherwise


def read_geometry(run):
    """Geometry of the states, or None and a sentence why there is none."""
    try:
        return Geometry(run), ""
    except ReportError as error:
        text = str(error)
        return None, (text if text.startswith("There are no pictures") else
                      f"There are no pictures: {text}")


def make_parts(run, geometry, rows, why, attempt):
    """Figures, pictures and view, as far as they can be made."""
    parts = {"view": None, "pictures": [], "why": why, "factors": (None, ""),
             "legend": [], "net": None, "energy": None,
             "pyramids": (None, "")}
    if geometry is not None:
        parts["view"] = attempt("view", None, view.pack, geometry, rows)
    if not style.pyplot:
        parts["why"] = " ".join((why, style.WHY_NOT)).strip()
        return parts
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of Matplotlib's layout
        if geometry is not None:
            parts["pictures"] = attempt(
                "pictures of stages", [],
                lambda: list(pictures.draw_stages(geometry, rows)))
            parts["legend"] = attempt("legend of pictures", [],
                                      pictures.legend, geometry, rows)
        parts["factors"] = attempt("figure of factors", (None, ""),
                                   plots.factors, run, rows)
        parts["net"] = attempt(
            "figure of the joints' orientations", None,
            plots.rose if run.is_plane else plots.stereonet, run) or ""
        parts["pyramids"] = attempt("figure of removable joint pyramids",
                                    (None, ""), pyramids.stereonets, run)
        parts["energy"] = attempt("figure of energies", None, plots.energies,
                                  run)
    return parts


def write_files(files):
    """Write texts by path; lines that say so."""
    lines = []
    for file, content in files.items():
        try:
            file.write_bytes(content.encode("utf-8"))
        except OSError as error:
            raise ReportError(f"'{file}' cannot be written: "
                              f"{error.strerror}.") from None
        lines.append(f"{file}  {file.stat().st_size / 1000:.0f} kB")
    return lines


def report(folder, path):
    """Write the report of a folder; lines that say what was written."""
    if is_study(folder):
        return report_of_study(folder, path)
    return report_of_run(folder, path)


def report_of_study(folder, path):
    """Write the page of a study."""
    study, attempt = Study(folder), Attempts()
    text = page_study.write_page(study, attempt)
    lines = [] if style.pyplot else [style.WHY_NOT]
    return lines + write_files({path: text}) + attempt.lost


def report_of_run(folder, path):
    """Write the page of a run, and tables beside it."""
    run, attempt = Run(folder), Attempts()
    geometry, why = attempt("pictures", (None, ""), read_geometry, run)
    rows = attempt("blocks", [], tables.block_rows, run, geometry)
    # these the program has written; of older runs there are none
    csvs = {name: (run.folder / name).read_bytes().decode("utf-8")
            for name in ("blocks.csv", "factors.csv")
            if (run.folder / name).exists()}
    csvs["stages.csv"] = attempt("stages.csv", "", tables.stages_csv, run)
    if run.summary.get("bolts"):
        csvs["bolts.csv"] = attempt("bolts.csv", "", tables.bolts_csv, run)
    parts = make_parts(run, geometry, rows, why, attempt)
    text = page.write_page(run, rows, parts, csvs, attempt)
    lines = [parts["why"]] if parts["why"] else []
    files = {path: text, **{path.parent / name: table
                            for name, table in csvs.items()}}
    return lines + write_files(files) + attempt.lost
