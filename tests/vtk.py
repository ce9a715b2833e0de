"""A swing exported for ParaView, opened by VTK: `vtk.py HYSTERON FOLDER`.  Exit code 77 without VTK's package."""
import shutil
import subprocess
import sys
import xml.etree.ElementTree as tree
from pathlib import Path

try:
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError:
    print("python3-vtk9 is not installed")
    sys.exit(77)

program, folder = sys.argv[1], Path(sys.argv[2])
shutil.rmtree(folder, ignore_errors=True)
subprocess.run([program, "swing", "--quick", "--seconds", "0.2", "--device", "cpu", "--no-images", "--quiet",
                "--export", "vtk", "--out", str(folder)], check=True, stdout=subprocess.DEVNULL)
instants = tree.parse(folder / "mesh" / "cloth.pvd").getroot().findall("Collection/DataSet")
assert len(instants) > 2, "several instants"
assert [float(i.get("timestep")) for i in instants] == sorted(float(i.get("timestep")) for i in instants)
for instant in instants:
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / "mesh" / instant.get("file")))
    reader.Update()
    cloth = reader.GetOutput()
    assert cloth.GetNumberOfPolys() > 100, "triangles"
    for name, components in (("velocity", 3), ("curvature", 1), ("moment", 1), ("residual_curvature", 1),
                             ("friction_share", 1)):
        array = cloth.GetPointData().GetArray(name)
        assert array and array.GetNumberOfComponents() == components, name
        assert array.GetNumberOfTuples() == cloth.GetNumberOfPoints(), name
    for name in ("curvature_tensor", "moment_tensor", "residual_curvature_tensor"):
        assert cloth.GetCellData().GetArray(name).GetNumberOfTuples() == cloth.GetNumberOfPolys(), name
low, high = cloth.GetPointData().GetArray("friction_share").GetRange()
assert 0 <= low and high <= 1 + 1e-9, "shares"
assert cloth.GetBounds()[4] < -0.01, "the strip has fallen"
print(len(instants), "instants read by VTK")
