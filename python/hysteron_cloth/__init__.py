"""Bending hysteresis of cloth: laws, fabrics, scenes, simulations and experiments of the hysteron workbench.

Everything is in SI units.  Arrays are numpy's; where they are views of a simulation's memory, their
documentation says so.  Failures are raised as hysteron_cloth.Error, with key and value.
"""

from pathlib import Path as _Path

from . import _hysteron
from ._hysteron import *  # noqa: F401,F403
from .errors import Cancelled, Error, MachineError, RequestError, RunError
from .jobs import Job, compare, run, start, sweep
from .program import find_program
from .runs import Comparison, Run, Sweep, read_table

__version__ = _hysteron.__version__

_hysteron._set_assets_place(str(_Path(__file__).parent / "assets"))
