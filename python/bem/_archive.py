"""Archives: what is precomputed for a body."""
from __future__ import annotations

import json
import os
import shutil
import tempfile
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _bem
from ._scene import Path, Progress, log, plain, warn

Mesh = Union[Path, Tuple[npt.ArrayLike, npt.ArrayLike]]
Material = Union[Path, Mapping[str, Any]]


class Archive:
    """The archive of a body: its mesh, material and matrices in a file.

    Opening one reads its mesh and material and checks the digest of the whole file. Scenes take an archive in place of its path:
    ``{"name": "ball", "archive": archive}``.

    Raises ArchiveError if the file is missing, damaged or no archive.
    """

    def __init__(self, path: Path) -> None:
        self._path = os.path.abspath(path)
        self._archive = _bem.Archive(self._path)
        self._folder: Optional[tempfile.TemporaryDirectory[str]] = None

    @property
    def path(self) -> str:
        """Absolute path of the file."""
        return self._path

    def __fspath__(self) -> str:
        return self._path

    def __repr__(self) -> str:
        return f"<bem.Archive {self._path}: {len(self.vertices)} vertices>"

    @property
    def info(self) -> Dict[str, Any]:
        """What is in it, without arrays: what ``bemprecomp --info --json`` prints."""
        found: Dict[str, Any] = json.loads(self._archive.info())
        return found

    @property
    def vertices(self) -> npt.NDArray[np.float64]:
        """Vertices of the mesh (N, 3) [m], in the order of the mesh that it was made from."""
        return self._archive.vertices()

    @property
    def faces(self) -> npt.NDArray[np.int32]:
        """Vertices of the triangles (M, 3), from 0."""
        return self._archive.faces()

    def verify(self, progress: Optional[Progress] = None) -> None:
        """Reads all matrices and checks that their numbers are finite. Raises ArchiveError."""
        self._archive.verify(progress)

    def save(self, path: Path, force: bool = False) -> "Archive":
        """Copies the file, and returns the copy. ``force``: in place of a file that is there."""
        if not force and os.path.exists(path):
            raise _bem.UsageError(f"{os.fspath(path)}: exists already; use force=True to overwrite it")
        partial = f"{os.fspath(path)}.partial"
        shutil.copyfile(self._path, partial)
        os.replace(partial, path)
        return Archive(path)


def setting_text(value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    return os.fspath(value) if hasattr(value, "__fspath__") else str(value)


def material_text(material: Material) -> Tuple[str, bool]:
    """The text that names a material, or its JSON."""
    if isinstance(material, Mapping):
        return json.dumps({"name": "material", **material}, default=plain), True
    return os.fspath(material), False


def mesh_arrays(mesh: Tuple[npt.ArrayLike, npt.ArrayLike]) -> Tuple[npt.NDArray[np.float64], npt.NDArray[np.int32]]:
    vertices, faces = (np.asarray(part) for part in mesh)
    for name, array in (("vertices", vertices), ("faces", faces)):
        if array.ndim != 2 or array.shape[1] != 3:
            raise _bem.UsageError(f"{name} must be an array of three columns, not of shape {array.shape}")
    if not np.issubdtype(faces.dtype, np.integer):
        raise _bem.UsageError(f"faces must be integers, not {faces.dtype}")
    if faces.size and max(-int(faces.min()), int(faces.max())) > np.iinfo(np.int32).max:
        raise _bem.UsageError("faces has numbers that no vertex can have")
    return vertices.astype(np.float64), faces.astype(np.int32)


def precompute(mesh: Mesh, material: Material, output: Optional[Path] = None, *, time_step: Optional[float] = None, mesh_scale: float = 1,
               name: str = "arrays", force: bool = False, progress: Optional[Progress] = None, **settings: Any) -> Archive:
    """Computes the matrices of a body, as ``bemprecomp`` does.

    mesh: a file, or vertices (N, 3) [m] and triangles (M, 3) of vertex numbers from 0, counter-clockwise seen from outside.
    material: a name (`materials`), a file, or a dictionary with density [kg/m^3], poisson_ratio and shear_modulus or youngs_modulus [Pa].
    output: file of the archive; without it the archive lives as long as the object that is returned.
    time_step: [s]; without it one is chosen, and noted in the log.
    mesh_scale: factor on the coordinates.
    name: of a mesh of arrays, for messages and for `Archive.info`.
    force: a file that is there is replaced. Without it, one that was made of the same is kept and opened.
    progress: called with the name of the work and the part of it that is done, from any thread.
    settings: what a scene has under "precompute"; `settings` lists them. As with ``bemprecomp``, ``repair`` is "off" if it is not given.

    Other Python threads go on meanwhile, and Ctrl-C ends it. Warnings are `BemWarning`.
    Raises InputError for a mesh or material that cannot be used, UsageError for a setting, ResourceError if memory or disk are too small.
    """
    if time_step is not None:
        settings["dt"] = time_step
    texts = {key: setting_text(value) for key, value in settings.items() if value is not None}
    text, is_json = material_text(material)
    folder = None if output is not None else tempfile.TemporaryDirectory(prefix="bem-")
    path = os.fspath(output) if output is not None else os.path.join(folder.name, "body.bem")  # type: ignore[union-attr]
    if isinstance(mesh, (str, os.PathLike)):
        name, arrays = os.fspath(mesh), None
    else:
        arrays = mesh_arrays(mesh)
    _bem.precompute(name, arrays, mesh_scale, text, is_json, texts, path, force, log.info, warn, progress)
    archive = Archive(path)
    archive._folder = folder
    return archive


def read_mesh(path: Path) -> Tuple[npt.NDArray[np.float64], npt.NDArray[np.int32]]:
    """Vertices (N, 3) and triangles (M, 3) of a mesh file, as they are in it. Raises InputError."""
    return _bem.read_mesh(os.fspath(path))


def settings() -> Dict[str, str]:
    """The settings of `precompute` with what they do."""
    return {key: text for key, text in _bem.settings().items() if key != "dt"}


def materials() -> List[str]:
    """Names of materials that need no file (docs/scene-format.md has their values)."""
    return _bem.materials()
