"""Mesh files: what polygons, formats, separate solids and damaged files become, and Ctrl-C while one is read."""
import json
import os
import pathlib
import resource
import signal
import subprocess
import time
import unittest
import zipfile

import h5py
import numpy

from cli_case import BEMPRECOMP, BEMSHAPE, CliCase

# prism with a U as its base, 8-gons as caps; lengths that no binary number has
U = [(0, 0), (0.3, 0), (0.3, 0.3), (0.2, 0.3), (0.2, 0.1), (0.1, 0.1), (0.1, 0.3), (0, 0.3)]
U_VERTICES = [(x, y, z) for z in (0, 0.1) for x, y in U]
U_FACES = [list(range(8, 16)), list(range(7, -1, -1))] + [[k, (k + 1) % 8, (k + 1) % 8 + 8, k + 8] for k in range(8)]
# its header never ends for the reader
ENDLESS_PLY = "ply\nformat binary_big_endian 1.0\nelement vertex 8\nproperty floap\r"
MEDIT = "MeshVersionFormatted 1\nDimension 3\nVertices\n3\n0 0 0 0\n1 0 0 0\n0 1 0 0\nTriangles\n1\n1 2 3 0\nEnd\n"


def rows(values):
    return "".join(" ".join(map(str, row)) + "\n" for row in values)


def obj_text(vertices, faces):
    return rows([("v", *v) for v in vertices] + [("f", *[k + 1 for k in f]) for f in faces])


def off_text(vertices, faces):
    return f"OFF\n{len(vertices)} {len(faces)} 0\n" + rows(vertices) + rows([(len(f), *f) for f in faces])


def ply_text(vertices, faces):
    return ("ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
            "element face %d\nproperty list uchar int vertex_indices\nend_header\n" % (len(vertices), len(faces))
            + rows(vertices) + rows([(len(f), *f) for f in faces]))


def children(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    except OSError:
        return []


class MeshCase(CliCase):
    def rigid(self, mesh, code=0):
        return self.run_tool(mesh, "rubber.json", "-o", "a.bem", "--dt", 0.01, "--model", "rigid", "--force", code=code)

    def write(self, name, text):
        (self.folder / name).write_text(text, newline="")
        return name

    def archive(self):
        """Vertices, faces and volume of the archive."""
        with h5py.File(self.folder / "a.bem") as file:
            vertices, faces = file["mesh/vertices"][:], file["mesh/faces"][:]
        body = json.loads(self.run_tool("--info", "a.bem", "--json").stdout)["body"]
        return vertices, faces, body["mass"] / 1000


class Polygons(MeshCase):
    def test_faces_are_the_same_triangles_in_every_format(self):
        expected = None
        for name, text in [("u.obj", obj_text), ("u.off", off_text), ("u.ply", ply_text)]:
            with self.subTest(name):
                self.rigid(self.write(name, text(U_VERTICES, U_FACES)))
                vertices, faces, volume = self.archive()
                self.assertEqual(len(faces), 28)
                self.assertAlmostEqual(volume, 0.007, delta=1e-8)
                a, b, c = (vertices[faces[:12, k]] for k in range(3))  # caps
                caps = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2
                self.assertAlmostEqual(caps, 0.14, delta=1e-7)
                expected = faces if expected is None else expected
                numpy.testing.assert_array_equal(faces, expected)

    def test_a_face_that_crosses_itself_is_named(self):
        star = [0, 2, 4, 6, 1, 3, 5, 7]
        self.write("star.obj", obj_text(U_VERTICES, [star, *U_FACES]))
        self.assert_error(self.rigid("star.obj", code=3), "star.obj:17: face 0 with 8 corners", "crosses or touches itself")

    def test_old_line_ends(self):
        self.rigid(self.write("u.obj", obj_text(U_VERTICES, U_FACES).replace("\n", "\r")))
        self.assertAlmostEqual(self.archive()[2], 0.007, 12)


class Messages(MeshCase):
    def test_formats_that_are_not_supported(self):
        for name, text, part in [("a.mesh", MEDIT, "a Medit mesh"), ("a.msh", MEDIT, "a Medit mesh"),
                                 ("b.msh", "$MeshFormat\n2.2 0 8\n", "a Gmsh mesh"), ("a.xyz", "1 2 3\n", ".xyz"),
                                 ("a.vtk", "# vtk DataFile Version 3.0\n", "a VTK file")]:
            with self.subTest(name):
                self.assert_error(self.rigid(self.write(name, text), code=3),
                                  f"{name}: {part} is a format that is not supported", "OBJ, OFF, PLY, STL")

    def test_a_3mf_file_is_read_or_not_supported_but_not_damaged(self):
        triangles = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        space = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
        package = "http://schemas.openxmlformats.org/package/2006"
        model = (f'<?xml version="1.0"?><model unit="meter" xmlns="{space}"><resources><object id="1" type="model"><mesh>'
                 + "<vertices>" + "".join('<vertex x="%d" y="%d" z="%d"/>' % c for c in corners) + "</vertices><triangles>"
                 + "".join('<triangle v1="%d" v2="%d" v3="%d"/>' % t for t in triangles)
                 + '</triangles></mesh></object></resources><build><item objectid="1"/></build></model>')
        types = (f'<?xml version="1.0"?><Types xmlns="{package}/content-types"><Default Extension="rels" ContentType='
                 '"application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType='
                 '"application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
        relations = (f'<?xml version="1.0"?><Relationships xmlns="{package}/relationships"><Relationship Id="r" Target='
                     '"/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
        for name, preview in [("plain.3mf", None), ("preview.3mf", b"\x89PNG")]:
            with zipfile.ZipFile(self.folder / name, "w") as file:
                for part, text in [("[Content_Types].xml", types), ("_rels/.rels", relations), ("3D/3dmodel.model", model)]:
                    file.writestr(part, text)
                if preview:
                    file.writestr("Metadata/thumbnail.png", preview)
        self.rigid("plain.3mf")
        self.assertAlmostEqual(self.archive()[2], 1 / 6, 9)
        done = self.rigid("preview.3mf", code=3)
        self.assert_error(done, "preview.3mf: ", "is a format that is not supported")
        whole = (self.folder / "preview.3mf").read_bytes()
        (self.folder / "cut.3mf").write_bytes(whole[:len(whole) // 2])
        self.assertNotIn("not supported", self.rigid("cut.3mf", code=3).stderr)

    def test_edges_that_lie_on_each_other(self):
        vertices = U_VERTICES + [(x + 1e-10, y, z) for x, y, z in U_VERTICES[:8]]
        faces = [[k + 16 for k in face] if i == 1 else face for i, face in enumerate(U_FACES)]
        self.assert_error(self.rigid(self.write("u.obj", obj_text(vertices, faces)), code=3),
                          "edges that lie on each other without sharing their vertices", "16 such edges",
                          "join vertices up to 1.01e-10 m apart", "that closes the surface")


class Solids(MeshCase):
    def two_spheres(self):
        lines = (self.folder / "sphere.obj").read_text().splitlines()
        vertices = [tuple(map(float, line.split()[1:])) for line in lines if line.startswith("v ")]
        faces = [[int(k) - 1 for k in line.split()[1:]] for line in lines if line.startswith("f ")]
        n = len(vertices)
        other = [(x + 0.5, y, z) for x, y, z in vertices]
        hole = [(0.5 * x, 0.5 * y, 0.5 * z) for x, y, z in vertices]
        moved = [[[k + i * n for k in face] for face in faces] for i in (1, 2)]
        self.write("two.obj", obj_text(vertices + other + hole, faces + moved[0] + [f[::-1] for f in moved[1]]))
        return n, len(faces)

    def split(self, *arguments, code=0):
        done = subprocess.run([BEMSHAPE, "split", *arguments], cwd=self.folder, text=True, capture_output=True, timeout=60)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def test_separate_solids_are_refused_and_split(self):
        n, faces = self.two_spheres()
        self.assert_error(self.rigid("two.obj", code=3), "two.obj: 2 separate solids",
                          "bemshape split two.obj -o 'part-%d.obj'", f"triangle {faces} ")
        self.split("two.obj", "-o", "part-%d.obj")
        self.assertEqual(self.files(), ["part-0.obj", "part-1.obj", "rubber.json", "sphere.obj", "two.obj"])
        self.assertEqual((self.folder / "part-1.obj").read_text().count("\nf "), faces)
        first = (self.folder / "part-0.obj").read_text().splitlines()
        self.assertEqual(sum(line.startswith("v ") for line in first), 2 * n)  # with its cavity
        self.rigid("sphere.obj")
        whole = self.archive()[2]
        for part, volume in [("part-0.obj", 0.875 * whole), ("part-1.obj", whole)]:
            self.assertNotIn("warning", self.rigid(part).stderr)
            self.assertAlmostEqual(self.archive()[2] / volume, 1, 9)

    def test_what_split_does_not_write(self):
        self.two_spheres()
        before = self.files()
        self.assertIn("-o needs a %d", self.split("two.obj", "-o", "part.obj", code=2).stderr)
        self.assertIn("more than one %d", self.split("two.obj", "-o", "%d-%d.obj", code=2).stderr)
        os.link(self.folder / "two.obj", self.folder / "part-1.obj")
        self.assertIn("would overwrite the input", self.split("two.obj", "-o", "part-%d.obj", code=2).stderr)
        os.unlink(self.folder / "part-1.obj")
        self.assertIn("no such mesh file", self.split("none.obj", "-o", "part-%d.obj", code=3).stderr)
        self.assertEqual(self.files(), before)
        self.split("sphere.obj", "-o", "one.obj")  # one solid needs no number
        self.assertEqual((self.folder / "one.obj").read_text(), (self.folder / "sphere.obj").read_text())


class ReaderProcess(MeshCase):
    def begin(self):
        """A program whose reader works on a damaged file."""
        self.write("bad.ply", ENDLESS_PLY)
        process = subprocess.Popen([BEMPRECOMP, "bad.ply", "rubber.json", "-o", "a.bem", "--dt", "0.01"],
                                   cwd=self.folder, stderr=subprocess.PIPE, text=True, start_new_session=True)
        while not children(process.pid):
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        return process, int(children(process.pid)[0])

    def assert_gone(self, pid):
        for _ in range(100):
            try:
                if ") Z " in pathlib.Path(f"/proc/{pid}/stat").read_text():
                    return
            except OSError:
                return
            time.sleep(0.05)
        self.fail("the reader outlived the program")

    def test_a_short_damaged_file_takes_a_moment(self):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assert_error(self.rigid(self.write("bad.ply", ENDLESS_PLY), code=3), "bad.ply", "damaged", "too much time")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertLess(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, 5)

    def test_interruptions_while_a_mesh_is_read(self):
        for sent, code in [(signal.SIGINT, 130), (signal.SIGTERM, 143)]:
            for send in (os.kill, os.killpg):  # the program alone, or all of it as Ctrl-C does
                with self.subTest(signal=sent, send=send.__name__):
                    process, reader = self.begin()
                    send(process.pid, sent)
                    start = time.monotonic()
                    message = process.communicate(timeout=30)[1]
                    self.assertEqual(process.returncode, code, message)
                    self.assertLess(time.monotonic() - start, 5)
                    self.assertIn("error: interrupted", message)
                    self.assert_gone(reader)

    def test_the_reader_ends_with_a_killed_program(self):
        process, reader = self.begin()
        process.kill()
        process.communicate()
        self.assert_gone(reader)


if __name__ == "__main__":
    unittest.main()
