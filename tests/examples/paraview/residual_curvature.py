"""Where a cloth would stay bent, at the end of a run with --export vtk, in ParaView's renderer:
pvbatch residual_curvature.py DIR PICTURE.png"""
import sys

from paraview.simple import *

folder, picture = sys.argv[1:]
series = PVDReader(FileName=folder + "/mesh/cloth.pvd")
smooth = GenerateSurfaceNormals(Input=series, FeatureAngle=180)

view = CreateView("RenderView")
view.ViewTime = series.TimestepValues[-1]
view.ViewSize = [960, 480]
view.UseColorPaletteForBackground, view.Background = 0, [1, 1, 1]
view.OrientationAxesVisibility = 0

cloth = Show(smooth, view)
ColorBy(cloth, ("POINTS", "residual_curvature"))
colors = GetColorTransferFunction("residual_curvature")
colors.ApplyPreset("Viridis (matplotlib)", True)
cloth.RescaleTransferFunctionToDataRange()
bar = GetScalarBar(colors, view)
bar.Title, bar.ComponentTitle = "residual curvature [1/m]", ""
bar.TitleColor = bar.LabelColor = [0, 0, 0]
bar.RangeLabelFormat = "%.0f"
cloth.SetScalarBarVisibility(view, True)

view.ResetActiveCameraToDirection(-0.4, 1, -0.5, 0, 0, 1)
Render(view)
view.ResetCamera(True)
SaveScreenshot(picture, view)
