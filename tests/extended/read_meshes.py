#!/usr/bin/env python3
"""Writes a model as a mesh in every format with export_meshes, and checks that trimesh and meshio find the same number
of points and triangles, and the same volume.
Usage: read_meshes.py EXPORT_MESHES MODEL"""

import pathlib
import subprocess
import sys
import tempfile

import meshio
import numpy as np
import trimesh

# It knows no properties of faces in PLY, no colours in OFF and no second solid in STL.
UNKNOWN_TO_MESHIO = ("patches-binary.ply", "patches-text.ply", "patches.off", "patches-text.stl")


def volume(points, triangles):
    corners = np.asarray(points, dtype=float)[triangles] - np.asarray(points, dtype=float)[0]
    return float(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6)


def by_trimesh(path):
    mesh = trimesh.load(path, process=False, force="mesh", maintain_order=True)
    return np.asarray(mesh.vertices), np.asarray(mesh.faces)


def by_meshio(path):
    mesh = meshio.read(path)
    return mesh.points, np.vstack([block.data for block in mesh.cells if block.type == "triangle"])


def main(program, model):
    faults = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        counts = subprocess.run([program, folder, model], check=True, capture_output=True, text=True).stdout.split()
        expected = tuple(map(int, counts))
        reference = volume(*by_trimesh(folder / "plain-text.ply"))
        for path in sorted(folder.iterdir()):
            for read in (by_trimesh, by_meshio):
                if read is by_meshio and path.name in UNKNOWN_TO_MESHIO:
                    continue
                points, triangles = read(path)
                used = np.unique(np.asarray(points, dtype=np.float64), axis=0) if path.suffix == ".stl" else points
                found = len(used), len(triangles)
                same = found == expected and abs(volume(points, triangles) / reference - 1) < 1e-5
                faults += not same
                print(f"{'ok' if same else 'WRONG'}: {path.name} by {read.__name__[3:]}: {found[0]} points, "
                      f"{found[1]} triangles")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
