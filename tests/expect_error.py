#!/usr/bin/env python3
"""Run a scene that cannot be used and look at what is said.

usage: expect_error.py KEYBLOCK FOLDER FRAGMENT ARGUMENT...

Passes if the exit code is 1, the message on standard error is a single line
that contains FRAGMENT, and nothing was written into FOLDER.
"""
import os
import subprocess
import sys

keyblock, folder, fragment = sys.argv[1:4]
run = subprocess.run([keyblock, "--output", folder] + sys.argv[4:],
                     capture_output=True, text=True)
message = run.stderr.strip()
print(message)
assert run.returncode == 1, f"exit code {run.returncode}"
assert message.startswith("Error: ") and message.count("\n") == 0, "not one line"
assert fragment in message, f"'{fragment}' is missing"
assert not os.path.exists(folder), "something was written"
