"""reconstruct gives the bits of the command, for files and for arrays, and numpy arrays as described."""

import json
import os
import pickle

import numpy as np
import pytest

import graben
from conftest import command


def assert_same_mesh(a, b):
    for one, other in ((a.vertices, b.vertices), (a.triangles, b.triangles), (a.normals, b.normals), (a.pieces, b.pieces)):
        assert one.dtype == other.dtype
        np.testing.assert_array_equal(one, other)
    assert a.fields.keys() == b.fields.keys()
    for name in a.fields:
        np.testing.assert_array_equal(a.fields[name], b.fields[name])


def without_timings(report):
    return {key: value for key, value in report.items() if key != "stages"}


@pytest.fixture(scope="module")
def horizon(normal):
    return graben.reconstruct(normal.picks, normal.faults)


@pytest.mark.parametrize("options, words", [({}, []),
                                            ({"voxel_size": 90.5, "fit": "normal", "threads": 1}, ["--voxel-size", "90.5", "--fit", "normal"]),
                                            ({"skip": ["shadows", "trim"], "extend_faults": "off"}, ["--skip", "shadows", "trim", "--extend-faults", "off"])])
def test_bits_of_the_command(normal, tmp_path, options, words):
    command("graben_reconstruct", "--horizon", normal.picks, "--fault", *normal.faults, "--output", tmp_path / "command.ply", "--report",
            tmp_path / "report.json", "--quiet", *words)
    made = graben.reconstruct(normal.picks, normal.faults, **options)
    made.write(tmp_path / "python.ply")
    assert (tmp_path / "python.ply").read_bytes() == (tmp_path / "command.ply").read_bytes()
    assert without_timings(made.report) == without_timings(json.loads((tmp_path / "report.json").read_text()))


def test_sticks_in_depth(tip_in_depth, tmp_path):
    command("graben_reconstruct", "--horizon", tip_in_depth.picks, "--fault", *tip_in_depth.sticks, "--z-positive", "down", "--output",
            tmp_path / "command.ply", "--report", tmp_path / "report.json", "--quiet")
    picks = np.loadtxt(tip_in_depth.picks)
    faults = [fault.sticks for path in tip_in_depth.sticks for fault in graben.read_faults(path)]
    made = graben.reconstruct(picks, faults, z_positive="down")
    made.write(tmp_path / "python.ply")
    assert made.z_positive == "down"
    assert (tmp_path / "python.ply").read_bytes() == (tmp_path / "command.ply").read_bytes()


def test_arrays_give_what_files_give(normal, horizon):
    picks = graben.read_picks(normal.picks)
    read = [fault for path in normal.faults for fault in graben.read_faults(path)]
    by_arrays = graben.reconstruct(picks.points, {fault.name: (fault.mesh.vertices, fault.mesh.triangles) for fault in read})
    assert_same_mesh(by_arrays, horizon)
    assert list(by_arrays.throws) == list(horizon.throws)


def test_other_layouts_are_converted(normal, horizon):
    picks = graben.read_picks(normal.picks).points
    assert_same_mesh(graben.reconstruct(np.asfortranarray(picks), normal.faults), horizon)
    padded = np.zeros((len(picks), 5))
    padded[:, 1:4] = picks
    assert_same_mesh(graben.reconstruct(padded[:, 1:4], normal.faults), horizon)
    assert_same_mesh(graben.reconstruct(picks.tolist(), normal.faults), horizon)


def test_what_a_horizon_holds(horizon):
    n = len(horizon)
    assert horizon.vertices.shape == (n, 3) and horizon.vertices.dtype == np.float64
    assert horizon.triangles.shape[1] == 3 and horizon.triangles.dtype == np.int32 and horizon.triangles.max() == n - 1
    assert horizon.normals.shape == (n, 3) and np.allclose(np.linalg.norm(horizon.normals, axis=1), 1.0)
    assert horizon.pieces.shape == (n,) and set(horizon.pieces) == {0, 1}
    assert {"pick_distance", "extrapolated", "residual", "height_sd"} <= set(horizon.fields)
    assert all(values.shape == (n,) and values.dtype == np.float32 for values in horizon.fields.values())
    assert horizon.vertex_faults.shape == (n, 2)
    np.testing.assert_array_equal(np.asarray(horizon), horizon.vertices)
    assert not horizon.vertices.flags.owndata, "handed over, not copied"


def test_throws_and_cutoffs(horizon):
    (name, throws), = horizon.throws.items()
    assert throws.dtype == graben.THROW_TYPE
    good = throws[throws["mark"] == 0]
    np.testing.assert_allclose(good["throw"], good["z"] - good["hanging_wall_z"], rtol=1e-12, atol=1e-9)
    assert 50.0 < good["throw"].mean() < 110.0
    profile = horizon.profiles[name]
    assert profile.dtype == graben.PROFILE_TYPE and np.all(np.diff(profile["along"]) > 0.0)
    assert {cutoff.side for cutoff in horizon.cutoffs} == {"footwall", "hanging wall"}
    for cutoff in horizon.cutoffs:
        np.testing.assert_array_equal(cutoff.points, horizon.vertices[cutoff.vertices])
        assert cutoff.fault == name and set(horizon.pieces[cutoff.vertices]) == {cutoff.piece}
    (polygon,) = horizon.polygons
    assert polygon.kind == "gap" and polygon.area == pytest.approx(horizon.report["faults"][0]["gap_area"])


def test_picks_are_kept_on_demand(normal, horizon):
    assert horizon.picks is None
    kept = graben.reconstruct(normal.picks, normal.faults, keep_picks=True, deviation=False)
    assert "height_sd" not in kept.fields
    np.testing.assert_allclose(kept.picks["points"], graben.read_picks(normal.picks).points, rtol=1e-15)
    assert kept.picks["residual"].std() == pytest.approx(2.0, abs=0.3)
    assert kept.picks["reason"].max() < len(graben.REASONS)
    np.testing.assert_array_equal(kept.vertices, horizon.vertices)


def test_dips(normal, horizon):
    middle = horizon.vertices[len(horizon) // 2]
    dipping = graben.reconstruct(normal.picks, normal.faults, dips=np.array([[*middle, 5.0, 90.0]]))
    assert dipping.report["dip_measurements"]["count"] == 1
    assert not np.array_equal(dipping.vertices, horizon.vertices)


def test_realizations(normal):
    made = graben.reconstruct(normal.picks, normal.faults, realizations=4, voxel_size=150.0)
    (profile,) = made.profiles.values()
    known = np.isfinite(profile["realized_low"])
    assert known.any() and np.all(profile["realized_low"][known] <= profile["realized_high"][known])
    with pytest.raises(ValueError, match="realizations: 0, or 4 to 1000"):
        graben.reconstruct(normal.picks, normal.faults, realizations=3)


def test_extent(normal, horizon, tmp_path):
    middle = horizon.vertices.mean(axis=0)[:2]
    ring = middle + 800.0 * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    inside = graben.reconstruct(normal.picks, normal.faults, extent=[ring])
    assert inside.report["extent"]["kind"] == "polygon" and np.abs(inside.vertices[:, :2] - middle).max() < 1000.0
    rows = [f"{x:.17g} {y:.17g} 0" for x, y in np.concatenate((ring, ring[:1]))] + ["999 999 999"]
    (tmp_path / "area.pol").write_text("\n".join(rows) + "\n")
    assert_same_mesh(graben.reconstruct(normal.picks, normal.faults, extent=tmp_path / "area.pol"), inside)
    hull = graben.reconstruct(normal.picks, normal.faults, extent="hull", fill_holes="all")
    assert hull.report["extent"]["kind"] == "hull"
    with pytest.raises(ValueError, match=r"extent\[0\]: .*n >= 3.*\(2, 2\)"):
        graben.reconstruct(normal.picks, extent=[ring[:2]])


def test_pickled_and_back(horizon):
    again = pickle.loads(pickle.dumps(horizon))
    assert_same_mesh(again, horizon)
    assert again.report == horizon.report and again.z_positive == horizon.z_positive
    for name, throws in horizon.throws.items():
        np.testing.assert_array_equal(again.throws[name], throws)
    assert [c.side for c in again.cutoffs] == [c.side for c in horizon.cutoffs]


@pytest.mark.parametrize("extension", [".ply", ".vtk", ".vtp", ".obj", ".ts"])
def test_written_and_read(horizon, tmp_path, extension):
    path = tmp_path / f"horizon{extension}"
    horizon.write(path)
    again = graben.read_mesh(path)
    np.testing.assert_array_equal(again.vertices, horizon.vertices)
    np.testing.assert_array_equal(again.triangles, horizon.triangles)


def test_memory_outlives_the_horizon(normal):
    vertices = graben.reconstruct(normal.picks, normal.faults, voxel_size=150.0).vertices
    total = vertices.sum()
    np.ones(vertices.shape)
    assert vertices.sum() == total
    vertices += 1.0  # the caller's own


def test_every_option_of_the_command_is_an_argument():
    told = command("graben_reconstruct", "--help")
    import inspect
    import re

    of_files = {"horizon", "fault", "output", "results", "report", "config", "help", "version", "quiet", "gocad_properties", "pictures", "picture_formats",
                "picture_format", "xy_unit", "z_unit", "require", "hold_out"}
    options = {name.replace("-", "_") for name in re.findall(r"^\s+--([a-z-]+)", told, re.MULTILINE)} - of_files
    assert len(options) > 20
    assert options - set(inspect.signature(graben.reconstruct).parameters) == set()
