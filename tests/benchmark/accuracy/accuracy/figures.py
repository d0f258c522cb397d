"""The figures of graben_evaluate, their limits and how they are shown."""

from dataclasses import dataclass
from math import isnan

# Without noise there is no sigma: distances are then told in h, and limited to a tenth of h for each sigma.
NOISELESS = 0.1


@dataclass(frozen=True)
class Figure:
    key: str  # in the reports of graben_evaluate
    title: str
    limit: float
    in_sigma: bool = False
    unit: str = ""
    scale: float = 1.0  # from the report's value to the one shown


FIGURES = (
    Figure("bridging_triangles", "joining two sides", 0),
    Figure("surface_to_truth_far", "to truth, away", 0.2, True),
    Figure("surface_to_truth_near", "to truth, zone", 0.25, True),
    Figure("truth_to_surface_near", "from truth, zone", 0.3, True),
    Figure("cutoffs_to_border", "cutoff lines", 0.6, True),
    Figure("throw_error", "mean throw off", float("nan"), True),
    Figure("border_to_fault_p95", "border to fault", 0.01, unit=" h"),
    Figure("border_off_fault", "border off the fault", 5.0, unit=" %"),
    Figure("pieces", "pieces", float("nan")),
    Figure("crumbs", "crumbs", 0),
    Figure("topology_errors", "topology errors", 0),
    Figure("flipped_triangles", "flipped", 0),
    Figure("share_below_10_degrees", "angles < 10°", 0.5, unit=" %", scale=100.0),
)
TOPOLOGY = ("non_manifold_edges", "non_manifold_vertices", "inconsistent_edges", "duplicate_triangles", "degenerate_triangles")


@dataclass(frozen=True)
class Value:
    """One figure of one surface."""

    value: float
    limit: float
    unit: str
    exact: bool = False  # must equal the limit

    def ok(self):
        if isnan(self.value) or isnan(self.limit):
            return isnan(self.limit)
        return self.value == self.limit if self.exact else self.value <= self.limit

    def badness(self):
        """How far over the limit, to compare seeds."""
        if isnan(self.value):
            return float("inf")
        if self.exact or self.limit == 0:
            return abs(self.value - self.limit)
        return self.value / self.limit

    def shown(self):
        if isnan(self.value):
            return "-"
        number = f"{self.value:.0f}" if float(self.value).is_integer() and not self.unit else f"{self.value:.3g}"
        return number + self.unit

    def marked(self):
        text = self.shown()
        if self.exact and not self.ok():
            text += f" of {self.limit:.0f}"
        return text if self.ok() else f"**{text}**"


def limit_of(figure, limits):
    return dict(limits).get(figure.key, figure.limit)


def limit_text(figure, limits=()):
    """For the head of a table. Limits: (key, limit) of those that differ from the figures' own."""
    if figure.key == "pieces":
        return "as true"
    most = limit_of(figure, limits)
    return "no limit" if isnan(most) else f"≤ {most:g}{' σ' if figure.in_sigma else figure.unit}" if most else "0"


def read(evaluation, sigma, voxel_size, limits=()):
    """The figures of one report of graben_evaluate, by key; a figure it does not have is left out. Limits: (key, limit) of those that differ here."""
    found = {entry["figure"]: entry for entry in evaluation["figures"]}
    found["topology_errors"] = {"value": sum(found[key]["value"] for key in TOPOLOGY)}
    seal = evaluation.get("seal_by_truth", {"border_vertices": 0})
    if seal["border_vertices"] > 0:
        found["border_off_fault"] = {"value": 100.0 * (1.0 - seal["share"])}
    values = {}
    for figure in FIGURES:
        limit = limit_of(figure, limits)
        entry = found.get(figure.key)
        if entry is None:
            continue
        value = float("nan") if entry["value"] is None else entry["value"] * figure.scale
        if figure.key == "pieces":
            values[figure.key] = Value(value, entry.get("limit", float("nan")), "", exact=True)
        elif figure.in_sigma and sigma == 0.0:
            values[figure.key] = Value(value / voxel_size, NOISELESS * limit, " h")
        else:
            values[figure.key] = Value(value, limit, " σ" if figure.in_sigma else figure.unit)
    return values


def worst(of_seeds):
    """The worst of each figure over several surfaces."""
    return {figure.key: max((values[figure.key] for values in of_seeds if figure.key in values), key=Value.badness)
            for figure in FIGURES if any(figure.key in values for values in of_seeds)}
