"""scripts/common: runs of programs, results that are kept, tables and sections of documents, OBJ files."""
import concurrent.futures
import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from common import markdown, obj, results  # noqa: E402
from common.programs import Failed, Programs, folder  # noqa: E402


class Folder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)


class Running(Folder):
    def setUp(self):
        super().setUp()
        self.log = self.folder / "log.txt"
        self.programs = Programs("", self.log, place=self.folder)

    def shell(self, script, **options):
        return self.programs.run("sh", "-c", script, **options)

    def test_what_a_program_says_and_costs(self):
        done = self.shell("echo out; echo 'warning: a' >&2; echo 'info: b' >&2; "
                          "i=0; while [ $i -lt 100000 ]; do i=$((i+1)); done")
        self.assertEqual((done.code, done.output), (0, "out\n"))
        self.assertEqual(done.lines("warning"), ["warning: a"])
        self.assertGreater(done.cpu, 0.02)
        self.assertGreater(done.memory, 1e5)

    def test_output_environment_and_the_place_where_it_runs(self):
        done = self.shell("echo $X >here; echo told", environment={"X": "7"}, output=self.folder / "told")
        self.assertEqual(done.output, "")
        self.assertEqual([(self.folder / name).read_text() for name in ("here", "told")], ["7\n", "told\n"])

    def test_a_failure_names_the_command_its_last_words_and_the_log(self):
        with self.assertRaises(Failed) as caught:
            self.shell("for i in 1 2 3 4 5 6 7; do echo line $i >&2; done; exit 3")
        self.assertEqual(caught.exception.code, 3)
        first, *words = str(caught.exception).splitlines()
        self.assertTrue(first.startswith("sh -c 'for"), first)
        self.assertTrue(first.endswith(f"exit code 3; its messages are in {self.log}"), first)
        self.assertEqual(words, [f"  line {i}" for i in range(3, 8)])
        self.assertIn("line 1\n", self.log.read_text())
        with self.assertRaisesRegex(Failed, "killed by signal 9"):
            self.shell("kill -9 $$")
        with self.assertRaisesRegex(Failed, "\n  only on stdout"):
            self.shell("echo only on stdout; exit 1")
        self.assertIn("only on stdout", self.log.read_text())

    def test_exit_codes_may_be_allowed(self):
        self.assertEqual(self.shell("exit 5", allowed=(0, 5)).code, 5)
        self.assertEqual(self.shell("exit 6", allowed=None).code, 6)

    def test_a_program_that_is_missing(self):
        with self.assertRaisesRegex(Failed, "cannot run /nowhere/bemshape box: No such file or directory") as caught:
            Programs("/nowhere", self.log).run("bemshape", "box", allowed=None)
        self.assertIsNone(caught.exception.code)
        self.assertEqual(folder(given="/nowhere"), pathlib.Path("/nowhere"))

    def test_a_log_is_begun_anew_and_keeps_runs_beside_each_other_apart(self):
        self.log.write_text("old\n")
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            list(pool.map(lambda k: self.shell(f"echo {k} >&2; sleep 0.05; echo {k} >&2"), range(8)))
        text = self.log.read_text()
        self.assertNotIn("old", text)
        for k in range(8):
            self.assertIn(f"\n{k}\n{k}\n", text)

    def test_messages_are_shown_while_a_program_runs(self):
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            Programs("", self.log, echo=True).run("sh", "-c", "echo first >&2; sleep 0.1; echo last >&2")
        self.assertEqual(shown.getvalue(), "sh -c 'echo first >&2; sleep 0.1; echo last >&2'\nfirst\nlast\n")

    def test_peak_memory_is_the_programs_own(self):
        ours = b"1" * 300_000_000  # what the kernel counts as the memory of programs that are started now, too
        del ours
        self.assertLess(self.shell("sleep 0.1").memory, 50e6)
        large = self.programs.run(sys.executable, "-c", "print(len(b'1' * 500_000_000))")
        self.assertTrue(500e6 < large.memory < 600e6, large.memory)

    def test_meshes_are_written_where_programs_find_them(self):
        self.programs.mesh("a.obj", ([[0, 0, 0.1], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
        self.assertEqual((self.folder / "a.obj").read_text(), "v 0.0 0.0 0.1\nv 1.0 0.0 0.0\nv 0.0 1.0 0.0\nf 1 2 3\n")


class Results(Folder):
    def test_they_survive_an_interruption(self):
        path = self.folder / "found.json"
        kept = results.Results(path)
        kept.add("a", {"error": 0.5})
        (self.folder / "found.partial").write_text('{"a": {"err')  # killed while it wrote
        self.assertEqual(results.Results(path).records, {"a": {"error": 0.5}})
        with self.assertRaises(TypeError):
            kept.add("b", object())
        self.assertEqual(results.Results(path).records, {"a": {"error": 0.5}})
        again = results.Results(path)
        again.add("c", 1)
        self.assertEqual(json.loads(path.read_text()), {"a": {"error": 0.5}, "c": 1})
        self.assertEqual([p.name for p in self.folder.iterdir()], ["found.json"])

    def test_nothing_is_there_at_first(self):
        self.assertIsNone(results.load(self.folder / "no.json"))
        self.assertEqual(results.Results(self.folder / "no.json").records, {})

    def test_changes_of_documents(self):
        document = {"bodies": [{"name": "a"}, {"name": "b"}], "time_step": 1}
        results.changed(document, {"/bodies/1/name": "c", "/time_step": 2})
        self.assertEqual(document, {"bodies": [{"name": "a"}, {"name": "c"}], "time_step": 2})
        self.assertEqual(len(results.changed(document, {"/bodies": 1})["bodies"]), 1)


class Markdown(unittest.TestCase):
    def test_tables(self):
        self.assertEqual(markdown.table(["a", 2], [[1, "x"]]), "| a | 2 |\n| --- | --- |\n| 1 | x |")
        self.assertEqual(markdown.table(["a", "b"], [], rule="---"), "| a | b |\n|---|---|")

    def test_sections(self):
        document = "head\n<!-- one -->\nold\n<!-- end of one -->\ntail\n"
        once = markdown.with_sections(document, {"one": "new"})
        self.assertEqual(once, document.replace("old", "new"))
        self.assertEqual(markdown.with_sections(once, {"one": "new"}), once)
        for wrong in ("nothing", "<!-- one -->", "<!-- end of one --><!-- one -->", document + document):
            with self.assertRaisesRegex(ValueError, "<!-- one -->"):
                markdown.with_sections(wrong, {"one": "new"})


class Obj(Folder):
    def test_all_digits_are_kept_and_faces_may_have_texture_coordinates(self):
        path = self.folder / "a.obj"
        mesh = [[0.1, 1 / 3, 1e-17], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[0, 1, 2]]
        obj.write(path, *mesh, comment="a triangle")
        self.assertEqual(obj.read(path), mesh)
        path.write_text("v 1 2 3 0.5\n\nvt 0 0\nf 1/1 1//1 1 1\n")
        self.assertEqual(obj.read(path), ([[1, 2, 3]], [[0, 0, 0, 0]]))


if __name__ == "__main__":
    unittest.main()
