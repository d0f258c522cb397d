"""What is wrong is told by argument, shape, file and row."""

import pickle

import numpy as np
import pytest

import graben

GOOD = np.random.default_rng(1).uniform(0.0, 100.0, (200, 3)) * (1.0, 1.0, 0.01)


@pytest.mark.parametrize("picks, message", [
    (np.zeros((5, 2)), r"picks: an array of shape \(n, 3\).* was expected, but its shape is \(5, 2\)"),
    (np.zeros((3, 500)), r"picks: .*its shape is \(3, 500\); transpose it"),
    (np.zeros(30), r"picks: .*its shape is \(30,\)"),
    (np.empty((0, 3)), r"picks: .*n >= 1.*its shape is \(0, 3\)"),
    (np.array([["a", "b", "c"]]), r"picks: .*its dtype is <U1"),
    (np.zeros((5, 3), complex), r"picks: .*its dtype is complex128"),
    ([[1, 2, 3], [1, 2]], r"picks: .*(no array|its dtype is object)"),
    (None, r"picks: .*its dtype is object"),
])
def test_picks_of_wrong_shape_or_type(picks, message):
    with pytest.raises(ValueError, match=message):
        graben.reconstruct(picks)


def test_nan_is_refused_with_its_row():
    picks = GOOD.copy()
    picks[[17, 40], [2, 0]] = np.nan, np.inf
    with pytest.raises(ValueError, match=r"picks: .*2 of 200 rows hold NaN or infinity, row 17 first; leave them out with picks\[numpy.isfinite"):
        graben.reconstruct(picks)


@pytest.mark.parametrize("faults, message", [
    (np.zeros((5, 3)), r"faults: a list of faults was expected.*not ndarray"),
    ([42], r"faults\[0\]: .*not int; a fault is a path"),
    ([(np.zeros((3, 2)), np.array([[0, 1, 2]]))], r"faults\[0\]\[0\], the vertices: .*its shape is \(3, 2\)"),
    ([(np.zeros((3, 3)), np.array([[0, 1, 3]]))], r"triangles: indices from 0 to 2 were expected.*but one is 3"),
    ([(np.zeros((3, 3)), np.array([[0, 1]]))], r"triangles: .*\(m, 3\).*its dtype is int64, its shape is \(1, 2\)"),
    ([[np.full((4, 3), np.nan), np.ones((4, 3))]], r"stick 0: .*NaN"),
])
def test_faults(faults, message):
    with pytest.raises(ValueError, match=message):
        graben.reconstruct(GOOD, faults)


@pytest.mark.parametrize("options, message", [
    ({"voxel_size": -3}, r"voxel_size: .*-3"),
    ({"voxel_size": "wide"}, r"voxel_size: .*wide"),
    ({"voxel_size": [1, 2]}, r"voxel_size"),
    ({"fit": "best"}, r"fit: .*best.*full"),
    ({"neighbors": 2}, r"neighbors: .*2"),
    ({"skip": ["everything"]}, r"skip: .*everything"),
    ({"z_positive": "sideways"}, r"z_positive: .*sideways"),
    ({"voxel_size": object()}, r"voxel_size: a number or a word was expected"),
])
def test_options_are_told_by_their_names(options, message):
    with pytest.raises(ValueError, match=message) as raised:
        graben.reconstruct(GOOD, **options)
    assert "--" not in str(raised.value)


def test_unknown_option():
    with pytest.raises(TypeError, match="voxelsize"):
        graben.reconstruct(GOOD, voxelsize=3)


def test_a_row_that_cannot_be_read(tmp_path):
    path = tmp_path / "picks.xyz"
    path.write_text("1 2 3\n4 5 6\n7 8 x9\n10 11 12\n")
    with pytest.raises(graben.FileError, match="x9|row|line|3") as raised:
        graben.reconstruct(path)
    assert raised.value.file == str(path) and raised.value.row == 3
    assert isinstance(raised.value, graben.Error) and isinstance(raised.value, OSError)


def test_a_file_that_is_not_there(tmp_path):
    for read in (graben.read_picks, graben.read_faults, graben.read_mesh):
        with pytest.raises(graben.FileError, match="nothing.ts") as raised:
            read(tmp_path / "nothing.ts")
        assert raised.value.file == str(tmp_path / "nothing.ts") and raised.value.row is None


def test_picks_that_make_no_surface():
    line = np.column_stack((np.arange(50.0), np.zeros(50), np.zeros(50)))
    with pytest.raises(graben.InvalidInputError, match="line"):
        graben.reconstruct(line)
    with pytest.raises(ValueError):
        graben.reconstruct(line[:2])


def test_too_little_memory():
    with pytest.raises(graben.ResourceError):
        graben.reconstruct(GOOD, memory_limit=1e-6)
    with pytest.raises(MemoryError):
        graben.reconstruct(GOOD, memory_limit=1e-6)


def test_errors_are_pickled():
    error = pickle.loads(pickle.dumps(graben.FileError("picks.xyz:3: no number", "picks.xyz", 3)))
    assert (type(error), str(error), error.file, error.row) == (graben.FileError, "picks.xyz:3: no number", "picks.xyz", 3)


def test_nothing_is_left_of_a_file_that_cannot_be_written(tmp_path):
    mesh = graben.Mesh(np.eye(3), np.array([[0, 1, 2]]))
    with pytest.raises(graben.FileError, match="no/such"):
        mesh.write(tmp_path / "no" / "such" / "mesh.ply")
    with pytest.raises(graben.InvalidInputError, match=r"\.ply"):
        mesh.write(tmp_path / "mesh.xyz")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("fields, message", [({"depth": np.zeros(2)}, r"fields\['depth'\]: .*\(3,\).*\(2,\)"),
                                             ({"depth": np.array(["a", "b", "c"])}, r"fields\['depth'\]: .*dtype")])
def test_fields_of_a_mesh(fields, message):
    with pytest.raises(ValueError, match=message):
        graben.Mesh(np.eye(3), np.array([[0, 1, 2]]), fields=fields)
