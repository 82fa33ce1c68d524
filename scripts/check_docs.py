#!/usr/bin/env python3
"""Checks what the documents refer to: files and headings of links, functions named beside a file, file names in the text,
and the documents' titles and equation numbers that comments in the code refer to.

    scripts/check_docs.py [ROOT]      ROOT: the project's folder; default: the one that holds this script

What is checked, in every Markdown file below ROOT:
* a relative link leads to a file or folder, and its anchor to a heading of that file;
* after a link to a source file, every `name` and every "name of a test", separated by commas, occurs in that file:
      [`kernels/contour.cpp`](../libbem/kernels/contour.cpp) `ContourQuadrature::weights`, `add_closure`
* in docs/glossary.md the `names` in the columns "code" of its tables occur in the sources of libbem;
* a path such as kernels/contour.hpp exists below ROOT, libbem, tests or scripts (not in CHANGELOG.md, which tells of the past).
* a test program such as unit_kernels is one that a CMakeLists.txt below tests adds;
* an equation number such as (M25) is in docs/equations.md.
And in comments of the code: such paths and numbers, and titles as in  docs/method.md, "Double nodes".

Every finding is printed as FILE:LINE: what is wrong; what cures it. Exit codes: 0 nothing found, 1 something found, 2 usage."""
import os
import pathlib
import re
import sys

SKIPPED = {".git", "build", "out", "node_modules", "__pycache__"}  # folders
FOREIGN = {"hwy"}  # folders of other libraries' headers
SOURCES = {".cpp", ".hpp", ".h", ".py", ".sh", ".c"}
PLACES = ("", "libbem", "tests", "scripts")  # folders that paths in texts are relative to
EQUATIONS, GLOSSARY = "docs/equations.md", "docs/glossary.md"

LINK = re.compile(r"!?\[((?:[^\[\]]|\[[^\]]*\])*)\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
NAMED = re.compile(r"(?:,?\s+(?:and\s+)?)(?:`([^`]+)`|\"([^\"]+)\")")
PATH = re.compile(r"(?<![\w/.*-])((?:[A-Za-z_][\w-]*/)+[\w-]+(?:\.[\w-]+)*\.(?:cpp|hpp|h|py|sh|md))\b(?!\()")
PROGRAM = re.compile(r"(?<![\w:])(?:unit|verification)_\w+")
TITLE = re.compile(r"([\w-]+\.md),\s*(?:(?:///?<?|#)\s*)?\"([^\"]+)\"")
EQUATION = re.compile(r"\((M\d+)\)")


class Findings:
    def __init__(self, root):
        self.root, self.count = root, 0

    def add(self, path, text, at, what, cure):
        line = text.count("\n", 0, at) + 1
        print(f"{path.relative_to(self.root)}:{line}: {what}; {cure}")
        self.count += 1


def files_below(root, suffixes):
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(f for f in folders if f not in SKIPPED)
        for name in sorted(names):
            if pathlib.Path(name).suffix in suffixes:
                yield pathlib.Path(folder) / name


def without_code_blocks(text):
    """Lines of code blocks, fenced or indented after an empty line, become empty; offsets stay."""
    out, fenced, empty_before = [], False, True
    for line in text.split("\n"):
        fence = line.lstrip().startswith("```")
        indented = line.startswith("    ") and empty_before
        out.append(" " * len(line) if fence or fenced or indented else line)
        fenced ^= fence
        empty_before = not line.strip() or indented
    return "\n".join(out)


def without_code_spans(text):
    return re.sub(r"`[^`\n]*`", lambda m: " " * len(m.group()), text)


def headings(text):
    return [re.sub(r"\s+#*$", "", m.group(1)) for m in re.finditer(r"^#{1,6} +(.+)$", without_code_blocks(text), re.M)]


def anchors(text):
    """The anchors that GitHub gives headings, and those of <a id="...">."""
    found = set(re.findall(r"<a (?:id|name)=\"([^\"]+)\"", text))
    for heading in headings(text):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
        slug = base = re.sub(r"[^\w\- ]", "", plain.lower()).replace(" ", "-")
        number = 0
        while slug in found:
            number += 1
            slug = f"{base}-{number}"
        found.add(slug)
    return found


def titles(text):
    """What a comment may call a part of a document: its headings and the words in italics that begin a paragraph."""
    leads = re.findall(r"^(?:\* )?\*([^*\n]+)\*", text, re.M)
    return {t.rstrip(".:") for t in headings(text) + leads}


def titles_of_documents(folder):
    """By file name, of all documents below the folder; those of one name share an entry."""
    found = {}
    for path in files_below(folder, {".md"}):
        found.setdefault(path.name, set()).update(titles(path.read_text(encoding="utf-8")))
    return found


def check_links(path, text, findings):
    visible = without_code_blocks(text)
    spans = without_code_spans(visible)
    for match in LINK.finditer(visible):
        target = match.group(2)
        if re.match(r"[a-z]+:", target) or not spans[match.start(2):match.end(2)].strip():
            continue
        name, _, anchor = target.partition("#")
        file = (path.parent / name).resolve() if name else path
        if not file.exists():
            findings.add(path, text, match.start(), f"the link leads to {name}, which does not exist",
                         "correct the path, which is relative to the document, or remove the link")
            continue
        if anchor and file.suffix == ".md" and anchor not in anchors(file.read_text(encoding="utf-8")):
            findings.add(path, text, match.start(), f"{name or path.name} has no heading with the anchor #{anchor}",
                         "take the anchor of one of its headings")
        if file.suffix in SOURCES:
            check_names(path, text, match.end(), visible, file, findings)


def check_names(path, text, at, visible, file, findings):
    """The names that follow a link to a source file."""
    source = None
    while match := NAMED.match(visible, at):
        at = match.end()
        source = source or file.read_text(encoding="utf-8")
        code, quoted = (m and m.replace("\\|", "|") for m in match.groups())  # of table cells
        for word in words_of(code) if code else [quoted]:
            known = word in source if quoted else re.search(rf"(?<!\w){re.escape(word)}(?!\w)", source)
            if not known:
                findings.add(path, text, match.start(), f"{file.relative_to(findings.root)} has no {code or quoted!r}",
                             "name a function, type or test of that file, or link to the file that has it")


def words_of(name):
    """The words of a name such as Class::function() or object.member."""
    return [w for w in re.split(r"::|\(\)|\.", name) if w]


def check_glossary(path, text, findings):
    """The names in the columns "code" of tables."""
    sources = (p.read_text(encoding="utf-8") for p in files_below(findings.root / "libbem", SOURCES))
    known = set(re.findall(r"\w+", "\n".join(sources)))
    column, at = None, 0
    for line in text.split("\n"):
        cells = [c.strip() for c in line.split("|")]
        column = (column or next((i for i, c in enumerate(cells) if c == "code"), None)) if line.startswith("|") else None
        for name in re.findall(r"`([^`]+)`", cells[column]) if column and column < len(cells) else []:
            if not set(words_of(name)) <= known:
                findings.add(path, text, at, f"libbem has no {name!r}", "name a function, type or member as it is called now")
        at += len(line) + 1


def check_paths(path, text, visible, findings):
    for match in PATH.finditer(visible):
        name = match.group(1)
        if name.split("/")[0] in SKIPPED | FOREIGN or any((findings.root / place / name).exists() for place in PLACES):
            continue
        if (path.parent / name).exists() or (path.parent.parent / name).exists():
            continue
        findings.add(path, text, match.start(), f"there is no file {name}", "name the file as it is called now")


def test_programs(root):
    lists = (p.read_text(encoding="utf-8") for p in files_below(root / "tests", {".txt"}) if p.name == "CMakeLists.txt")
    return set(re.findall(r"bem_add_test\((\w+)", "\n".join(lists)))


def check_programs(path, text, visible, known, findings):
    for match in PROGRAM.finditer(visible):
        if match.group() not in known:
            findings.add(path, text, match.start(), f"there is no test program {match.group()}", "name it as tests/ has it now")


def comments(text, suffix):
    """The text with everything but comments blanked; offsets stay."""
    pattern = r"//[^\n]*" if suffix in {".cpp", ".hpp", ".h", ".c"} else r"(?m)(?:^|(?<=\s))#[^\n]*|\"\"\"[\s\S]*?\"\"\""
    out, end = [], 0
    for match in re.finditer(pattern, text):
        out += [re.sub(r"[^\n]", " ", text[end:match.start()]), match.group()]
        end = match.end()
    return "".join(out + [re.sub(r"[^\n]", " ", text[end:])])


def check_titles(path, text, visible, documents, findings):
    for match in TITLE.finditer(visible):
        name, title = match.groups()
        title = re.sub(r"\s+(?:///?<?|#)?\s*", " ", title)
        if name in documents and title not in documents[name]:
            findings.add(path, text, match.start(), f"{name} has no part with the title \"{title}\"",
                         "name one of its headings")


def check_equations(path, text, visible, known, findings):
    for match in EQUATION.finditer(visible):
        if match.group(1) not in known:
            findings.add(path, text, match.start(), f"equation ({match.group(1)}) is not in {EQUATIONS}",
                         "add it to the numbers there, or refer to one that is there")


def main(arguments) -> int:
    if len(arguments) > 1 or any(a.startswith("-") for a in arguments):
        print(__doc__, file=sys.stdout if arguments[0] in ("-h", "--help") else sys.stderr)
        return 0 if arguments[0] in ("-h", "--help") else 2
    root = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).parent.parent).resolve()
    findings = Findings(root)
    documents = titles_of_documents(root / "docs")
    equations = root / EQUATIONS
    known = set(re.findall(r"\bM\d+\b", equations.read_text(encoding="utf-8"))) if equations.exists() else set()
    programs = test_programs(root)
    glossary = root / GLOSSARY
    if glossary.exists():
        check_glossary(glossary, glossary.read_text(encoding="utf-8"), findings)
    for path in files_below(root, {".md"}):
        text = path.read_text(encoding="utf-8")
        visible = without_code_blocks(text)
        check_links(path, text, findings)
        check_titles(path, text, visible, documents, findings)
        check_equations(path, text, visible, known, findings)
        if path.name != "CHANGELOG.md":
            check_paths(path, text, LINK.sub(lambda m: " " * len(m.group()), visible), findings)
            check_programs(path, text, visible, programs, findings)
    for path in files_below(root, SOURCES):
        text = path.read_text(encoding="utf-8")
        visible = comments(text, path.suffix)
        check_titles(path, text, visible, documents, findings)
        if path.suffix not in {".py", ".sh"}:
            check_paths(path, text, visible, findings)
            check_equations(path, text, visible, known, findings)
    return 1 if findings.count else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
