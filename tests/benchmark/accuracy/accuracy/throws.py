"""How far the mean throws of a report are from the true ones."""

from math import hypot, nan

from .sections import lines


def _mean_z(path):
    """Of the cutoff lines in a file, by their length on the map; nan if they have none."""
    total = length = 0.0
    for line in lines(path):
        for (xa, ya, za), (xb, yb, zb) in zip(line, line[1:]):
            step = hypot(xb - xa, yb - ya)
            total += 0.5 * (za + zb) * step
            length += step
    return total / length if length > 0.0 else nan


def worst_error(report, cutoffs):
    """Over all faults of the report; nan where one has no throw. Cutoffs: the files of the true lines."""
    walls = {path.stem: path for path in cutoffs}
    errors = []
    for fault in report["faults"]:
        true = _mean_z(walls[f"cutoff_{fault['name']}_footwall"]) - _mean_z(walls[f"cutoff_{fault['name']}_hangingwall"])
        errors.append(abs((fault.get("throw") or {}).get("mean", nan) - true))
    return nan if any(error != error for error in errors) else max(errors, default=0.0)
