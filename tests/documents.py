#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Looks whether what the documents name is there.

usage: documents.py ROOT

Links of *.md and doc/*.md to files; source files in backticks, as
`contact/law.h`; and functions named beside them, as `step/step.cc`, `advance`.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1]).resolve()
SOURCE = (ROOT, ROOT / "source", ROOT / "include" / "keyblock")


def faults_of(path):
    text = path.read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)#]+)", text):
        if "://" not in target and not (path.parent / target).exists():
            yield f"no file {target}"
    for name, function in re.findall(
            r"`([\w/]+\.(?:h|cc|py|sh|prm))`(?:, `(\w+)`)?", text):
        found = [folder / name for folder in SOURCE if (folder / name).exists()]
        if not found and "/" in name:
            yield f"no file {name}"
        elif not found and name.endswith((".h", ".cc")):
            yield f"no source {name}"
        elif found and function and not re.search(
                rf"\b{function}\b", found[0].read_text(encoding="utf-8")):
            yield f"no {function} in {name}"


def main():
    faults = [f"{path.relative_to(ROOT)}: {fault}"
              for path in [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "doc").glob("*.md"))]
              for fault in faults_of(path)]
    print("\n".join(faults) or "all that is named is there")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
