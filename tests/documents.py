#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Looks whether what the documents name is there.

usage: documents.py ROOT

Links of *.md, doc/*.md and doc/manual/*.md to files; files in backticks, as `contact/law.h` or
`contrib/fuzz.py SCENE.prm`; functions named beside them, as `step/step.cc`,
`advance`; bare names of documents, as doc/theory.md. In doc/theory.md every
displayed equation has one number, from 1 on in order, and every number that the
text, or a comment that names the theory, refers to is that of an equation; the
same for its sections. The maps of the rooms list those of source/CMakeLists.txt.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1]).resolve()
THEORY = ROOT / "doc" / "theory.md"
MAPS = (ROOT / "doc" / "main_page.md", ROOT / "doc" / "reading.md")
# headers and sources are named without these
SOURCE = (ROOT, ROOT / "source", ROOT / "include" / "keyblock")
DOCUMENTS = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "doc").glob("*.md")),
             *sorted((ROOT / "doc" / "manual").glob("*.md"))]

FILE = re.compile(r"`([\w/.-]+\.(?:h|cc|py|sh|prm|md|cmake))(?: [^`]*)?`"
                  r"(?:,\s+`(\w+)`)?")
# equation 8, equations 1 to 6, eq. 14, equation (8); (8) alone in the theory
EQUATION = re.compile(r"\b(?:[Ee]quations?|[Ee]qs?\.)\s+\(?(\d+[a-z]?)\)?"
                      r"(?:\s*(?:to|and|-|–)\s*\(?(\d+[a-z]?)\)?)?")
BARE_NUMBER = re.compile(r"(?<![\w\]])\((\d{1,2}[a-z]?)\)")
SECTION = re.compile(r"\b[Ss]ections?\s+(\d+)")


def files_in(path, text):
    for target in re.findall(r"\]\(([^)#]+)", text):
        if "://" not in target and not (path.parent / target).exists():
            yield f"no file {target}"
    for name in re.findall(r"(?<![\w/`(])doc/\w+\.md", text):
        if not (ROOT / name).exists():
            yield f"no file {name}"
    for name, function in FILE.findall(text):
        found = [folder / name for folder in SOURCE if (folder / name).exists()]
        if not found and "/" in name:
            yield f"no file {name}"
        elif not found and name.endswith((".h", ".cc")):
            yield f"no source {name}"
        elif found and function and not re.search(
                rf"\b{function}\b", found[0].read_text(encoding="utf-8")):
            yield f"no {function} in {name}"


def equations_of(text):
    """Their numbers in order, None for one without or with several."""
    numbers = [re.findall(r"\\tag\{(\w+)\}", display)
               for display in re.findall(r"\$\$(.+?)\$\$", text, re.DOTALL)]
    return [tags[0] if len(tags) == 1 else None for tags in numbers]


def without_code_and_math(text):
    text = re.sub(r"```.*?```|\$\$.*?\$\$", " ", text, flags=re.DOTALL)
    return re.sub(r"`[^`\n]*`|\$[^$]*\$", " ", text)


def references_in(text, equations, sections):
    """Numbers in a text about the theory that are not there."""
    for numbers in EQUATION.findall(text):
        for number in filter(None, numbers):
            if number not in equations:
                yield f"no equation {number}"
    for number in SECTION.findall(text):
        if number not in sections:
            yield f"no section {number}"


def faults_of_theory(text):
    equations = equations_of(text)
    wanted = [str(n) for n in range(1, len(equations) + 1)]
    for found, number in zip(equations, wanted):
        if found != number:
            yield f"equation {number} has the number {found}"
    if text.count("\\tag{") > len(equations):
        yield "an equation number outside of $$...$$"
    sections = re.findall(r"^## (\d+)\.", text, re.MULTILINE)
    plain = without_code_and_math(text)
    yield from references_in(plain, equations, sections)
    for number in BARE_NUMBER.findall(plain):
        if number not in equations:
            yield f"no equation ({number})"


def comments_on_theory():
    """Where sources refer to the theory: the file and what stands behind."""
    for folder in ("source", "include", "tests", "contrib"):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (".h", ".cc", ".py"):
                lines = path.read_text(encoding="utf-8").splitlines()
                text = " ".join(re.sub(r"^\s*(//+|\*|#)?\s*", "", line)
                                for line in lines)
                for place in re.findall(
                        r"\btheory(?:\.md)?, ((?:section|equation|eq)[^;)]{1,20})", text):
                    yield path, place


def faults_of_maps():
    text = (ROOT / "source" / "CMakeLists.txt").read_text(encoding="utf-8")
    rooms = re.findall(r"^(?:add_room|  include)\((\w+)", text, re.MULTILINE)
    for path in MAPS:
        listed = re.findall(r"^\| `(\w+)` \|", path.read_text(encoding="utf-8"),
                            re.MULTILINE)
        if listed != rooms:
            yield f"{path.relative_to(ROOT)}: the rooms are {', '.join(rooms)}"


def main():
    faults = [f"{path.relative_to(ROOT)}: {fault}"
              for path in DOCUMENTS
              for fault in files_in(path, path.read_text(encoding="utf-8"))]
    theory = THEORY.read_text(encoding="utf-8")
    faults += [f"doc/theory.md: {fault}" for fault in faults_of_theory(theory)]
    faults += faults_of_maps()
    equations = equations_of(theory)
    sections = re.findall(r"^## (\d+)\.", theory, re.MULTILINE)
    faults += [f"{path.relative_to(ROOT)}: {fault} in doc/theory.md"
               for path, place in comments_on_theory()
               for fault in references_in(place, equations, sections)]
    print("\n".join(faults) or "all that is named is there")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
