"""The examples of docs/python.md, in their order."""
import os
import pathlib
import re

PAGE = pathlib.Path(os.environ["BEM_DOCS"], "python.md")


def test_the_examples_of_the_page_run():
    text = PAGE.read_text()
    names = {}
    examples = list(re.finditer(r"^```python\n(.*?)^```$", text, re.DOTALL | re.MULTILINE))
    assert len(examples) > 8
    for example in examples:
        line = text.count("\n", 0, example.start(1))
        exec(compile("\n" * line + example[1], PAGE, "exec"), names)
