"""JSON: files that are whole at any time, results that are kept, changes of documents."""
import json


def load(path):
    """What is in a JSON file; None if there is none."""
    return json.loads(path.read_text()) if path.exists() else None


def save(path, value, indent=1):
    """Replaces a JSON file at once: an interruption leaves the old one."""
    partial = path.with_suffix(".partial")
    partial.write_text(json.dumps(value, indent=indent) + "\n")
    partial.replace(path)


class Results:
    """{key: record} in a JSON file, which is written after every run, so that a study that was stopped goes on."""

    def __init__(self, path):
        self.path, self.records = path, load(path) or {}

    def add(self, key, record):
        self.records[key] = record
        save(self.path, self.records, indent=0)


def changed(content, changes):
    """Puts values {JSON path: value} into a document; a whole number for an array keeps its first few items."""
    for pointer, value in changes.items():
        *parents, key = pointer.strip("/").split("/")
        target = content
        for parent in parents:
            target = target[int(parent) if isinstance(target, list) else parent]
        if isinstance(target, list):
            key = int(key)
        elif isinstance(value, int) and isinstance(target.get(key), list):
            value = target[key][:value]
        target[key] = value
    return content
