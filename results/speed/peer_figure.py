"""The comparison and the figure of a table that peers.py wrote: error over time of every setting of every solver.

`fastest` sets the fastest run of each peer beside hysteron's, in the same material, at three errors: the smallest that
any setting of the peer has (`best`; hysteron's is no larger), 8 mm and 2 mm.
"""
import csv
import math
import subprocess

FAR = 60.0  # [mm] from which on a run shows another fall
WITHIN = (8, 2)  # [mm]
TENSIONS = (1e3, 1e4)  # [N/m]
MATERIAL = {"style3d": "woven", "style3d-lossless": "woven", "vbd": "isotropic", "libuipc": "woven"}


def read_table(path):
    with path.open(newline="") as stream:
        return list(csv.DictReader(stream))


def write_table(path, columns, rows):
    with path.open("w", newline="") as stream:
        writer = csv.DictWriter(stream, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def number(row, column):
    return float(row[column]) if row[column] else math.nan


def fastest(rows):
    """For each peer on each case its fastest run within some errors, and hysteron's, in the same material."""
    found = []
    for solver, material in MATERIAL.items():
        for size in sorted({int(row["triangles"]) for row in rows}):
            for tension in TENSIONS:
                here = [row for row in rows if int(row["triangles"]) == size and row["material"] == material
                        and float(row["tension_N_per_m"]) == tension]
                theirs = [row for row in here if row["solver"] == solver]
                ours = [row for row in here if row["solver"] == "hysteron"]
                if theirs:
                    case = {"solver": solver, "triangles": size, "tension_N_per_m": f"{tension:g}"}
                    found += [{**case, **compared(at, theirs, ours)} for at in ("best", *WITHIN)]
    return found


def within(rows, error):
    """The fastest of them that is as near as that, or none."""
    near = [row for row in rows if row["rms_mm"] and number(row, "rms_mm") <= error]
    return min(near, key=lambda row: number(row, "ms_per_simulated_ms"), default=None)


def compared(at, theirs, ours):
    arrived = [number(row, "rms_mm") for row in theirs if row["rms_mm"] and number(row, "rms_mm") <= FAR]
    row = {"at_mm": at, "settings_tried": len(theirs)}
    if not arrived:
        return {**row, "note": f"none within {FAR:g} mm"}
    peer = within(theirs, min(arrived) if at == "best" else at)
    if peer is None:
        return {**row, "note": f"none within {at} mm"}
    row.update(setting=peer["setting"], ms_per_simulated_ms=peer["ms_per_simulated_ms"], rms_mm=peer["rms_mm"])
    own = within(ours, number(peer, "rms_mm") if at == "best" else at)
    if own is None:
        return {**row, "note": "hysteron was not run as near"}
    times = number(peer, "ms_per_simulated_ms") / number(own, "ms_per_simulated_ms")
    return {**row, "hysteron_setting": own["setting"], "hysteron_ms_per_simulated_ms": own["ms_per_simulated_ms"],
            "hysteron_rms_mm": own["rms_mm"], "times_as_long": f"{times:.3g}"}


FASTEST = ("solver triangles tension_N_per_m at_mm settings_tried setting ms_per_simulated_ms rms_mm hysteron_setting "
           "hysteron_ms_per_simulated_ms hysteron_rms_mm times_as_long note").split()
# Label, colour, gnuplot's point, and which rows: solver, material, what the setting begins with.
SERIES = (("hysteron bdf2", "#0072B2", 7, "hysteron", "woven", "bdf2"),
          ("hysteron implicit", "#56B4E9", 5, "hysteron", "woven", "implicit"),
          ("hysteron tr-bdf2", "#003C64", 9, "hysteron", "woven", "tr-bdf2"),
          ("hysteron, isotropic", "#999999", 7, "hysteron", "isotropic", ""),
          ("Style3D", "#D55E00", 7, "style3d", "woven", ""),
          ("Style3D without its losses", "#D55E00", 6, "style3d-lossless", "woven", ""),
          ("VBD, isotropic", "#CC79A7", 5, "vbd", "isotropic", ""),
          ("libuipc", "#009E73", 9, "libuipc", "woven", ""))


def figure_script(rows, base, terminal):
    """A page of panels, tensions over one another and meshes side by side, as a gnuplot script."""
    sizes = sorted({int(row["triangles"]) for row in rows})
    drawn = [row for row in rows if row["rms_mm"]]
    width, height = 120 + 480 * len(sizes), 60 + 430 * len(TENSIONS)
    costs, errors = [number(row, "ms_per_simulated_ms") for row in drawn], [number(row, "rms_mm") for row in drawn]
    script = [f"set terminal {terminal} enhanced size {width},{height} font 'DejaVu Sans,13' background rgb 'white'",
              f"set output '{base}.{'png' if terminal == 'pngcairo' else 'svg'}'", "set encoding utf8",
              f"set multiplot layout {len(TENSIONS)},{len(sizes)}", "set logscale xy", "set grid lc rgb '#dddddd'",
              f"set xrange [{0.7 * min(costs)}:{1.5 * max(costs)}]",
              f"set yrange [{0.7 * min(errors)}:{1.5 * max(errors)}]",
              "set xlabel 'time [ms a simulated ms]'", "set ylabel 'error at 0.25 s [mm]'"]
    for tension in TENSIONS:
        for size in sizes:
            first = (tension, size) == (TENSIONS[0], sizes[-1])
            script.append("set key top right samplen 1 font ',10' opaque" if first else "unset key")
            script.append(f"set title '{size:,} triangles, {tension / 1e3:g} kN/m'")
            script += panel(drawn, tension, size)
    return "\n".join([*script, "unset multiplot", ""])


def panel(rows, tension, size):
    blocks, plots = [], []
    for index, (label, color, point, solver, material, start) in enumerate(SERIES):
        here = sorted((number(row, "ms_per_simulated_ms"), number(row, "rms_mm")) for row in rows
                      if row["solver"] == solver and row["material"] == material and row["setting"].startswith(start)
                      and int(row["triangles"]) == size and float(row["tension_N_per_m"]) == tension)
        blocks += [f"$series{index} << END", *(f"{cost} {error}" for cost, error in here), "END"]
        if any(row["solver"] == solver and row["material"] == material for row in rows):
            style = "linespoints lw 1.5" if solver == "hysteron" and material == "woven" else "points"
            data = f"$series{index} using 1:2" if here else "NaN"
            plots.append(f"{data} with {style} pt {point} ps 1.1 lc rgb '{color}' title '{label}'")
    return [*blocks, "plot " + ", ".join(plots)]


def draw(folder):
    """DIR/fastest.csv, DIR/plot_peers.png and .svg from DIR/table.csv."""
    rows = read_table(folder / "table.csv")
    if not any(row["rms_mm"] for row in rows):
        raise SystemExit(f"{folder / 'table.csv'} has no error to draw")
    write_table(folder / "fastest.csv", FASTEST, fastest(rows))
    for terminal in ("pngcairo", "svg"):
        script = figure_script(rows, folder / "plot_peers", terminal)
        subprocess.run(["gnuplot", "-"], input=script, text=True, check=True)
