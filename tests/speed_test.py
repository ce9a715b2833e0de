#!/usr/bin/env python3
"""Ratios of processor times of two methods in one run, beside those recorded in speed.json: above twice that it fails.

    tests/speed_test.py build/hysteron             compares
    tests/speed_test.py --record build/hysteron    writes speed.json, on an idle machine

A ratio says what a method costs beside another one, whatever the machine: programs take turns on one thread, and of each
the fastest of three counts, since whatever else runs there only makes them slower.
"""
import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

RECORD = Path(__file__).with_name("speed.json")
REPEATS = 3
LIMIT = 2  # times the recorded ratio; four such tests side by side on two cores moved it by a third

SQUARE = ["swing", "--scene", "hanging-square"]
EXPLICIT = [*SQUARE, "--triangles", "2000", "--integrator", "explicit", "--substeps", "300", "--step", "0.005",
            "--seconds", "0.01", "--law"]
IMPLICIT = [*SQUARE, "--triangles", "1152", "--seconds", "0.1", "--linear-solver"]
RUNS = {
    "linear": [*EXPLICIT, "linear"],
    "prandtl": [*EXPLICIT, "prandtl"],
    "wong": [*EXPLICIT, "wong"],  # a law along four directions
    "block-jacobi": [*IMPLICIT, "block-jacobi"],
    "multigrid": [*IMPLICIT, "multigrid"],
    "cholesky": [*IMPLICIT, "cholesky"],
}
RATIOS = [("prandtl", "linear"), ("wong", "linear"), ("multigrid", "block-jacobi"), ("cholesky", "block-jacobi")]


def processor_time(program, arguments):
    """Of a run without pictures [s]."""
    with tempfile.TemporaryDirectory() as folder:
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run([program, *arguments, "--threads", "1", "--device", "cpu", "--no-images", "--quiet", "--out",
                        f"{folder}/run"], check=True, capture_output=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def measured(program):
    """Name of a ratio: its value."""
    turns = [{name: processor_time(program, arguments) for name, arguments in RUNS.items()} for _ in range(REPEATS)]
    times = {name: min(turn[name] for turn in turns) for name in RUNS}
    for name, seconds in times.items():
        print(f"{name}: {seconds:.2f} s")
    return {f"{method} over {other}": times[method] / times[other] for method, other in RATIOS}


def main(arguments):
    program = arguments[-1]
    ratios = measured(program)
    if "--record" in arguments:
        RECORD.write_text(json.dumps({name: round(ratio, 2) for name, ratio in ratios.items()}, indent=2) + "\n", "utf-8")
        return 0
    recorded = json.loads(RECORD.read_text("utf-8"))
    slow = [name for name, ratio in ratios.items() if ratio > LIMIT * recorded[name]]
    for name, ratio in ratios.items():
        print(f"{name}: {ratio:.2f}, recorded {recorded[name]:.2f}{': too slow' if name in slow else ''}")
    return 1 if slow else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
