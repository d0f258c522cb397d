"""to_pyvista and to_xtgeo, against stand-ins that take what the documentation of the two libraries says their constructors take; and the notebook's view."""

import base64
import re
import sys
import types

import numpy as np
import pytest

import graben
from graben.raster import Grid, heights


class PolyData:
    """pyvista.PolyData(points, faces): (n, 3) points, faces a padded connectivity array [3, a, b, c, 3, ...]."""

    def __init__(self, var_inp=None, faces=None):
        self.points = np.asarray(var_inp)
        assert self.points.ndim == 2 and self.points.shape[1] == 3
        assert faces.ndim == 1 and faces.dtype.kind == "i"
        padded = faces.reshape(-1, 4)
        assert (padded[:, 0] == 3).all() and padded[:, 1:].max() < len(self.points)
        self.regular_faces = padded[:, 1:]
        self.point_data = {}


class RegularSurface:
    """xtgeo.RegularSurface(ncol, nrow, xinc, yinc, xori, yori, yflip, rotation, values, ..., name): values (ncol, nrow), masked where undefined."""

    def __init__(self, ncol, nrow, xinc, yinc, xori=0.0, yori=0.0, yflip=1, rotation=0.0, values=None, ilines=None, xlines=None, masked=True, name="unknown"):
        assert values.shape == (ncol, nrow) and np.ma.isMaskedArray(values) and values.dtype == np.float64
        assert xinc > 0 and yinc > 0 and yflip in (-1, 1)
        self.ncol, self.nrow, self.xinc, self.yinc, self.xori, self.yori, self.values, self.name = ncol, nrow, xinc, yinc, xori, yori, values, name


@pytest.fixture
def libraries(monkeypatch):
    monkeypatch.setitem(sys.modules, "pyvista", types.SimpleNamespace(PolyData=PolyData))
    monkeypatch.setitem(sys.modules, "xtgeo", types.SimpleNamespace(RegularSurface=RegularSurface))


@pytest.fixture(scope="module")
def horizon(tip_in_depth):
    return graben.reconstruct(tip_in_depth.picks, tip_in_depth.faults, z_positive="down")


def test_pyvista(libraries, horizon):
    data = horizon.to_pyvista()
    np.testing.assert_array_equal(data.points, horizon.vertices)
    np.testing.assert_array_equal(data.regular_faces, horizon.triangles)
    assert set(data.point_data) == {"Normals", "piece", *horizon.fields}
    again = graben.evaluate(data)  # an object with points and regular_faces is a mesh
    assert again["topology"]["triangles"] == len(horizon.triangles)


def test_xtgeo(libraries, horizon):
    surface = horizon.to_xtgeo(spacing=50.0)
    assert surface.xinc == surface.yinc == 50.0 and surface.name == "horizon"
    x = surface.xori + surface.xinc * np.arange(surface.ncol)
    near = np.abs(horizon.vertices[:, 0][:, None] - x).min(axis=1) < 25.0
    assert near.any()
    known = ~np.ma.getmaskarray(surface.values)
    assert 0.8 < known.mean() < 1.0
    assert horizon.vertices[:, 2].min() <= surface.values.min() and surface.values.max() <= horizon.vertices[:, 2].max()
    with pytest.raises(ValueError, match="spacing"):
        horizon.to_xtgeo(spacing=-1.0)


def test_without_the_libraries(monkeypatch, horizon):
    for name, method in (("pyvista", horizon.to_pyvista), ("xtgeo", horizon.to_xtgeo)):
        monkeypatch.setitem(sys.modules, name, None)
        with pytest.raises(ImportError, match=f"to_{name} needs {name}"):
            method()


def test_heights_are_those_of_the_triangle_there():
    random = np.random.default_rng(3)
    x, y = np.meshgrid(np.arange(0.0, 11.0), np.arange(0.0, 8.0), indexing="ij")
    x[1:-1, 1:-1] += random.uniform(-0.3, 0.3, (9, 6))
    vertices = np.column_stack((x.ravel(), y.ravel(), random.normal(0.0, 10.0, x.size)))
    corner = (np.arange(10)[:, None] * 8 + np.arange(7)).ravel()
    triangles = np.concatenate((np.column_stack((corner, corner + 8, corner + 9)), np.column_stack((corner, corner + 9, corner + 1))))
    grid = Grid(-0.25, 0.0, 0.25, 43, 29)
    z = heights(graben.Mesh(vertices, triangles), grid)
    for column in range(grid.columns):
        for row in range(grid.rows):
            place = np.array([grid.x0 + grid.spacing * column, grid.y0 + grid.spacing * row, 1.0])
            there = [vertices[t, 2] @ w for t in triangles for w in [np.linalg.solve(np.vstack((vertices[t, :2].T, np.ones(3))), place)] if w.min() > -1e-9]
            assert (z[column, row] == pytest.approx(max(there), abs=1e-7)) if there else np.isnan(z[column, row])


def test_the_upper_sheet_counts():
    square = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    vertices = np.concatenate((np.column_stack((square, np.full(4, 1.0))), np.column_stack((square, np.full(4, 7.0)))))
    triangles = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
    grid = Grid(0.0, 0.0, 1.0, 3, 3)
    assert (heights(graben.Mesh(vertices, triangles, z_positive="up"), grid) == 7.0).all()
    assert (heights(graben.Mesh(vertices, triangles, z_positive="down"), grid) == 1.0).all()


def test_view_in_a_notebook(horizon):
    page = horizon._repr_html_()
    picture = base64.b64decode(re.search(r"data:image/png;base64,([^']+)'", page).group(1))
    assert picture.startswith(b"\x89PNG") and len(picture) > 10000
    assert "6,000" in page and f"{len(horizon.triangles):,}" in page and "down" in page
    assert all(name in page for name in horizon.throws)
    assert horizon._repr_html_() == page


def test_names_are_no_markup(horizon):
    import copy

    odd = copy.copy(horizon)
    odd.warnings = ["a < b & c"]
    assert "a &lt; b &amp; c" in odd._repr_html_()


def test_pictures(horizon, tmp_path):
    horizon.picture(tmp_path / "heights.png")
    horizon.picture(tmp_path / "field.png", "height_sd", width=600, height=500)
    heights_png, field_png = ((tmp_path / f"{name}.png").read_bytes() for name in ("heights", "field"))
    assert heights_png.startswith(b"\x89PNG") and field_png.startswith(b"\x89PNG") and heights_png != field_png
    assert int.from_bytes(field_png[16:20], "big") == 600 and int.from_bytes(field_png[20:24], "big") == 500
    with pytest.raises(ValueError, match="field: one of .*height_sd.* was expected, not 'colour'"):
        horizon.picture(tmp_path / "none.png", "colour")
