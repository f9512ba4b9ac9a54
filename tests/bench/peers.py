#!/usr/bin/env python3
"""Runs the benchmarks against other programs and libraries and prints one Markdown table of ratios.

    tests/bench/peers.py BUILD FOLDER [--large]

scripts/bench --peers calls it. BUILD is the build folder; FOLDER keeps the Python environment with the peers. Each
program compares its answers with the peer's before it takes the time, runs both in turn, and gives medians of
processor time. What is not installed is skipped with a line on standard error. --large: patches of ten million
triangles, too, which take ten minutes and 12 GB, and all control points of the splines."""

import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGES = ["numpy==2.4.6", "scipy==1.17.1", "vtk==9.7.2", "libigl==2.6.3", "trimesh==5.2.0", "f3d==4.0.0",
            "cadquery-ocp-novtk==8.0.1.1.0"]
PROGRAMS = ["bench_boundary", "bench_read_peers", "bench_fit_splines", "bench_report_way", "bench_report_program",
            "bench_openmesh_butterfly"]
GRIDS, LARGE = ["grid-1e4", "grid-1e4-shuffled", "grid-1e6", "grid-1e6-shuffled"], ["grid-1e7", "grid-1e7-shuffled"]
BANDS = "bands-1e5"


def skip(what, why):
    print(f"skipped: {what}: {why}", file=sys.stderr)


def output(what, *command):
    """The table of a program as lists of cells; its other lines as lists of words; nothing where it fails."""
    print(f"running: {what}", file=sys.stderr)
    result = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, text=True)
    if result.returncode != 0:
        skip(what, f"status {result.returncode}: {result.stdout.strip()[-200:]}")
        return []
    return [[cell.strip() for cell in line.strip("|").split("|")] if line.startswith("|") else line.split()
            for line in result.stdout.splitlines() if line.strip()]


def environment(folder):
    """A Python with as many of the peers as can be had."""
    python = folder / "bin/python"
    if not python.exists():
        subprocess.run(["python3", "-m", "venv", folder], check=True)
    for package in PACKAGES:
        command = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", package]
        if subprocess.run(command, stdout=sys.stderr).returncode != 0:
            skip(package, "cannot be installed")
    return python


def row(peer, task, size, ratio, target=None):
    print(f"| {peer} | {task} | {size} | {float(ratio):.3f} | {'' if target is None else target} |", flush=True)


def boundary_target(peer, size):
    if peer.startswith("CGAL"):
        return 0.125 if size == BANDS else 0.067
    if peer.startswith("sort all edges"):
        return None if size == BANDS or "1e4" in size else 0.125
    if peer.startswith("copy of the indices"):
        return 1.7 if "1e6" in size or "1e7" in size else None
    return 0.25 if size == BANDS else 0.1


def boundaries(programs, python, large):
    sizes = [*GRIDS, BANDS, *(LARGE if large else [])]
    for size in sizes:
        for cells in output(f"boundaries, {size}", programs / "bench_boundary", 5, size):
            if cells[0] == size and cells[1] not in ("sorted", "halfedge"):
                row(cells[1], "boundary and loops", size, 1 / float(cells[3]), boundary_target(cells[1], size))
    counts = ["1e4", "1e6", *(["1e7"] if large else [])]
    for count in counts:
        for cells in output(f"boundaries beside Python's libraries, {count}", python,
                            ROOT / "tests/bench/boundary_peers.py", programs.parents[1] / "meshcontour", 5, count):
            if cells[0][:1].isdigit() and cells[1] != "meshcontour":
                row(cells[1], "boundary and loops", cells[0], 1 / float(cells[3]), 0.1)


def reading(programs, model):
    for cells in output("reading", programs / "bench_read_peers", model, 7):
        if len(cells) == 3 and cells[0] in ("pugixml", "rapidxml", "tinyxml2"):
            row(f"{cells[0]} and from_chars", "reading", "11 MB webxml", 1 / float(cells[2]),
                0.2 if cells[0] == "tinyxml2" else 0.5)


def fits(programs, python, folder, large):
    path = folder / "splines.json"
    output("splines", programs / "bench_fit_splines", path)
    what = [] if large else ["times"]
    for cells in output("splines beside FITPACK" + " and OpenCASCADE" * large, python,
                        ROOT / "tests/bench/spline_peers.py", path, *what):
        if len(cells) == 7 and cells[1].isdigit():
            row("FITPACK, one call", f"fit, {cells[0]}", f"{cells[1]} points", cells[6], 0.2)
        if cells[:4] == ["more", "control", "points", "than"]:
            row("FITPACK or OpenCASCADE", "share of fits with more control points", f"{cells[-1]} fits",
                int(cells[-3]) / int(cells[-1]), 0)


def pictures(programs, python, model):
    for cells in output("pictures drawn the report's way", programs / "bench_report_way", model):
        if len(cells) == 6 and cells[0] in ("curves", "triangles") and cells[2] != "meshcontour":
            target = {"one GLU renderer": 0.6, "a renderer and a flush per loop": 0.1}.get(cells[2])
            row(cells[2], f"picture, {cells[0]}", cells[1], cells[5], target)
    lines = output("whole processes", python, ROOT / "tests/bench/whole_process.py", programs.parents[1], model)
    times = {cells[0]: float(cells[1]) for cells in lines if len(cells) == 4 and cells[1][:1].isdigit()}
    for peer, ours, target in (("the report's, without faces", "meshcontour, curves alone", 0.1),
                               ("the report's, with faces", "meshcontour", 0.1),
                               ("f3d, PLY", "meshcontour, PLY", 0.25), ("meshcontour", "meshcontour, cold cache", 1.3)):
        if peer in times:
            row(peer, f"whole process: {ours}", "11 MB", times[ours] / times[peer], target)


def subdivision(programs, folder):
    mesh = folder / "torus.ply"
    source = ROOT / "data/samples/swp/torus.swp"
    subprocess.run([programs.parents[1] / "meshcontour", "-q", source, "--save-mesh", mesh], check=True)
    for cells in output("subdivision", programs / "bench_openmesh_butterfly", 3, mesh):
        if len(cells) == 7 and cells[1].isdigit():
            row("OpenMesh modified butterfly", "subdivision", f"{cells[1]} triangles", cells[3])


def main():
    build, environment_folder, large = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), "--large" in sys.argv
    for program in PROGRAMS:
        command = ["cmake", "--build", build, "--target", program]
        if subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode != 0:
            skip(program, "cannot be built here")
    python = environment(environment_folder)
    programs = build.resolve() / "tests/bench"
    print("| peer | task | size | ours / peer | at most |\n|---|---|---|---:|---:|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        model = folder / "model.xml"
        subprocess.run([ROOT / "scripts/make_samples", "--size", "11MB", model], check=True, stdout=subprocess.DEVNULL)
        stages = {"bench_boundary": lambda: boundaries(programs, python, large),
                  "bench_read_peers": lambda: reading(programs, model),
                  "bench_fit_splines": lambda: fits(programs, python, folder, large),
                  "bench_report_way": lambda: pictures(programs, python, model),
                  "bench_openmesh_butterfly": lambda: subdivision(programs, folder)}
        for program, stage in stages.items():
            if (programs / program).exists():
                stage()


if __name__ == "__main__":
    main()
