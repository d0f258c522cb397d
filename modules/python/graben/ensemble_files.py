"""An ensemble as a folder of files."""

import csv
import os
import re
from typing import Any, Iterable, List, Sequence

import numpy as np

from .ensembles import Ensemble, HeightMap

_NO_DATA = -9999.0


def _file_name(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9._-]", "_", name)


def _table(folder: str, name: str, header: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    with open(os.path.join(folder, name), "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        writer.writerows(rows)
    return name


def _cells(rows: np.ndarray) -> Iterable[List[Any]]:
    for row in rows:
        yield ["" if isinstance(value, float) and np.isnan(value) else value for value in row.tolist()]


def _ascii_grid(folder: str, name: str, map_: HeightMap, values: np.ndarray) -> str:
    """ESRI ASCII grid: rows from north to south."""
    grid = map_.grid
    with open(os.path.join(folder, name), "w", encoding="ascii") as file:
        file.write(f"ncols {grid.columns}\nnrows {grid.rows}\nxllcenter {grid.x0!r}\nyllcenter {grid.y0!r}\ncellsize {grid.spacing!r}\n"
                   f"NODATA_value {_NO_DATA:g}\n")
        for row in np.where(np.isnan(values), _NO_DATA, values).T[::-1]:
            file.write(" ".join(f"{value:.6g}" if value != _NO_DATA else f"{_NO_DATA:g}" for value in row) + "\n")
    return name


def write(folder: Any, ensemble: Ensemble) -> List[str]:
    folder = os.fspath(folder)
    os.makedirs(folder, exist_ok=True)
    names = []
    for number, (fault, rows) in enumerate(ensemble.throws.items(), 1):
        names.append(_table(folder, f"throw_{number}_{_file_name(fault)}.csv", rows.dtype.names, _cells(rows)))
    for horizon, map_ in ensemble.maps.items():
        for what in ("mean", "deviation", "probability"):
            names.append(_ascii_grid(folder, f"{_file_name(horizon)}_{what}.asc", map_, getattr(map_, what)))
    if ensemble.blocks:
        rows = ([name, probability, *ensemble.volumes[name]] for name, probability in ensemble.blocks.items())
        names.append(_table(folder, "blocks.csv", ("block", "probability", "volume_mean", "volume_deviation"), rows))
    names.append(_table(folder, "failed.csv", ("realization", "reason"), ensemble.failed))
    return names
