"""The command graben_ensemble."""

import argparse
import inspect
import sys
from typing import Any, List, Optional

from .data import version
from .ensembles import Ensemble, ensemble
from .errors import Error, FileError
from .horizon import reconstruct
from .models import model

_FEWEST = 2
# Arguments of reconstruct that are not options of each realization.
_NOT_PASSED_ON = {"picks", "faults", "progress", "realizations", "deviation", "keep_picks", "threads"}


def _number_or_word(text: str) -> Any:
    try:
        return float(text) if any(c in text for c in ".eE") else int(text)
    except ValueError:
        return text


def _of_reconstruct() -> List[str]:
    return [name for name in inspect.signature(reconstruct).parameters if name not in _NOT_PASSED_ON]


def _of_model() -> List[str]:
    return [name for name in inspect.signature(model).parameters if name not in {"horizons", "options", *_NOT_PASSED_ON, *_of_reconstruct()}]


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="graben_ensemble", description="Makes a horizon, or a stack of horizons with the blocks between them, many times "
                                     "from picks and faults perturbed as interpretations err: P10, P50 and P90 of the throw along each fault, heights and "
                                     "their deviation on a map, the probability that a block exists.",
                                     epilog="Example: graben_ensemble --horizon top.xyz --fault F1.pol --realizations 200 --fault-sigma 20 --results "
                                     "ensemble/. The options of graben_reconstruct hold for every realization.")
    add = parser.add_argument
    add("--version", action="version", version=f"graben_ensemble {version}")
    add("--horizon", nargs="+", required=True, metavar="PICKS", help="picks of the horizon; or NAME=PICKS of several, top to bottom, for a model")
    add("--fault", nargs="+", action="extend", default=[], metavar="FILE", help="faults that cut it")
    add("--results", required=True, metavar="DIR", help="folder for the tables and maps")
    add("--realizations", type=int, default=200, metavar="N", help="how many (200)")
    add("--pick-sigma", type=float, metavar="D", help="standard deviation of the picks' error, z units (default: the noise measured on them)")
    add("--pick-range", type=float, metavar="D", help="how far errors of picks go together (default: along lines their distance, else not at all)")
    add("--fault-sigma", type=float, default=0.0, metavar="D", help="standard deviation of the distance a fault lies off, x, y units (0: faults stay)")
    add("--fault-range", type=float, metavar="D", help="how far that goes together (default: a third of the fault's extent)")
    add("--misties", type=float, default=0.0, metavar="D", help="standard deviation of a constant for each line, z units (0)")
    add("--map-spacing", type=float, metavar="D", help="between the nodes of the maps (default: two voxels)")
    add("--seed", type=int, default=1, metavar="N", help="of the random numbers (1)")
    add("--workers", type=int, metavar="N", help="processes of this machine; the result is the same for every number (default: one per processor)")
    add("--scheduler", metavar="ADDRESS", help="of a Dask cluster to work on instead")
    add("--quiet", action="store_true", help="say nothing but errors")
    for title, names in (("options of graben_reconstruct", _of_reconstruct()), ("further options of graben_model, for several horizons", _of_model())):
        group = parser.add_argument_group(title)
        for name in names:
            option = "--" + name.replace("_", "-")
            if name == "units_as_given":
                group.add_argument(option, action="store_true")
            else:
                group.add_argument(option, nargs="+" if name in ("dips", "null", "skip") else None, type=str if name == "dips" else _number_or_word)
    return parser


def _picks(horizons: List[str]) -> Any:
    if len(horizons) == 1 and "=" not in horizons[0]:
        return horizons[0]
    if not all("=" in one for one in horizons):
        raise ValueError("option --horizon: several horizons need names, NAME=PICKS")
    return [tuple(one.split("=", 1)) for one in horizons]


def _options(given: argparse.Namespace) -> dict:
    options = {name: getattr(given, name) for name in _of_reconstruct() + _of_model() if getattr(given, name) not in (None, False)}
    several = any("=" in one for one in given.horizon)
    for name in options:
        if name in _of_model() and not several:
            raise ValueError(f"option --{name.replace('_', '-')}: only for several horizons, NAME=PICKS")
    if "columns" in options:
        options["columns"] = tuple(str(options["columns"]).split(","))
    return options


def _say(made: Ensemble) -> None:
    print(f"realizations {made.n}, of which {len(made.failed)} failed")
    for error, name in zip(made.errors, made.maps):
        print(f"{name:12} error of the picks {error.pick_sigma:.4g} over {error.pick_range:.4g}, of the faults {error.fault_sigma:.4g}, "
              f"misties {error.misties:.4g}")
    for fault, rows in made.throws.items():
        largest = abs(rows["p50"]).argmax() if len(rows) else None
        if largest is not None:
            print(f"{fault:12} largest throw {rows['p50'][largest]:.4g} (P10 {rows['p10'][largest]:.4g}, P90 {rows['p90'][largest]:.4g})")
    for block, probability in made.blocks.items():
        print(f"{block:24} exists in {100.0 * probability:.0f} %, volume {made.volumes[block][0]:.4g} +- {made.volumes[block][1]:.2g}")


def _progress(stage: str, fraction: float) -> None:
    if stage == "realizations":
        sys.stderr.write(f"\rrealizations {100.0 * fraction:3.0f} %" + ("\n" if fraction >= 1.0 else ""))


def main(arguments: Optional[List[str]] = None) -> int:
    given = _parser().parse_args(arguments)
    try:
        if given.realizations < _FEWEST:
            raise ValueError(f"option --realizations: {_FEWEST} or more were expected, not {given.realizations}")
        made = ensemble(_picks(given.horizon), given.fault, n=given.realizations, pick_sigma=given.pick_sigma, pick_range=given.pick_range,
                        fault_sigma=given.fault_sigma, fault_range=given.fault_range, misties=given.misties, seed=given.seed, client=given.scheduler,
                        workers=given.workers, map_spacing=given.map_spacing, progress=_progress if sys.stderr.isatty() and not given.quiet else None,
                        **_options(given))
        made.write(given.results)
    except (Error, ValueError, OSError, ImportError) as error:
        print(f"graben_ensemble: error: {' '.join(str(error).split())}", file=sys.stderr)
        return 2 if isinstance(error, ValueError) and not isinstance(error, Error) else 1
    except KeyboardInterrupt:
        print("graben_ensemble: interrupted; nothing was written", file=sys.stderr)
        return 130
    for number, reason in made.failed[:10]:
        print(f"warning: realization {number} failed: {reason}", file=sys.stderr)
    if len(made.failed) == made.n:
        print("graben_ensemble: error: every realization failed; see failed.csv", file=sys.stderr)
        return 1
    if not given.quiet:
        _say(made)
    return 0


if __name__ == "__main__":
    sys.exit(main())
