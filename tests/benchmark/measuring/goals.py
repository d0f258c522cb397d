"""The goals of speed and memory, each with what was measured."""

from . import clouds, jobs, tools

MILLION = 1000000


class Goals:
    def __init__(self, runs):
        self.runs = runs
        self.rows = []

    def wall(self, tool, picks, case="horizon"):
        return self.runs.median(case, picks, tool, "wall")

    def cpu(self, tool, picks, case="horizon"):
        return self.runs.median(case, picks, tool, "cpu")

    def against(self, what, goal, peer, case, picks, met, form):
        """A ratio of graben's time and a peer's: form(graben, peer). A peer that ran out of time has a least time."""
        graben, other, bounded = self.wall("graben", picks, case), self.wall(peer, picks, case), False
        if other is None and self.runs.failure(case, picks, peer) == "timeout":
            other, bounded = self.runs.find(case, picks, peer)[-1]["wall"], True
        if graben is None or other is None:
            return
        value, text, bound = form(graben, other)
        verdict = "met" if met(value) else "not known" if bounded else "**not met**"
        cpu = "-" if bounded else text % form(self.cpu("graben", picks, case), self.cpu(peer, picks, case))[0]
        self.rows.append((what, goal, (bound if bounded else "") + text % value, cpu, verdict))

    def share_of(self, what, limit, peer, case="horizon", picks=MILLION):
        self.against(what, "at most %g" % limit, peer, case, picks, lambda v: v <= limit, lambda graben, other: (graben / other, "%.2f", "under "))

    def times_faster(self, what, limit, peer, case="horizon", picks=MILLION):
        self.against(what, "at least %g" % limit, peer, case, picks, lambda v: v >= limit, lambda graben, other: (other / graben, "%.1f", "over "))

    def add(self, what, goal, value, met, text="%.2f", cpu="-"):
        """value None: not measured."""
        if value is not None:
            self.rows.append((what, goal, text % value, cpu, "met" if met(value) else "**not met**"))

    def ratio(self, what, goal, above, below, met, text="%.2f", cpu="-"):
        self.add(what, goal, above / below if above is not None and below else None, met, text, cpu)

    def at_most(self, what, limit, above, below):
        self.ratio(what, "at most %g" % limit, above, below, lambda v: v <= limit)

    def at_least(self, what, limit, above, below):
        self.ratio(what, "at least %g" % limit, above, below, lambda v: v >= limit, "%.1f")

    def against_peers(self, case, whose):
        self.share_of(whose + ": graben / VTK", 0.4, "vtk_extract_surface", case)
        self.times_faster(whose + ": PCL's normals and MarchingCubesHoppe / graben", 15, "pcl_hoppe", case)
        self.share_of(whose + ": graben / `pcl::NormalEstimationOMP`, whole processes", 0.7, "pcl_normals", case)
        normals = self.runs.median(case, MILLION, "pcl_normals", lambda run: run["stages"].get("normals"))
        self.at_most(whose + ": graben / `pcl::NormalEstimationOMP` without reading and writing", 0.7, self.wall("graben", MILLION, case), normals)

    def memory(self):
        for picks in self.runs.sizes("horizon"):
            peak = self.runs.median("horizon", picks, "graben", "peak")
            failure = self.runs.failure("horizon", picks, "graben")
            if failure:
                self.rows.append(("%s picks: runs to the end" % clouds.label(picks), "yes", failure, "-", "**not met**"))
            if picks < MILLION or peak is None:
                continue
            each = self.runs.median("horizon", picks, "graben", lambda run, n=picks: (run["peak"] - run["output"]) / n)
            self.add("%s picks: bytes a pick beyond the output mesh" % clouds.label(picks), "at most 200", each, lambda v: v <= 200, "%.0f")
            if picks == 10 * MILLION:
                self.add("10 M picks: peak memory, GiB", "under 3", peak / 2**30, lambda v: v < 3)
            if picks == 50 * MILLION:
                self.add("50 M picks: runs to the end; peak memory, GiB", "within 24", peak / 2**30, lambda v: v < 24)

    def threads(self):
        for picks in self.runs.sizes("horizon"):
            if picks >= MILLION:
                one, two = (self.runs.median("horizon", picks, tool, tools.in_memory) for tool in ("graben_one_thread", "graben_stages"))
                self.at_least("%s picks: one thread / two, picks in memory to mesh in memory" % clouds.label(picks), 1.7, one, two)

    def fault_time(self, picks):
        """Seconds that faults add in memory, and all seconds."""
        with_faults, without = (self.runs.median("horizon", picks, tool, tools.in_memory) for tool in ("graben_stages", "graben_no_faults"))
        return (with_faults - without, with_faults) if with_faults is not None and without is not None else (None, None)

    def faults(self):
        for picks in self.runs.sizes("horizon"):
            if picks >= MILLION:
                extra, whole = self.fault_time(picks)
                self.ratio("%s picks: share of the time that two faults add" % clouds.label(picks), "at most 20 %",
                           None if extra is None else 100 * extra, whole, lambda v: v <= 20, "%.0f %%")
        small, large = self.fault_time(MILLION)[0], self.fault_time(4 * MILLION)[0]
        near = [self.runs.median("horizon", n, "graben_stages", lambda run: run.get("zone")) for n in (MILLION, 4 * MILLION)]
        if small and large and all(near):
            growth = near[1] / near[0]
            self.ratio("4 M picks / 1 M: time that the faults add", "nearer to %.1f, as picks near faults, than to 4" % growth, large, small,
                       lambda v: v <= (growth + 4) / 2, "%.1f")

    def reading(self):
        for tool, what, limit in (("read_text", "text", 150), ("read_binary", "binary PCD", 1000)):
            for picks in self.runs.sizes("files"):
                speed = self.runs.median("files", picks, tool, lambda run: run["input"] / run["stages"]["read"] / 1e6)
                self.add("reading %s picks, %s, MB/s" % (clouds.label(picks), what), "at least %d" % limit, speed,
                         lambda v, least=limit: v >= least, "%.0f")

    def all(self):
        self.against_peers("horizon", "1 M picks")
        self.times_faster("4 M picks: PCL's normals and MarchingCubesHoppe / graben", 80, "pcl_hoppe", picks=4 * MILLION)
        small, large = self.cpu("graben", MILLION), self.cpu("graben", 10 * MILLION)
        self.ratio("10 M picks / 1 M: time", "at most 11", self.wall("graben", 10 * MILLION), self.wall("graben", MILLION), lambda v: v <= 11,
                   "%.1f", "%.1f" % (large / small) if small and large else "-")
        self.memory()
        self.threads()
        self.reading()
        self.faults()
        self.against_peers("object", "closed object, 1 M points, no fault")
        jobs.goals(self.add, self.runs)
        return self.rows
