"""Runs the code cells of a notebook in their order, as one program: python run_notebook.py FILE.ipynb"""

import json
import sys

import support  # noqa: F401  (skips without numpy)

with open(sys.argv[1]) as file:
    cells = json.load(file)["cells"]
code = [cell for cell in cells if cell["cell_type"] == "code"]
assert code, "no cell of code"
names = {"__name__": "__main__"}
for number, cell in enumerate(code, 1):
    exec(compile("".join(cell["source"]), f"{sys.argv[1]}, cell {number}", "exec"), names)
print(len(code), "cells")
