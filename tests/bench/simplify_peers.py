#!/usr/bin/env python3
"""What MeshLab's quadric edge collapses make of the meshes of bench_simplify_quality. Needs pymeshlab and numpy.

usage: simplify_peers.py FOLDER
"""

import pathlib
import sys

import numpy as np
import pymeshlab


def read_off(path):
    words = path.read_text().split()
    points, faces = int(words[1]), int(words[2])
    at = 4 + 3 * points
    rows = np.array(words[at:], dtype=object)
    corners = np.empty((faces, 3), dtype=np.int32)
    place = 0
    for face in range(faces):  # a row may end with a colour, which a mesh of one patch has not
        corners[face] = rows[place + 1 : place + 4]
        place += 4
    return np.array(words[4:at], dtype=float).reshape(-1, 3), corners


def write_off(path, points, faces):
    with path.open("w") as out:
        out.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        out.writelines(f"{x!r} {y!r} {z!r}\n" for x, y, z in points.tolist())
        out.writelines(f"3 {a} {b} {c}\n" for a, b, c in faces.tolist())


def main():
    folder = pathlib.Path(sys.argv[1])
    for line in (folder / "list.txt").read_text().splitlines():
        source, count, target = line.split()
        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(pymeshlab.Mesh(*read_off(folder / source)))
        meshes.meshing_decimation_quadric_edge_collapse(
            targetfacenum=int(count), qualitythr=0.3, optimalplacement=True, planarquadric=False)
        result = meshes.current_mesh()
        write_off(folder / target, result.vertex_matrix(), result.face_matrix())
        print(target, result.face_number(), flush=True)


if __name__ == "__main__":
    main()
