"""What hysteron raises: one line of message, and the key and value that it is about."""

from pathlib import Path
from typing import Optional


class Error(Exception):
    """Every failure of hysteron.

    key: what the message is about, as scene files spell it ("fabric.b2"); "" if it is about none.
    value: what it was given, as text without its unit.
    path: the folder of the run that has failed; None if it was no run of the program.
    """

    def __init__(self, message: str, key: str = "", value: str = "", path: Optional[Path] = None) -> None:
        super().__init__(message)
        self.key = key
        self.value = value
        self.path = path


class RequestError(Error, ValueError):
    """The request is wrong: an unknown key, a wrong type, a value out of range, an impossible mesh."""


class MachineError(Error, RuntimeError):
    """The machine failed: a file, the disk, a GPU, the renderer."""


class RunError(Error, RuntimeError):
    """The run cannot go on: no convergence, no feasible state."""


class Cancelled(RunError):
    """A run was ended by Job.cancel(); the message says what it has left in its folder."""
