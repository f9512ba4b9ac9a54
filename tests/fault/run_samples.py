#!/usr/bin/env python3
"""Runs the program on every sample with every group of options, in one thread and in several, and checks that it
succeeds without a sanitizer's report and writes the same both times.

Usage: run_samples.py PROGRAM SAMPLES [tables|pictures]; SAMPLES is the folder of stud.xml. Only tables and meshes, or
only pictures, else both."""

import collections
import os
import pathlib
import subprocess
import sys
import tempfile

TABLES = [option for kind in ("csv", "obj", "json", "step", "dxf", "svg", "glb") for option in ("-o", "a." + kind)]
GROUPS = [TABLES + group for group in [
    ["--fit", "primitives", "--strict"],
    ["--fit", "approximate", "--extractor", "halfedge", "--edges", "unique", "--csv-of", "curves", "--obj", "curves"],
    ["--fit", "interpolate", "--dxf", "polyline", "--step", "ap214", "--unit", "in", "--input-unit", "mm"],
    ["--fit", "control", "--subdivide", "2", "--save-mesh", "a.ply", "--save-mesh", "a.stl", "--save-mesh", "b.obj"],
    ["--simplify", "ratio:0.3", "--save-mesh", "a.off", "--save-mesh", "a.net"],
    ["--subdivide", "2", "--save-wavelet", "a.mcw", "--simplify", "ratio:0.2", "--simplify-method", "wavelet"],
    ["--patches-from", "angle", "--repair", "--weld", "1e-6", "--report", "r.json"],
    ["--patches-from", "none", "--obj", "tree", "-o", "a.wrl", "--boundary-rule", "trig", "--subdivide", "1"],
]]
PICTURES = ["-o", "{view}.png", "-o", "{view}.svg", "--size", "160x120", "--view", "iso,top",
            "--report", "html:r.html", "--layers",
            "mesh,edges,curves,wireframe,points,control,frames,detail,annotations,tree,axes,scale"]
REPORTS = {"r.json", "r.html"}  # hold times


def samples(folder):
    sweeps = ["curves", "frame"]  # the small ones
    return [folder / "stud.xml", folder / "assembly/index.xml", *(folder / f"samples/swp/{name}.swp" for name in sweeps)]


def outputs(folder):
    return {file.name: file.read_bytes() for file in folder.iterdir() if file.name not in REPORTS}


def run(program, sample, options, threads, folder):
    return subprocess.run([program, sample, "-q", "-j", str(threads), *options], cwd=folder, capture_output=True, text=True,
                          stdin=subprocess.DEVNULL)


def main(program, folder, only=""):
    program, failures, codes = os.path.abspath(program), 0, collections.Counter()
    for sample in samples(pathlib.Path(folder).resolve()):
        for options in [*(GROUPS if only != "pictures" else []), *([PICTURES] if only != "tables" else [])]:
            results = []
            for threads in (1, 4):
                with tempfile.TemporaryDirectory() as work:
                    done = run(program, sample, options, threads, work)
                    results.append(outputs(pathlib.Path(work)))
                codes[done.returncode] += 1
                if done.returncode not in (0, 65) or "Sanitizer" in done.stderr or "runtime error" in done.stderr:
                    failures += 1
                    print(f"{sample} {' '.join(options)} -j {threads}: exit code {done.returncode}\n{done.stderr[:3000]}")
            if results[0] != results[1]:
                failures += 1
                print(f"{sample} {' '.join(options)}: other outputs with several threads")
    print(f"exit codes {dict(sorted(codes.items()))}, {failures} failures")
    return 1 if failures or not codes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
