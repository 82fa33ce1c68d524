"""Tables, and the sections of documents that scripts fill."""


def table(head, rows, rule=" --- "):
    """`rule` stands in the cells of the line below the head."""
    lines = [f"| {' | '.join(map(str, cells))} |" for cells in (head, *rows)]
    return "\n".join([lines[0], f"|{'|'.join([rule] * len(head))}|", *lines[1:]])


def with_sections(document, sections):
    """The document with the texts {name: text} between their markers, `<!-- NAME -->` and `<!-- end of NAME -->`. Raises
    ValueError if it has not both of them once, in this order."""
    for name, text in sections.items():
        begin, end = f"<!-- {name} -->", f"<!-- end of {name} -->"
        if document.count(begin) != 1 or document.count(end) != 1 or document.index(end) < document.index(begin):
            raise ValueError(f"expected the markers {begin} and {end} once each, in this order")
        head, rest = document.split(begin)
        document = f"{head}{begin}\n{text}\n{end}{rest.split(end)[1]}"
    return document
