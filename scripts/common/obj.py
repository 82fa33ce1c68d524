"""OBJ files of meshes, with all digits; needs nothing but Python."""


def read(path):
    """Vertices and faces, lists of lists; a face has the indices of its corners from 0. Raises ValueError."""
    vertices, faces = [], []
    with open(path, encoding="utf-8") as file:
        for line in file:
            kind, *values = line.split() or [""]
            if kind == "v":
                vertices.append([float(x) for x in values[:3]])
            elif kind == "f":
                faces.append([int(v.split("/")[0]) - 1 for v in values])
    return vertices, faces


def write(path, vertices, faces, comment=None):
    """Of vertices [N, 3] and the indices of corners from 0 [M, 3]."""
    with open(path, "w", encoding="ascii") as file:
        if comment:
            file.write(f"# {comment}\n")
        for x in vertices:
            file.write("v " + " ".join(repr(float(c)) for c in x) + "\n")
        for f in faces:
            file.write("f " + " ".join(str(i + 1) for i in f) + "\n")
