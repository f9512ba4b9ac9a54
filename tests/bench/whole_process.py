#!/usr/bin/env python3
"""Times whole runs that make a picture of 500 x 500 pixels, in turn: processor seconds of each process with all its
threads, medians, as multiples of ours.

    tests/bench/whole_process.py BUILD MODEL.xml [ROUNDS]

BUILD is a build folder with bench_report_program. f3d is timed, too, where Python finds it, with and without the start
of its Python; it and our second row get the model as PLY. The last rows: a cold cache of shaders, and no picture."""

import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

F3D = """import sys, f3d
engine = f3d.Engine.create_osmesa()
engine.window.size = (500, 500)
engine.scene.add(sys.argv[1])
engine.window.render_to_image().save(sys.argv[2])
"""


def seconds(command, environment):
    pid = os.posix_spawn(command[0], command, os.environ | environment,
                         file_actions=[(os.POSIX_SPAWN_OPEN, out, os.devnull, os.O_WRONLY, 0) for out in (1, 2)])
    _, status, usage = os.wait4(pid, 0)
    if status != 0:
        sys.exit(f"{command}: status {status}")
    return usage.ru_utime + usage.ru_stime


def contenders(build, model, folder):
    ours, report = build / "meshcontour", build / "tests/bench/bench_report_program"
    ply = folder / "model.ply"
    subprocess.run([ours, "-q", model, "--save-mesh", ply], check=True)
    size = ["--size", "500x500"]
    yield "meshcontour", [ours, "-q", model, "-o", folder / "ours.png", *size], {}
    yield "meshcontour, cold cache", [ours, "-q", model, "-o", folder / "cold.png", *size], {"COLD": "1"}
    yield "meshcontour, curves alone", [ours, "-q", model, "-o", folder / "c.png", "--layers", "edges,curves", *size], {}
    yield "meshcontour, PLY", [ours, "-q", ply, "-o", folder / "ply.png", *size], {}
    yield "meshcontour, PLY, faces alone", [ours, "-q", ply, "-o", folder / "faces.png", "--layers", "mesh", *size], {}
    yield "meshcontour, table only", [ours, "-q", model, "-o", folder / "ours.csv"], {}
    yield "the report's, without faces", [report, model, folder / "report.png"], {}
    yield "the report's, with faces", [report, model, folder / "faces-report.png", "faces"], {}
    if subprocess.run([sys.executable, "-c", "import f3d"], stderr=subprocess.DEVNULL).returncode == 0:
        yield "f3d, PLY", [sys.executable, "-c", F3D, ply, folder / "f3d.png"], {}
        yield "f3d, its start alone", [sys.executable, "-c", "import f3d"], {}


def main():
    build, model = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 5
    with tempfile.TemporaryDirectory() as name:
        folder, times = pathlib.Path(name), {}
        runs = list(contenders(build, model, folder))
        for turn in range(rounds + 1):
            for title, command, settings in runs:
                cache = folder / ("cold" if settings else "warm")
                shutil.rmtree(folder / "cold", ignore_errors=True)
                cache.mkdir(exist_ok=True)
                taken = seconds([str(part) for part in command], {"MESA_SHADER_CACHE_DIR": str(cache)})
                if turn > 0:
                    times.setdefault(title, []).append(taken)
        ours = statistics.median(times["meshcontour"])
        print("| run | processor seconds | least | / ours |\n|---|---:|---:|---:|")
        for title, taken in times.items():
            middle = statistics.median(taken)
            print(f"| {title} | {middle:.3f} | {min(taken):.3f} | {middle / ours:.2f} |")


if __name__ == "__main__":
    main()
