#!/usr/bin/env python3
"""Runs the program again and again while a system call fails or a signal arrives somewhere, and checks that every
output is absent, old or complete, that outputs change together or not at all, and that no temporary is left.

Usage: inject_faults.py PROGRAM [RUNS]. Exit code 77 where system calls cannot be traced."""

import collections
import itertools
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

CODES = {0, 1, 64, 65, 66, 69, 70, 71, 73, 74, 75, 126, 127, 129, 130, 137, 143}
ERRORS = {
    "write": ["ENOSPC", "EIO", "EINTR", "EDQUOT"],
    "fsync": ["EIO", "ENOSPC"],
    "openat": ["EMFILE", "EACCES", "ENOSPC", "EIO"],
    "linkat": ["EIO", "EACCES", "ENOENT"],
    "renameat2": ["EIO", "EACCES", "EINVAL"],
    "renameat": ["EIO", "EACCES"],
    "rename": ["EIO"],
    "fchmod": ["EPERM"],
    "close": ["EIO"],
    "newfstatat": ["EIO"],
}
SIGNALS = ["SIGTERM", "SIGINT", "SIGHUP", "SIGKILL"]
OUTPUTS = ["a.json", "b.csv", "c.obj"]
OLD = "what was there before\n"


def make_input(folder):
    """A square of two triangles in a format that needs nothing else."""
    path = folder / "in.off"
    path.write_text("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n")
    return path


def faults(generator):
    """An endless choice of strace's inject expressions, each with the nth call it hits."""
    while True:
        call = generator.choice([*ERRORS, "unlinkat"])  # a file that cannot be removed stays
        nth = generator.randint(1, 40 if call in ("openat", "newfstatat", "close") else 6)
        if call in ERRORS and generator.random() < 0.5:
            yield f"{call}:error={generator.choice(ERRORS[call])}:when={nth}", None
        else:
            signal = generator.choice(SIGNALS)
            yield f"{call}:signal={signal}:when={nth}", signal


def run(program, source, folder, inject):
    command = ["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"trace={inject.split(':')[0]}", "-e", f"inject={inject}",
               program, "-q", str(source)]
    for name in OUTPUTS:
        command += ["-o", str(folder / name)]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=60)
    return done.returncode if done.returncode >= 0 else 128 - done.returncode


def check(folder, code, signal, new):
    """What is wrong with the folder after a run; empty if nothing."""
    faults_found = []
    states = []
    for name in OUTPUTS:
        path = folder / name
        text = path.read_text() if path.exists() else None
        state = "new" if text == new[name] else "old" if text == (OLD if name == "a.json" else None) else "broken"
        states.append(state)
    if "broken" in states:
        faults_found.append(f"outputs {states}")
    elif len(set(states)) > 1 and signal != "SIGKILL":
        faults_found.append(f"outputs changed apart: {states}")
    if code == 0 and set(states) != {"new"}:
        faults_found.append(f"exit code 0 with outputs {states}")
    litter = [p.name for p in folder.iterdir() if p.name.startswith(".meshcontour")]
    if litter and signal != "SIGKILL":
        faults_found.append(f"left behind: {litter}")
    if code not in CODES:
        faults_found.append(f"exit code {code}")
    return faults_found


def main(program, runs="100"):
    if shutil.which("strace") is None:
        print("strace is not installed")
        return 77
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        source = make_input(work)
        clean = work / "clean"
        clean.mkdir()
        if run(program, source, clean, "write:error=EIO:when=60000") != 0:
            print("the program cannot be traced here")
            return 77
        new = {name: (clean / name).read_text() for name in OUTPUTS}
        outcomes, failures = collections.Counter(), 0
        for number, (inject, signal) in enumerate(itertools.islice(faults(random.Random(1)), int(runs))):
            folder = work / f"run{number}"
            folder.mkdir()
            (folder / "a.json").write_text(OLD)
            code = run(program, source, folder, inject)
            outcomes[code] += 1
            for fault in check(folder, code, signal, new):
                failures += 1
                print(f"{inject}: {fault} (exit code {code})")
            shutil.rmtree(folder)
        print(f"{runs} runs, exit codes {dict(sorted(outcomes.items()))}, {failures} failures")
        return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
