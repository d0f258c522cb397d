"""Markdown of a log of runs."""

import os
import platform
import re
import subprocess

from . import clouds, goals, processes, tools


def row(cells):
    return "| " + " | ".join(cells) + " |"


def seconds(value):
    return "%.2f" % value if value < 10 else "%.0f" % value


def short(ratio):
    return "%.0f" % ratio if ratio >= 10 else "%.2g" % ratio


def cell(log, case, picks, tool):
    wall, cpu, peak = (log.median(case, picks, tool, key) for key in ("wall", "cpu", "peak"))
    if wall is None:
        runs = log.find(case, picks, tool)
        if log.failure(case, picks, tool) == "timeout":
            return "over %.0f s" % runs[-1]["wall"]
        return log.failure(case, picks, tool) or "-"
    text = "%s s, %s s, %.0f MB" % (seconds(wall), seconds(cpu), peak / 1e6)
    graben = log.median(case, picks, "graben", "wall")
    return text + (" (%s×)" % short(wall / graben) if graben and tool != "graben" else "")


def speed(log):
    columns = [(case, picks) for case in ("horizon", "object") for picks in log.sizes(case)]
    heads = [clouds.label(picks) + (", closed object" if case == "object" else "") for case, picks in columns]
    lines = [row(["wall s, CPU s, peak memory (wall / graben's)"] + heads), "|---" * (len(heads) + 1) + "|"]
    names = {"graben": "**graben**", **{name: text for name, (text, _) in tools.PEERS.items()}}
    for tool, name in names.items():
        if any(log.find(case, picks, tool) for case, picks in columns):
            lines.append(row([name] + [cell(log, case, picks, tool) for case, picks in columns]))
    return lines


def goal_table(log):
    rows = goals.Goals(log).all()
    return [row(["goal", "to reach", "measured", "by CPU time", ""]), "|---|---|---|---|---|"] + [row(r) for r in rows] if rows else []


def cpu_name():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        found = re.search(r"model name\s*: (.*)", file.read())
    return found.group(1) if found else platform.machine()


def version(package):
    found = subprocess.run(["dpkg-query", "--show", "--showformat=${Version}", package], capture_output=True, text=True, check=False)
    return re.match(r"[\d.]*", found.stdout).group(0).rstrip(".")


def caption(log):
    versions = [(name, version(package)) for name, package in
                (("PCL", "libpcl-dev"), ("VTK", "libvtk9-dev"), ("CGAL", "libcgal-dev"), ("Open3D", "libopen3d-dev"))]
    text = "%s, %d processors, %.0f GiB; %s. Medians of up to %d interleaved runs of whole processes." % (
        cpu_name(), os.cpu_count(), processes.machine_memory() / 2**30, ", ".join("%s %s" % v for v in versions if v[1]), log.repeats())
    if log.others() > 0.1:
        text += " Other processes kept %.1f processors busy meanwhile: times are too long, ratios rough." % log.others()
    return text


def replace(path, name, lines):
    """Puts lines between <!-- NAME --> and <!-- /NAME --> of a file. Lines that stand there stay if there are none to put."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    begin, end = "<!-- %s -->\n" % name, "<!-- /%s -->" % name
    if begin not in text or end not in text:
        raise SystemExit("%s has no lines %s and %s" % (path, begin.strip(), end))
    if lines:
        head, tail = text.split(begin)[0], text.split(end)[1]
        with open(path, "w", encoding="utf-8") as file:
            file.write(head + begin + "\n".join(lines) + "\n" + end + tail)
