"""Many reconstructions from perturbed picks and faults: how sure is the throw, the depth, a block?"""

import os
from dataclasses import dataclass, field
from typing import Any, Dict, Iterator, List, Optional, Sequence, Tuple

import numpy as np

from .data import Fault, Mesh, Picks
from .files import Progress, as_faults, as_picks
from .horizon import Horizon, reconstruct
from .models import Model, model
from .perturb import Errors, find_lines, perturbed
from .raster import Grid, heights
from .reduction import Moments, Quantiles
from .steps import Sampling, sampling
from .workers import Outcome, in_this_process, on_dask, on_processes

#: Columns of Ensemble.throws. x y z along throw: of the surface from the picks as given, see THROW_TYPE; p10 p50 p90: a tenth, a half, nine tenths of the
#: realizations have no greater throw; mean, deviation: of the realizations; surface_deviation: standard deviation that reconstruct reckons from the picks as
#: given, which also holds what a surface misses of bends between the picks, as realizations do not; count: realizations that have a throw there. All throws in
#: z units.
ENSEMBLE_TYPE = np.dtype([(name, "f8") for name in ("x", "y", "z", "along", "throw", "p10", "p50", "p90", "mean", "deviation", "surface_deviation")]
                         + [("count", "i8")])

_USED = ("voxel_size", "rho", "delta", "zone_width", "fault_reach", "neighbors")


@dataclass(eq=False)
class HeightMap:
    """Heights of one horizon over all realizations, on the nodes of a grid; arrays have the shape (columns, rows).

    Attributes
    ----------
    grid : Grid
    mean, deviation : float64, z units
        NaN where no realization has the surface; deviation: where fewer than two have.
    probability : float64
        Share of the realizations that have the surface there.
    """

    grid: Grid
    mean: np.ndarray
    deviation: np.ndarray
    probability: np.ndarray


@dataclass(eq=False)
class Ensemble:
    """What many realizations say together.

    Attributes
    ----------
    n : int
        Realizations asked for.
    failed : list of (number, reason)
        Those that gave no surface; they count in nothing else.
    throws : dict of arrays by fault, dtype ENSEMBLE_TYPE
        Of one horizon; empty for a model.
    maps : dict of HeightMap by horizon
    blocks : dict by name
        Of a model: share of the realizations in which a block of this name exists.
    volumes : dict of (mean, deviation) by name
        Of the blocks, where they exist.
    base : Horizon or Model
        From the picks as given.
    errors : list of Errors
        What was perturbed, and by how much, for each horizon.
    """

    n: int
    failed: List[Tuple[int, str]]
    throws: Dict[str, np.ndarray]
    maps: Dict[str, HeightMap]
    blocks: Dict[str, float]
    volumes: Dict[str, Tuple[float, float]]
    base: Any
    errors: List[Errors]

    def __repr__(self) -> str:
        return f"<graben.Ensemble of {self.n}: {len(self.failed)} failed, {len(self.throws)} faults, {len(self.blocks)} blocks>"

    def write(self, folder: Any) -> List[str]:
        """Writes throws as CSV, maps as ESRI ASCII grids, blocks and failures as CSV into a folder. Gives the names of the files."""
        from .ensemble_files import write

        return write(folder, self)


@dataclass
class _Job:
    """All that a worker needs for any realization."""

    horizons: List[Tuple[str, Picks, str]]
    errors: List[Errors]
    faults: List[Fault]
    single: bool
    seed: int
    options: Dict[str, Any]
    grids: List[Grid]
    places: Dict[str, np.ndarray]  # by fault, (k, 2): where throws are compared
    reach: float = 0.0  # how far across its strike a fault may have moved


def _throws_at(places: np.ndarray, reach: float, profile: Optional[np.ndarray]) -> np.ndarray:
    """A realization's throws straight across from places along strike, NaN where it has none."""
    result = np.full(len(places), np.nan)
    if profile is None or len(profile) == 0 or len(places) < 2:
        return result
    rows = np.stack((profile["x"], profile["y"]), axis=1)
    strike = np.gradient(places, axis=0)
    length = np.linalg.norm(strike, axis=1, keepdims=True)
    strike = np.divide(strike, length, out=np.zeros_like(strike), where=length > 0.0)
    interval = float(np.median(np.linalg.norm(np.diff(places, axis=0), axis=1)))
    for i, (place, along) in enumerate(zip(places, strike)):
        offset = rows - place
        ahead = offset @ along
        across = np.abs(offset[:, 0] * along[1] - offset[:, 1] * along[0])
        near = (across <= reach + interval) & (np.abs(ahead) <= 1.5 * interval)
        before, after = np.flatnonzero(near & (ahead <= 0.0)), np.flatnonzero(near & (ahead >= 0.0))
        if len(before) and len(after):
            a, b = before[ahead[before].argmax()], after[ahead[after].argmin()]
            gap = ahead[b] - ahead[a]
            share = -ahead[a] / gap if gap > 0.0 else 0.0
            result[i] = (1.0 - share) * profile["throw"][a] + share * profile["throw"][b]
        elif near.any():
            nearest = np.flatnonzero(near)[np.abs(ahead[near]).argmin()]
            if abs(ahead[nearest]) <= interval:
                result[i] = profile["throw"][nearest]
    return result


def _realize(job: _Job, number: int) -> Dict[str, Any]:
    """One realization, as little of it as is needed."""
    horizons, faults = perturbed(job.horizons, job.errors, job.faults, job.seed, number)
    if job.single:
        made = reconstruct(horizons[0][1], faults, deviation=False, **job.options)
        throws = {fault: _throws_at(places, job.reach, made.profiles.get(fault)) for fault, places in job.places.items()}
        return {"throws": throws, "heights": [heights(made, job.grids[0])], "blocks": {}}
    stack = model(horizons, faults, **job.options)
    if not stack.closed:
        raise RuntimeError(f"the model is not closed: {stack.defects[0]}")
    return {"throws": {}, "heights": [heights(stack.horizons[name], grid) for (name, _, _), grid in zip(job.horizons, job.grids)],
            "blocks": {block.name: block.volume for block in stack.blocks}}


def _stack(picks: Any) -> Tuple[List[Tuple[str, Picks, str]], bool]:
    if isinstance(picks, dict):
        picks = list(picks.items())
    several = isinstance(picks, (list, tuple)) and len(picks) > 0 and all(isinstance(one, (list, tuple)) and isinstance(one[0], str) for one in picks)
    if not several:
        return [("horizon", as_picks("picks", picks), "conformable")], True
    return [(one[0], as_picks(f"picks[{one[0]!r}]", one[1]), one[2] if len(one) > 2 else "conformable") for one in picks], False


def _not_negative(**lengths: Optional[float]) -> None:
    for name, value in lengths.items():
        if value is not None and not (np.isscalar(value) and np.isfinite(value) and value >= 0.0):
            raise ValueError(f"{name}: a finite number, 0 or more, was expected, not {value!r}")


def _lines_of(picks: Picks, given: Any, measured: Sampling, misties: float, argument: str) -> Optional[np.ndarray]:
    if given is not None:
        labels = np.asarray(given)
        if labels.shape != (len(picks),):
            raise ValueError(f"lines: an array of shape ({len(picks)},), the line of each pick, was expected, but its shape is {labels.shape}")
        return np.unique(labels, return_inverse=True)[1]
    if measured.along_lines:
        return find_lines(picks.points, measured.along)
    if misties > 0.0:
        raise ValueError(f"misties: {argument} do not lie along lines that could be off their neighbours; name the line of each pick with lines=")
    return None


def _errors_of(picks: Picks, argument: str, z_scale: float, lines: Any, pick_sigma: Optional[float], pick_range: Optional[float], fault_sigma: float,
               fault_range: Optional[float], misties: float) -> Errors:
    scaled = Picks(picks.points * (1.0, 1.0, z_scale)) if z_scale != 1.0 else picks
    measured = sampling(scaled)
    labels = _lines_of(picks, lines, measured, misties, argument)
    if pick_range is None:
        pick_range = measured.line_distance if labels is not None else 0.0
    return Errors(measured.sigma / z_scale if pick_sigma is None else pick_sigma, pick_range, fault_sigma, fault_range, misties, z_scale, labels)


def _prepare_horizon(job: _Job, spacing: Optional[float], progress: Progress) -> Horizon:
    base = reconstruct(job.horizons[0][1], job.faults, progress=progress, **job.options)
    parameters = base.report["parameters"]
    job.options.update({name: parameters[name] for name in _USED})
    job.grids = [Grid.over(base, spacing or 2.0 * base.voxel_size)]
    job.places = {fault: np.stack((rows["x"], rows["y"]), axis=1) for fault, rows in base.profiles.items() if len(rows) > 0}
    job.reach = 4.0 * job.errors[0].fault_sigma
    return base


def _prepare_model(job: _Job, spacing: Optional[float], progress: Progress) -> Model:
    base = model(job.horizons, job.faults, progress=progress, **job.options)
    for name in ("outline", "top", "base", "size"):
        job.options[name] = base.report[name]
    job.grids = [Grid.over(base.horizons[name], spacing or 2.0 * base.reports[name]["parameters"]["voxel_size"]) for name, _, _ in job.horizons]
    return base


class _Reduction:
    """Takes results in, in order of their numbers."""

    def __init__(self, job: _Job):
        self.throws = {fault: (Quantiles(len(places)), Moments((len(places),))) for fault, places in job.places.items()}
        self.heights = [Moments(grid.shape) for grid in job.grids]
        self.volumes: Dict[str, Moments] = {}
        self.failed: List[Tuple[int, str]] = []
        self.done = 0

    def take(self, outcome: Outcome) -> None:
        number, result, failure = outcome
        if failure is not None:
            self.failed.append((number, failure))
            return
        self.done += 1
        for fault, values in result["throws"].items():
            for one in self.throws[fault]:
                one.add(values)
        for moments, z in zip(self.heights, result["heights"]):
            moments.add(z)
        for block, volume in result["blocks"].items():
            self.volumes.setdefault(block, Moments((1,))).add(np.array([volume]))


def _throw_table(rows: np.ndarray, quantiles: Quantiles, moments: Moments) -> np.ndarray:
    table = np.empty(len(rows), ENSEMBLE_TYPE)
    for name in ("x", "y", "z", "along", "throw"):
        table[name] = rows[name]
    for name, share in (("p10", 0.1), ("p50", 0.5), ("p90", 0.9)):
        table[name] = quantiles.at(share)
    table["mean"], table["deviation"], table["count"] = moments.mean, moments.deviation, moments.count
    table["surface_deviation"] = rows["deviation"]
    return table


def _outcomes(job: _Job, n: int, client: Any, workers: Optional[int]) -> Iterator[Outcome]:
    if client is not None:
        return on_dask(_realize, job, n, client)
    workers = workers if workers is not None else (os.cpu_count() or 1)
    return in_this_process(_realize, job, n) if workers == 0 else on_processes(_realize, job, n, workers)


def ensemble(
    picks: Any,
    faults: Any = (),
    *,
    n: int = 200,
    pick_sigma: Optional[float] = None,
    pick_range: Optional[float] = None,
    fault_sigma: float = 0.0,
    fault_range: Optional[float] = None,
    misties: float = 0.0,
    lines: Any = None,
    seed: int = 1,
    client: Any = None,
    workers: Optional[int] = None,
    map_spacing: Optional[float] = None,
    progress: Progress = None,
    **options: Any,
) -> Ensemble:
    """Makes the horizon, or the model, n times from picks and faults that are perturbed as interpretations err, and tells what all have in common.

    Results are taken in as they arrive, in order: memory does not grow with n, and every number of workers gives the same. Parameters are those estimated
    from the picks as given.

    Parameters
    ----------
    picks : as in reconstruct; or, for a model, a dict of picks by name or list of (name, picks), top to bottom, as in model
    faults : as in reconstruct
    n : int
        Realizations.
    pick_sigma : float, z units
        Standard deviation of the picks' error; None: the noise measured on the picks.
    pick_range : float, x, y units
        How far errors of picks go together: along their line where they lie along lines (None: the distance of the lines), in the map elsewhere (None: 0,
        each pick for itself).
    fault_sigma : float, x, y units
        Standard deviation of the distance by which a fault lies off, across itself; 0: faults stay.
    fault_range : float, x, y units
        How far that goes together on a fault; None: a third of the fault's extent.
    misties : float, z units
        Standard deviation of a constant for each line.
    lines : array (n,)
        The line of each pick, any labels; None: found from the order of the picks where they lie along lines. Of one horizon only.
    seed : int
        Of the random numbers; each realization has its own.
    client : dask.distributed.Client, or address of a scheduler
        Where the realizations are made; its workers need graben too. None: processes of this machine.
    workers : int
        Processes of this machine; None: one per processor; 0: in this process, one after another.
    map_spacing : float, x, y units
        Of the nodes of the maps; None: two voxels.
    progress : callable of (stage, fraction)
    **options
        Of reconstruct, or of model. threads: for each realization, default 1.

    Returns
    -------
    Ensemble
    """
    if not isinstance(n, (int, np.integer)) or n < 1:
        raise ValueError(f"n: a whole number, 1 or more, was expected, not {n!r}")
    _not_negative(pick_sigma=pick_sigma, pick_range=pick_range, fault_sigma=fault_sigma, fault_range=fault_range, misties=misties, map_spacing=map_spacing)
    horizons, single = _stack(picks)
    if lines is not None and not single:
        raise ValueError("lines: only for picks of one horizon")
    z_scale = float(options.get("z_scale") or 1.0)
    errors = [_errors_of(given, f"the picks of {name}", z_scale, lines, pick_sigma, pick_range, fault_sigma, fault_range, misties)
              for name, given, _ in horizons]
    job = _Job(horizons, errors, as_faults("faults", faults), single, seed, dict(options), [], {})
    threads = job.options.pop("threads", None)
    base = (_prepare_horizon if single else _prepare_model)(job, map_spacing, progress)
    job.options["threads"] = threads or 1
    reduction = _Reduction(job)
    for outcome in _outcomes(job, n, client, workers):
        reduction.take(outcome)
        if progress is not None:
            progress("realizations", (outcome[0] + 1) / n)
    return _gathered(n, job, base, reduction)


def _gathered(n: int, job: _Job, base: Any, reduction: _Reduction) -> Ensemble:
    done = max(reduction.done, 1)
    maps = {name: HeightMap(grid, moments.mean, moments.deviation, moments.count / done)
            for (name, _, _), grid, moments in zip(job.horizons, job.grids, reduction.heights)}
    volumes = {name: (float(m.mean[0]), float(m.deviation[0])) for name, m in sorted(reduction.volumes.items())}
    return Ensemble(n, reduction.failed, {fault: _throw_table(base.profiles[fault], *both) for fault, both in reduction.throws.items()}, maps,
                    {name: int(reduction.volumes[name].count[0]) / done for name in volumes}, volumes, base, job.errors)
