"""Experiments of the program, each in a process of its own: started, followed, cancelled."""

import atexit
import os
import queue
import signal
import subprocess
import sys
import tempfile
import threading
from pathlib import Path
from typing import Any, Callable, Iterable, Optional, Union

from .errors import Cancelled, Error, MachineError, RequestError, RunError
from .program import checked_program, option_words
from .runs import Comparison, Run, Sweep, run_in

PathLike = Union[str, "os.PathLike[str]"]
Progress = Union[bool, Callable[[str], Any], None]

_FAILURES = {1: MachineError, 2: RequestError, 3: RunError}  # keys are the program's exit codes


class Job:
    """A run of the program that goes on beside Python; start() makes it.

    path: the folder that the run writes to, absolute.
    words: the command line, a list of texts.
    lines: what the program has said on stderr and wait() has seen, its progress and warnings.
    text: what it has printed on stdout, its closing summary, once wait() has returned.
    """

    def __init__(self, experiment: str, words: list[str], folder: Path, options: dict[str, Any],
                 progress: Progress = None) -> None:
        self.path = folder.absolute()
        self.words = [checked_program(), experiment, *words]
        self.lines: list[str] = []
        self.text = ""
        self._experiment, self._options, self._progress = experiment, options, progress
        self._before = self._stamp()
        self._cancelled = False
        self._outcome: Union[Run, Error, None] = None
        self._said: "queue.SimpleQueue[Optional[str]]" = queue.SimpleQueue()
        self._printed = tempfile.TemporaryFile()
        try:  # in a group of its own, so that Ctrl-C reaches the program once, by wait()
            self._process = subprocess.Popen(self.words, stdin=subprocess.DEVNULL, stdout=self._printed,
                                             stderr=subprocess.PIPE, start_new_session=True)
        except OSError as failure:
            raise MachineError(f"cannot start {self.words[0]}: {failure.strerror}") from failure
        _going_on.add(self)
        threading.Thread(target=self._listen, daemon=True).start()

    @property
    def running(self) -> bool:
        """Whether the program has not ended yet."""
        return self._process.poll() is None

    def cancel(self) -> None:
        """Asks the program to end, by SIGINT; wait() then raises Cancelled.

        A run with the option `checkpoint` writes one first, at the end of its step.  A second call, half a second or
        more after the first, ends the program at once.  From any thread."""
        self._cancelled = self._cancelled or self.running
        # SIGTERM is used if SIGINT is ignored, as a shell's background jobs inherit.
        self._signal(signal.SIGTERM if signal.getsignal(signal.SIGINT) is signal.SIG_IGN else signal.SIGINT)

    def wait(self) -> Run:
        """Follows the program to its end, and returns what it has left: a Run, a Comparison or a Sweep.

        RequestError, MachineError, RunError: the program has failed, with its own line.  Cancelled after cancel().  On
        Ctrl-C the program is asked to end as by cancel(), and KeyboardInterrupt says what it has left; what a progress
        callback raises ends it likewise.  Ctrl-C again ends it at once."""
        if self._outcome is None:
            try:
                self._follow(self._show)
            except BaseException as stop:
                self._end()
                if isinstance(stop, KeyboardInterrupt):
                    raise KeyboardInterrupt(self._cancelled_message()) from None
                raise
        if isinstance(self._outcome, Run):
            return self._outcome
        assert self._outcome is not None
        raise self._outcome

    def __repr__(self) -> str:
        state = "running" if self.running else f"ended with exit code {self._process.returncode}"
        return f"<Job {self._experiment} in {self.path}, {state}>"

    def _listen(self) -> None:
        """Runs on a thread: hands lines on as they come, then None."""
        assert self._process.stderr is not None
        with self._process.stderr as lines:
            for line in lines:
                self._said.put(line.decode("utf-8", "replace").rstrip("\n"))
        self._process.wait()
        _going_on.discard(self)
        self._said.put(None)

    def _follow(self, show: Callable[[str], Any]) -> None:
        for line in iter(self._said.get, None):
            self.lines.append(line)
            show(line)
        self._close()

    def _show(self, line: str) -> None:
        if callable(self._progress):
            self._progress(line)
            return
        wanted = self._progress if self._progress is not None else sys.stderr.isatty()
        if wanted or line.startswith("warning: "):
            print(line, file=sys.stderr, flush=True)

    def _end(self) -> None:
        self.cancel()
        try:
            self._follow(lambda line: None)
        except KeyboardInterrupt:
            self._signal(signal.SIGKILL)
            self._follow(lambda line: None)

    def _signal(self, number: int) -> None:
        try:
            os.killpg(self._process.pid, number)
        except ProcessLookupError:  # it has ended
            pass

    def _close(self) -> None:
        with self._printed as printed:
            printed.seek(0)
            self.text = printed.read().decode("utf-8", "replace")
        self._outcome = self._failure() or self._result()

    def _stamp(self) -> Optional[tuple[int, int]]:
        """Tells one manifest of the folder from the next, which replaces the file."""
        try:
            status = (self.path / "manifest.json").stat()
        except OSError:
            return None
        return status.st_ino, status.st_mtime_ns

    def _result(self) -> Union[Run, Error]:
        stamp = self._stamp()
        if stamp is None or (stamp == self._before and not self._options.get("resume")):
            said = self.text.strip().splitlines()
            return RequestError(f"{' '.join(self.words[1:])} has run nothing that is recorded in {self.path}"
                                + (f"; it said: {said[0]}" if said else ""))
        try:
            return run_in(self.path, self._experiment)
        except Error as failure:
            return failure

    def _failure(self) -> Optional[Error]:
        code = self._process.returncode
        if code == 0:
            return None
        if self._cancelled and (code in (-signal.SIGINT, -signal.SIGTERM, -signal.SIGKILL) or code == 3):
            return Cancelled(self._cancelled_message(), path=self.path)
        if code < 0:
            ended = f"hysteron {self._experiment} was ended by {signal.Signals(-code).name}"
            return MachineError(f"{ended}; {self._kept()}", path=self.path)
        line = self._last_line() or f"hysteron {self._experiment} has ended with exit code {code}"
        return _FAILURES.get(code, RunError)(line, *self._key_in(line), self.path)

    def _last_line(self) -> str:
        lines = [line for line in self.lines if line.strip()]
        return next((line for line in reversed(lines) if line.startswith("hysteron")), lines[-1] if lines else "")

    def _key_in(self, line: str) -> tuple[str, str]:
        """Which of the options that were given the line is about, and its value; two empty texts if none."""
        for word, value in zip(self.words, [*self.words[1:], ""]):
            if word.startswith("--"):
                option, _, joined = word[2:].partition("=")
                if f" {option} = " in line or f"--{option};" in line or f"(--{option})" in line:
                    return option, joined or ("" if value.startswith("--") else value)
        return "", ""

    def _cancelled_message(self) -> str:
        if self._process.returncode == 0:
            return f"hysteron {self._experiment} had come to its end in {self.path}"
        line = self._last_line()
        if "SIGINT" in line or "SIGTERM" in line:  # the line says how far it came
            return f"{line} ({self.path})"
        return f"hysteron {self._experiment} was cancelled; {self._kept()}"

    def _kept(self) -> str:
        if self._experiment in ("sweep", "compare"):
            return f"the runs that are complete are kept in {self.path}: resume=True goes on with the others"
        if (self.path / "checkpoint").exists():
            return f"a checkpoint is kept in {self.path}: the same call with resume=True goes on from there"
        if self._stamp() in (None, self._before):
            return f"it has left nothing in {self.path}"
        return f"what it had written is kept in {self.path}, without a checkpoint, which the option checkpoint makes"


_going_on: "set[Job]" = set()


def _default_folder(experiment: str, arguments: tuple[PathLike, ...]) -> Path:
    """Where the program writes a run without --out."""
    name = experiment
    if arguments and experiment in ("run", "compare", "sweep"):
        name += "-" + Path(arguments[0]).stem
    elif arguments and experiment == "rerun":  # a folder, or the manifest in it
        recorded = Path(arguments[0]).absolute()
        name += "-" + (recorded.parent if recorded.is_file() else recorded).name
    return Path("out", name)


@atexit.register
def _end_all() -> None:
    """Leaves no program behind when the interpreter ends; each may take some seconds for its checkpoint."""
    going_on = list(_going_on)
    for job in going_on:
        job.cancel()
    for job in going_on:
        try:
            job._process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            job._signal(signal.SIGKILL)


def start(experiment: str, *arguments: PathLike, out: Optional[PathLike] = None, progress: Progress = None,
          **options: Any) -> Job:
    """Starts an experiment as run() does and returns at once.

    The Job has wait(), cancel() and running; several may run beside each other, each in a folder of its own."""
    words = [os.fspath(argument) for argument in arguments] + list(option_words(experiment, options))
    if out is not None:
        words += ["--out", os.fspath(out)]
    folder = _default_folder(experiment, arguments) if out is None else Path(out)
    return Job(experiment, words, folder, options, progress)


def run(experiment: str, *arguments: PathLike, out: Optional[PathLike] = None, progress: Progress = None,
        **options: Any) -> Run:
    """Runs an experiment of the program and returns what it has left.

        run("drape", fabric="my.toml", quick=True).metrics["drape_coefficient_percent"]

    experiment: a subcommand that writes a run: "drape", "crease", "swing", "kes", ... (`hysteron --help`).
    arguments: what the subcommand takes without a flag, such as the file of run("run", "scene.toml").
    out: the folder of the results; where none is named, out/<experiment> below the current folder, as on the command
    line.  A complete run replaces the one that was there, whose object keeps its metrics and series.
    progress: called with each line of the program's progress and warnings; True, False: progress is shown on stderr or
    not; None: where stderr is a terminal.  Warnings are always shown.
    options: those of `hysteron EXPERIMENT --help`, in SI units, with underscores for their hyphens and dots:
    no_images=True, fabric_b2=1e-5, drape_standard="jis", or **{"fabric.b2": 1e-5}.  Values are bools, numbers, texts,
    paths and lists of them; param is a dict.

    The program runs in a process of its own, with the bits and files of the same command line.  RequestError,
    MachineError and RunError have its own line; Ctrl-C ends it (Job.wait)."""
    return start(experiment, *arguments, out=out, progress=progress, **options).wait()


def _joined(names: Union[str, Iterable[str], None]) -> Optional[str]:
    return names if names is None or isinstance(names, str) else ",".join(names)


def compare(experiment: PathLike, laws: Union[str, Iterable[str], None] = None, *,
            fabrics: Union[str, Iterable[str], None] = None, integrators: Union[str, Iterable[str], None] = None,
            **options: Any) -> Comparison:
    """One experiment, or one scene's file, under several laws, fabrics or integrators.

        compare("swing", ["linear", "prandtl"], quick=True).columns["prandtl"].series

    laws, fabrics, integrators: names, one of the three; without any the program's laws.  Further arguments are those of
    run(), and so are errors; without out the folder is out/compare-<experiment>."""
    result = run("compare", experiment, laws=_joined(laws), fabrics=_joined(fabrics), integrators=_joined(integrators),
                 **options)
    assert isinstance(result, Comparison)
    return result


def sweep(study: PathLike, **options: Any) -> Sweep:
    """The runs of a study: a file (docs/studies.md), or a name of assets/studies.

        sweep("study.toml", jobs=2).table()["drape_coefficient_percent"]

    Options are those of `hysteron sweep --help`: jobs is how many run at a time, resume=True keeps finished ones.
    progress, errors and cancelling are those of run(); without out the folder is out/sweep-<study>."""
    result = run("sweep", study, **options)
    assert isinstance(result, Sweep)
    return result
