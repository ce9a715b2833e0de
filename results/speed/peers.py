#!/usr/bin/env python3
"""A falling square under hysteron and under other public cloth solvers: error over time, on one machine, in one record.

    peers.py measure --hysteron build/hysteron --out DIR [--budget SECONDS] [--device cuda] [--triangles 18432,4608]
    peers.py draw DIR

`measure` runs every setting of PLANS below that DIR does not have yet, the most telling first, writes DIR/table.csv
after each, and ends when none fits into the budget any more; `draw` makes DIR/fastest.csv and the figure of the table.
It needs numpy, and what there is of newton, warp-lang and pyuipc (Python package index); `draw` needs gnuplot alone.

A square of 0.5 m that lies flat is let go, held by two corners, and is compared at 0.25 s: 0.1238 kg/m^2, tension along
warp and weft of 1 and 10 kN/m, bending B = 1.157e-5 N m without friction, no viscosity, no contact, no air.  All
solvers have the triangles and vertices of hysteron's own mesh; its strains are those of triangles (`membrane.element =
constant`), as theirs are.  Two materials: `woven` with a shear of 60 N/m, as Style3D and libuipc can have, and
`isotropic` with half the tension as shear (no Poisson effect), which is all that VBD can have.  Errors are the root
mean square distance of all vertices from hysteron's `tr-bdf2` with steps of 1/960 s in double precision, of the same
material on the same mesh; everything that is measured runs in single precision (libuipc has double alone).
A row's time is the median of its runs, in milliseconds for a millisecond of the simulation: hysteron's
`wall_seconds.solve`, for the others the clock around all steps and a last synchronisation, after compilation and, under
Newton, capture.
"""
import argparse
import hashlib
import importlib.metadata
import importlib.util
import json
import math
import pathlib
import platform
import shutil
import statistics
import subprocess
import sys
import time

from peer_figure import FAR, MATERIAL, TENSIONS, draw, read_table, write_table

END, SIDE, DENSITY, RIGIDITY = 0.25, 0.5, 0.1238, 1.1571847e-05  # [s], [m], [kg/m^2], [N m]
REFERENCE = ("tr-bdf2", 960)
ENOUGH = 2.0  # [s] of timed runs, after which a row is not repeated
REPEATS = 3
GIVEN_UP = 3  # failures in a row after which a solver is left alone in this call
LARGE = 20000  # triangles from which on rows come later and are fewer
CONTROLS_BEFORE = 3  # the priority of rows that wait for the controls
COLUMNS = ("material tension_N_per_m triangles solver setting steps_per_s iterations linear_iterations "
           "ms_per_simulated_ms fastest slowest runs rms_mm lowest_m note").split()

# Settings by solver: priority (lower ones of all solvers and meshes come first), steps a second, then its own numbers.
# Newton's own cloth examples take 10 steps of 1/600 s with 4 x 10 iterations (cloth_style3d), 2 of 1/120 s with 10 x 10
# (cloth_hanging, style3d), and 10 of 1/600 s with 10 iterations (cloth_hanging, VBD).
PLANS = {
    "hysteron": [(1, 40, "bdf2"), (1, 60, "implicit"), (1, 20, "bdf2"), (1, 20, "implicit"), (2, 60, "bdf2"),
                 (2, 40, "tr-bdf2"), (2, 60, "tr-bdf2"), (2, 120, "implicit"), (3, 120, "bdf2"), (3, 20, "tr-bdf2"),
                 (4, 40, "implicit"), (4, 240, "implicit"), (4, 240, "bdf2"), (4, 120, "tr-bdf2")],
    "style3d": [(1, 600, 4, 10), (1, 120, 10, 10), (1, 120, 300, 10), (1, 60, 600, 10), (1, 240, 100, 10),
                (2, 480, 40, 10), (2, 120, 1000, 10), (2, 120, 100, 40), (3, 60, 200, 40), (3, 240, 300, 10),
                (3, 120, 30, 10), (3, 120, 100, 10), (3, 120, 40, 200), (3, 240, 20, 10), (3, 60, 200, 10),
                (3, 480, 80, 10), (3, 960, 20, 40), (3, 60, 2000, 10), (3, 120, 300, 40), (4, 60, 600, 40),
                (4, 120, 100, 200), (4, 240, 1000, 10), (4, 120, 3000, 10), (4, 120, 1000, 40)],
    "style3d-lossless": [(2, 480, 60, 10), (2, 960, 40, 10), (3, 240, 300, 10), (3, 960, 100, 10), (4, 480, 200, 10)],
    "vbd": [(1, 600, 10), (1, 240, 100), (1, 960, 40), (1, 960, 160), (2, 120, 400), (2, 480, 100), (2, 240, 400),
            (2, 1920, 40), (2, 1920, 160), (3, 240, 20), (3, 960, 10), (3, 480, 400), (3, 960, 600), (3, 3840, 40),
            (4, 3840, 160), (4, 1920, 600)],
    "libuipc": [(3, 60, "bdf2", 0.05), (3, 60, "bdf1", 0.05), (3, 120, "bdf2", 0.01), (4, 120, "bdf1", 0.01),
                (4, 240, "bdf2", 0.01), (4, 40, "bdf2", 0.01), (4, 60, "bdf2", 0.01, "mas")],
}


# hysteron


def read_ply(path):
    """Vertices and triangles of a mesh that hysteron exported."""
    import numpy as np

    data = path.read_bytes()
    body = data.index(b"end_header\n") + len(b"end_header\n")
    lines = [line.split() for line in data[:body].decode().splitlines()]
    counts = {line[1]: int(line[2]) for line in lines if line[0] == "element"}
    numbers = [(line[2], {"float": "<f4", "double": "<f8"}[line[1]]) for line in lines
               if line[0] == "property" and line[1] != "list"]
    vertex, face = np.dtype(numbers), np.dtype([("count", "u1"), ("corners", "<i4", 3)])
    vertices = np.frombuffer(data, vertex, counts["vertex"], body)
    faces = np.frombuffer(data, face, counts["face"], body + counts["vertex"] * vertex.itemsize)
    return np.stack([vertices[axis] for axis in "xyz"], 1).astype(float), faces["corners"].astype(int)


class Hysteron:
    def __init__(self, program, device, work):
        self.program, self.device, self.work = program, device, work
        self.build = hashlib.sha1(pathlib.Path(program).read_bytes()).hexdigest()[:8]
        work.mkdir(parents=True, exist_ok=True)
        self.free_scene = work / "free-square.toml"
        self.free_scene.write_text(f'law = "linear"\nseconds = {END}\n[cloth]\nshape = "square"\nlength = {SIDE}\n')

    def run(self, case, integrator, rate, precision, free=False, rigidity=RIGIDITY):
        """Rest and last positions, triangles, seconds of solving; raises RuntimeError with hysteron's own last line."""
        out = self.work / "hysteron"
        scene = ["run", self.free_scene] if free else ["swing", "--scene", "hanging-square"]
        command = [self.program, *scene, "--mesh", "aligned", "--triangles", case.triangles,
                   "--fabric", "cotton-broad-soft", "--fabric.warp", case.tension, "--fabric.weft", case.tension,
                   "--fabric.shear", case.shear, "--fabric.b2", rigidity, "--fabric.density", DENSITY,
                   "--fabric.damping", 0, "--membrane.element", "constant", "--law", "linear",
                   "--integrator", integrator, "--step", repr(1 / rate), "--seconds", END,
                   "--precision", precision, "--device", self.device, "--threads", 4 if self.device == "cuda" else 1,
                   "--fps", round(1 / END), "--export", "ply", "--no-images", "--quiet", "--out", out]
        shutil.rmtree(out, ignore_errors=True)
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError((done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[-1])
        first, *_, last = sorted((out / "mesh").glob("*.ply"))
        (rest, triangles), (end, _) = read_ply(first), read_ply(last)
        self.manifest = json.loads((out / "manifest.json").read_text())
        if self.manifest["steps"] != round(END * rate):
            raise RuntimeError(f"{self.manifest['steps']} steps instead of {round(END * rate)}")
        return rest, end, triangles, self.manifest["wall_seconds"]["solve"]


class Case:
    """One material on one mesh, with its reference."""

    def __init__(self, material, tension, triangles):
        self.material, self.tension, self.triangles = material, tension, triangles
        self.shear = 60.0 if material == "woven" else 0.5 * tension
        self.name = f"{material}-{tension:g}-{triangles}"

    def load(self, hysteron):
        """From the working folder, where another call left it."""
        import numpy as np

        file = hysteron.work / f"{self.name}-{hysteron.build}.npz"
        if not file.exists():
            rest, end, corners, _ = hysteron.run(self, *REFERENCE, "double")
            about = {**{name: hysteron.manifest["hysteron"][name] for name in ("version", "commit", "dirty")},
                     "device": hysteron.manifest["device"]}
            np.savez(file, rest=rest, end=end, corners=corners, about=json.dumps(about))
        stored = np.load(file)
        hysteron.about = json.loads(str(stored["about"]))
        self.rest, self.end, self.corners = stored["rest"], stored["end"], stored["corners"]
        self.held = [int(i) for i in np.nonzero(np.abs(self.end - self.rest).max(1) < 1e-9)[0]]
        if len(self.held) != 2:
            raise RuntimeError(f"{len(self.held)} vertices of the reference are held instead of two corners")

    def error(self, positions):
        return 1e3 * math.sqrt(((positions - self.end) ** 2).sum(1).mean())

    def square(self, held=None):
        from peer_solvers import Square

        return Square(self.rest, self.corners, self.held if held is None else held, self.tension, self.shear, RIGIDITY,
                      DENSITY)


# Jobs: what a row of the table is of


class Job:
    def __init__(self, solver, priority, case, rate, *numbers):
        self.solver, self.priority, self.case, self.rate, self.numbers = solver, priority, case, rate, numbers
        word = f"{numbers[0]} " if isinstance(numbers[0], str) else ""
        named = (", " if word else " x ").join(str(number) for number in (numbers[1:] if word else numbers))
        self.setting = f"{word}1/{rate} s" + f", {named}" * bool(named)
        self.key = (case.material, f"{case.tension:g}", str(case.triangles), solver, self.setting)

    @property
    def steps(self):
        return round(END * self.rate)

    def work(self):
        """What the time of the row grows with."""
        counts = [number for number in self.numbers if isinstance(number, int)]
        return self.steps * math.prod(counts[:1]) * (counts[1] + 2 if len(counts) > 1 else 1)

    def row(self, seconds, positions, note):
        row = dict.fromkeys(COLUMNS, "")
        row.update(zip(("material", "tension_N_per_m", "triangles", "solver", "setting"), self.key))
        counts = [number for number in self.numbers if isinstance(number, int)] + ["", ""]
        row.update(steps_per_s=self.rate, iterations=counts[0], linear_iterations=counts[1], runs=len(seconds),
                   note=note)
        if seconds:
            costs = [f"{f(seconds) / END:.4g}" for f in (statistics.median, min, max)]
            row.update(zip(("ms_per_simulated_ms", "fastest", "slowest"), costs))
        if positions is not None and all(math.isfinite(x) for x in positions.ravel()):
            row.update(rms_mm=f"{self.case.error(positions):.4g}", lowest_m=f"{positions[:, 2].min():.5g}")
            if self.case.error(positions) > FAR:
                row["note"] = f"more than {FAR:g} mm away"
        elif positions is not None:
            row["note"] = "positions are no finite numbers"
        return row


def all_jobs(sizes, solvers):
    """The most telling first: all of a priority, smaller meshes before large ones."""
    cases = {(material, tension, size): Case(material, tension, size)
             for material in ("woven", "isotropic") for tension in TENSIONS for size in sizes}
    jobs = []
    for (material, tension, size), case in cases.items():
        for solver in solvers:
            if MATERIAL.get(solver, material) != material:
                continue
            for priority, *setting in PLANS[solver]:
                if material == "isotropic" and setting in ([20, "implicit"], [120, "implicit"]):
                    continue  # few of hysteron's are needed beside VBD
                jobs.append(Job(solver, priority + 2 * (size > LARGE), case, *setting))
    return sorted(jobs, key=lambda job: (job.priority, job.case.material != "woven", job.case.triangles,
                                         job.case.tension, job.solver))


class Peers:
    """Solvers of other people, each made once for a case."""

    def __init__(self, device, work):
        self.device, self.work, self.made = device, work, {}

    def make(self, job, held=None):
        import peer_solvers

        key = (job.solver.partition("-")[0], job.case.name, held is None)
        if key not in self.made:
            square = job.case.square(held)
            if job.solver == "libuipc":
                solver = peer_solvers.Libuipc(square, self.device, self.work)
            elif job.solver == "vbd":
                solver = peer_solvers.Vbd(square, self.device)
            else:
                solver = peer_solvers.Style3D(square, self.device)
            self.made[key] = solver
        return self.made[key]

    def run(self, job, repeats=REPEATS, held=None):
        solver = self.make(job, held)
        solver.losses = job.solver == "style3d"
        return solver.run(1 / job.rate, job.steps, Repeats(repeats), *job.numbers)


class Repeats:
    """Counts the timed runs of a row: `REPEATS`, or fewer where they are long."""

    def __init__(self, most):
        self.most = most

    def more(self, seconds):
        return len(seconds) < self.most and sum(seconds) < ENOUGH


def measured(job, hysteron, peers):
    """The job's row; what fails is one as well."""
    seconds, positions = [], None
    try:
        if job.solver != "hysteron":
            positions, seconds = peers.run(job)
            return job.row(seconds, positions, "")
        began, repeats = time.perf_counter(), Repeats(REPEATS)
        while repeats.more(seconds) and (not seconds or time.perf_counter() - began < 2 * ENOUGH):
            _, positions, _, solving = hysteron.run(job.case, job.numbers[0], job.rate, "float")
            seconds.append(solving)
        return job.row(seconds, positions, "")
    except (RuntimeError, subprocess.TimeoutExpired) as error:
        return job.row(seconds, None, " ".join(str(error).split())[:200])


# Controls


def fall(rate, kept=1.0, order=1):
    """How far backward Euler falls until END [m], where velocities keep this part of themselves in each step; of order
    2, BDF2 after a first step of it."""
    heights, velocities = [0.0], [0.0]
    for i in range(round(END * rate)):
        if i == 0 or order == 1:
            velocities.append(velocities[-1] + 9.81 / rate)
            heights.append(heights[-1] + velocities[-1] / rate)
        else:
            velocities.append((4 * velocities[-1] - velocities[-2] + 2 * 9.81 / rate) / 3)
            heights.append((4 * heights[-1] - heights[-2] + 2 * velocities[-1] / rate) / 3)
        velocities[-1] *= kept
    return heights[-1]


def free_fall(size, solvers, hysteron, peers):
    """Without held corners every vertex falls alike, as far as a formula says: gravity and instant are the same.

    tr-bdf2 falls as far as a point does but for its first step.  Style3D is given far more iterations than its examples
    have: with 4 x 10 it falls half as far.
    """
    rows, case = [], Case("isotropic", TENSIONS[0], size)
    case.load(hysteron)
    exact = 0.5 * 9.81 * END**2
    for integrator, rate in (("bdf2", 60), ("implicit", 60), ("tr-bdf2", 60)):
        rest, end, _, _ = hysteron.run(case, integrator, rate, "float", free=True)
        expected = exact if integrator == "tr-bdf2" else fall(rate, order=1 + (integrator == "bdf2"))
        rows.append((f"hysteron {integrator}", rate, rest, end, expected))
    for solver in solvers:
        job = Job(solver, 0, case, 60, *{"vbd": (4,), "libuipc": ("bdf1", 1e-3)}.get(solver, (40, 200)))
        try:
            end, _ = peers.run(job, 1, held=[])
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            print(f"{solver} does not fall: {error}", flush=True)
            continue
        rows.append((solver, job.rate, case.rest, end, fall(job.rate, 0.998 if solver == "style3d" else 1.0)))
    found = []
    for name, rate, rest, end, expected in rows:
        ways = (rest - end)[:, 2]
        found.append({"solver": name, "steps_per_s": rate, "fallen_mm": round(1e3 * float(ways.mean()), 3),
                      "by_its_formula_mm": round(1e3 * expected, 3), "exact_mm": round(1e3 * exact, 3),
                      "spread_mm": round(1e3 * float(ways.max() - ways.min()), 3)})
    return found


def reference_control(case, hysteron):
    """What the reference's own step is worth, and what the choice of bending and of the material moves [mm]."""
    def moved(positions):
        return round(case.error(positions), 4)

    half = REFERENCE[1] // 2
    found = {"material": case.material, "tension_N_per_m": case.tension, "triangles": case.triangles,
             "twice_the_step_mm": moved(hysteron.run(case, REFERENCE[0], half, "double")[1])}
    if case.triangles < LARGE:
        other = Case("isotropic" if case.material == "woven" else "woven", case.tension, case.triangles)
        other.load(hysteron)
        stiffer = hysteron.run(case, REFERENCE[0], half // 2, "double", rigidity=2 * RIGIDITY)[1]
        found.update(twice_the_bending_mm=moved(stiffer), other_material_mm=moved(other.end))
    return found


# The record


class Record:
    """DIR/table.csv and DIR/record.json, written anew after every row."""

    def __init__(self, folder):
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        self.rows = read_table(folder / "table.csv") if (folder / "table.csv").exists() else []
        self.known = json.loads((folder / "record.json").read_text()) if (folder / "record.json").exists() else {}

    def has(self, job):
        return any(tuple(row[column] for column in COLUMNS[:5]) == job.key for row in self.rows)

    def add(self, row):
        self.rows.append({column: str(value) for column, value in row.items()})
        write_table(self.folder / "table.csv", COLUMNS, self.rows)

    def require(self, found):
        """All rows are of one set of versions and one machine."""
        known = self.known.setdefault("versions", found)
        if known != found:
            changed = ", ".join(name for name in found if found[name] != known.get(name))
            raise SystemExit(f"{self.folder} was measured with others: {changed}")
        self.write()

    def write(self):
        (self.folder / "record.json").write_text(json.dumps(self.known, indent=1) + "\n")


def versions(device, hysteron):
    found = {"python": platform.python_version()}
    for package in ("newton", "warp-lang", "pyuipc", "numpy"):
        try:
            found[package] = importlib.metadata.version(package)
        except importlib.metadata.PackageNotFoundError:
            found[package] = "none"
    if device == "cuda":
        query = ["nvidia-smi", "--query-gpu=name,driver_version", "--format=csv,noheader"]
        answer = subprocess.run(query, check=True, capture_output=True, text=True).stdout.splitlines()[0]
        found.update(zip(("gpu", "driver"), answer.split(", ")))
    found["hysteron"] = hysteron.about
    return found


def installed(solvers):
    needed = {"style3d": "newton", "style3d-lossless": "newton", "vbd": "newton", "libuipc": "uipc"}
    missing = [solver for solver in solvers if solver in needed and not importlib.util.find_spec(needed[solver])]
    for solver in missing:
        print(f"{solver} is left out: there is no package {needed[solver]}", flush=True)
    return [solver for solver in solvers if solver not in missing]


class Budget:
    """What is left of the seconds, and whether a job fits, by what those of its solver took on that many triangles."""

    def __init__(self, seconds):
        self.until, self.rates, self.failures = time.monotonic() + seconds, {}, {}

    def left(self):
        return self.until - time.monotonic()

    def fits(self, job):
        if self.failures.get(job.solver, 0) >= GIVEN_UP:
            return False
        rate = self.rates.get((job.solver, job.case.triangles), self.rates.get(job.solver, 0.0))
        return rate * job.work() < self.left()

    def spent(self, job, row, seconds):
        self.failures[job.solver] = 0 if row["runs"] else self.failures.get(job.solver, 0) + 1
        rate = seconds / job.work()
        if job.work() > 1000 or job.solver == "libuipc":  # others are set-up more than work
            self.rates[job.solver, job.case.triangles] = self.rates[job.solver] = rate


def measure(asked):
    work = pathlib.Path(asked.work)
    hysteron, peers = Hysteron(asked.hysteron, asked.device, work), Peers(asked.device, work)
    record, budget = Record(pathlib.Path(asked.out)), Budget(asked.budget)
    solvers = installed(asked.solvers.split(","))
    jobs = [job for job in all_jobs([int(size) for size in asked.triangles.split(",")], solvers) if not record.has(job)]
    left_out, had_controls = 0, False
    for job in jobs:
        if job.priority >= CONTROLS_BEFORE and not had_controls:
            had_controls = True
            controls(asked, solvers, hysteron, peers, record, budget)
        if budget.left() <= 0 or not budget.fits(job):
            left_out += 1
            continue
        began = time.monotonic()
        job.case.load(hysteron)
        loaded = time.monotonic()
        row = measured(job, hysteron, peers)
        budget.spent(job, row, time.monotonic() - loaded)
        record.add(row)
        record.require(versions(asked.device, hysteron))
        if "CUDA" in row["note"] and job.solver not in ("hysteron", "libuipc"):  # which are processes of their own
            raise SystemExit(f"{job.solver} {job.setting}: {row['note']}; the rows after it go into another call")
        print(f"{job.case.name} {job.solver} {job.setting}: {row['ms_per_simulated_ms']} ms a simulated ms, "
              f"{row['rms_mm']} mm {row['note']} ({time.monotonic() - began:.1f} s)", flush=True)
    if not had_controls:
        controls(asked, solvers, hysteron, peers, record, budget)
    record.write()
    print(f"{len(record.rows)} rows; {left_out} settings did not fit into {asked.budget:g} s", flush=True)


def controls(asked, solvers, hysteron, peers, record, budget):
    """Each once, where there is time."""
    sizes = sorted(int(size) for size in asked.triangles.split(","))
    if "free_fall" not in record.known and budget.left() > 0:
        others = [name for name in solvers if name != "hysteron"]
        record.known["date"] = time.strftime("%Y-%m-%d")
        record.known["free_fall"] = free_fall(sizes[0], others, hysteron, peers)
        record.write()
    found = record.known.setdefault("references", [])
    for case in [Case(material, tension, size) for size in sizes for material in ("woven", "isotropic")
                 for tension in TENSIONS]:
        name = [case.material, case.tension, case.triangles]
        known = any([row[key] for key in ("material", "tension_N_per_m", "triangles")] == name for row in found)
        if known or budget.left() <= 0 or (case.material == "isotropic" and case.triangles > LARGE):
            continue
        case.load(hysteron)
        found.append(reference_control(case, hysteron))
        record.write()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    measuring = commands.add_parser("measure")
    measuring.set_defaults(run=measure)
    measuring.add_argument("--hysteron", required=True, metavar="PROGRAM")
    measuring.add_argument("--out", required=True, metavar="DIR")
    measuring.add_argument("--work", default="/tmp/hysteron-peers", metavar="DIR", help="for references, kept")
    measuring.add_argument("--budget", type=float, default=540, metavar="SECONDS")
    measuring.add_argument("--device", choices=("cuda", "cpu"), default="cuda")
    measuring.add_argument("--triangles", default="18432,4608,131072", help="2 n^2 each")
    measuring.add_argument("--solvers", default=",".join(PLANS))
    drawing = commands.add_parser("draw")
    drawing.set_defaults(run=lambda asked: draw(asked.folder))
    drawing.add_argument("folder", type=pathlib.Path, metavar="DIR")
    asked = parser.parse_args()
    return asked.run(asked)


if __name__ == "__main__":
    sys.exit(main())
