"""Runs a process and measures it."""

import os
import re
import resource
import signal
import subprocess
import tempfile
import threading
import time

CLOCK_TICKS = os.sysconf("SC_CLK_TCK")


def busy_seconds():
    """CPU time of all processes of the machine since its start."""
    with open("/proc/stat", encoding="ascii") as stat:
        user, nice, system, _idle, _wait, irq, softirq = map(int, stat.readline().split()[1:8])
    return (user + nice + system + irq + softirq) / CLOCK_TICKS


def machine_memory():
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def measure(command, timeout):
    """wall and cpu in seconds, peak resident bytes, status ('ok', 'timeout' or what went wrong), stages by name and the CPU time that
    others took per second. Peaks under Python's own, about 15 MB, cannot be seen. Memory is limited to nine tenths of the machine's."""
    limit = machine_memory() * 9 // 10

    def limit_memory():
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))

    with tempfile.TemporaryFile() as said:
        busy, start = busy_seconds(), time.monotonic()
        process = subprocess.Popen(command, stdout=said, stderr=subprocess.STDOUT, start_new_session=True, preexec_fn=limit_memory)
        late = threading.Event()

        def stop():
            late.set()
            os.killpg(process.pid, signal.SIGKILL)

        timer = threading.Timer(timeout, stop)
        timer.start()
        try:
            _, code, usage = os.wait4(process.pid, 0)
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
        finally:
            timer.cancel()
        wall = time.monotonic() - start
        process.returncode = os.waitstatus_to_exitcode(code)
        others = busy_seconds() - busy
        said.seek(0)
        text = said.read().decode(errors="replace")

    cpu = usage.ru_utime + usage.ru_stime
    status = "ok"
    if late.is_set():
        status = "timeout"
    elif process.returncode < 0:
        status = "signal " + signal.Signals(-process.returncode).name
    elif process.returncode:
        status = "exit code %d" % process.returncode
    return {
        "wall": wall,
        "cpu": cpu,
        "peak": usage.ru_maxrss * 1024,
        "others": max(0.0, others - cpu) / max(wall, 1.0 / CLOCK_TICKS),
        "status": status,
        "said": text.strip().splitlines()[-1:] if status != "ok" else [],
        "stages": {name: float(seconds) for name, seconds in re.findall(r"^time (\S+) ([\d.]+)$", text, re.M)},
    }
