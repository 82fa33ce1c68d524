"""The parts of USD's text form that tests look at, where every statement and every sample has a line of its own."""
import ast
import re

import numpy as np


def value(text):
    text = text.strip().removesuffix("(").strip()  # metadata follow
    if text.startswith(("[", "(")):
        found = ast.literal_eval(text)
        return np.array(found) if not found or not isinstance(found[0], str) else found
    return ast.literal_eval(text)


class Layer:
    """`metadata` of the layer, and by name the meshes: attributes, of which those that change are dictionaries by time."""

    def __init__(self, text):
        head, body = re.match(r"#usda 1\.0\n\((.*?)\n\)\n(.*)", text, re.S).groups()
        self.metadata = {name: value(words) for name, words in re.findall(r"^    (\w+) = ([^{\n]+)$", head, re.M)}
        self.meshes = {}
        mesh, samples = None, None
        for line in body.splitlines():
            if started := re.match(r'\s*def (\w+) "(\w+)"', line):
                mesh = self.meshes.setdefault(started.group(2), {}) if started.group(1) == "Mesh" else None
                continue
            if samples is not None:
                if sample := re.match(r"\s*([-+.\deE]+): (.*),$", line):
                    samples[float(sample.group(1))] = value(sample.group(2))
                else:
                    samples = None
            elif begun := re.match(r"\s*(?:uniform )?[\w\[\]]+ ([\w:]+)\.timeSamples = {$", line):
                samples = mesh[begun.group(1)] = {}
            elif attribute := re.match(r"\s*(?:uniform )?[\w\[\]]+ ([\w:]+) = ([^{]+)$", line):
                if mesh is not None:
                    mesh[attribute.group(1)] = value(attribute.group(2))
