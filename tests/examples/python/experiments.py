import hysteron_cloth as h

run = h.run("drape", fabric="wool-tropical", quick=True, triangles=120, no_images=True)
print(run.metrics["drape_coefficient_percent"], run.path, run.warnings)  # as manifest.json has them
print(run.series["time [s]"], run.series["drape_coefficient [%]"])  # columns of metrics.csv, by names with units

both = h.compare("swing", ["linear", "prandtl"], quick=True, triangles=100, no_images=True)
print(both.columns["prandtl"].series["bending_friction [J]"][-1])
