"""graben: faulted geological horizons from picks and faults.

    import graben
    horizon = graben.reconstruct("picks.xyz", ["F1.pol", "F2.pol"])
    horizon.throws["F1"]["throw"].max()
    horizon.write("horizon.ply")

Coordinates are in the user's frame: x and y in one unit, z in its own, up or down. reconstruct makes one horizon, model closed blocks of several, ensemble
many horizons from perturbed picks and faults; read_picks, read_faults, read_mesh and write deal with files; normals, marching_cubes, cut and fit are the
steps of the paper as PCL classes; sampling and evaluate measure. The commands of the same names give the same results.
"""

from .data import Fault, Mesh, Picks, version as __version__
from .ensembles import ENSEMBLE_TYPE, Ensemble, HeightMap, ensemble
from .errors import Error, FileError, InvalidInputError, ResourceError
from .files import read_faults, read_mesh, read_picks, write
from .horizon import PROFILE_TYPE, REASONS, THROW_TYPE, Cutoff, Horizon, Polygon, reconstruct
from .models import Block, Model, Section, model
from .raster import Grid
from .steps import Sampling, cut, evaluate, fit, marching_cubes, normals, sampling

__all__ = [
    "Block", "Cutoff", "ENSEMBLE_TYPE", "Ensemble", "Error", "Fault", "FileError", "Grid", "HeightMap", "Horizon", "InvalidInputError", "Mesh",
    "Model", "PROFILE_TYPE", "Picks", "Polygon", "REASONS", "ResourceError", "Sampling", "Section", "THROW_TYPE", "cut", "ensemble", "evaluate",
    "fit", "marching_cubes", "model", "normals", "read_faults", "read_mesh", "read_picks", "reconstruct", "sampling", "write",
]
