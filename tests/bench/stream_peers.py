#!/usr/bin/env python3
"""Wavelet streams beside Draco at equal error, on meshes that bench_simplify_quality wrote. Needs pymeshlab, numpy and
DracoPy.

For each precision of Draco: its bytes and root mean square distance to the original, and the bytes of a stream with the
same distance, between the precisions of --wavelet-precision that were tried.

usage: stream_peers.py MESHCONTOUR MESH.off ...
"""

import pathlib
import subprocess
import sys
import tempfile

import DracoPy
import numpy as np
import pymeshlab
from simplify_peers import read_off

BITS = (9, 10, 11, 12, 13, 14)
PRECISIONS = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5)


def distance(original, other):
    """The larger root mean square distance of the two directions, in per cent of the diagonal."""
    meshes = pymeshlab.MeshSet()
    for mesh in (original, other):
        meshes.add_mesh(pymeshlab.Mesh(*mesh))
    found = [
        meshes.get_hausdorff_distance(
            sampledmesh=i, targetmesh=1 - i, samplevert=True, sampleface=True, samplenum=40000)["RMS"]
        for i in (0, 1)
    ]
    return 100 * max(found) / np.linalg.norm(np.ptp(original[0], axis=0))


def draco(mesh, bits):
    data = DracoPy.encode(*mesh, quantization_bits=bits, compression_level=10, create_metadata=False)
    back = DracoPy.decode(data)
    return len(data), distance(mesh, (np.asarray(back.points, float), np.asarray(back.faces, np.int32)))


def stream(program, path, mesh, precision, folder):
    packed, back = folder / "x.mcw", folder / "x.off"
    subprocess.run([program, path, "--patches-from", "none", "--save-wavelet", packed,
                    "--wavelet-precision", str(precision)], check=True, capture_output=True)
    subprocess.run([program, packed, "--save-mesh", back], check=True, capture_output=True)
    return packed.stat().st_size, distance(mesh, read_off(back))


def main():
    print("| mesh | distance, % | Draco, bytes | stream, bytes | ratio |\n|---|---:|---:|---:|---:|")
    for name in sys.argv[2:]:
        path = pathlib.Path(name)
        mesh = read_off(path)
        with tempfile.TemporaryDirectory() as folder:
            ours = [stream(sys.argv[1], path, mesh, precision, pathlib.Path(folder)) for precision in PRECISIONS]
        sizes, errors = np.log([size for size, _ in ours]), np.log([error for _, error in ours])
        for bits in BITS:
            size, error = draco(mesh, bits)
            if not errors.min() <= np.log(error) <= errors.max():
                continue
            equal = np.exp(np.interp(-np.log(error), -errors, sizes))
            print(f"| {path.stem} | {error:.4f} | {size} | {equal:.0f} | {equal / size:.2f} |", flush=True)


if __name__ == "__main__":
    main()
