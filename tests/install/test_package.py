"""The Debian packages: built, unpacked with dpkg into an empty folder, where bemsim runs a scene. As root, with debootstrap and
a network, also installed by apt into a bare Debian 12, which has nothing but what the packages ask for."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["BEM_BUILD"])
MATERIAL = '{"name": "rubber", "density": 1000, "shear_modulus": 1e6, "poisson_ratio": 0.3}'
SCENE = """{"version": 1, "time_step": 0.005, "duration": 0.05, "bodies":
           [{"name": "ball", "mesh": "ball.obj", "material": "rubber.json", "velocity": [1, 0, 0]}]}"""
RUN = """set -e; cd "$1"; export BEM_CACHE=cache
bemshape icosphere --subdivisions 1 --radius 0.5 -o ball.obj
bemsim scene.json -o out -q
bemmeasure scene.json out/trajectory.h5 >measure.json
"""


def run(*command, **options):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **options)
    if done.returncode:
        raise AssertionError(f"{command}: exit code {done.returncode}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return done.stdout


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="bem-package-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        run("cpack", "-G", "DEB", "-B", cls.folder, cwd=BUILD)
        cls.programs, cls.library = (next(cls.folder.glob(f"{name}_*.deb")) for name in ("bem", "libbem-dev"))

    def scene(self, place):
        place.mkdir()
        (place / "rubber.json").write_text(MATERIAL)
        (place / "scene.json").write_text(SCENE)

    def test_every_library_that_the_programs_load_is_asked_for(self):
        asked = run("dpkg-deb", "-f", self.programs, "Depends")
        root = self.unpacked("libraries", self.programs)
        for program in (root / "usr/bin").glob("bem*"):
            for line in run("readelf", "-d", program).splitlines() if not program.is_symlink() else ():
                if "(NEEDED)" in line and "ld-linux" not in line:
                    name = line.split("[")[1].rstrip("]")
                    packages = {hit.split(":")[0] for hit in run("dpkg", "-S", f"*/{name}").splitlines()}
                    self.assertTrue(any(package in asked for package in packages), f"{name}: {packages}, {asked}")

    def test_bemsim_runs_where_the_package_is_unpacked(self):
        root, place = self.unpacked("root", self.programs), self.folder / "scene"
        self.scene(place)
        environment = {"PATH": f"{root}/usr/bin:/usr/bin:/bin"}
        run("sh", "-c", RUN, "sh", place, env=environment)
        self.assertIn('"ball"', (place / "measure.json").read_text())
        self.assertEqual(run(root / "usr/bin/bemsim", "--version").split()[0], "bem")
        run("sh", "-c", 'bemrender "$1/out/trajectory.h5" --still "$1/still.png"', "sh", place, env=environment)
        self.assertGreater((place / "still.png").stat().st_size, 10000)
        self.assertRegex(run("readelf", "-d", root / "usr/bin/bemsim"), r"RUNPATH.*blis-serial")

    def test_the_library_has_headers_and_the_package_for_cmake(self):
        root = self.unpacked("library", self.library)
        self.assertTrue((root / "usr/include/bem/model/precompute.hpp").exists())
        self.assertEqual(len(list(root.glob("usr/lib/**/libbem.a"))), 1)
        self.assertEqual(len(list(root.glob("usr/lib/**/bemConfig.cmake"))), 1)
        self.assertFalse((root / "usr/bin").exists())

    @unittest.skipUnless(shutil.which("debootstrap") and os.geteuid() == 0, "needs debootstrap and root")
    def test_apt_installs_it_into_a_bare_debian(self):
        root = self.folder / "debian"
        run("debootstrap", "--variant=minbase", "bookworm", root, env={**os.environ, "DEBOOTSTRAP_DIR": "/usr/share/debootstrap"})
        for name in ("etc/apt/apt.conf.d", "etc/resolv.conf"):  # how this machine reaches the network
            source, target = pathlib.Path("/") / name, root / name
            (shutil.copytree if source.is_dir() else shutil.copy)(source, target, **({"dirs_exist_ok": True} if source.is_dir() else {}))
        shutil.copy(self.programs, root)
        run("chroot", root, "apt-get", "install", "-y", "-qq", "--no-install-recommends", f"/{self.programs.name}",
            env={**os.environ, "DEBIAN_FRONTEND": "noninteractive"})
        self.scene(root / "scene")
        run("chroot", root, "sh", "-c", RUN, "sh", "/scene")
        self.assertIn('"ball"', (root / "scene/measure.json").read_text())
        run("chroot", root, "dpkg", "--purge", "bem")
        self.assertFalse((root / "usr/bin/bemsim").exists())

    def unpacked(self, name, package):
        root = self.folder / name
        run("dpkg-deb", "-x", package, root)
        return root


if __name__ == "__main__":
    sys.exit(unittest.main())
