#!/usr/bin/env python3
"""Compare the limit equilibrium that --validate prints with references.

usage: statics.py KEYBLOCK SCENE REFERENCES FOLDER [--set ...]

A line of the references reads `block | stage | factor | tolerance | mode | words`;
the factor within that share of it (a - where the block is stable), the words,
separated by semicolons, in the block's row, or not in it after a !. All rows must be
named. Nothing may be written.
"""
import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "contrib"))
from statics_table import read_statics  # noqa: E402


def main():
    keyblock, scene, references, folder = sys.argv[1:5]
    # CMake splits lists at semicolons: @ stands for one
    overrides = [text.replace("@", ";") for text in sys.argv[5:]]
    run = subprocess.run([keyblock, "--validate", scene, "--output", folder] + overrides,
                         capture_output=True, text=True)
    print(run.stdout, run.stderr)
    assert run.returncode == 0, f"exit code {run.returncode}"
    assert not os.path.exists(folder), "something was written"
    rows = read_statics(run.stdout)
    lines = [line for line in Path(references).read_text(encoding="utf-8").splitlines()
             if line.strip() and not line.startswith("#")]
    assert lines and len(rows) == len(lines), f"{len(rows)} rows, not {len(lines)}"
    for row, line in zip(rows, lines):
        block, stage, factor, tolerance, mode, words = (s.strip() for s in line.split("|"))
        assert (row.block, row.stage, row.mode) == (int(block), stage, mode), f"{row}\n{line}"
        value = float("inf") if factor == "-" else float(factor)
        assert (row.factor == value
                or abs(row.factor - value) <= float(tolerance) * value), f"{row}\n{line}"
        for word in (w.strip() for w in words.split(";")):
            if word.startswith("!"):
                assert word[1:] not in row.text, f"'{word[1:]}' stands in {row}"
            else:
                assert word in row.text, f"'{word}' is missing in {row}"


if __name__ == "__main__":
    main()
