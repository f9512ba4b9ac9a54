#!/usr/bin/env python3
"""Runs the program where memory is short, beside others that write the same files, while its input is replaced, for a
reader who goes away, and with its inputs in another order, and checks that each result is complete or absent, and the same.

Usage: run_conditions.py PROGRAM MODEL"""

import contextlib
import itertools
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import threading

MEGABYTE = 1 << 20
TABLES = ["-o", "a.csv", "-o", "a.step", "-o", "a.obj"]
PICTURE = ["-o", "a.png", "--layers", "mesh,edges,curves", "--size", "320x240"]
NO_RENDERER, NO_MEMORY = 69, 71


def run(program, folder, *arguments, **options):
    return subprocess.run([program, "-q", *map(str, arguments)], cwd=folder, stdin=subprocess.DEVNULL,
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, timeout=120, **options)


def contents(folder):
    return {file.name: file.read_bytes() for file in pathlib.Path(folder).iterdir()}


def expect(program, *arguments):
    with tempfile.TemporaryDirectory() as folder:
        run(program, folder, *arguments, check=True)
        return contents(folder)


@contextlib.contextmanager
def meanwhile(change):
    """Calls a function with 0, 1, 2, ... in a thread as long as the block runs."""
    stop = threading.Event()

    def repeat():
        for number in itertools.count():
            if stop.is_set():
                return
            change(number)

    changing = threading.Thread(target=repeat)
    changing.start()
    try:
        yield
    finally:
        stop.set()
        changing.join()


def short_memory(program, model):
    """Every amount of address space gives all outputs, or none and a reason; never a signal."""
    for outputs in (TABLES, PICTURE):
        expected = expect(program, model, *outputs)
        for megabytes in (24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024, 2048):
            limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes * MEGABYTE,) * 2)
            with tempfile.TemporaryDirectory() as folder:
                done = run(program, folder, model, *outputs, preexec_fn=limit)
                good = done.returncode == 0 and contents(folder) == expected
                refused = done.returncode in (NO_RENDERER, NO_MEMORY) and not contents(folder) and done.stderr.strip()
                if not (good or refused):
                    yield f"{megabytes} MB: exit code {done.returncode}, {sorted(contents(folder))}, {done.stderr[:300]}"


def company(program, model):
    """Eight runs that write the same files at once leave them complete and nothing else."""
    expected = expect(program, model, *TABLES)
    with tempfile.TemporaryDirectory() as folder:
        runs = [subprocess.Popen([program, "-q", model, *TABLES], cwd=folder, stdin=subprocess.DEVNULL) for _ in range(8)]
        codes = [one.wait(120) for one in runs]
        if any(codes) or contents(folder) != expected:
            yield f"exit codes {codes}, {sorted(contents(folder))}"


def replaced_input(program, model):
    """While the input is replaced again and again, each run has read the old file or the new one."""
    grid = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"
    files = [grid, grid.replace("1 1 0", "2 2 0")]
    with tempfile.TemporaryDirectory() as work:
        source = pathlib.Path(work, "in.off")
        expected = []
        for text in files:
            source.write_text(text)
            expected.append(expect(program, source, *TABLES))

        def replace(number):
            fresh = pathlib.Path(work, "fresh.off")
            fresh.write_text(files[number % 2])
            fresh.rename(source)

        with meanwhile(replace):
            for _ in range(40):
                with tempfile.TemporaryDirectory() as folder:
                    done = run(program, folder, source, *TABLES)
                    if done.returncode != 0 or contents(folder) not in expected:
                        yield f"exit code {done.returncode}: {done.stderr[:300]}"


def shrinking_input(program, model):
    """An input that is cut while it is read gives a result or a refusal, never a signal."""
    content = pathlib.Path(model).read_bytes()
    with tempfile.TemporaryDirectory() as work:
        source = pathlib.Path(work, "in" + pathlib.Path(model).suffix)
        source.write_bytes(content)

        def cut(_):
            os.truncate(source, len(content) // 3)
            source.write_bytes(content)

        with meanwhile(cut):
            for _ in range(40):
                with tempfile.TemporaryDirectory() as folder:
                    done = run(program, folder, source, *TABLES)
                    if done.returncode not in (0, 65, 66) or (done.returncode != 0 and contents(folder)):
                        yield f"exit code {done.returncode}: {done.stderr[:300]}"


def closed_pipe(program, model):
    """A reader who goes away ends the run with the code of failed writing and a message."""
    for kind in ("csv", "obj", "step"):
        command = [program, model, "-o", "-", "--format", kind]
        done = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)
        done.stdout.close()
        message = done.stderr.read().decode()
        if done.wait(120) != 74 or not message.startswith("meshcontour: "):
            yield f"{kind}: exit code {done.returncode}, {message[:300]}"


def order_of_inputs(program, model):
    """The same files in another order, by other numbers of workers, have the same outputs."""
    with tempfile.TemporaryDirectory() as work:
        sources = []
        for number in range(6):
            sources.append(pathlib.Path(work, f"part{number}.off"))
            sources[-1].write_text(f"OFF\n3 1 0\n0 0 0\n{number + 1} 0 0\n0 1 0\n3 0 1 2\n")
        expected = expect(program, *sources, "-o", "{stem}.csv", "-o", "{stem}.step")
        for order, workers in ((sources[::-1], 1), (sources[3:] + sources[:3], 2), (sources[::-1], 5)):
            if expect(program, *order, "-o", "{stem}.csv", "-o", "{stem}.step", "-j", workers) != expected:
                yield f"{[source.name for source in order]} by {workers} workers"


def main(program, model):
    program, model, failures = os.path.abspath(program), os.path.abspath(model), 0
    for check in (short_memory, company, replaced_input, shrinking_input, closed_pipe, order_of_inputs):
        for failure in check(program, model):
            failures += 1
            print(f"{check.__name__}: {failure}")
        print(f"{check.__name__}: done")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
