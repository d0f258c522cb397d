"""While it runs: progress, Ctrl-C, other threads."""

import _thread
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import graben


def rough_plane(count, seed=1):
    random = np.random.default_rng(seed)
    x, y = random.uniform(0.0, 5000.0, (2, count))
    return np.column_stack((x, y, 40.0 * np.sin(x / 700.0) * np.cos(y / 900.0) + random.normal(0.0, 2.0, count)))


def test_progress_is_told_in_order():
    told = []
    graben.reconstruct(rough_plane(20000), progress=lambda stage, fraction: told.append((stage, fraction)))
    stages = list(dict.fromkeys(stage for stage, _ in told))
    assert {"normals", "marching cubes"} <= set(stages)
    assert all(0.0 <= fraction <= 1.0 for _, fraction in told)


def test_progress_comes_in_the_asking_thread():
    seen = set()
    graben.reconstruct(rough_plane(3000), progress=lambda *_: seen.add(threading.get_ident()))
    assert seen == {threading.get_ident()}


def test_what_progress_raises_stops_the_job():
    class Enough(Exception):
        pass

    def stop(stage, fraction):
        if stage == "normals":
            raise Enough(stage)

    with pytest.raises(Enough, match="normals"):
        graben.reconstruct(rough_plane(20000), progress=stop)


def test_interrupt_is_seen_within_the_work():
    """Interrupted in the middle of a stage, from another thread as the terminal does it; the job has stages to go then."""
    after = []

    def progress(stage, fraction):
        if stage == "normals" and fraction == 0.0:
            threading.Timer(0.05, _thread.interrupt_main).start()
        after.append(stage)

    with pytest.raises(KeyboardInterrupt):
        graben.reconstruct(rough_plane(400000), progress=progress)
    assert "quality" not in after
    assert len(graben.reconstruct(rough_plane(3000)).triangles) > 0, "and the next job runs as ever"


def test_ctrl_c_ends_a_program():
    program = ("import graben, numpy, sys\nx = numpy.random.default_rng(1).uniform(0, 5000, (4000000, 3)) * (1, 1, 0.001)\n"
               "print('begins', flush=True)\ngraben.reconstruct(x)\nprint('ended', flush=True)")
    running = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert running.stdout.readline() == "begins\n"
    time.sleep(1.0)
    running.send_signal(signal.SIGINT)
    out, err = running.communicate(timeout=300)
    assert "ended" not in out and "KeyboardInterrupt" in err and running.returncode != 0


def test_python_goes_on_meanwhile():
    """A thread ticks each millisecond: with the lock held by the job it would not within a stage."""
    ticks, ended, at = [], threading.Event(), {}

    def tick():
        while not ended.wait(0.001):
            ticks.append(None)

    thread = threading.Thread(target=tick)
    thread.start()
    graben.reconstruct(rough_plane(300000), progress=lambda stage, fraction: at.setdefault((stage, fraction), len(ticks)))
    ended.set()
    thread.join()
    assert at["normals", 1.0] - at["normals", 0.0] > 20


def test_two_threads_side_by_side():
    """Each waits inside its job until the other is inside too."""
    both = threading.Barrier(2, timeout=120)
    made = {}

    def run(number):
        met = []

        def progress(stage, fraction):
            if stage == "normals" and not met:
                met.append(both.wait())

        made[number] = graben.reconstruct(rough_plane(20000, seed=number), progress=progress)

    threads = [threading.Thread(target=run, args=(number,)) for number in (1, 2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for number in (1, 2):
        np.testing.assert_array_equal(made[number].vertices, graben.reconstruct(rough_plane(20000, seed=number)).vertices)


def test_the_same_for_any_number_of_threads():
    one, two = (graben.reconstruct(rough_plane(20000), threads=threads) for threads in (1, 2))
    np.testing.assert_array_equal(one.vertices, two.vertices)
    np.testing.assert_array_equal(one.triangles, two.triangles)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")
def test_works_in_a_forked_child():
    graben.reconstruct(rough_plane(3000))
    child = os.fork()
    if child == 0:
        os._exit(0 if len(graben.reconstruct(rough_plane(3000)).triangles) > 0 else 1)
    deadline = time.monotonic() + 120.0
    while time.monotonic() < deadline:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            assert status == 0
            return
        time.sleep(0.05)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    pytest.fail("the child hangs")
