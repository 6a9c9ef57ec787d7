# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of the Python module share."""
import contextlib
import math
import os
import sys
import tempfile

FAULTS = []


def check(what, found, wanted, relative=0., absolute=0.):
    """Note a fault unless the number found is what is wanted."""
    if not (found == wanted or
            math.isfinite(found) and abs(found - wanted) <= absolute + relative * abs(wanted)):
        FAULTS.append(f"{what} is {found}, not {wanted}")


def check_that(what, is_true):
    """Note a fault unless it is true."""
    if not is_true:
        FAULTS.append(f"it is not so that {what}")


def check_raises(kind, words, action):
    """Note a fault unless the action raises an error with all of the words."""
    try:
        action()
    except kind as error:
        for word in words:
            check_that(f"'{error}' has '{word}'", word in str(error))
        check_that(f"'{error}' is one line", "\n" not in str(error))
    else:
        FAULTS.append(f"nothing was raised for {words}")


@contextlib.contextmanager
def captured():
    """What this process, libraries included, prints: a list of one text."""
    sys.stdout.flush()
    with tempfile.TemporaryFile("w+", encoding="utf-8") as file:
        kept = os.dup(1), os.dup(2)
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)
        text = []
        try:
            yield text
        finally:
            sys.stdout.flush()
            for i, descriptor in enumerate(kept, 1):
                os.dup2(descriptor, i)
                os.close(descriptor)
            file.seek(0)
            text.append(file.read())


def end():
    """Exit with 1 and the faults, if there are any."""
    print("\n".join(FAULTS) or "all is as it should be")
    sys.exit(1 if FAULTS else 0)
