"""Scenes as the compiled module takes them: the name of a file, and a text in place of its contents."""
from __future__ import annotations

import json
import logging
import os
import warnings
from typing import Any, Callable, Mapping, Optional, Tuple, Union

Path = Union[str, "os.PathLike[str]"]
Scene = Union[Path, Mapping[str, Any]]
Progress = Callable[[str, float], None]

log = logging.getLogger("bem")  # gets notes


class BemWarning(UserWarning):
    """What the library warns of."""


def warn(text: str) -> None:
    warnings.warn(text, BemWarning, stacklevel=3)


def plain(value: Any) -> Any:
    """What json cannot write: paths and archives by their names, arrays as lists, numbers of numpy as numbers."""
    if hasattr(value, "__fspath__"):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"a scene cannot hold a {type(value).__name__}")


def named_text(scene: Scene, base: Optional[Path]) -> Tuple[str, Optional[str]]:
    """The name of a scene's file, and its text if it is no file. `base`: the folder that paths in it are relative to."""
    if isinstance(scene, Mapping):
        return os.path.join(os.path.abspath(base or os.curdir), "scene"), json.dumps(scene, indent=2, default=plain)
    if base is not None:
        raise ValueError("base belongs to scenes that are dictionaries: paths in a file are relative to its folder")
    return os.fspath(scene), None
