"""Reading, sampling, evaluate, and the steps as PCL classes."""

import json

import numpy as np
import pytest

import graben
from conftest import command


def test_read_picks(normal, tip_in_depth):
    picks = graben.read_picks(normal.picks)
    np.testing.assert_array_equal(picks.points, np.loadtxt(normal.picks))
    assert len(picks) == 6000 and picks.source == normal.picks
    np.testing.assert_array_equal(np.asarray(picks), picks.points)
    swapped = graben.read_picks(normal.picks, columns=(2, 1, 3))
    np.testing.assert_array_equal(swapped.points, picks.points[:, [1, 0, 2]])


def test_null_values(tmp_path):
    path = tmp_path / "picks.xyz"
    path.write_text("".join(f"{i} {i % 7} {-77 if i == 5 else 100 + i}\n" for i in range(50)))
    assert len(graben.read_picks(path)) == 50
    assert len(graben.read_picks(path, null=[-77])) == 49


def test_read_faults(normal):
    (mesh,) = graben.read_faults(normal.faults[0])
    assert mesh.mesh is not None and mesh.sticks is None and len(mesh.mesh.triangles) > 10
    (sticks,) = graben.read_faults(normal.sticks[0])
    assert sticks.mesh is None and all(stick.shape[1] == 3 for stick in sticks.sticks)
    assert repr(sticks).startswith("<graben.Fault ")


def test_sampling(normal, lines):
    dense = graben.sampling(normal.picks)
    assert dense.sigma == pytest.approx(2.0, rel=0.15) and not dense.along_lines
    assert dense.mean_distance == pytest.approx(np.sqrt(36e6 / 6000), rel=0.15)
    along = graben.sampling(lines.picks)
    assert along.along_lines and along.line_distance == pytest.approx(300.0, rel=0.2) and along.along == pytest.approx(50.0, rel=0.2)


def test_evaluate_is_the_command(normal, tmp_path):
    horizon = graben.reconstruct(normal.picks, normal.faults)
    horizon.write(tmp_path / "horizon.ply")
    truth, = [str(path) for path in normal.folder.glob("truth*.ply")]
    lines = sorted(map(str, normal.folder.glob("cutoff*.pol")))
    command("graben_evaluate", tmp_path / "horizon.ply", "--picks", normal.picks, "--fault", *normal.faults, "--truth", truth, "--cutoffs", *lines, "--sigma",
            2, "--report", tmp_path / "evaluation.json", "--quiet")
    told = json.loads((tmp_path / "evaluation.json").read_text())
    measured = graben.evaluate(tmp_path / "horizon.ply", picks=normal.picks, faults=normal.faults, truth=truth, cutoffs=lines, sigma=2)
    for key in told.keys() - {"mesh", "picks", "files", "cutoff_lines"}:
        assert measured[key] == told[key], key
    arrays = graben.evaluate((horizon.vertices, horizon.triangles), picks=graben.read_picks(normal.picks).points)
    assert arrays["approximation_error"]["all_picks"]["count"] == 6000
    assert "truth" not in arrays


def test_the_steps_make_a_faulted_surface(normal):
    picks = graben.read_picks(normal.picks).points
    normals, curvature = graben.normals(picks, normal.faults)
    assert normals.shape == picks.shape and curvature.shape == (len(picks),)
    found = np.isfinite(normals).all(axis=1)
    assert found.mean() > 0.99
    np.testing.assert_allclose(np.linalg.norm(normals[found], axis=1), 1.0, rtol=1e-5)
    assert (normals[found, 2] > 0.5).all()
    surface = graben.marching_cubes(picks, normals, normal.faults, voxel_size=100.0)
    fitted = graben.fit(surface, picks, normals, normal.faults)
    assert len(fitted.vertices) == len(surface.vertices)
    moved = np.linalg.norm(fitted.vertices - surface.vertices, axis=1)
    assert 0.0 < moved.max() < 100.0
    np.testing.assert_allclose(graben.fit(surface, picks, normals, normal.faults, fit="off").vertices, surface.vertices, rtol=0.0, atol=1e-3)
    assert graben.evaluate(fitted, faults=normal.faults)["bridging_triangles"] == 0


def test_a_mesh_is_cut(normal):
    whole = graben.reconstruct(normal.picks)
    parted = graben.cut(whole, normal.faults)
    assert whole.vertices.shape != parted.vertices.shape
    topology = graben.evaluate(parted)["topology"]
    assert topology["pieces"] >= 2 and topology["non_manifold_edges"] == 0


def test_steps_say_what_is_wrong(normal):
    with pytest.raises(ValueError, match=r"normals: .*\(6000, 3\).*\(2, 3\)"):
        graben.marching_cubes(normal.picks, np.zeros((2, 3)))
    with pytest.raises(ValueError, match="orientation: 'mst' or 'up'"):
        graben.normals(normal.picks, orientation="down")
    with pytest.raises(graben.InvalidInputError):
        graben.marching_cubes(np.eye(3), np.zeros((3, 3)))
