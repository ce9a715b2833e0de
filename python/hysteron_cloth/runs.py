"""What runs of the program have written: metrics, series, pictures and tables of a folder."""

import csv
import functools
import json
from pathlib import Path
from typing import Any, Union

import numpy as np

from .errors import MachineError, RequestError

Table = dict[str, np.ndarray]


def _column(name: str, cells: list[str]) -> np.ndarray:
    if name in ("run", "state_hash"):  # these are texts, even if all are digits
        return np.array(cells)
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)


def read_table(file: Union[str, Path]) -> Table:
    """The columns of a CSV file by their names with units ("time [s]"): arrays of float64, an empty cell being NaN, and
    of str where a cell is no number.  MachineError where it cannot be read."""
    try:
        with open(file, newline="", encoding="utf-8") as text:
            header, *rows = list(csv.reader(text)) or [[]]
    except OSError as failure:
        raise MachineError(f"cannot read {file}: {failure.strerror}") from failure
    return {name: _column(name, [row[i] if i < len(row) else "" for row in rows]) for i, name in enumerate(header)}


class Run:
    """What a run has left in its folder.  Run("out/drape") reads that of an earlier one, of the command line, too.

    path: its folder, absolute.
    experiment: "drape".
    manifest: all that manifest.json says, as a dict.
    metrics: its results; keys end in their unit: "drape_coefficient_percent".  None is a number that is not finite.
    series: the columns of metrics.csv by their names with units, "drape_coefficient [%]": arrays of shape (rows,); {}
    where the experiment records none.
    warnings: what the program has warned of, a list of texts.
    state_hash: that of the final state; None where nothing was simulated.
    complete: False of a run that was interrupted or could not go on.

    Metrics and series are read when the run ends; they stay when a later run replaces the folder.
    RequestError where the folder holds no run.
    """

    def __init__(self, folder: Union[str, Path]) -> None:
        self.path = Path(folder).absolute()
        self.manifest: dict[str, Any] = self._read_manifest()
        self.experiment: str = self.manifest["experiment"]
        self.metrics: dict[str, Any] = self.manifest["metrics"]
        self.warnings: list[str] = self.manifest.get("warnings") or []
        self.state_hash = self.manifest.get("state_hash")
        self.complete: bool = self.manifest["complete"]
        series = self.path / "metrics.csv"
        self.series: Table = read_table(series) if series.is_file() else {}

    def _read_manifest(self) -> dict[str, Any]:
        file = self.path / "manifest.json"
        try:
            manifest = json.loads(file.read_text("utf-8"))
        except (OSError, ValueError) as failure:
            raise RequestError(f"{self.path} holds no run: {file.name} cannot be read ({failure})",
                               path=self.path) from failure
        if not isinstance(manifest, dict) or not {"experiment", "metrics", "complete", "files"} <= manifest.keys():
            raise RequestError(f"{file} is not the manifest of a run", path=self.path)
        return manifest

    def _own_folder(self) -> Path:
        """Its folder.  RequestError where a later run has replaced what it held."""
        if self._read_manifest().get("started") != self.manifest.get("started"):
            raise RequestError(f"{self.path} holds a later run than the one whose files are asked for: give each run a "
                               "folder of its own (out)", "out", str(self.path), self.path)
        return self.path

    @property
    def images(self) -> list[Path]:
        """Paths of its pictures and plots (PNG), in the order in which they were written; [] with no_images.

        RequestError where a later run has replaced the folder."""
        folder = self._own_folder()
        return [folder / name for name in self.manifest["files"] if name.endswith(".png")]

    def table(self, name: str = "table.csv") -> Table:
        """The columns of another CSV file of the folder ("turns.csv"), as read_table() has them."""
        return read_table(self._own_folder() / name)

    def __repr__(self) -> str:
        return f"<{self.experiment} in {self.path}{'' if self.complete else ', incomplete'}>"


class Comparison(Run):
    """What `compare` has left: a Run, and its columns.  Metrics are named "prandtl.turns"."""

    @functools.cached_property
    def columns(self) -> dict[str, Run]:
        """The run of each column, by its law, fabric or integrator."""
        names = map(str, next(iter(self.table().values())).tolist())
        return {name: Run(self.path / name) for name in names if (self.path / name / "manifest.json").is_file()}


class Sweep(Run):
    """What `sweep` has left: a Run, whose table() has a row for each run of the study."""

    @functools.cached_property
    def runs(self) -> dict[str, Run]:
        """Each run of the study that has begun, by its name in the table's column "run"."""
        folders = {name: self.path / "runs" / name for name in self.table()["run"].tolist()}
        return {name: Run(folder) for name, folder in folders.items() if (folder / "manifest.json").is_file()}


def run_in(folder: Path, experiment: str) -> Run:
    """The run in that folder as its own class."""
    return {"compare": Comparison, "sweep": Sweep}.get(experiment, Run)(folder)
