"""The synthetic cases: what graben_synthesize is asked for, and what differs from it in the other two commands."""

from dataclasses import dataclass
from math import nan, sqrt

INTERPRETED = ("normal", "reverse", "tip", "listric", "branch", "conjugate")  # kinds that are picked as interpreters pick
SIZE = 6000.0
PICKS = 60000
SIGMA = 2.0
SPACING = SIZE / sqrt(PICKS)
KINDS = ("normal", "reverse", "tip", "conjugate", "listric", "branch", "cross", "relay")


@dataclass(frozen=True)
class Case:
    """One row of the table."""

    group: str
    name: str
    title: str
    synthesize: tuple  # options of graben_synthesize
    sigma: float = SIGMA  # noise, given to graben_synthesize and graben_evaluate
    reconstruct: tuple = ()  # options of graben_reconstruct beside picks, faults and output
    faults: str = "ts"  # what graben_reconstruct gets: ts, the surfaces, or pol, the sticks
    judged_by: tuple = ()  # options of graben_synthesize that make the faults graben_evaluate gets; none: the same
    evaluate: tuple = ()  # more options of graben_evaluate
    limits: tuple = ()  # (key, limit) of figures that have another limit here; nan: none


def _kinds():
    for kind in KINDS:
        yield Case("kinds", kind, kind, ("--kind", kind))
    yield Case("kinds", "utm", "normal in UTM coordinates", ("--kind", "normal", "--origin", "461000,5931000,-1700"))


def _throw():
    for spacings in (1, 2, 3, 5, 10, 20):
        throw = f"{spacings * SPACING:.3f}"
        for kind in ("normal", "reverse"):
            yield Case("throw", f"throw-{spacings}-{kind}", f"{kind}, throw {spacings} spacings", ("--kind", kind, "--throw", throw))


def _noise():
    for share in (0.0, 0.02, 0.1, 0.25, 0.5):
        for kind in ("normal", "reverse", "tip"):
            yield Case("noise", f"sigma-{share:g}-{kind}", f"{kind}, σ = {share:g} spacings", ("--kind", kind), sigma=round(share * SPACING, 6))


def _density():
    for per_h in (0.5, 1.5, 2.0):
        picks = str(round(PICKS / per_h**2))
        for kind in ("normal", "reverse", "tip"):
            yield Case("density", f"per-h-{per_h:g}-{kind}", f"{kind}, one pick per {per_h:g} h, h = {SPACING:.4g} given",
                       ("--kind", kind, "--picks", picks), reconstruct=("--voxel-size", f"{SPACING:.6g}"))
    for kind in ("normal", "reverse", "tip"):
        for picks in (15000, 240000):
            yield Case("density", f"picks-{picks}-{kind}", f"{kind}, {picks} picks, h estimated", ("--kind", kind, "--picks", str(picks)))
    yield Case("density", "uneven", "normal, density varies tenfold", ("--kind", "normal", "--uneven", "1"))
    yield Case("density", "gap", "normal, no picks within 2 spacings of the fault", ("--kind", "normal", "--gap", f"{2 * SPACING:.3f}"))
    yield Case("density", "hole", "normal, no picks in a disc 4 spacings wide at the fault", ("--kind", "normal", "--hole", f"50,0,{2 * SPACING:.3f}"))


def _dip():
    for dip in (30, 45, 75, 85, 90):
        for kind in ("normal", "tip"):
            yield Case("dip", f"dip-{dip}-{kind}", f"{kind}, dip {dip}°", ("--kind", kind, "--dip", str(dip)))
        if dip < 85:
            yield Case("dip", f"dip-{dip}-reverse", f"reverse, dip {dip}°", ("--kind", "reverse", "--dip", str(dip)))


def _near():
    distance = f"{5 * SPACING:.3f}"
    for throw in (40, 100):
        yield Case("two faults", f"parallel-{throw}", f"parallel, 5 spacings apart, throw {throw}",
                   ("--kind", "parallel", "--fault-distance", distance, "--throw", str(throw)))
    yield Case("two faults", "parallel-reverse", "parallel and reverse, 5 spacings apart, throw 40",
               ("--kind", "parallel", "--fault-distance", distance, "--throw", "-40"))
    yield Case("two faults", "relay-near", "relay, 5 spacings apart, throw 40", ("--kind", "relay", "--fault-distance", distance, "--throw", "40"))
    yield Case("two faults", "cross-reverse", "cross, hanging walls up", ("--kind", "cross", "--throw", "-80"))
    yield Case("two faults", "branch-gap", "branch stops 60 m short", ("--kind", "branch", "--branch-gap", "60"), judged_by=("--branch-gap", "0"))
    yield Case("two faults", "branch-sticks", "branch, from sticks", ("--kind", "branch"), faults="pol")


def _short_sticks():
    for name, title, overhang in (
            ("below", "sticks end 20 m under the higher cutoff", "-20,150"),
            ("above", "sticks end 20 m over the lower cutoff", "150,-20"),
            ("both", "sticks end 20 m inside both cutoffs", "-20,-20"),
            ("wholly-above", "sticks end 20 m over the horizon", "250,-120"),
            ("wholly-below", "sticks begin 20 m under the horizon", "-120,250")):
        yield Case("sticks", f"sticks-{name}", f"normal, {title}", ("--kind", "normal", "--overhang", overhang), faults="pol",
                   judged_by=("--overhang", "150"))
    yield Case("sticks", "sticks-tip", "tip, from sticks", ("--kind", "tip"), faults="pol")


def _meshes():
    for kind in ("normal", "tip"):
        for edge in (15, 400):
            yield Case("fault mesh", f"mesh-{edge}-{kind}", f"{kind}, fault mesh of {edge} m", ("--kind", kind, "--fault-mesh-size", str(edge)))
    for edge in (15, 100, 300):
        yield Case("fault mesh", f"wavy-{edge}", f"normal, wavy (60 m), fault mesh of {edge} m",
                   ("--kind", "normal", "--waviness", "60", "--fault-mesh-size", str(edge)))
    yield Case("fault mesh", "wavy-reverse", "reverse, wavy (60 m), fault mesh of 50 m",
               ("--kind", "reverse", "--waviness", "60", "--fault-mesh-size", "50"))


def _interpretation():
    for shift in (10, 30):
        yield Case("interpretation", f"shift-{shift}", f"normal, fault given {shift} m off", ("--kind", "normal", "--fault-shift", str(shift)))
    yield Case("interpretation", "smear", "normal, picks within 30 m moved across the fault", ("--kind", "normal", "--smear", "30"))


def _limits(away, zone, missing, cutoffs, throw=3.0, off_fault=1.0, slivers=0.4):
    return (("surface_to_truth_far", away), ("surface_to_truth_near", zone), ("truth_to_surface_near", missing), ("cutoffs_to_border", cutoffs),
            ("throw_error", throw), ("border_to_fault_p95", nan), ("border_off_fault", off_fault), ("share_below_10_degrees", slivers))


LINES = _limits(0.25, 0.4, 0.45, 0.9)
LINES_1000 = _limits(0.4, 0.6, 0.65, 1.25)
MISTIES = _limits(1.1, 1.1, 1.3, 2.2)
SHADOW = _limits(0.16, 0.4, 0.45, 0.8, throw=2.0)
CONTOURS = _limits(1.5, 2.5, 2.5, 3.0)


def _reach(distance):
    """How far from picks the truth has to be there; not in half as wide a margin at the edge of the area, where lines end."""
    return ("--pick-reach", f"{distance:g}", "--margin", f"{0.5 * distance:g}")


def _along(distance, azimuth=0, along=12.5):
    return ("--sampling", "lines", "--line-distance", str(distance), "--azimuth", str(azimuth), "--along-line", f"{along:g}")


def _lines():
    """The faults strike 10 to 20 degrees off north: lines to the east are nearly dip lines."""
    for kind in INTERPRETED:
        yield Case("lines", f"lines-both-250-{kind}", f"{kind}, lines 250 m apart both ways", ("--kind", kind, *_along("250,250")),
                   evaluate=_reach(130), limits=LINES)
        for distance, azimuth, angle in ((250, 90, "steep"), (500, 90, "steep"), (500, 45, "30° to 55°"), (500, 0, "small")):
            yield Case("lines", f"lines-{distance}-{azimuth}-{kind}", f"{kind}, lines {distance} m apart one way, angle to the fault {angle}",
                       ("--kind", kind, *_along(distance, azimuth)), evaluate=_reach(0.52 * distance), limits=LINES)
    for kind in INTERPRETED:
        yield Case("lines 1000 m", f"lines-1000-{kind}", f"{kind}, lines 1000 m apart one way", ("--kind", kind, *_along(1000, 90)),
                   evaluate=_reach(520), limits=LINES_1000)
    for kind in INTERPRETED:
        yield Case("misties", f"misties-{kind}", f"{kind}, lines 400 and 600 m apart, off by 1.5 σ", ("--kind", kind, *_along("400,600"), "--mistie", "3"),
                   evaluate=_reach(310), limits=MISTIES)
    for kind in INTERPRETED:
        yield Case("every n-th line", f"every-4th-{kind}", f"{kind}, every 4th inline and crossline of 25 m", ("--kind", kind, *_along("100,100", along=25)),
                   evaluate=_reach(60), limits=LINES)
        yield Case("every n-th line", f"every-20th-{kind}", f"{kind}, every 20th inline and crossline of 25 m", ("--kind", kind, *_along("500,500", along=25)),
                   evaluate=_reach(260), limits=LINES)


def _shadow():
    for kind in INTERPRETED:
        for shadow in (100, 200):
            yield Case("shadow", f"shadow-{shadow}-{kind}", f"{kind}, 25 m grid, no picks within {shadow} m of the fault",
                       ("--kind", kind, "--sampling", "grid", "--line-distance", "25", "--shadow", str(shadow)), evaluate=_reach(1.3 * shadow), limits=SHADOW)
        yield Case("shadow", f"shadow-fine-{kind}", f"{kind}, 12.5 m grid, no picks within 200 m of the fault",
                   ("--kind", kind, "--size", "3000", "--relief", "60", "--sampling", "grid", "--line-distance", "12.5", "--shadow", "200"),
                   evaluate=_reach(260), limits=SHADOW)
    for kind in ("normal", "reverse"):
        yield Case("shadow", f"shadow-one-side-{kind}", f"{kind}, 25 m grid, no picks within 300 m in the hanging wall",
                   ("--kind", kind, "--sampling", "grid", "--line-distance", "25", "--shadow", "0,300"), evaluate=_reach(390), limits=SHADOW)
        yield Case("shadow", f"shadow-400-{kind}", f"{kind}, 25 m grid, no picks within 400 m of the fault",
                   ("--kind", kind, "--sampling", "grid", "--line-distance", "25", "--shadow", "400"), evaluate=_reach(520), limits=SHADOW)
        yield Case("shadow", f"shadow-lines-{kind}", f"{kind}, lines 250 m apart both ways, no picks within 200 m of the fault",
                   ("--kind", kind, *_along("250,250"), "--shadow", "200"), evaluate=_reach(260), limits=LINES_1000)


def _holes():
    discs = ("--hole", "-1700,-1500,300", "--hole", "-2000,600,200", "--hole", "1900,-1500,500")  # at no fault of any kind
    for kind in INTERPRETED:
        yield Case("holes", f"holes-{kind}", f"{kind}, 25 m grid with three holes", ("--kind", kind, "--sampling", "grid", "--line-distance", "25", *discs),
                   evaluate=_reach(30))
    for kind in INTERPRETED:
        yield Case("unpicked", f"unpicked-{kind}", f"{kind}, lines 250 m apart both ways, a fifth unpicked in stretches of 600 m",
                   ("--kind", kind, *_along("250,250"), "--unpicked", "0.2,600"), evaluate=_reach(130), limits=LINES_1000)


def _contours():
    for kind in INTERPRETED:
        yield Case("contours", f"contours-{kind}", f"{kind}, contours of 20 m, a vertex every 20 m, off by 2 m on the map",
                   ("--kind", kind, "--sampling", "contours", "--contour-interval", "20", "--along-line", "20"), evaluate=_reach(150), limits=CONTOURS)


def _steep():
    for tilt in (30, 40, 50):
        for azimuth, where in ((105, "with the fault"), (285, "against it"), (15, "along it")):
            yield Case("steep", f"steep-{tilt}-{azimuth}", f"tip, horizon dips {tilt}° {where}, picks 43 m apart",
                       ("--kind", "tip", "--tilt", f"{tilt},{azimuth}", *_along("43", along=43)),
                       limits=_limits(0.25, 0.4, 0.45, 0.9, throw=nan, off_fault=1.5, slivers=0.5))


def _digitised():
    # Triangles at the given fault cross the true one where the two lie a little apart.
    limits = (("bridging_triangles", nan), ("surface_to_truth_near", 0.4), ("truth_to_surface_near", 0.45), ("cutoffs_to_border", 2.0),
              ("throw_error", 2.0), ("border_to_fault_p95", 0.25), ("border_off_fault", nan))
    for kind in INTERPRETED:
        yield Case("digitised", f"digitised-{kind}", f"{kind}, sticks every 12.5 m, nodes off by 15 m",
                   ("--kind", kind, "--stick-spacing", "12.5", "--stick-jitter", "15"), faults="pol", judged_by=("--stick-jitter", "0"), limits=limits)
    for kind in ("normal", "tip", "branch"):
        yield Case("digitised", f"digitised-lines-{kind}", f"{kind}, lines 250 m apart, on each a stick whose nodes are off by 10 m",
                   ("--kind", kind, *_along("250", 90), "--stick-spacing", "250", "--stick-jitter", "10"), faults="pol", judged_by=("--stick-jitter", "0"),
                   evaluate=_reach(130), limits=limits)


def all_cases():
    """Every row in the order of the table."""
    makers = (_kinds, _throw, _noise, _density, _dip, _near, _short_sticks, _meshes, _interpretation, _lines, _shadow, _holes, _contours, _steep,
              _digitised)
    return [case for maker in makers for case in maker()]


def chosen(names):
    """The rows of these names or groups; all if there are none. Ends the program at a name that is neither."""
    cases = all_cases()
    if not names:
        return cases
    known = {case.name for case in cases} | {case.group for case in cases}
    unknown = sorted(set(names) - known)
    if unknown:
        raise SystemExit(f"there is no case or group {', '.join(unknown)}; --list shows all")
    return [case for case in cases if case.name in names or case.group in names]
