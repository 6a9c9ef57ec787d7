# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes the report of a run: reads first, writes last."""
import warnings

from . import page, pictures, plots, style, tables, view
from .geometry import Geometry
from .reading import ReportError, Run


def read_geometry(run):
    """Geometry of the states, or None and a sentence why there is none."""
    try:
        return Geometry(run), ""
    except ReportError as error:
        text = str(error)
        return None, (text if text.startswith("There are no pictures") else
                      f"There are no pictures: {text}")


def make_parts(run, geometry, rows, why):
    """Figures, pictures and view, as far as they can be made."""
    parts = {"view": None, "pictures": [], "why": why, "factors": (None, ""),
             "legend": [], "net": None, "energy": None}
    if geometry is not None:
        parts["view"] = view.pack(geometry, rows)
    if not style.pyplot:
        parts["why"] = " ".join((why, style.WHY_NOT)).strip()
        return parts
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of Matplotlib's layout
        if geometry is not None:
            parts["pictures"] = list(pictures.draw_stages(geometry, rows))
            parts["legend"] = pictures.legend(geometry, rows)
        parts["factors"] = plots.factors(run, rows)
        parts["net"] = (plots.rose if run.is_plane else plots.stereonet)(
            run) or ""
        parts["energy"] = plots.energies(run)
    return parts


def report(folder, path):
    """Write the report of a folder; lines that say what was written."""
    run = Run(folder)
    geometry, why = read_geometry(run)
    rows = tables.block_rows(run, geometry)
    # these the program has written; of older runs there are none
    csvs = {name: (run.folder / name).read_bytes().decode("utf-8")
            for name in ("blocks.csv", "factors.csv")
            if (run.folder / name).exists()}
    csvs["stages.csv"] = tables.stages_csv(run)
    if run.summary.get("bolts"):
        csvs["bolts.csv"] = tables.bolts_csv(run)
    parts = make_parts(run, geometry, rows, why)
    text = page.write_page(run, rows, parts, csvs)
    lines = [parts["why"]] if parts["why"] else []
    files = {path: text, **{path.parent / name: table
                            for name, table in csvs.items()}}
    for file, content in files.items():
        try:
            file.write_bytes(content.encode("utf-8"))
        except OSError as error:
            raise ReportError(f"'{file}' cannot be written: "
                              f"{error.strerror}.") from None
        lines.append(f"{file}  {file.stat().st_size / 1000:.0f} kB")
    return lines
