"""The synthetic cases: what graben_synthesize is asked for, and what differs from it in the other two commands."""

from dataclasses import dataclass
from math import sqrt

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


def all_cases():
    """Every row in the order of the table."""
    makers = (_kinds, _throw, _noise, _density, _dip, _near, _short_sticks, _meshes, _interpretation)
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
