"""Tasks by number on local processes or on a Dask cluster, results in order of their numbers."""

import os
import pickle
import struct
import subprocess
import sys
import threading
from typing import Any, Callable, Dict, Iterator, List, Optional, Tuple

_AHEAD = 4  # tasks for each worker that may be under way or done before their turn: what bounds the memory
_MOST_DEATHS = 3  # of workers at one task, after which it counts as failed

Outcome = Tuple[int, Any, Optional[str]]  # number, result, or why there is none


def send(stream: Any, value: Any) -> None:
    data = pickle.dumps(value, protocol=pickle.HIGHEST_PROTOCOL)
    stream.write(struct.pack("<Q", len(data)))
    stream.write(data)
    stream.flush()


def receive(stream: Any) -> Any:
    """\\raise EOFError where the other end is gone."""
    head = stream.read(8)
    if len(head) < 8:
        raise EOFError
    size = struct.unpack("<Q", head)[0]
    data = stream.read(size)
    if len(data) < size:
        raise EOFError
    return pickle.loads(data)


def attempt(task: Callable[[Any, int], Any], job: Any, number: int) -> Tuple[Any, Optional[str]]:
    """A result, or why there is none in one line."""
    try:
        return task(job, number), None
    except Exception as error:  # whatever a realization fails of is told, and the others go on
        return None, f"{type(error).__name__}: {' '.join(str(error).split())}"


class _Process:
    """A Python of its own that does tasks one after another."""

    def __init__(self, task: Callable[[Any, int], Any], job: Any):
        path = os.pathsep.join([os.path.dirname(os.path.dirname(os.path.abspath(__file__))), *filter(None, [os.environ.get("PYTHONPATH")])])
        self.process = subprocess.Popen([sys.executable, "-m", "graben.worker"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        env={**os.environ, "PYTHONPATH": path})
        send(self.process.stdin, (task, job))

    def do(self, number: int) -> Tuple[Any, Optional[str]]:
        send(self.process.stdin, number)
        return receive(self.process.stdout)

    def end(self) -> None:
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()


class _Pool:
    """Threads that each keep a process busy, and hand results over in order."""

    def __init__(self, task: Callable[[Any, int], Any], job: Any, count: int, workers: int):
        self._task, self._job, self._count, self._ahead = task, job, count, _AHEAD * workers
        self._changed = threading.Condition()
        self._next, self._wanted = 0, 0
        self._done: Dict[int, Outcome] = {}
        self._stopped = False
        self._error: Optional[BaseException] = None
        self._processes: List[_Process] = []
        self._threads = [threading.Thread(target=self._keep_busy, daemon=True) for _ in range(min(workers, count))]

    def outcomes(self) -> Iterator[Outcome]:
        for thread in self._threads:
            thread.start()
        try:
            for number in range(self._count):
                with self._changed:
                    self._changed.wait_for(lambda: number in self._done or self._error is not None)
                    if self._error is not None:
                        raise self._error
                    outcome = self._done.pop(number)
                    self._wanted = number + 1
                    self._changed.notify_all()
                yield outcome
        finally:
            self._stop()

    def _stop(self) -> None:
        with self._changed:
            self._stopped = True
            self._changed.notify_all()
            for process in self._processes:
                process.process.kill()
        for thread in self._threads:
            thread.join()

    def _take(self) -> Optional[int]:
        with self._changed:
            self._changed.wait_for(lambda: self._stopped or self._next >= self._count or self._next < self._wanted + self._ahead)
            if self._stopped or self._next >= self._count:
                return None
            self._next += 1
            return self._next - 1

    def _start(self) -> _Process:
        process = _Process(self._task, self._job)
        with self._changed:
            self._processes.append(process)
        return process

    def _end(self, process: Optional[_Process]) -> None:
        if process is not None:
            with self._changed:
                self._processes.remove(process)
            process.end()

    def _keep_busy(self) -> None:
        process = None
        try:
            number = self._take()
            while number is not None:
                outcome = None
                for _ in range(_MOST_DEATHS):
                    try:
                        process = process or self._start()
                        outcome = (number, *process.do(number))
                        break
                    except (EOFError, BrokenPipeError):  # it was killed: another one does the task again
                        self._end(process)
                        process = None
                        if self._stopped:
                            return
                with self._changed:
                    self._done[number] = outcome or (number, None, f"{_MOST_DEATHS} workers ended while they were at it")
                    self._changed.notify_all()
                number = self._take()
        except BaseException as error:
            with self._changed:
                self._error = error
                self._changed.notify_all()
        finally:
            self._end(process)


def on_processes(task: Callable[[Any, int], Any], job: Any, count: int, workers: int) -> Iterator[Outcome]:
    """task(job, number) for all numbers below count, on processes of this machine."""
    return _Pool(task, job, count, workers).outcomes()


def in_this_process(task: Callable[[Any, int], Any], job: Any, count: int) -> Iterator[Outcome]:
    for number in range(count):
        yield (number, *attempt(task, job, number))


def _as_is(value: Any) -> Any:
    return value


def on_dask(task: Callable[[Any, int], Any], job: Any, count: int, client: Any) -> Iterator[Outcome]:
    """The same on a dask.distributed client, or the address of a scheduler. What a lost worker was at is done again by another."""
    from distributed import Client

    own = Client(client) if isinstance(client, str) else None
    client = own or client
    # A task, not scattered data: it can be made again where all workers that held it are gone.
    data = client.submit(_as_is, job, pure=False)
    ahead = _AHEAD * max(1, len(client.scheduler_info()["workers"]))
    futures: Dict[int, Any] = {}
    try:
        for number in range(count):
            for later in range(number, min(count, number + ahead)):
                if later not in futures:
                    futures[later] = client.submit(attempt, task, data, later, pure=False)
            future = futures.pop(number)
            try:
                yield (number, *future.result())
            except Exception as error:  # the scheduler gave it up
                yield number, None, f"{type(error).__name__}: {' '.join(str(error).split())}"
    finally:
        for future in futures.values():
            future.cancel()
        if own is not None:
            own.close()
