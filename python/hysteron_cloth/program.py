"""The program `hysteron`: where it is, whether it is the module's, and its command lines from Python's values."""

import functools
import os
import re
import shutil
import signal
import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any, Iterator, Mapping

from . import _hysteron
from .errors import MachineError, RequestError

_VERSION = re.compile(r"\d+\.\d+\.\d+ \(commit \w+(, modified)?\)")  # as `hysteron --version` prints it


def find_program() -> str:
    """The program that runs are started with, as a path.

    It is the one that the environment variable HYSTERON_PROGRAM names, else the one in this package (of a wheel), else
    the one of the build tree that this package lies in, else `hysteron` on PATH.  MachineError where there is none.
    """
    named = os.environ.get("HYSTERON_PROGRAM")
    package = Path(__file__).resolve().parent
    places = [named] if named else [str(package / "hysteron"), str(package.parents[1] / "hysteron"), "hysteron"]
    for place in places:
        found = shutil.which(place)
        if found:
            return found
    if named:
        raise MachineError(f"HYSTERON_PROGRAM = {named} is no program; unset it or name one", "HYSTERON_PROGRAM", named)
    raise MachineError(f"no program at {places[0]} or {places[1]}, and no hysteron on PATH; set HYSTERON_PROGRAM to it")


def main() -> None:
    """The command `hysteron` of a wheel: this process becomes the program, with the shell's arguments."""
    program = find_program()
    if os.path.samefile(program, sys.argv[0]):
        raise SystemExit(f"hysteron: {program} starts the program and is not it; reinstall hysteron-cloth")
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # Python ignores it, which the program would inherit
    os.execv(program, [program, *sys.argv[1:]])


def checked_program() -> str:
    """find_program(), with one warning where it was built from another version or commit than this module."""
    program = find_program()
    status = os.stat(program)
    _check_version(program, status.st_mtime_ns, status.st_ino)
    return program


@functools.lru_cache(maxsize=None)
def _check_version(program: str, _changed: int, _inode: int) -> None:
    """Asks a program for its version once, and again where the file is another one since."""
    try:
        said = subprocess.run([program, "--version"], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              errors="replace", check=False)
    except OSError as failure:
        raise MachineError(f"cannot start {program}: {failure.strerror}") from failure
    version = said.stdout.strip()
    if not _VERSION.fullmatch(version):
        raise MachineError(f"{program} is not the program of this package: --version says \"{version[:80]}\"; set "
                           "HYSTERON_PROGRAM to the right one")
    if version != _hysteron.build:
        warnings.warn(f"the program {program} is {version}, this Python module {_hysteron.build}: results are the "
                      "program's", stacklevel=6)


@functools.lru_cache(maxsize=None)
def _options(experiment: str) -> Mapping[str, str]:
    """The options of an experiment by their names in Python, {"drape_standard": "drape.standard"}."""
    scene = [row["key"] for row in _hysteron.scene_keys()]  # the experiment itself refuses those that it fixes
    return {_python_name(name): name for name in scene + _hysteron._experiment_options(experiment)}


def _python_name(option: str) -> str:
    return option.replace(".", "_").replace("-", "_")


def option_name(experiment: str, keyword: str) -> str:
    """The option that a keyword means: "fabric.b2" of fabric_b2, "no-images" of no_images.

    Underscores stand for hyphens and dots.  A keyword that is no option has hyphens for them, and one with a dot is
    left as it is: the program refuses it and names the nearest one.
    """
    known = _options(experiment).get(_python_name(keyword))
    return known or (keyword if "." in keyword else keyword.replace("_", "-"))


def _text(option: str, value: Any) -> str:
    """A value as a command line spells it; a list has commas."""
    if hasattr(value, "tolist"):  # an array or number of numpy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (list, tuple)):
        return ",".join(_text(option, entry) for entry in value)
    raise RequestError(f"{option} = {value!r} must be a bool, a number, a text, a path or a list of them; fabrics and "
                       "scenes are named, or written into files", option, repr(value))


def option_words(experiment: str, options: Mapping[str, Any]) -> Iterator[str]:
    """The words of a command line that keywords mean: True is the bare flag, None is left out, a dict gives its option
    once for each entry (param={"stops": 8})."""
    for keyword, value in options.items():
        option = option_name(experiment, keyword)
        if value is None:
            continue
        if value is True:
            yield "--" + option
        elif isinstance(value, Mapping):
            for name, entry in value.items():
                yield f"--{option}={name}={_text(option, entry)}"
        else:
            text = _text(option, value)
            yield from [f"--{option}={text}"] if value is False or text.startswith("-") else ["--" + option, text]
