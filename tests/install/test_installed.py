"""What cmake --install leaves for users of the programs: manual pages, completion, bemrender, documents."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

TREE = pathlib.Path(os.environ["BEM_TREE"])
BIN = TREE / "bin"
SUBCOMMANDS = {"icosphere", "box", "split", "repair", "remesh", "wrap"}
# A shell calls the function of the completion for the words of a command line, of which the last one is completed.
BASH = """source "{file}"; COMP_WORDS=({words}); COMP_CWORD={last}
_bem "{program}" "{word}" "{before}"; printf '%s\\n' "${{COMPREPLY[@]}}" """
ZSH = """compadd() {{ print -l -- $@[2,-1] }}; _files() {{ print files }}; _call_program() {{ $@[2,-1] }}
words=({words}); CURRENT={last}; PREFIX="{word}"; source "{file}" """


def run(*command, **options):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, check=True, **options).stdout


def programs():
    return sorted(path.name for path in BIN.iterdir())


def options_of(*command):
    """The long options that a help text begins lines with."""
    lines = re.findall(r"^ {2,6}(-.+?)(?: {2}|$)", run(BIN / command[0], *command[1:], "--help"), re.MULTILINE)
    return set(re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", " ".join(lines)))


class Pages(unittest.TestCase):
    @unittest.skipUnless(shutil.which("help2man"), "help2man is not installed")
    def test_every_program_has_a_page_with_its_options(self):
        for program in programs():
            text = (TREE / f"share/man/man1/{program}.1").read_text()
            self.assertRegex(text, rf"\n{program} \\- [a-z].{{20,}}\n")
            self.assertIn(".SH SYNOPSIS", text)
            for option in options_of(program):
                self.assertIn(option.replace("-", r"\-"), text)

    def test_the_readme_finds_what_it_links_to(self):
        readme = TREE / "share/doc/bem/README.md"
        links = set(re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", readme.read_text()))
        self.assertGreater(len(links), 20)
        for link in links:
            self.assertTrue((readme.parent / link).exists(), link)


class Completion(unittest.TestCase):
    def complete(self, shell, *words):
        program = words[0]
        if shell == "bash":
            file, text, last = TREE / f"share/bash-completion/completions/{program}", BASH, len(words) - 1
        else:
            file, text, last = TREE / "share/zsh/site-functions/_bem", ZSH, len(words)
        quoted = " ".join(f'"{w}"' for w in (BIN / program, *words[1:]))
        script = text.format(file=file, words=quoted, last=last, program=BIN / program, word=words[-1], before=words[-2])
        return set(run(shell, *(["-f"] if shell == "zsh" else ["--norc"]), "-c", script).split())

    def completes(self, shell):
        for program in programs():
            self.assertEqual(self.complete(shell, program, "--"), options_of(program), program)
        self.assertEqual(self.complete(shell, "bemshape", "box", "--"), options_of("bemshape", "box"))
        self.assertLessEqual(SUBCOMMANDS, self.complete(shell, "bemshape", ""))
        self.assertLess({"--size", "--divisions"}, self.complete(shell, "bemshape", "box", "--"))

    def test_bash_knows_the_options_that_the_programs_print(self):
        self.completes("bash")
        self.assertEqual(self.complete("bash", "bemsim", "--chec"), {"--check", "--checkpoint-every"})
        self.assertEqual(self.complete("bash", "bemsim", "scene"), set())  # files

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_knows_the_options_that_the_programs_print(self):
        self.completes("zsh")
        self.assertEqual(self.complete("zsh", "bemsim", "scene"), {"files"})


class Render(unittest.TestCase):
    def test_bemrender_draws_where_there_is_no_source_tree(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            with h5py.File(path / "t.h5", "w") as file:
                file["time"] = [0.0]
                file["bodies/a/positions"] = np.vstack([np.zeros(3), np.eye(3)])[None]
                file["bodies/a/faces"] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
            environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
            run(BIN / "bemrender", "t.h5", "--still", "t.png", "--size", "64x48", cwd=path, env=environment)
            self.assertTrue((path / "t.png").read_bytes().startswith(b"\x89PNG"))


if __name__ == "__main__":
    unittest.main()
