#!/usr/bin/env python3
"""Walks a page of docs/ as a reader does: its files are written, its commands run, in a folder of their own.

    tests/page.py docs/your-fabric.md build/hysteron

A block that begins with ```csv NAME is the file NAME; one with ```sh holds commands.  Exit 1 with the command that
fails and what it said.  Drapes have few triangles: the page is walked, and its numbers are tested elsewhere.
"""

import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

COARSE = """#!/bin/sh
case $1 in drape | validate) set -- "$@" --triangles 200 ;; esac
exec {} "$@"
"""
BLOCK = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def main():
    page, program = Path(sys.argv[1]), Path(sys.argv[2]).resolve()
    blocks = BLOCK.findall(page.read_text(encoding="utf-8"))
    commands = 0
    with tempfile.TemporaryDirectory() as folder:
        bin_folder = Path(folder) / "bin"
        bin_folder.mkdir()
        hysteron = bin_folder / "hysteron"
        hysteron.write_text(COARSE.format(shlex.quote(str(program))), encoding="utf-8")
        hysteron.chmod(0o755)
        environment = dict(os.environ, PATH=f"{bin_folder}:{os.environ['PATH']}", OMP_NUM_THREADS="2")
        for language, name, text in blocks:
            if name:
                (Path(folder) / name).write_text(text, encoding="utf-8")
            elif language == "sh":
                for command in text.replace("\\\n", " ").strip().splitlines():
                    done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, text=True,
                                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
                    if done.returncode != 0:
                        print(f"{page}: {command}\n{done.stdout}exit {done.returncode}")
                        return 1
                    print(f"{command}\n{done.stdout}")
                    commands += 1
    if commands == 0:
        print(f"{page} has no commands")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
