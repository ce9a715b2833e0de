#!/usr/bin/env python3
"""Time of a step of typical runs under one program or several, taken in turns on one device.

    steps.py --program now=build/hysteron [--program before=OTHER/hysteron] --out DIR [--repeats 3] [--device cuda]
             [--fabrics cotton-broad,cotton-broad-soft] [--runs crease-480,...]

writes DIR/table.csv, a row for each run, fabric and program: medians, fastest and slowest [ms] of the repeats.  Programs
take turns within a repeat, so that what slows a machine down for a while slows all of them down.  A first run of each
program, of the kernels' loading, does not count.
"""
import argparse
import csv
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

SQUARE = ["swing", "--scene", "hanging-square"]
CREASE = ["crease", "--crease.hold", "0.02", "--crease.lift", "0.1", "--crease.recovery", "0.02"]
IMPLICIT = [*SQUARE, "--precision", "float"]  # steps of 1/60 s
# Name: triangles, arguments, and whether it is repeated.
RUNS = {
    "crease-480": (480, CREASE, True),
    "crease-1600": (1600, CREASE, True),
    "swing-1014": (1014, ["swing", "--seconds", "0.5"], True),
    "fold-4992": (4992, ["fold", "--quick"], True),
    "drape-6000": (6000, ["drape"], True),
    "square-18432": (18432, [*IMPLICIT, "--seconds", "0.5"], True),
    "square-131072": (131072, [*IMPLICIT, "--seconds", "0.5"], True),
    "square-1000000": (1000000, [*IMPLICIT, "--seconds", "0.2"], False),
    "semi-implicit-131072": (131072, [*SQUARE, "--integrator", "semi-implicit", "--step", "0.001", "--seconds", "0.1"],
                             False),
}
COLUMNS = ("run fabric program commit runs ms_per_step fastest slowest newton linear solve_s total_s "
           "bytes_per_triangle").split()


def manifest_of(program, arguments, device, work):
    """The manifest of a run without pictures [file's JSON]."""
    environment = dict(os.environ)
    assets = pathlib.Path(program).parent / "assets"
    if assets.is_dir():
        environment["HYSTERON_ASSETS"] = str(assets)
    libraries = pathlib.Path(program).parent / "lib"
    if libraries.is_dir():
        environment["LD_LIBRARY_PATH"] = str(libraries)
    out = pathlib.Path(tempfile.mkdtemp(dir=work))
    command = [program, *arguments, "--device", device, "--no-images", "--quiet", "--out", str(out / "run")]
    result = subprocess.run(command, capture_output=True, text=True, env=environment)
    if result.returncode != 0:
        sys.exit(f"{' '.join(command)}: {result.stderr.strip()}")
    return json.loads((out / "run/manifest.json").read_text())


def row_of(name, fabric, program, manifests):
    last = manifests[-1]
    times = [1e3 * m["wall_seconds"]["solve"] / m["steps"] for m in manifests]
    return dict(zip(COLUMNS, [
        name, fabric, program, last["hysteron"]["commit"][:8] + "+" * last["hysteron"]["dirty"], len(times), f"{statistics.median(times):.4g}", f"{min(times):.4g}",
        f"{max(times):.4g}", f"{last['metrics'].get('newton_iterations_per_step', 0):.4g}",
        f"{last['metrics']['solver_iterations_per_step']:.4g}",
        f"{statistics.median(m['wall_seconds']['solve'] for m in manifests):.4g}",
        f"{statistics.median(m['wall_seconds']['total'] for m in manifests):.4g}",
        f"{last['bytes_device'] / last['triangles']:.0f}"]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", action="append", required=True, metavar="NAME=FILE")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--device", default="cuda")
    parser.add_argument("--fabrics", default="cotton-broad")
    parser.add_argument("--runs", default=",".join(RUNS))
    choice = parser.parse_args()
    programs = dict(item.split("=", 1) for item in choice.program)
    choice.out.mkdir(parents=True, exist_ok=True)
    rows = []
    with tempfile.TemporaryDirectory() as work:
        for program in programs.values():
            manifest_of(program, ["swing", "--quick"], choice.device, work)
        for fabric in choice.fabrics.split(","):
            for name in choice.runs.split(","):
                triangles, arguments, is_repeated = RUNS[name]
                taken = {program: [] for program in programs}
                for _ in range(choice.repeats if is_repeated else 1):
                    for program, file in programs.items():
                        taken[program].append(manifest_of(
                            file, [*arguments, "--triangles", str(triangles), "--fabric", fabric], choice.device, work))
                rows += [row_of(name, fabric, program, taken[program]) for program in programs]
                with open(choice.out / "table.csv", "w", newline="") as file:
                    writer = csv.DictWriter(file, COLUMNS)
                    writer.writeheader()
                    writer.writerows(rows)
                print(*(f"{r['program']} {r['run']} {r['fabric']} {r['ms_per_step']} ms" for r in rows[-len(programs):]),
                      sep="\n", flush=True)


if __name__ == "__main__":
    main()
