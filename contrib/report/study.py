# SPDX-License-Identifier: LGPL-2.1-or-later
"""The output folder of a study: study.json, and the entries of used.prm."""
import json
import pathlib
import time

from .reading import ReportError, read_entries


def is_study(folder):
    """Whether the later results of a folder are those of a study."""
    folder = pathlib.Path(folder)
    study, run = folder / "study.json", folder / "summary.json"
    return study.exists() and not (
        run.exists() and run.stat().st_mtime > study.stat().st_mtime)


class Study:
    """The results in the output folder of one study."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        path = self.folder / "study.json"
        try:
            self.results = json.loads(path.read_text(encoding="utf-8"))
        except OSError as error:
            raise ReportError(f"'{path}' cannot be read ({error.strerror})."
                              ) from None
        except ValueError as error:
            raise ReportError(f"'{path}' is damaged ({error}); start the study "
                              "again, it goes on where it was.") from None
        if not isinstance(self.results, dict) or not {
                "samples", "probability", "convergence",
                "variables"} <= set(self.results):
            raise ReportError(f"'{path}' lacks samples or their probability; "
                              "is it that of a study of keyblock?")
        self.entries, self.changed = read_entries(self.folder)
        self.summary = {}  # the sections that runs have in common look here
        self.written = time.localtime(path.stat().st_mtime)

    @property
    def is_plane(self):
        """Whether volumes are areas."""
        return self.entries.get("Dimension", "2") == "2"

    @property
    def title(self):
        """The title of the scene, or its name."""
        return (self.entries.get("Title")
                or pathlib.Path(self.results.get("scene", "study")).stem)
