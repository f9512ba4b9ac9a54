#!/usr/bin/env python3
"""Boundary loops of grids with holes: meshcontour beside VTK, libigl and trimesh, one thread, in turn, processor time.

Usage: boundary_peers.py PROGRAM [ROUNDS [TRIANGLES...]]; needs numpy, and takes of vtk, libigl and trimesh what is
installed. The meshes are given to each in
its own form before the clock starts; every answer is compared with ours: boundary edges and loops."""

import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np


def grid(triangles, shuffled):
    """Squares with a hole in every 8th of every second row and column."""
    side = int((triangles / 2) ** 0.5)
    i, j = (index.ravel() for index in np.meshgrid(np.arange(side), np.arange(side), indexing="ij"))
    keep = ~((i % 8 == 3) & (j % 8 == 3))
    a = (i * (side + 1) + j)[keep]
    corners = np.stack([a, a + side + 1, a + side + 2, a, a + side + 2, a + 1], axis=1).reshape(-1, 3)
    ticks = np.arange(side + 1, dtype=float)
    points = np.stack([np.repeat(ticks, side + 1), np.tile(ticks, side + 1), np.zeros((side + 1) ** 2)], axis=1)
    if shuffled:
        generator = np.random.default_rng(1)
        order = generator.permutation(len(points))
        place = np.empty_like(order)
        place[order] = np.arange(len(order))
        points, corners = points[order], generator.permutation(place[corners])
    return points, corners.astype(np.int32)


def write_ply(path, points, corners):
    faces = np.empty(len(corners), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, corners
    head = ("ply\nformat binary_little_endian 1.0\n"
            f"element vertex {len(points)}\nproperty double x\nproperty double y\nproperty double z\n"
            f"element face {len(corners)}\nproperty list uchar int vertex_indices\nend_header\n")
    path.write_bytes(head.encode() + points.astype("<f8").tobytes() + faces.tobytes())


class Ours:
    name = "meshcontour"

    def __init__(self, program, points, corners, folder):
        self.path, self.report, self.program = folder / "grid.ply", folder / "report.json", program
        write_ply(self.path, points, corners)

    def run(self):
        subprocess.run([self.program, "-q", "-j", "1", self.path, "--patches-from", "none", "-o", "/dev/null", "--format",
                        "csv", "--report", self.report], check=True)
        report = json.loads(self.report.read_text())
        stage = next(stage for stage in report["stages"] if stage["stage"] == "boundary")
        return stage["cpu_ms"] / 1000, (report["counts"]["boundary_edges"], report["counts"]["loops"])


class Vtk:
    name = "VTK feature edges and stripper"

    def __init__(self, _, points, corners, __):
        from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
        from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkStripper
        self.filters = vtkFeatureEdges, vtkStripper
        self.data = vtkPolyData()
        vertices, cells = vtkPoints(), vtkCellArray()
        vertices.SetData(numpy_to_vtk(points, deep=True))
        flat = np.column_stack([np.full(len(corners), 3), corners]).astype(np.int64).ravel()
        cells.ImportLegacyFormat(numpy_to_vtkIdTypeArray(flat, deep=True))
        self.data.SetPoints(vertices)
        self.data.SetPolys(cells)

    def run(self):
        start = time.process_time()
        edges, strips = (kind() for kind in self.filters)
        edges.SetInputData(self.data)
        edges.BoundaryEdgesOn()
        edges.FeatureEdgesOff()
        edges.NonManifoldEdgesOff()
        edges.ManifoldEdgesOff()
        edges.ColoringOff()
        strips.SetInputConnection(edges.GetOutputPort())
        strips.SetMaximumLength(1 << 30)
        strips.JoinContiguousSegmentsOn()
        strips.Update()
        seconds = time.process_time() - start
        return seconds, (edges.GetOutput().GetNumberOfLines(), strips.GetOutput().GetNumberOfLines())


class Igl:
    name = "libigl boundary_facets and boundary_loop_all"

    def __init__(self, _, __, corners, ___):
        import igl
        self.igl, self.corners = igl, corners.astype(np.int64)

    def run(self):
        start = time.process_time()
        facets = self.igl.boundary_facets(self.corners)
        loops = self.igl.boundary_loop_all(self.corners)
        return time.process_time() - start, (len(facets[0] if isinstance(facets, tuple) else facets), len(loops))


class Trimesh:
    name = "trimesh outline"

    def __init__(self, _, points, corners, __):
        import trimesh
        if len(corners) > 2_000_000:
            raise ImportError("takes minutes")
        self.mesh = lambda: trimesh.Trimesh(points, corners, process=False)

    def run(self):
        start = time.process_time()
        entities = self.mesh().outline().entities
        seconds = time.process_time() - start
        return seconds, (sum(len(entity.points) - 1 for entity in entities), len(entities))


def contenders(*arguments):
    for kind in (Ours, Vtk, Igl, Trimesh):
        try:
            yield kind(*arguments)
        except ImportError as error:
            print(f"skipped: {kind.name}: {error}", file=sys.stderr)


def main(program, rounds="5", *sizes):
    print("| triangles | method | ms | time / ours |\n|---:|---|---:|---:|")
    for size in [int(float(size)) for size in sizes or ("1e4", "1e6")]:
        for shuffled in (False, True):
            points, corners = grid(size, shuffled)
            with tempfile.TemporaryDirectory() as folder:
                peers = list(contenders(program, points, corners, pathlib.Path(folder)))
                times = {peer.name: [] for peer in peers}
                for _ in range(int(rounds)):
                    answers = {}
                    for peer in peers:
                        seconds, answers[peer.name] = peer.run()
                        times[peer.name].append(seconds)
                    if len(set(answers.values())) > 1:
                        print(f"the answers differ: {answers}")
                        return 1
            ours = statistics.median(times[Ours.name])
            for name, seconds in times.items():
                median = statistics.median(seconds)
                print(f"| {len(corners)}{' shuffled' if shuffled else ''} | {name} | {1000 * median:.2f} | "
                      f"{median / ours:.1f} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
