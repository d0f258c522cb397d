"""Ensembles: the same for any number of workers, nothing lost with a worker, truth inside the band."""

import os
import signal
import threading
import time

import numpy as np
import pytest

import graben
from graben import workers
from graben.perturb import Errors, find_lines, perturbed_faults, perturbed_picks, smooth_field
from graben.reduction import Moments, Quantiles

N = 8


def assert_same(a, b):
    assert a.failed == b.failed and a.blocks == b.blocks and a.volumes == b.volumes
    assert a.throws.keys() == b.throws.keys()
    for fault in a.throws:
        np.testing.assert_array_equal(a.throws[fault], b.throws[fault])
    for name in a.maps:
        for what in ("mean", "deviation", "probability"):
            np.testing.assert_array_equal(getattr(a.maps[name], what), getattr(b.maps[name], what))


@pytest.fixture(scope="module")
def options():
    return {"n": N, "voxel_size": 200.0, "fault_sigma": 15.0, "seed": 7}


@pytest.fixture(scope="module")
def alone(normal, options):
    return graben.ensemble(normal.picks, normal.faults, workers=0, **options)


def test_what_an_ensemble_says(alone):
    assert alone.n == N and alone.failed == []
    (throws,) = alone.throws.values()
    assert throws.dtype == graben.ENSEMBLE_TYPE
    inner = throws[throws["count"] == N]
    assert len(inner) > 0.7 * len(throws)
    assert (inner["p10"] < inner["p50"]).all() and (inner["p50"] < inner["p90"]).all()
    np.testing.assert_allclose(inner["mean"], inner["throw"], atol=5.0)
    (map_,) = alone.maps.values()
    sure = map_.probability == 1.0
    assert sure.mean() > 0.6 and np.nanmedian(map_.deviation[sure]) == pytest.approx(1.0, abs=0.9)
    assert ((0.0 <= map_.probability) & (map_.probability <= 1.0)).all()


@pytest.mark.parametrize("count", [1, 3])
def test_the_same_for_any_number_of_workers(normal, options, alone, count):
    assert_same(graben.ensemble(normal.picks, normal.faults, workers=count, **options), alone)


def test_another_seed_is_another_ensemble(normal, options, alone):
    other = graben.ensemble(normal.picks, normal.faults, workers=2, **{**options, "seed": 8, "n": 4})
    (a,), (b,) = alone.throws.values(), other.throws.values()
    assert not np.array_equal(a["mean"], b["mean"])


def test_a_worker_that_is_killed_loses_nothing(normal, options, alone, monkeypatch):
    started, killed = [], []
    start = workers._Process.__init__

    def remember(self, task, job):
        start(self, task, job)
        started.append(self.process)

    monkeypatch.setattr(workers._Process, "__init__", remember)

    def kill_one(stage, fraction):
        if stage == "realizations" and not killed:
            killed.append(started[0].pid)
            os.kill(started[0].pid, signal.SIGKILL)

    again = graben.ensemble(normal.picks, normal.faults, workers=2, progress=kill_one, **options)
    assert killed and len(started) == 3, "another one took its place"
    assert_same(again, alone)


def die_at_two(job, number):
    if number == 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return number * job


def test_a_task_that_kills_its_workers_is_given_up(monkeypatch):
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([os.path.dirname(__file__), os.environ.get("PYTHONPATH", "")]))
    outcomes = list(workers.on_processes(die_at_two, 10, 5, 2))
    assert [number for number, _, _ in outcomes] == [0, 1, 2, 3, 4]
    assert [result for _, result, _ in outcomes] == [0, 10, None, 30, 40]
    assert outcomes[2][2] == "3 workers ended while they were at it"


def fail_at_odd(job, number):
    if number % 2:
        raise ValueError(f"odd\n{number}")
    return number


def test_failures_are_counted_and_listed(monkeypatch):
    for outcomes in (workers.in_this_process(fail_at_odd, None, 4), workers.on_processes(fail_at_odd, None, 4, 2)):
        assert list(outcomes) == [(0, 0, None), (1, None, "ValueError: odd 1"), (2, 2, None), (3, None, "ValueError: odd 3")]


def test_workers_end_with_the_one_who_asked():
    outcomes = workers.on_processes(time_out, None, 100, 2)
    next(outcomes)
    outcomes.close()
    assert threading.active_count() < 10


def time_out(job, number):
    time.sleep(0.01)
    return number


def slow_first(job, number):
    time.sleep(3.0 if number == 0 else 0.0)
    return number


def test_results_wait_for_their_turn_in_bounded_number():
    """While the first is slow the others do not run ahead without end."""
    pool = workers._Pool(slow_first, None, 200, 2)
    outcomes = pool.outcomes()
    assert next(outcomes) == (0, 0, None)
    assert 2 < pool._next <= 2 * workers._AHEAD + 2
    assert [number for number, _, _ in outcomes] == list(range(1, 200))


def test_dask(normal, options, alone):
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            assert_same(graben.ensemble(normal.picks, normal.faults, client=client, **options), alone)
            killed = []

            def kill_one(stage, fraction):
                if stage == "realizations" and not killed:
                    killed.append(next(iter(client.run(os.getpid).values())))
                    os.kill(killed[0], signal.SIGKILL)

            assert_same(graben.ensemble(normal.picks, normal.faults, client=client, progress=kill_one, **options), alone)
            assert killed
        assert_same(graben.ensemble(normal.picks, normal.faults, client=cluster.scheduler_address, **options), alone)


def test_truth_against_the_band(normal):
    """Noise alone makes a band that is too narrow; four of five true throws should lie within 1.28 of the surface's own deviation."""
    made = graben.ensemble(normal.picks, normal.faults, n=10, workers=2)
    (throws,), (profile,) = made.throws.values(), made.base.profiles.values()
    true = true_throws(normal, profile)
    known = throws["count"] == 10
    off = np.abs(throws["throw"] - true)[known]
    assert known.sum() > 10 and off.max() < 8.0
    assert (off <= 1.2816 * throws["surface_deviation"][known]).mean() >= 0.7
    assert (off <= 4.0 * throws["deviation"][known]).mean() >= 0.8
    assert np.median(np.abs(throws["p50"] - throws["throw"])[known]) < 2.0


def true_throws(case, profile):
    """Between the true cutoffs, where they pass the two cutoffs of each row in the map."""
    lines = [line for path in sorted(case.folder.glob("cutoff*.pol")) for fault in graben.read_faults(path) for line in fault.sticks]
    assert len(lines) == 2
    footwall, hanging_wall = (np.column_stack((profile[f"{wall}x"], profile[f"{wall}y"])) for wall in ("", "hanging_wall_"))
    found = [(nearest(line, footwall), nearest(line, hanging_wall)) for line in lines]
    first = 0 if np.median(found[0][0][1]) < np.median(found[1][0][1]) else 1
    return found[first][0][0] - found[1 - first][1][0]


def nearest(line, places):
    """z of a line where it is nearest to places in the map, and how near."""
    points = np.concatenate([a + (b - a) * np.linspace(0.0, 1.0, 200)[:, None] for a, b in zip(line[:-1], line[1:])])
    distance = np.linalg.norm(points[None, :, :2] - places[:, None], axis=2)
    return points[distance.argmin(axis=1), 2], distance.min(axis=1)


def test_a_model(stack):
    files = {"Top": str(stack.folder / "horizon.xyz"), "Base": str(stack.folder / "horizon_2.xyz")}
    options = {"n": 3, "size": 500.0, "voxel_size": 200.0, "inset": 200.0}
    made = graben.ensemble(files, stack.faults, workers=2, **options)
    assert made.failed == [] and set(made.maps) == set(files)
    assert len(made.blocks) == 6 and all(probability == 1.0 for probability in made.blocks.values())
    for name, (mean, deviation) in made.volumes.items():
        assert 0.0 < deviation < 0.05 * mean
    assert_same(graben.ensemble(files, stack.faults, workers=0, **options), made)


def test_files(alone, tmp_path):
    names = alone.write(tmp_path / "results")
    assert sorted(names) == sorted(os.listdir(tmp_path / "results"))
    table = np.genfromtxt(tmp_path / "results" / [name for name in names if name.startswith("throw_1_")][0], delimiter=",", names=True)
    (throws,) = alone.throws.values()
    np.testing.assert_array_equal(table["p10"], throws["p10"])
    map_ = alone.maps["horizon"]
    lines = (tmp_path / "results" / "horizon_mean.asc").read_text().splitlines()
    assert lines[0] == f"ncols {map_.grid.columns}" and lines[1] == f"nrows {map_.grid.rows}"
    rows = np.array([line.split() for line in lines[6:]], float)  # from north to south
    np.testing.assert_allclose(np.where(rows == -9999.0, np.nan, rows), map_.mean.T[::-1], rtol=1e-5)


# What is perturbed, and how

def test_noise_of_picks():
    picks = graben.Picks(np.random.default_rng(1).uniform(0.0, 1000.0, (20000, 3)))
    errors = Errors(3.0, 0.0, 0.0, None, 0.0, 1.0, None)
    first, again, second = (perturbed_picks(picks, errors, 5, number).points for number in (0, 0, 1))
    noise = first - picks.points
    np.testing.assert_array_equal(first, again)
    assert (noise[:, :2] == 0.0).all() and noise[:, 2].std() == pytest.approx(3.0, rel=0.03)
    assert abs(np.corrcoef(noise[:, 2], (second - picks.points)[:, 2])[0, 1]) < 0.03


def test_errors_go_together_along_lines_and_not_between_them():
    x, line = np.meshgrid(np.arange(0.0, 4000.0, 25.0), np.arange(60))
    picks = graben.Picks(np.column_stack((x.ravel(), 200.0 * line.ravel(), np.zeros(x.size))))
    lines = find_lines(picks.points, 25.0)
    np.testing.assert_array_equal(lines, line.ravel())
    errors = Errors(2.0, 200.0, 0.0, None, 0.0, 1.0, lines)
    noise = np.array([perturbed_picks(picks, errors, 1, number).points[:, 2].reshape(x.shape) for number in range(20)])
    assert noise.std() == pytest.approx(2.0, rel=0.1)

    def correlation(a, b):
        return np.corrcoef(a.ravel(), b.ravel())[0, 1]

    assert correlation(noise[:, :, :-2], noise[:, :, 2:]) > 0.9  # 50 along the line
    assert abs(correlation(noise[:, :, :-40], noise[:, :, 40:])) < 0.15  # 1000 along it
    assert abs(correlation(noise[:, :-1], noise[:, 1:])) < 0.15  # the next line
    assert abs(correlation(noise[:, :-1, -1], noise[:, 1:, 0])) < 0.15  # from the end of one to the beginning of the next


def test_misties_are_constants_of_lines(lines):
    picks = graben.read_picks(lines.picks)
    labels = find_lines(picks.points, 50.0)
    moved = perturbed_picks(picks, Errors(0.0, 0.0, 0.0, None, 6.0, 1.0, labels), 1, 0)
    shift = moved.points[:, 2] - picks.points[:, 2]
    for label in np.unique(labels):
        assert np.ptp(shift[labels == label]) < 1e-9
    assert len(np.unique(labels)) > 10 and 3.0 < np.array([shift[labels == label][0] for label in np.unique(labels)]).std() < 10.0


def test_misties_of_scattered_picks_are_refused(normal):
    with pytest.raises(ValueError, match="misties: .* do not lie along lines.*lines="):
        graben.ensemble(normal.picks, normal.faults, misties=3.0, n=2)


@pytest.mark.parametrize("options, message", [({"n": 0}, "n: a whole number"), ({"pick_sigma": -1}, "pick_sigma: .*-1"),
                                              ({"fault_sigma": np.nan}, "fault_sigma: .*nan"), ({"lines": [1, 2]}, r"lines: .*\(6000,\)")])
def test_wrong_arguments(normal, options, message):
    with pytest.raises(ValueError, match=message):
        graben.ensemble(normal.picks, normal.faults, **{"n": 2, **options})


def test_faults_move_across_themselves_and_smoothly(normal):
    for path in (normal.faults[0], normal.sticks[0]):
        (fault,) = graben.read_faults(path)
        errors = Errors(0.0, 0.0, 20.0, None, 0.0, 1.0, None)
        before = fault.mesh.vertices if fault.mesh else np.concatenate(fault.sticks)
        shifts = []
        for number in range(40):
            (moved,) = perturbed_faults([fault], errors, 1, number)
            shifts.append((moved.mesh.vertices if moved.mesh else np.concatenate(moved.sticks)) - before)
        shifts = np.array(shifts)
        distance = np.linalg.norm(shifts, axis=2)
        assert np.sqrt((distance**2).mean()) == pytest.approx(20.0, rel=0.25)
        main = np.linalg.svd(shifts.reshape(-1, 3), full_matrices=False)[1]
        assert main[1] < 0.2 * main[0], "one way, across the fault"


def test_fields_have_unit_variance_and_a_range():
    places = np.random.default_rng(1).uniform(0.0, 100.0, (500, 2))
    fields = np.array([smooth_field(places, 30.0, np.random.default_rng(number)) for number in range(600)])
    assert fields.std() == pytest.approx(1.0, rel=0.05)
    distance = np.linalg.norm(places[0] - places, axis=1)
    correlation = np.array([np.corrcoef(fields[:, 0], fields[:, i])[0, 1] for i in range(500)])
    np.testing.assert_allclose(correlation, np.exp(-0.5 * (distance / 30.0) ** 2), atol=0.17)


# What is kept of them

def test_moments():
    values = np.random.default_rng(2).normal(5.0, 2.0, (50, 4))
    values[3:9, 1], values[:, 3] = np.nan, np.nan
    moments = Moments((4,))
    for row in values:
        moments.add(row)
    np.testing.assert_allclose(moments.mean[:3], np.nanmean(values[:, :3], axis=0))
    np.testing.assert_allclose(moments.deviation[:3], np.nanstd(values[:, :3], axis=0, ddof=1))
    assert list(moments.count) == [50, 44, 50, 0] and np.isnan(moments.mean[3])


@pytest.mark.parametrize("count", [5, 128, 129, 2000])
def test_quantiles(count):
    random = np.random.default_rng(count)
    values = random.normal(100.0, 5.0, (count, 3))
    values[:, 1] = random.standard_t(2, count)  # far values beyond the range of the first
    values[random.random(count) < 0.2, 2] = np.nan
    quantiles = Quantiles(3)
    for row in values:
        quantiles.add(row)
    for share in (0.1, 0.5, 0.9):
        exact = np.nanquantile(values, share, axis=0)
        tolerance = 1e-12 if count <= Quantiles.KEPT else 0.1
        np.testing.assert_allclose(quantiles.at(share)[[0, 2]], exact[[0, 2]], atol=tolerance)
        np.testing.assert_allclose(quantiles.at(share)[1], exact[1], atol=1e-12 if count <= Quantiles.KEPT else 0.5)


def test_quantiles_of_a_place_known_late():
    quantiles = Quantiles(2)
    for number in range(400):
        quantiles.add(np.array([1.0, float(number % 11) if number >= 200 else np.nan]))
    np.testing.assert_allclose(quantiles.at(0.5), [1.0, 5.0], atol=0.6)
