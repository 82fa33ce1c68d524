"""scripts/check_docs.py: finds every kind of broken reference, with its place, and nothing in the project itself."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "check_docs.py"
GOOD = {
    "README.md": "# Bem\n\n[The method](docs/method.md#two-words--more) is in `libbem/a/good.cpp`, see\n[below](#bem).\n\n"
                 "    [code](nowhere.md)\n\n```\n[more code](nowhere.md)\n```\n\n`[a span](nowhere.md)` and\n[two\nlines](docs/method.md)\n",
    "docs/method.md": "# Method\n\n## Two words: & more\n\n*A lead.* Text (M1) about a/good.cpp.\n`unit_a` tests it.\n",
    "docs/more/details.md": "# Details\n\n## A case\n\n[The method](../method.md#two-words--more)\n",
    "tests/CMakeLists.txt": "bem_add_test(unit_a SOURCES test_a.cpp)\n",
    "docs/equations.md": "| (M1) | [`a/good.cpp`](../libbem/a/good.cpp) `Good::run`, `other` and \"a test of \\|z\\|\" |\n",
    "docs/glossary.md": "# Glossary\n\n| word | code | not called |\n|---|---|---|\n| thing | `Good::run`, `other` | `gone` |\n",
    "libbem/a/good.cpp": "// (M1), docs/method.md, \"Two\n// words: & more\"; docs/method.md, \"A lead\"; a/good.cpp\n"
                         "// docs/more/details.md, \"A case\"\n"
                         "struct Good { void run(); };  // a test of |z|\nvoid other();\n",
}


class CheckDocs(unittest.TestCase):
    def check(self, **changes):
        """Runs the script on the good files but for the changes, FILE=(from, to); returns its exit code and findings."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in GOOD.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                before, after = changes.get(path.stem, ("", ""))
                self.assertIn(before, text)
                path.write_text(text.replace(before, after, 1))
            done = subprocess.run([sys.executable, SCRIPT, folder], text=True, capture_output=True)
            self.assertEqual(done.stderr, "")
            return done.returncode, done.stdout

    def test_the_project_is_in_order(self):
        done = subprocess.run([sys.executable, SCRIPT], text=True, capture_output=True)
        self.assertEqual((done.returncode, done.stdout), (0, ""))

    def test_good_files_pass(self):
        self.assertEqual(self.check(), (0, ""))

    def test_every_broken_reference_is_named_with_its_place_and_cure(self):
        for changes, place, reason in (
                ({"README": ("docs/method.md#", "docs/methods.md#")}, "README.md:3", "docs/methods.md, which does not exist"),
                ({"README": ("#two-words--more", "#three-words")}, "README.md:3", "no heading with the anchor #three-words"),
                ({"README": ("#bem", "#bern")}, "README.md:4", "no heading with the anchor #bern"),
                ({"README": ("a/good.cpp", "a/bad.cpp")}, "README.md:3", "no file libbem/a/bad.cpp"),
                ({"method": ("Two words", "Three words")}, "README.md:3", "anchor #two-words--more"),
                ({"method": ("A lead", "The lead")}, "libbem/a/good.cpp:2", "no part with the title \"A lead\""),
                ({"details": ("A case", "No case")}, "libbem/a/good.cpp:3", "details.md has no part with the title \"A case\""),
                ({"details": ("../method.md", "method.md")}, "docs/more/details.md:5", "method.md, which does not exist"),
                ({"method": ("unit_a", "unit_b")}, "docs/method.md:6", "no test program unit_b"),
                ({"method": ("a/good", "b/good")}, "docs/method.md:5", "no file b/good.cpp"),
                ({"equations": ("Good::run", "Good::walk")}, "docs/equations.md:1", "no 'Good::walk'"),
                ({"equations": ("`other`", "`another`")}, "docs/equations.md:1", "no 'another'"),
                ({"equations": ("a test", "no test")}, "docs/equations.md:1", "no 'no test of |z|'"),
                ({"glossary": ("`other`", "`another`")}, "docs/glossary.md:5", "libbem has no 'another'"),
                ({"equations": ("M1", "M2")}, "libbem/a/good.cpp:1", "equation (M1) is not in"),
                ({"method": ("M1", "M2")}, "docs/method.md:5", "equation (M2) is not in"),
                ({"good": ("run()", "ran()")}, "docs/equations.md:1", "no 'Good::run'"),
                ({"good": ("; a/good.cpp", "; a/gone.hpp")}, "libbem/a/good.cpp:2", "no file a/gone.hpp")):
            with self.subTest(changes=changes):
                code, findings = self.check(**changes)
                self.assertEqual(code, 1)
                self.assertIn(reason, findings)
                self.assertTrue(any(line.startswith(place + ": ") and reason in line and "; " in line
                                    for line in findings.splitlines()), findings)

    def test_wrong_arguments_are_a_usage_error(self):
        self.assertEqual(subprocess.run([sys.executable, SCRIPT, "--all"], capture_output=True).returncode, 2)
        self.assertEqual(subprocess.run([sys.executable, SCRIPT, "--help"], capture_output=True).returncode, 0)


if __name__ == "__main__":
    unittest.main()
