"""A horizon as a notebook shows it: a map and its numbers."""

import base64
import html as markup
import os
import tempfile
from typing import Any, List, Optional, Tuple

from . import _core


def _map_faults(horizon: Any) -> List[Tuple[str, list, list, list]]:
    names = list(horizon.throws)
    return [(name, [c.points for c in horizon.cutoffs if c.fault == name],
             [p.ring for p in horizon.polygons if p.fault == name and p.kind == "gap"],
             [p.ring for p in horizon.polygons if p.fault == name and p.kind == "overlap"]) for name in names]


def png(horizon: Any, field: Optional[str] = None, width: int = 640, height: int = 520) -> bytes:
    """The map of a horizon, as graben_reconstruct draws it, as the bytes of a PNG; see Horizon.picture."""
    if field is not None and field not in horizon.fields:
        raise ValueError(f"field: one of {', '.join(horizon.fields)} was expected, not {field!r}")
    with tempfile.TemporaryDirectory() as folder:
        stem = os.path.join(folder, "map")
        _core.draw_map(stem, horizon._core_mesh(), _map_faults(horizon), horizon.z_positive, field or "", width, height)
        with open(stem + ".png", "rb") as file:
            return file.read()


def _rows(horizon: Any) -> List[Tuple[str, str]]:
    report = horizon.report
    rows = [("picks", f"{report['picks']['count']:,}"), ("triangles", f"{len(horizon.triangles):,}"), ("pieces", str(report["topology"]["pieces"])),
            ("voxel size", f"{horizon.voxel_size:.4g}"), ("z grows", horizon.z_positive)]
    for name, throws in horizon.throws.items():
        if len(throws):
            rows.append((f"throw at {name}", f"{throws['throw'].min():.4g} to {throws['throw'].max():.4g}"))
    return rows + [("warning", sentence) for sentence in horizon.warnings]


def html(horizon: Any) -> str:
    table = "".join(f"<tr><th style='text-align:left'>{markup.escape(key)}</th><td style='text-align:left'>{markup.escape(value)}</td></tr>"
                    for key, value in _rows(horizon))
    picture = ""
    if len(horizon.triangles):
        picture = f"<img alt='map of the horizon' src='data:image/png;base64,{base64.b64encode(png(horizon)).decode()}'>"
    return f"<div>{picture}<table>{table}</table></div>"
