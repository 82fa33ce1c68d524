#!/usr/bin/env pvpython
"""Takes a picture of a run with ParaView, coloured by a field (docs/hand-over.md).

    xvfb-run -a -s -noreset pvpython scripts/paraview_picture.py out/vtp/trajectory.pvd picture.png --time 0.4"""
import argparse
import pathlib
import sys

from paraview import simple


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=pathlib.Path, metavar="trajectory.pvd", help="run of bemsim --format vtp")
    parser.add_argument("picture", type=pathlib.Path, metavar="PNG")
    parser.add_argument("--time", type=float, help="of the frame [s] (the last one)")
    parser.add_argument("--field", default="von_mises", help="colour (von_mises)")
    parser.add_argument("--top", type=float, help="largest value of the colours (that of the frame)")
    parser.add_argument("--size", type=int, nargs=2, default=[1000, 620], metavar=("WIDTH", "HEIGHT"))
    options = parser.parse_args()
    if not options.run.is_file():
        sys.exit(f"error: {options.run}: there is no such file; run bemsim with --format vtp")
    return options


def fields_of(source):
    data = source.GetDataInformation().GetPointDataInformation()
    return [data.GetArrayInformation(i).GetName() for i in range(data.GetNumberOfArrays())]


def show(source, view, options):
    smooth = simple.GenerateSurfaceNormals(Input=simple.ExtractSurface(Input=source), FeatureAngle=50)
    shown = simple.Show(smooth, view)
    fields = fields_of(source)
    if options.field not in fields:
        sys.exit(f"error: {options.run}: has no field {options.field}, but {', '.join(fields)}")
    simple.ColorBy(shown, ("POINTS", options.field))
    table = simple.GetColorTransferFunction(options.field)
    table.ApplyPreset("Viridis (matplotlib)", True)
    table.RescaleTransferFunction(0, options.top or source.PointData[options.field].GetRange()[1])
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle, bar.TitleColor, bar.LabelColor = options.field.replace("_", " "), "", [0.1] * 3, [0.1] * 3
    shown.SetScalarBarVisibility(view, True)


def main():
    options = parse_arguments()
    simple._DisableFirstRenderCameraReset()
    source = simple.PVDReader(FileName=str(options.run.resolve()))
    view = simple.CreateRenderView(ViewSize=options.size)
    view.UseColorPaletteForBackground, view.Background, view.OrientationAxesVisibility = 0, [0.97] * 3, 0
    time = source.TimestepValues[-1] if options.time is None else options.time
    view.ViewTime = time
    source.UpdatePipeline(time)
    show(source, view, options)
    least_most = source.GetDataInformation().GetBounds()
    centre = [(least_most[2 * i] + least_most[2 * i + 1]) / 2 for i in range(3)]
    view.CameraFocalPoint, view.CameraViewUp = centre, [0, 1, 0]
    view.CameraPosition = [centre[0] + 0.2, centre[1] + 0.4, centre[2] + 1]
    view.ResetCamera(*least_most)
    view.CameraViewAngle *= 0.75
    simple.Render(view)
    simple.SaveScreenshot(str(options.picture.resolve()), view, ImageResolution=options.size)


if __name__ == "__main__":
    main()
