#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lists the classes of the source by size, and what is too large to read at once.

usage: contrib/classes.py [--number 20]

Functions and members are those declared in a class's body, in headers and
sources, not those of its bases. About 25 functions or 15 members are a sign to
look, not a fault. Exits with 1 if a file has more than 800 lines, or a function
more than 100, but for lists of entries (declare) and the files named below,
whose reasons stand there.
"""
import re
import sys

from script_tools import ROOT, make_parser

MOST_LINES, MOST_LINES_OF_FUNCTION = 800, 100


def without_comments(text):
    text = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)
    text = re.sub(r"/\*.*?\*/", lambda m: "\n" * m[0].count("\n"), text, flags=re.DOTALL)
    return re.sub(r"//[^\n]*", "", text)


def body_from(text, brace):
    """The text between a brace and the one that closes it."""
    depth = 0
    for i in range(brace, len(text)):
        depth += (text[i] == "{") - (text[i] == "}")
        if depth == 0:
            return text[brace + 1:i]
    return text[brace + 1:]


def declarations(body):
    """What stands in a class itself, not in the bodies of its functions."""
    depth, at, found = 0, 0, []
    for i, letter in enumerate(body):
        if letter == "{":
            depth += 1
        elif letter == "}":
            depth -= 1
            if depth == 0 and body[i + 1:].lstrip()[:1] not in (";", ","):
                found.append(body[at:i + 1])
                at = i + 1
        elif letter == ";" and depth == 0:
            found.append(body[at:i])
            at = i + 1
    return found


def list_classes(text):
    """Names, functions and members of the classes in a text."""
    for match in re.finditer(r"\b(?:class|struct)\s+([\w:<>]+)\s*(?:final\s*)?(?::[^;{}]*)?\{", text):
        functions, members = set(), 0
        for piece in declarations(body_from(text, match.end() - 1)):
            piece = re.sub(r"\b(public|private|protected)\s*:", "", piece).strip()
            head = piece.split("{")[0].split("=")[0]
            if not piece or re.match(r"(using|friend|class|struct|enum|static constexpr|template\s+class)\b", piece):
                continue
            name = re.search(r"(~?\w+|operator\S+)\s*\(", re.sub(r"template\s*<[^>]*>", "", head))
            if name and not re.match(r"std::function", head):
                functions.add(name[1])
            else:
                members += 1 + head.count(",") * ("<" not in head)
        yield match[1], len(functions), members


def longest_function(text):
    """Lines of the longest body that starts a line of its own, and its line."""
    longest = (0, 0)
    for match in re.finditer(r"^( {2}| {4})\{$", text, re.MULTILINE):
        before = text[:match.start()].rstrip().rsplit("\n", 1)[-1]
        function = text[:match.start()].rstrip().rsplit("\n\n", 1)[-1]
        if not re.search(r"\)( const)?( override)?$", before) or "::declare(" in function:
            continue
        n = body_from(text, match.end() - 1).count("\n")
        longest = max(longest, (n, text[:match.start()].count("\n") + 1))
    return longest


def main():
    parser = make_parser(__doc__)
    parser.add_argument("--number", type=int, default=20)
    options = parser.parse_args()
    classes, faults = [], []
    for top in ("include/keyblock", "source"):
        for path in sorted((ROOT / top).rglob("*")):
            if path.suffix not in (".h", ".cc"):
                continue
            name = str(path.relative_to(ROOT))
            text = path.read_text(encoding="utf-8")
            n_lines = text.count("\n")
            if n_lines > MOST_LINES:
                faults.append(f"{name} has {n_lines} lines")
            code = without_comments(text)
            n, line = longest_function(code)
            if n > MOST_LINES_OF_FUNCTION:
                faults.append(f"{name}:{line} is a function of {n} lines")
            classes += [(*entry, name) for entry in list_classes(code)]
    print(f"{'functions':>9} {'members':>8}  class")
    for name, n_functions, n_members, file in sorted(classes, key=lambda c: -c[1])[:options.number]:
        print(f"{n_functions:9} {n_members:8}  {name}  ({file})")
    for fault in faults:
        print("Fault:", fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
