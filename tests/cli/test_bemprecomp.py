"""bemprecomp: inputs, options, exit codes, and what is left behind."""
import json
import os
import re
import resource
import signal
import subprocess
import time
import unittest

from cli_case import BEMPRECOMP, BEMSHAPE, DATA, CliCase

INPUTS = ["rubber.json", "sphere.obj"]

# What the message about each bad mesh must say after the file's name: the first bad element, and
# how many there are. What is no mesh file at all is refused at its first bad line.
BAD_MESHES = {
    "inconsistent_orientation": r": inconsistent orientation: .* edge 0-2 of triangle 0 .* 3 such edges in all",
    "index_out_of_range": r":7: index out of range: face 1 .* 2 such faces in all",
    "no_triangle": r": no triangle at all",
    "nonfinite": r":3: non-finite coordinate: vertex 1 .* 2 such vertices in all",
    "nonmanifold_edge": r": non-manifold edge: edge 1-0 of triangle 0 .* 4 triangles .* 1 such edge in all",
    "nonmanifold_vertex": r": non-manifold vertex: vertex 0 .* 1 such vertex in all",
    "open_boundary": r": open boundary: edge 2-1 of triangle 0 .* 3 such edges in all",
    "repeated_vertex": r": zero-area triangle: triangle 4 .* 2 such triangles in all",
    "short_face": r":7: a face needs at least three vertices",
    "unparsable_number": r':4: "1\.o" is not a number',
    "zero_area": r": zero-area triangle: triangle 1 .* 2 such triangles in all",
    "zero_volume": r": zero volume: the part with triangle 0 .* 1 such part in all",
}


class Inputs(CliCase):
    def test_bad_meshes_are_refused(self):
        meshes = sorted((DATA / "bad_meshes").glob("*.obj"))
        self.assertEqual({m.stem for m in meshes}, set(BAD_MESHES))
        for mesh in meshes:
            with self.subTest(mesh=mesh.name):
                done = self.run_tool(mesh, "rubber.json", "-o", "a.bem", "--dt", 0.01, code=3)
                self.assert_error(done)
                self.assertRegex(done.stderr, f"^error: .*{mesh.name}{BAD_MESHES[mesh.stem]}")
        self.assertEqual(self.files(), INPUTS)

    def test_missing_or_broken_inputs(self):
        for mesh, material in [("none.obj", "rubber.json"), ("sphere.obj", "none.json"),
                               ("sphere.obj", "sphere.obj"), (".", "rubber.json")]:
            with self.subTest(mesh=mesh, material=material):
                done = self.run_tool(mesh, material, "-o", "a.bem", "--dt", 0.01, code=3)
                self.assert_error(done, mesh if mesh != "sphere.obj" else material)
        self.material("bad.json", poisson_ratio=0.7)
        done = self.run_tool("sphere.obj", "bad.json", "-o", "a.bem", "--dt", 0.01, code=3)
        self.assert_error(done, "bad.json:1:", "/poisson_ratio")
        for name in ("rub\0ber", "two\nlines", "x" * 1001):
            (self.folder / "bad.json").write_text(json.dumps(
                {**json.loads((self.folder / "rubber.json").read_text()), "name": name}))
            done = self.run_tool("sphere.obj", "bad.json", "-o", "a.bem", "--dt", 0.01, code=3)
            self.assert_error(done, "bad.json:1:", "/name")
        self.assertEqual(self.files(), ["bad.json", *INPUTS])

    def test_absurd_histories(self):
        for options, message in [(("--damping", "kelvin_voigt:1e9", "--dt", 0.01), "steps long"),
                                 (("--history", 1, "--dt", 1e-4), "too short")]:
            done = self.run_tool("sphere.obj", "rubber.json", "-o", "a.bem", *options, code=2)
            self.assert_error(done, message)
        self.assertEqual(self.files(), INPUTS)

    def test_interruption_of_one_that_waits_for_a_pipe(self):
        for mesh, material in [("pipe.obj", "rubber.json"), ("sphere.obj", "pipe.obj")]:
            os.mkfifo(self.folder / "pipe.obj")
            process = subprocess.Popen([BEMPRECOMP, mesh, material, "-o", "a.bem", "--dt", "0.01"], cwd=self.folder,
                                       stderr=subprocess.PIPE, text=True)
            time.sleep(0.5)
            process.send_signal(signal.SIGTERM)
            self.assertIn("interrupted", process.communicate(timeout=10)[1])
            self.assertEqual(process.returncode, 143)
            (self.folder / "pipe.obj").unlink()

    def test_time_step_comes_from_option_or_material(self):
        done = self.run_tool("sphere.obj", "rubber.json", "-o", "a.bem")
        self.assertRegex(done.stderr, 'info: no time step is given: 0.[0-9]+ s, .*"auto"')
        long = self.run_tool("sphere.obj", "rubber.json", "--dry-run", "--history", 61)
        self.assertIn("the history is long: 61 steps; memory and time grow with it\n", long.stderr)
        self.material("timed.json", time_step=0.01)
        for arguments, dt in [([], 0.01), (["--dt", "0.02"], 0.02)]:
            self.run_tool("sphere.obj", "timed.json", "-o", "a.bem", "--force", *arguments)
            info = json.loads(self.run_tool("--info", "a.bem", "--json").stdout)
            self.assertEqual(info["scheme"]["dt"], dt)

    def test_an_archive_of_the_same_inputs_is_up_to_date(self):
        self.precompute()
        made = (self.folder / "a.bem").stat().st_mtime_ns
        self.assertEqual(self.precompute().stderr, "info: a.bem: up to date\n")
        self.assertEqual(self.precompute("--if-changed").stderr, "info: a.bem: up to date\n")
        self.assertEqual((self.folder / "a.bem").stat().st_mtime_ns, made)
        self.assert_error(self.precompute("--codec-tol", 1e-3, code=2), "a.bem: exists already", "--codec-tol 1e-04", "--force")
        self.material(density=1001)
        self.assert_error(self.precompute(code=2), "has another density: 1000 instead of 1001")
        self.precompute("--if-changed")
        self.assertGreater((self.folder / "a.bem").stat().st_mtime_ns, made)
        self.sphere(0)
        self.assert_error(self.precompute(code=2), "has another mesh: 42 vertices and 80 triangles instead of 12 vertices")
        (self.folder / "a.bem").write_text("mine")
        self.assert_error(self.precompute("--if-changed", code=2), "is no complete archive")
        self.assertEqual((self.folder / "a.bem").read_text(), "mine")
        self.assert_error(self.precompute("--if-changed", "--force", code=2), "either --force or --if-changed")

    def test_mesh_scale(self):
        self.precompute("--mesh-scale", 2)
        info = json.loads(self.run_tool("--info", "a.bem", "--json").stdout)
        self.assertAlmostEqual(info["body"]["extent"], 0.4, 12)
        self.assertEqual(info["provenance"]["mesh_scale"], 2)

    def test_mesh_warnings_do_not_stop(self):
        sphere = (self.folder / "sphere.obj").read_text()
        pierced = re.sub(r"^v (\S+) (\S+) (\S+)", lambda m: "v " + " ".join(str(-1.5 * float(x)) for x in m.groups()),
                         sphere, count=1, flags=re.M)
        run_shape = [BEMSHAPE, "box", "--divisions", "1", "1", "1", "--size", "1", "1"]
        subprocess.run([*run_shape, "0.005", "-o", self.folder / "thin.obj"], check=True)
        meshes = {
            "inward": (re.sub(r"^f (\d+) (\d+) (\d+)$", r"f \1 \3 \2", sphere, flags=re.M), "outward"),
            "crossing": (pierced, "the surface intersects itself: [0-9]+ pairs"),
            "thin": ((self.folder / "thin.obj").read_text(), "very thin triangles .* 8 triangles, first triangle 0"),
        }
        for name, (text, message) in meshes.items():
            with self.subTest(name):
                self.assertNotEqual(text, sphere)
                (self.folder / "sphere.obj").write_text(text)
                lines = self.precompute("-q", "--force", "--window", "1", "--discretisation",
                                        "collocation").stderr.splitlines()  # galerkin takes minutes for thin bodies
                about_mesh = [line for line in lines if line.startswith("warning: sphere.obj: ")]
                self.assertRegex(about_mesh[-1], message)
                self.assertEqual(len(about_mesh), 1, lines)
                self.run_tool("--verify", "a.bem")


class Usage(CliCase):
    def test_wrong_command_lines(self):
        wrong = [
            (["--dt", "0"], "--dt"), (["--dt", "-1"], "--dt"), (["--dt", "nan"], "--dt"),
            (["--dt", "inf"], "--dt"), (["--dt", "x"], "--dt must be a positive number, not x"),
            (["--dt"], "--dt needs a value"), (["--diff", "a.bem"], "--diff needs 2 values"), (["--dt", "1e-12"], "--dt"),
            (["--scheme", "rk4"], "radau2"), (["--scheme", "theta:2"], "theta"),
            (["--window", "0"], "--window"), (["--window", "1.5"], "--window"),
            (["--window", "off"], "--window"),
            (["--model", "soft"], "dynamic, static or rigid"),
            (["--model", "static", "--scheme", "radau2"], "one stage"),
            (["--model", "static", "--history", "4"], "no history"),
            (["--model", "static", "--inverse", "iterative"], "--inverse dense"),
            (["--codec", "haar", "--compression-ratio", "4", "--codec-tol", "1e-3"], "either"),
            (["--codec", "haar", "--compression-ratio", "0.5"], "--compression-ratio"),
            (["--precision", "float64"], "--codec none"),
            (["--codec", "zip"], "--codec"), (["--codec", "none", "--codec-tol", "1e-3"], "--codec lowrank"),
            (["--codec-tol", "1e-9"], "--codec-tol"),
            (["--compression-ratio", "4"], "--codec haar"),
            (["--corner-angle-deg", "0"], "between 0 and 180"), (["--corner-angle-deg", "x"], "auto, none or an angle"),
            (["--damping", "0.1"], "kelvin_voigt:T"), (["--damping", "kelvin_voigt:0"], "kelvin_voigt:T"),
            (["--damping", "zener:0.1"], "kelvin_voigt:T"), (["--damping"], "--damping needs a value"),
            (["--damping", "kelvin_voigt:0.1:1"], "kelvin_voigt:T"),
            (["--model", "static", "--damping", "kelvin_voigt:0.1"], "no damping"),
            (["--history", "0"], "--history"), (["--history-tol", "2"], "--history-tol"),
            (["--history", "9", "--history-tol", "1e-3"], "--history-tol"),
            (["--quadrature-tol", "0"], "--quadrature-tol"), (["--mesh-scale", "0"], "--mesh-scale"),
            (["--threads", "0"], "--threads"), (["--codec", "none", "--precision", "float16"], "float32"),
            (["--thread", "1"], "did you mean --threads?"), (["--dtt=1"], "did you mean --dt"),
            (["-q", "-v"], "--quiet"), (["--json"], "--info"), (["third.obj"], "third.obj"),
            (["--log-file", "sphere.obj"], "sphere.obj"), (["--stats", "rubber.json"], "rubber"),
        ]
        for arguments, part in wrong:
            with self.subTest(arguments=arguments):
                base = ["sphere.obj", "rubber.json", "-o", "a.bem"]
                dt = [] if any(a.startswith("--dt") for a in arguments) else ["--dt", "0.01"]
                self.assert_error(self.run_tool(*dt, *base, *arguments, code=2), part)
        for arguments in [[], ["sphere.obj"], ["sphere.obj", "rubber.json", "--dt", "1"],
                          ["--info"], ["--diff", "a"], ["--info", "a", "--verify", "a"]]:
            with self.subTest(arguments=arguments):
                self.assert_error(self.run_tool(*arguments, code=2))
        self.assertEqual(self.files(), INPUTS)

    def test_outputs_must_not_destroy_inputs(self):
        before = (self.folder / "sphere.obj").read_bytes()
        done = self.precompute("--force", output="./sphere.obj", code=2)
        self.assert_error(done, "sphere.obj", "input")
        self.assertEqual((self.folder / "sphere.obj").read_bytes(), before)

    def test_help_and_version(self):
        self.assertRegex(self.run_tool("--version").stdout, r"^bem \d+\.\d+\.\d+\n$")
        text = self.run_tool("--help").stdout
        for option in ["--dt", "--scheme", "--window", "--model", "--history-tol", "--history",
                       "--quadrature-tol", "--codec", "--codec-tol", "--compression-ratio",
                       "--corner-angle-deg", "--damping", "--mesh-scale", "--threads", "--dry-run",
                       "--stats", "--force", "--quiet", "--verbose", "--log-file", "--version",
                       "--info", "--json", "--verify", "--diff"]:
            self.assertIn(option, text)
        self.assertLessEqual(max(len(line) for line in text.splitlines()), 100)

    def test_overwriting_needs_force(self):
        (self.folder / "a.bem").write_text("mine")
        self.assert_error(self.precompute(code=2), "a.bem", "--force")
        self.assertEqual((self.folder / "a.bem").read_text(), "mine")
        self.precompute("--force")
        self.run_tool("--verify", "a.bem")


class Messages(CliCase):
    def test_verbosity_and_log_file(self):
        self.assertEqual(self.precompute("-q", output="q.bem").stderr, "")
        normal = self.precompute(output="n.bem")
        self.assertIn("info: ", normal.stderr)
        self.assertNotIn("detail: ", normal.stderr)
        self.assertEqual(normal.stdout, "")
        self.assertNotIn("\r", normal.stderr)  # no progress bar without a terminal
        verbose = self.precompute("-v", "--log-file", "log.txt", output="v.bem")
        self.assertIn("detail: assembly", verbose.stderr)
        self.assertEqual((self.folder / "log.txt").read_text(), verbose.stderr)

    def test_errors_reach_the_log_file(self):
        done = self.run_tool("--info", "none.bem", "--log-file", "log.txt", code=4)
        self.assertEqual((self.folder / "log.txt").read_text(), done.stderr)

    def test_long_history_is_warned_about(self):
        self.assertIn("warning: the history is long: 61 steps",
                      self.precompute("--history", "61", "--dry-run").stderr)
        self.assertNotIn("warning", self.precompute("--history", "60", "--dry-run").stderr)

    def test_meshes_in_millimetres_are_told_of(self):
        (self.folder / "large.obj").write_text("".join(
            "v " + " ".join(str(60 * float(x)) for x in line.split()[1:]) + "\n" if line.startswith("v ") else line
            for line in (self.folder / "sphere.obj").open()))
        done = self.run_tool("large.obj", "rubber.json", "--dry-run")
        self.assertIn("info: large.obj: the body is 12 m large; a mesh in millimetres needs --mesh-scale 0.001\n", done.stderr)
        self.assertNotIn("large;", self.run_tool("large.obj", "rubber.json", "--dry-run", "--mesh-scale", 1.1).stderr)
        self.assertNotIn("large;", self.run_tool("sphere.obj", "rubber.json", "--dry-run").stderr)

    def test_growth_is_warned_about(self):
        # a history that is cut too short blows up
        base = ["sphere.obj", "rubber.json", "--dt", "0.002", "--scheme", "bdf1", "--history", "8",
                "--discretisation", "collocation"]
        for window, message in [("1", "motions grow by a factor of .*--window auto"),
                                ("auto", "motions would grow by a factor of .* the window 0\\.[0-9]+ "
                                 "removes that, but takes 86 % of every vibration while a shear wave crosses the "
                                 "body: better are --discretisation galerkin, a larger --dt")]:
            with self.subTest(window=window):
                done = self.run_tool(*base, "-o", "a.bem", "--force", "--window", window,
                                     "--stats", "s.json", "-q")
                stats = json.loads((self.folder / "s.json").read_text())
                self.assertGreater(stats["report"]["growth"], 1.2)
                self.assertRegex(done.stderr, f"^warning: {message}")
                self.assertEqual("warning: " + stats["warnings"][0], done.stderr.rstrip("\n"))
                if window == "auto":
                    grown = stats["scheme"]["window"] * stats["report"]["growth"]
                    self.assertAlmostEqual(grown, 1, 5)
                    self.assertLessEqual(grown, 1)
        self.assertNotIn("motions", self.precompute("--force").stderr)

    def test_damping_holds_what_grows(self):
        base = ["sphere.obj", "rubber.json", "--dt", "0.00114", "-o", "a.bem", "--force", "-q", "--discretisation",
                "collocation"]
        warning = self.run_tool(*base).stderr
        damping, hertz = re.search("or --damping (kelvin_voigt:[0-9.e-]+), .* slower than ([0-9]+) Hz", warning).groups()
        self.assertTrue(100 < float(hertz) < 200, hertz)
        self.assertEqual(self.run_tool(*base, "--damping", damping).stderr, "")

    def test_growth_that_no_sensible_window_prevents_is_an_error(self):
        base = ["--dt", "0.002", "--scheme", "bdf1", "--history", "2", "--discretisation", "collocation"]
        done = self.run_tool("sphere.obj", "rubber.json", *base, "-o", "a.bem", "-q", code=5)
        self.assert_error(done, "motions grow by a factor of 3.66", "--discretisation galerkin", "larger --dt",
                          "--window")
        self.assertNotIn("a.bem", self.files())

    def test_growth_of_the_default_is_measured_on_request(self):
        """With a time step at which collocation grows by 1.00018 per step."""
        base = ["sphere.obj", "rubber.json", "--dt", "0.00114", "-o", "a.bem", "--force", "-q", "--stats", "s.json"]
        for options, measured in ([], False), (["--measure-growth"], True), (["--discretisation", "collocation"], True):
            with self.subTest(options=options):
                done = self.run_tool(*base, *options)
                stats = json.loads((self.folder / "s.json").read_text())
                info = json.loads(self.run_tool("--info", "a.bem", "--json").stdout)
                collocation = "collocation" in options
                self.assertEqual(done.stderr == "", not collocation)
                self.assertEqual(info["scheme"]["discretisation"], "collocation" if collocation else "galerkin")
                self.assertEqual("discretisation" in info["provenance"]["options"], not collocation)
                for report in stats["report"], info["report"]:
                    self.assertEqual("growth" in report, measured)
                self.assertEqual("growth factor" in [phase["name"] for phase in stats["phases"]], measured)
                self.assertEqual("growth factor" in self.run_tool("--info", "a.bem").stdout, measured)
                self.assertEqual("growth factor" in self.run_tool(*base, *options, "--dry-run").stdout, measured)
                if not collocation:
                    self.assertEqual(stats["scheme"]["window"], 1)
                    self.assertLess(stats["report"].get("growth", 0), 1 + 1e-6)

    def test_dry_run_writes_nothing(self):
        for output in [["-o", "a.bem"], []]:
            done = self.run_tool("sphere.obj", "rubber.json", "--dt", "0.01", "--dry-run", *output)
            for word in ["lam:", "n_max:", "memory:", "archive size:", "time:"]:
                self.assertIn(word, done.stdout)
        self.assertEqual(self.files(), INPUTS)

    def test_dry_run_takes_no_time_where_the_run_takes_long(self):
        subprocess.run([BEMSHAPE, "icosphere", "--subdivisions", "5", "-o", self.folder / "large.obj"], check=True)
        for options in [["large.obj", "rubber.json"], ["sphere.obj", "rubber.json", "--dt", "2e-5"]]:
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            done = self.run_tool(*options, "--dry-run")
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            self.assertLess(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, 4)
            self.assertRegex(done.stdout, r"archive size: +about .* [MG]B")
            self.assertRegex(done.stdout, r"time: +about [0-9]+ (h|min)")

    def test_dry_run_is_right_to_a_factor(self):
        for options in [[], ["--discretisation", "collocation"], ["--loads", "none"]]:
            options += ["--force"]
            size = re.search(r"archive size: +about ([\d.]+) (k|M)B", self.precompute("--dry-run", *options).stdout)
            self.precompute(*options)
            ratio = float(size[1]) * {"k": 1e3, "M": 1e6}[size[2]] / os.path.getsize(self.folder / "a.bem")
            self.assertTrue(0.6 < ratio < 1.6, f"{options}: {ratio}")

    def test_walls_that_are_thin_for_their_triangles(self):
        def plate(thickness):
            subprocess.run([BEMSHAPE, "box", "--size", "1", "1", thickness, "--divisions", "6", "6", "1", "-o",
                            self.folder / "plate.obj"], check=True)
            return ["plate.obj", "rubber.json", "--dt", "0.01", "--dry-run"]
        for thickness in "0.004", "0.00001":
            self.assertRegex(self.run_tool(*plate(thickness)).stderr, "takes at least .* times as long as usual")
        self.assertNotIn("as usual", self.run_tool(*plate("0.1")).stderr)

    def test_peak_memory_is_the_programs_own(self):
        large = bytearray(500_000_000)
        large[::4096] = b"x" * len(large[::4096])  # resident
        self.precompute("--stats", "s.json", "--quiet")
        del large
        self.assertLess(json.loads((self.folder / "s.json").read_text())["peak_memory_bytes"], 3e8)

    def test_stats(self):
        self.precompute("--stats", "s.json", "--threads", "1", "--measure-growth")
        stats = json.loads((self.folder / "s.json").read_text())
        self.assertEqual(stats["threads"], 1)
        self.assertEqual(stats["archive_bytes"], os.path.getsize(self.folder / "a.bem"))
        self.assertEqual(stats["body"]["nodes"], 42)
        self.assertGreater(stats["peak_memory_bytes"], 1e6)
        names = [phase["name"] for phase in stats["phases"]]
        for name in ["mesh", "assembly", "factorisation", "inverse", "growth factor", "writing"]:
            self.assertIn(name, names)
        self.assertEqual(len(names), len(set(names)))
        self.assertAlmostEqual(sum(p["wall_seconds"] for p in stats["phases"]),
                               stats["wall_seconds"], 6)
        for key in ["lam", "rotation_residual", "condition", "growth"]:
            self.assertGreater(stats["report"][key], 0)
        self.assertEqual(stats["report"]["row_sum_residual"], 0)  # galerkin has nothing to repair
        self.assertEqual(self.files(), ["a.bem", "rubber.json", "s.json", "sphere.obj"])


class Resources(CliCase):
    def test_folders_that_cannot_be_written(self):
        for output in ["none/a.bem", "/proc/a.bem", "sphere.obj/a.bem"]:
            with self.subTest(output=output):
                self.assert_error(self.precompute(output=output, code=6), output)
        self.assert_error(self.precompute("--stats", "none/s.json", code=6), "none/s.json")
        self.assert_error(self.precompute("--log-file", "none/log", code=6), "none/log")
        self.assertEqual(self.files(), INPUTS)

    def test_a_disk_that_fills_up_leaves_nothing(self):
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (300000, 300000))
        done = self.precompute(code=6, preexec_fn=limit, restore_signals=False)
        self.assert_error(done, "a.bem")
        self.assertEqual(self.files(), INPUTS)

    def test_streams_that_are_full(self):
        self.precompute("--history", "2", "--window", "1")
        with open("/dev/full", "w") as full:
            for arguments in [["--info", "a.bem"], ["--verify", "a.bem"], ["--help"], ["--version"]]:
                with self.subTest(arguments=arguments):
                    done = subprocess.run([BEMPRECOMP, *arguments], cwd=self.folder, stdout=full,
                                          stderr=subprocess.PIPE, text=True)
                    self.assertEqual(done.returncode, 6)
                    self.assertEqual(done.stderr, "error: standard output cannot be written\n")
        done = self.precompute("--force", "--stats", "/dev/full", code=6)
        self.assertRegex(done.stderr, "error: /dev/full: cannot be written")
        done = self.precompute("--force", "--log-file", "/dev/full", "-q")
        self.assertEqual(done.stderr, "warning: the log file cannot be written any more\n")
        done = self.precompute("--force", "-q", "--stats", "/dev/stdout")
        self.assertEqual(json.loads(done.stdout)["body"]["nodes"], 42)

    def test_what_a_killed_run_leaves_is_removed_by_the_next(self):
        self.sphere(3)
        process = subprocess.Popen(
            [BEMPRECOMP, "sphere.obj", "rubber.json", "-o", "a.bem", "--dt", "0.001", "--stats",
             "s.json", "-v"], cwd=self.folder, stderr=subprocess.PIPE, text=True)
        for line in process.stderr:
            if line == "detail: assembly\n":
                break
        process.kill()
        process.wait()
        process.stderr.close()
        self.assertEqual(len(self.files()), len(INPUTS) + 1, self.files())
        self.sphere(1)
        self.precompute("--stats", "s.json")
        self.assertEqual(self.files(), sorted([*INPUTS, "a.bem", "s.json"]))

    def test_too_large_a_problem_is_refused_before_it_starts(self):
        start = time.monotonic()
        done = self.precompute("--history", "100000", "--codec", "none", "--precision", "float64", "--scheme",
                               "radau2", code=6)
        self.assert_error(done, "memory", "GB")
        self.assertLess(time.monotonic() - start, 10)
        self.assertEqual(self.files(), INPUTS)

    def test_interruption_leaves_nothing(self):
        self.sphere(3)
        for sent, code in [(signal.SIGINT, 130), (signal.SIGTERM, 143)]:
            with self.subTest(signal=sent):
                process = subprocess.Popen(
                    [BEMPRECOMP, "sphere.obj", "rubber.json", "-o", "a.bem", "--dt", "0.001",
                     "--stats", "s.json", "-v"], cwd=self.folder, stderr=subprocess.PIPE, text=True)
                for line in process.stderr:
                    if line == "detail: assembly\n":
                        break
                process.send_signal(sent)
                start = time.monotonic()
                rest = process.stderr.read()
                self.assertEqual(process.wait(timeout=30), code, rest)
                process.stderr.close()
                self.assertLess(time.monotonic() - start, 10)
                self.assertIn("error: interrupted", rest)
                self.assertEqual(self.files(), INPUTS)


if __name__ == "__main__":
    unittest.main()
