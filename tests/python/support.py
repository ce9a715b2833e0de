"""This module has what the tests of the package share; it ends the script as skipped (77) where there is no numpy."""

import os
import subprocess
import sys

try:
    import numpy as np
except ImportError:
    print("numpy is not installed for " + sys.executable)
    raise SystemExit(77)

import hysteron_cloth

PROGRAM = os.environ["HYSTERON_PROGRAM"]


def program(*arguments):
    """Runs the program; its output."""
    return subprocess.run([PROGRAM, *map(str, arguments)], check=True, capture_output=True, text=True).stdout
