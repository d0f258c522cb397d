"""Meshes as objects of other libraries, where these are installed."""

from typing import Any, Optional

import numpy as np

from .data import Mesh
from .raster import Grid, heights, median_edge


def _library(name: str, method: str) -> Any:
    import importlib

    try:
        return importlib.import_module(name)
    except ImportError:
        raise ImportError(f"{method} needs {name}, which is not installed: pip install {name}") from None


def to_pyvista(mesh: Mesh) -> Any:
    pyvista = _library("pyvista", "to_pyvista")
    faces = np.column_stack((np.full(len(mesh.triangles), 3), mesh.triangles)).ravel()
    data = pyvista.PolyData(mesh.vertices, faces)
    if mesh.normals is not None:
        data.point_data["Normals"] = mesh.normals
    if mesh.pieces is not None:
        data.point_data["piece"] = mesh.pieces
    for name, values in mesh.fields.items():
        data.point_data[name] = values
    return data


def to_xtgeo(mesh: Mesh, spacing: Optional[float] = None) -> Any:
    xtgeo = _library("xtgeo", "to_xtgeo")
    if spacing is not None and not spacing > 0.0:
        raise ValueError(f"spacing: a length above 0 was expected, not {spacing!r}")
    grid = Grid.over(mesh, spacing or median_edge(mesh))
    values = np.ma.masked_invalid(heights(mesh, grid))
    return xtgeo.RegularSurface(ncol=grid.columns, nrow=grid.rows, xinc=grid.spacing, yinc=grid.spacing, xori=grid.x0, yori=grid.y0, yflip=1, rotation=0.0,
                                values=values, name=mesh.name)
