#!/usr/bin/env python3
"""A large binary STL to its sharp edges as CSV, beside other programs, in one run.

    compare_stl.py [--triangles N] [--rounds N] [--python PYTHON] BUILD

BUILD holds `meshcontour` and, if it was built, `tests/bench/bench_cgal_edges`. PYTHON has numpy, and trimesh and pyvista
for the rows of these; what is missing is left out. Every program reads the file, joins equal points, finds the edges
above 30 degrees and writes those between patches, as far as it knows patches; meshcontour also traces the loops and
writes them. Programs run in turn; a row has the medians."""

import argparse
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

MAKE = """
import sys
import numpy as np
n = int((int(sys.argv[1]) / 2) ** 0.5)
x = np.linspace(0, 100, n + 1)
X, Y = np.meshgrid(x, x, indexing="ij")
Z = 2 * np.floor(3 * np.sin(X / 9) + 3 * np.cos(Y / 11)) + 0.3 * np.sin(X / 5)
P = np.stack([X, Y, Z], -1).astype("<f4")
a, b, c, d = P[:-1, :-1], P[1:, :-1], P[1:, 1:], P[:-1, 1:]
facets = np.zeros(2 * n * n, dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
facets["corners"] = np.stack([np.stack([a, b, c], -2), np.stack([a, c, d], -2)], -3).reshape(-1, 3, 3)
with open(sys.argv[2], "wb") as out:
    out.write(b" " * 80 + np.uint32(len(facets)).tobytes() + facets.tobytes())
"""

TRIMESH = """
import sys
import numpy as np
import trimesh
mesh = trimesh.load(sys.argv[1], file_type="stl")
sharp = mesh.face_adjacency_angles > np.radians(30)
patch = trimesh.graph.connected_component_labels(mesh.face_adjacency[~sharp], node_count=len(mesh.faces))
faces, edges = mesh.face_adjacency[sharp], mesh.face_adjacency_edges[sharp]
border = trimesh.grouping.group_rows(mesh.edges_sorted, require_count=1)
edges = np.vstack([edges[patch[faces[:, 0]] != patch[faces[:, 1]]], mesh.edges_sorted[border]])
ends = edges.ravel()
np.savetxt(sys.argv[2], np.c_[ends, mesh.vertices[ends]], delimiter=",", fmt=["%d"] + ["%.9g"] * 3)
print(len(edges))
"""

PYVISTA = """
import sys
import numpy as np
import pyvista
mesh = pyvista.read(sys.argv[1]).clean()
edges = mesh.extract_feature_edges(feature_angle=30, boundary_edges=True, non_manifold_edges=True, feature_edges=True,
                                   manifold_edges=False)
ends = edges.lines.reshape(-1, 3)[:, 1:].ravel()
np.savetxt(sys.argv[2], np.c_[ends, edges.points[ends]], delimiter=",", fmt=["%d"] + ["%.9g"] * 3)
print(edges.n_cells)
"""


def measure(command):
    """Wall and processor seconds, peak memory in MB, and what was printed."""
    with tempfile.TemporaryFile() as output:
        start = time.monotonic()
        process = subprocess.Popen([str(word) for word in command], stdout=output)
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - start
        if status:
            raise RuntimeError(f"{command[0]}: exit status {status}")
        output.seek(0)
        return wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, output.read().decode().strip()


def has(python, module):
    return subprocess.run([python, "-c", f"import {module}"], capture_output=True).returncode == 0


def contenders(options, model, folder):
    program = options.build / "meshcontour"
    ours = [program, model, "-q", "--feature-angle", 30, "-o", folder / "loops.csv"]
    yield "meshcontour", ours
    yield "meshcontour -j 1", ours + ["-j", 1]
    if (options.build / "tests/bench/bench_cgal_edges").exists():
        yield "CGAL", [options.build / "tests/bench/bench_cgal_edges", model, folder / "cgal.csv"]
    for name, text in (("trimesh", TRIMESH), ("pyvista", PYVISTA)):
        if has(options.python, name):
            yield name, [options.python, "-c", text, model, folder / f"{name}.csv"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--triangles", type=int, default=5_000_000)
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--python", default=sys.executable)
    parser.add_argument("build", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        model = folder / "plate.stl"
        subprocess.run([options.python, "-c", MAKE, str(options.triangles), str(model)], check=True)
        runs = {}
        for _ in range(options.rounds):
            for who, command in contenders(options, model, folder):
                runs.setdefault(who, []).append(measure(command))
        print("| program | wall, s | processor, s | peak memory, MB | edges |\n|---|---:|---:|---:|---:|")
        for who, rows in runs.items():
            wall, processor, memory = (statistics.median(row[i] for row in rows) for i in range(3))
            print(f"| {who} | {wall:.2f} | {processor:.2f} | {memory:.0f} | {rows[0][3] or '-'} |")


if __name__ == "__main__":
    main()
