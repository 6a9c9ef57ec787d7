#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lines of progress on a terminal of 80 columns.

usage: progress.py KEYBLOCK PRM FOLDER CASE

factors: the search for factors tells its block, trial and bracket, on one line that
is gone before the factor is printed.
stage: a stage that a signal stops; what is said of it begins a line of its own.
"""
import fcntl
import os
import pathlib
import re
import signal
import struct
import subprocess
import sys
import termios

KEYBLOCK, PRM, FOLDER, CASE = sys.argv[1:5]
COLUMNS = 80
SCENES = {
    "factors": ("two_wedges", []),
    "stage": ("incline_30", ["Stages/slide/Duration=1e4"])}


def output_of(scene, settings, wanted):
    """What a run writes on a terminal; it is stopped by a signal once wanted
    is there."""
    ours, its = os.openpty()
    fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", 40, COLUMNS, 0, 0))
    with subprocess.Popen(
            [KEYBLOCK, pathlib.Path(PRM) / f"{scene}.prm", "--output", FOLDER]
            + [word for s in settings for word in ("--set", s)],
            stdout=its, stderr=its) as run:
        os.close(its)
        text, is_asked = b"", False
        while True:
            try:
                piece = os.read(ours, 4096)
            except OSError:  # the end, on Linux
                break
            if not piece:
                break
            text += piece
            if wanted and not is_asked and wanted in text:
                run.send_signal(signal.SIGTERM)
                is_asked = True
    os.close(ours)
    return text.decode("utf-8").replace("\r\n", "\n")


def main():
    """Exit with a sentence for what is wrong."""
    scene, settings = SCENES[CASE]
    text = output_of(scene, settings, b"\rStage 2 of 2" if CASE == "stage" else b"")
    drawn = re.findall(r"\r((?:Stage \d|Factor  block \d of)[^\r\n]*)", text)
    assert drawn, text
    assert all(len(line) < COLUMNS for line in drawn), drawn
    shown = [part for line in text.split("\n") for part in line.split("\r")]
    assert all(len(line) <= COLUMNS for line in shown), max(shown, key=len)
    for line in text.split("\n"):
        shown = line.rsplit("\r", 1)[-1]
        assert not re.match(r"Stage \d|Factor  block \d of", shown), line
    if CASE == "stage":
        assert re.search(r"\r *\rSaved  ", text), text
        assert re.match(r"Stage 2 of 2 .*step \d+ of \d+.*  left [\d.]+ (s|min|h)",
                        drawn[-1]), drawn
        return
    searches = [line for line in drawn if re.match(
        r"Factor  block \d of 2 \(id \d+\), trial \d+", line)]
    assert searches, drawn
    assert any("bracket so far [" in line for line in searches), searches
    assert re.search(r"\r *\rFactor  block \d after", text), text


main()
