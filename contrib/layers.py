#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lists the rooms of the source, what each includes, and looks for cycles.

usage: contrib/layers.py

Rooms are the folders of source/ and include/keyblock/, in the order of
source/CMakeLists.txt. Exits with 1 if a file includes a header of a later room,
headers include each other in a circle, a folder is no room, or a file prints
warnings past WarningList (base/warning_list.h), which keeps them for summary.json.
"""
import collections
import re
import sys

from script_tools import ROOT


def rooms_in_order():
    text = (ROOT / "source" / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.findall(r"^(?:add_room|  include)\((\w+)", text, re.MULTILINE)


def includes_of(path):
    """Headers of the project, as room/name.h."""
    return re.findall(r"#include <keyblock/([\w/]+\.h)>",
                      path.read_text(encoding="utf-8"))


def find_cycle(graph):
    """Headers that include each other in a circle, or nothing."""
    done, path = set(), []

    def visit(header):
        if header in path:
            return path[path.index(header):] + [header]
        if header in done:
            return []
        path.append(header)
        for other in graph.get(header, []):
            if found := visit(other):
                return found
        path.pop()
        done.add(header)
        return []

    for header in graph:
        if found := visit(header):
            return found
    return []


def main():
    rooms = rooms_in_order()
    headers = ROOT / "include" / "keyblock"
    faults = [f"{folder.relative_to(ROOT)} is no room of source/CMakeLists.txt"
              for top in (headers, ROOT / "source") for folder in top.iterdir()
              if folder.is_dir() and folder.name not in rooms]
    graph = {}
    for number, room in enumerate(rooms):
        uses, n_lines = collections.Counter(), 0
        files = sorted((headers / room).glob("*.h"))
        files += sorted((ROOT / "source" / room).glob("*.cc"))
        for path in files:
            found = includes_of(path)
            if path.suffix == ".h":
                graph[f"{room}/{path.name}"] = found
            text = path.read_text(encoding="utf-8")
            n_lines += len(text.splitlines())
            if '"Warning' in text and path.name != "warning_list.h":
                faults.append(f"{path.relative_to(ROOT)} prints a warning; give it to a WarningList")
            for other in (include.split("/")[0] for include in found):
                uses[other] += 1
                if rooms.index(other) > number:
                    faults.append(f"{path.relative_to(ROOT)} includes {other}, a later room")
        below = ", ".join(f"{other} {uses[other]}" for other in rooms if uses[other]
                          and other != room)
        print(f"{number + 1:2d} {room:13s}{len(files):3d} files {n_lines:6d} lines; includes "
              f"{below or 'none before it'}")
    if cycle := find_cycle(graph):
        faults.append("a circle of headers: " + " -> ".join(cycle))
    print("\n".join(faults) if faults else "no include of a later room, no circle")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
