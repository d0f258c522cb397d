"""What is run: graben and the programs of tests/benchmark/peers."""

import json
import os

from . import clouds

# name: (what it is, largest horizon it is run on unless named with --tools)
PEERS = {
    "pcl_normals": ("`pcl::NormalEstimationOMP` alone", 10000000),
    "vtk_extract_surface": ("`vtkPCANormalEstimation` + `vtkSignedDistance` + `vtkExtractSurface`", 10000000),
    "pcl_hoppe": ("`pcl::NormalEstimationOMP` + `pcl::MarchingCubesHoppe`", 4000000),
    "pcl_poisson": ("`pcl::NormalEstimationOMP` + `pcl::Poisson`", 1000000),
    "pcl_greedy": ("`pcl::NormalEstimationOMP` + `pcl::GreedyProjectionTriangulation`", 1000000),
    "cgal_advancing_front": ("CGAL advancing front", 1000000),
    "cgal_scale_space": ("CGAL scale space + advancing front", 1000000),
    "open3d_ball_pivoting": ("Open3D ball pivoting", 1000000),
}
OF_OBJECTS = ("pcl_normals", "vtk_extract_surface", "pcl_hoppe")
IN_AND_OUT = ("reading", "writing")


class Tools:
    """Commands, by name. graben: default options with faults. The others of graben's serve the goals: graben_stages and
    graben_one_thread write a report, graben_no_faults has one as well and is given no faults."""

    def __init__(self, folder, programs, wanted):
        self.folder, self.programs, self.wanted = folder, programs, wanted
        self.output = os.path.join(folder, "surface.ply")
        self.report = os.path.join(folder, "report.json")

    def program(self, name):
        return os.path.join(self.programs, name)

    def installed(self, peer):
        return os.path.exists(self.program("peer_" + peer))

    def peers(self, picks, among=PEERS):
        return [p for p in among if self.installed(p) and (p in self.wanted if self.wanted else picks <= PEERS[p][1])]

    def graben(self, picks, path, faults, *options):
        command = [self.program("graben_reconstruct"), "--horizon", path, "--voxel-size", "%.6g" % (2 * clouds.spacing(picks)),
                   "--output", self.output, *options]
        return command + (["--fault", *faults] if faults else [])

    def peer(self, name, picks, path, *options):
        return [self.program("peer_" + name), path, self.output, "--voxel", "%.6g" % (2 * clouds.spacing(picks)), *options]

    def of_horizon(self, picks, path, faults):
        report = ("--report", self.report)
        commands = {"graben": self.graben(picks, path, faults)}
        commands.update((p, self.peer(p, picks, path)) for p in self.peers(picks))
        commands["graben_stages"] = self.graben(picks, path, faults, *report)
        commands["graben_one_thread"] = self.graben(picks, path, faults, "--threads", "1", *report)
        commands["graben_no_faults"] = self.graben(picks, path, [], *report)
        return commands

    def of_object(self, points, path):
        commands = {"graben": self.graben(points, path, [])}
        commands.update((p, self.peer(p, points, path, "--object")) for p in self.peers(points, OF_OBJECTS))
        return commands

    def of_files(self, binary, text):
        return {"read_binary": [self.program("graben_read_speed"), binary], "read_text": [self.program("graben_read_speed"), text]}

    def after(self, run, command):
        """Adds what a run left in files, and takes these away."""
        if run["status"] == "ok" and os.path.exists(self.output):
            run["output"] = os.path.getsize(self.output)
        if os.path.exists(self.report):
            if run["status"] == "ok" and "--report" in command:
                with open(self.report, encoding="utf-8") as file:
                    report = json.load(file)
                run["stages"] = {s["stage"]: s["seconds"] for s in report["stages"]}
                run["zone"] = report["approximation_error"]["zone_after_fit"]["count"]
            os.remove(self.report)
        if os.path.exists(self.output):
            os.remove(self.output)


def in_memory(run):
    """Seconds from picks in memory to mesh in memory."""
    return sum(seconds for stage, seconds in run["stages"].items() if stage not in IN_AND_OUT) if run["stages"] else None
