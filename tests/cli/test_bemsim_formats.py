"""The output formats of bemsim beside HDF5, read as other programs read them."""
import unittest
import xml.etree.ElementTree

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from simulation_case import SimulationCase, falling_ball, held_ball, models, program, read_obj


class Formats(SimulationCase):
    def test_obj_equals_hdf5(self):
        self.scene["bodies"].append(held_ball())
        self.simulate("--format", "obj,hdf5", "--every", 5)
        files = sorted(path.name for path in (self.out / "obj").iterdir())
        self.assertEqual(files, [f"{name}_{k:06}.obj" for name in ("ball", "held") for k in range(5)])
        with self.trajectory() as file:
            for name, body in file["bodies"].items():
                for k in range(5):
                    vertices, faces = read_obj(self.out / "obj" / f"{name}_{k:06}.obj")
                    np.testing.assert_array_equal(vertices, body["positions"][k])
                    np.testing.assert_array_equal(faces, body["faces"])

    def test_option_replaces_the_formats_of_the_scene(self):
        self.scene["output"] = {"formats": ["hdf5", "vtp"]}
        self.simulate("--format", "obj", "--steps", 1)
        self.assertEqual([path.name for path in self.out.iterdir()], ["obj"])


def read_vtp(path):
    reader = vtkXMLPolyDataReader()
    failures = []
    reader.AddObserver("ErrorEvent", lambda *_: failures.append(path))
    reader.SetFileName(str(path))
    reader.Update()
    assert not failures, failures
    return reader.GetOutput()


def corners(surface):
    cells = vtk_to_numpy(surface.GetPolys().GetConnectivityArray())
    np.testing.assert_array_equal(vtk_to_numpy(surface.GetPolys().GetOffsetsArray()),
                                  np.arange(0, len(cells) + 1, 3))
    return cells.reshape(-1, 3)


def read_pvd(path):
    """Times, and by time the entries."""
    root = xml.etree.ElementTree.parse(path).getroot()
    assert root.tag == "VTKFile" and root.attrib["type"] == "Collection"
    times = {}
    for entry in root.find("Collection"):
        times.setdefault(float(entry.attrib["timestep"]), []).append(entry.attrib)
    return times


def read_pc2(path):
    data = path.read_bytes()
    assert data[:12] == b"POINTCACHE2\0"
    version, vertices = np.frombuffer(data, "<i4", 2, 12)
    start, sampling = np.frombuffer(data, "<f4", 2, 20)
    samples, = np.frombuffer(data, "<i4", 1, 28)
    assert (version, start, sampling) == (1, 0, 1)
    return np.frombuffer(data, "<f4", offset=32).reshape(samples, vertices, 3)


class ParaView(SimulationCase):
    def setUp(self):
        super().setUp()
        loaded = {**held_ball(), "tractions": [{"select": "all", "traction": [30, 0, -40]}]}
        self.scene["bodies"] = [falling_ball(), {**loaded, "name": "held & <pulled>"}]

    def test_vtp_equals_hdf5(self):
        for fields in (["positions"], ["positions", "tractions"]):
            self.scene["output"] = {"formats": ["vtp", "hdf5"], "every": 5, "fields": fields}
            self.simulate("--force")
            self.check_vtp("tractions" in fields)

    def check_vtp(self, tractions):
        rest, _ = read_obj(models / "ball.obj")
        times = read_pvd(self.out / "vtp" / "trajectory.pvd")
        with self.trajectory() as file:
            self.assertEqual(list(times), list(file["time"]))
            names = list(file["bodies"])
            for k, (time, entries) in enumerate(times.items()):
                self.assertEqual([e["name"] for e in entries], names)
                self.assertEqual([e["part"] for e in entries], ["0", "1"])
                for entry in entries:
                    body = file["bodies"][entry["name"]]
                    surface = read_vtp(self.out / "vtp" / entry["file"])
                    points = vtk_to_numpy(surface.GetPoints().GetData())
                    self.assertEqual(points.dtype, np.float64)
                    self.assertEqual(points.tobytes(), body["positions"][k].tobytes())
                    np.testing.assert_array_equal(corners(surface), body["faces"])
                    self.assertEqual(surface.GetFieldData().GetArray("TimeValue").GetValue(0), time)
                    placed = body["frame/translation"][k] + rest @ body["frame/rotation"][k].T
                    fields = {"deformation": body["positions"][k] - placed}
                    if tractions:
                        fields["tractions"] = body["tractions"][k]
                    data = surface.GetPointData()
                    self.assertEqual([data.GetArrayName(i) for i in range(data.GetNumberOfArrays())], list(fields))
                    for name, expected in fields.items():
                        np.testing.assert_allclose(vtk_to_numpy(data.GetArray(name)), expected, rtol=1e-12, atol=1e-14)
            last = vtk_to_numpy(read_vtp(self.out / "vtp" / times[time][1]["file"]).GetPointData().GetArray("deformation"))
            self.assertGreater(np.abs(last).max(), 1e-4)

    def test_vtp_beside_an_earlier_run(self):
        self.simulate("--format", "vtp", "--steps", 3)
        self.assert_error(self.simulate("--format", "vtp", expect=2), "--force")
        (self.out / "vtp" / "mine.vtp").write_text("mine")
        self.simulate("--format", "hdf5", "--force", "--steps", 3)
        self.assertEqual([path.name for path in (self.out / "vtp").iterdir()], ["mine.vtp"])


class PointCache(SimulationCase):
    def test_pc2_equals_hdf5_in_single_precision(self):
        self.scene["bodies"].append(held_ball())
        self.simulate("--format", "pc2,hdf5", "--every", 4)
        with self.trajectory() as file:
            for name, body in file["bodies"].items():
                samples = read_pc2(self.out / "pc2" / f"{name}.pc2")
                np.testing.assert_array_equal(samples, body["positions"][:].astype(np.float32))
                vertices, faces = read_obj(self.out / "pc2" / f"{name}.obj")
                np.testing.assert_array_equal(faces, body["faces"])
                np.testing.assert_allclose(vertices, body["positions"][0], atol=1e-14)

    def test_pc2_beside_an_earlier_run(self):
        self.simulate("--format", "pc2", "--steps", 3)
        self.assert_error(self.simulate("--format", "pc2", expect=2), "--force")
        (self.out / "pc2" / "mine.obj").write_text("mine")
        self.simulate("--format", "hdf5", "--force", "--steps", 3)
        self.assertEqual([path.name for path in (self.out / "pc2").iterdir()], ["mine.obj"])

    def test_check_names_the_formats(self):
        self.scene["output"] = {"formats": ["vtp", "pc2"]}
        self.assertIn("as vtp, pc2", self.check().stdout)


if __name__ == "__main__":
    unittest.main()
