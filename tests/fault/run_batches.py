#!/usr/bin/env python3
"""Runs batches as servers do and checks what is promised of them:

load    every file gives its result in two workers whose memory is limited to 1 GB each, and memory stays flat;
broken  of 1 % broken files of every class each is named with its reason, all others are done, the exit code is 1;
kill    a batch that is killed ten times and resumed has the same outputs as one that ran through.

Usage: run_batches.py PROGRAM [LOAD_FILES [BROKEN_FILES [KILL_FILES]]]"""

import hashlib
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

from small_models import broken, square_grid

GIGABYTE = 1 << 30
SLICES = 10


def make_inputs(folder, count, side):
    folder.mkdir()
    for number in range(count):
        (folder / f"part{number:05}.xml").write_text(square_grid(number, side(number)))


def digest(folder):
    """Names and contents of the outputs."""
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(folder.iterdir())
            if not path.name.startswith(".")}


def resident_megabytes(pid):
    """Of a process and its children."""
    total = 0
    for process in [str(pid), *pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]:
        try:
            status = pathlib.Path(f"/proc/{process}/status").read_text()
        except OSError:
            continue  # it has ended meanwhile
        total += sum(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS:")) / 1024
    return total


def watch(process):
    """Memory over time until the process ends, in megabytes."""
    samples = []
    while process.poll() is None:
        try:
            samples.append(resident_megabytes(process.pid))
        except OSError:
            break
        time.sleep(0.02)
    return samples


def load(program, work, count):
    make_inputs(work / "in", count, lambda number: 10 + number % 30)
    (work / "out").mkdir()
    limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (GIGABYTE, GIGABYTE))  # of each process
    start = time.monotonic()
    process = subprocess.Popen([program, "-q", "in", "-o", "out/{stem}.csv", "-o", "out/{stem}.step", "-j", "2"],
                               cwd=work, preexec_fn=limit)
    samples = watch(process)
    seconds = time.monotonic() - start
    peaks = [max(samples[k * len(samples) // SLICES:(k + 1) * len(samples) // SLICES] or [0]) for k in range(SLICES)]
    print(f"load: {count} files in {seconds:.1f} s; largest resident MB in each tenth of that: "
          + " ".join(f"{peak:.0f}" for peak in peaks))
    wrong = [] if process.returncode == 0 else [f"exit code {process.returncode}"]
    outputs = len(list((work / "out").iterdir()))
    if outputs != 2 * count:
        wrong.append(f"{outputs} outputs for {count} files")
    half = peaks[:SLICES // 2]
    if len(samples) >= 10 * SLICES and max(peaks[SLICES // 2:]) > 1.25 * max(half) + 4:
        wrong.append("memory grows")
    return wrong


def bad_batch(program, work, count):
    make_inputs(work / "in", count, lambda number: 2 + number % 8)
    names = {}
    for name, content in broken(square_grid(1, 3)).items():
        for number in range(max(1, count // 100)):
            path = work / "in" / f"part{number * 97 % count:05}-{name}.xml"
            path.write_bytes(content)
            names[path.name] = content
    (work / "in" / "part00000-gone.xml").symlink_to("nowhere")
    names["part00000-gone.xml"] = None
    (work / "out").mkdir()
    done = subprocess.run([program, "in", "-o", "out/{stem}.csv", "-j", "2"], cwd=work, stderr=subprocess.PIPE,
                          stdin=subprocess.DEVNULL, text=True)
    lines = done.stderr.splitlines()
    wrong = [] if done.returncode == 1 else [f"exit code {done.returncode}"]
    wrong += [f"{name} is not named" for name in names if not any(f"in/{name}" in line for line in lines)]
    outputs = {path.stem for path in (work / "out").iterdir()}
    expected = {path.stem for path in (work / "in").iterdir() if path.name not in names}
    wrong += [f"no output for {stem}" for stem in sorted(expected - outputs)]
    wrong += [f"an output for the broken {stem}" for stem in sorted(outputs - expected)]
    print(f"broken: {count} good files and {len(names)} broken ones; {lines[-1]}")
    return wrong


def kill(program, work, count):
    make_inputs(work / "in", count, lambda number: 4 + number % 20)
    for folder in ("clean", "out"):
        (work / folder).mkdir()
    command = [program, "-q", "in", "-j", "2"]
    start = time.monotonic()
    subprocess.run([*command, "-o", "clean/{stem}.csv"], cwd=work, check=True)
    seconds = time.monotonic() - start
    resumed = [*command, "-o", "out/{stem}.csv", "--resume", "journal"]
    reached = []
    for attempt in range(10):
        process = subprocess.Popen(resumed, cwd=work)
        time.sleep(seconds * (0.05 + 0.013 * attempt))
        process.kill()
        process.wait()
        reached.append(len(digest(work / "out")))
    time.sleep(0.5)  # workers end with their parent
    litter = len([path for path in (work / "out").iterdir() if path.name.startswith(".")])
    code = subprocess.run(resumed, cwd=work).returncode
    print(f"kill: outputs after each of ten kills {reached} of {count}, {litter} temporaries left by them")
    wrong = [] if code == 0 else [f"exit code {code}"]
    if digest(work / "out") != digest(work / "clean"):
        wrong.append("other outputs than of a run without kills")
    return wrong


def main(program, *counts):
    program = os.path.abspath(program)
    counts = [int(count) for count in counts] + [40, 60, 60][len(counts):]
    failures = []
    for run, count in zip((load, bad_batch, kill), counts):
        with tempfile.TemporaryDirectory() as name:
            failures += [f"{run.__name__}: {wrong}" for wrong in run(program, pathlib.Path(name), count)]
    print("\n".join(failures[:50]) or "all as promised")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
