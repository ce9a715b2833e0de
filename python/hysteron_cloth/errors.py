"""What hysteron raises: one line of message, and the key and value that it is about."""


class Error(Exception):
    """Every failure of hysteron.

    key: what the message is about, as scene files spell it ("fabric.b2"); "" if it is about none.
    value: what it was given, as text without its unit.
    """

    def __init__(self, message: str, key: str = "", value: str = "") -> None:
        super().__init__(message)
        self.key = key
        self.value = value


class RequestError(Error, ValueError):
    """The request is wrong: an unknown key, a wrong type, a value out of range, an impossible mesh."""


class MachineError(Error, RuntimeError):
    """The machine failed: a file, the disk, a GPU, the renderer."""


class RunError(Error, RuntimeError):
    """The run cannot go on: no convergence, no feasible state."""
