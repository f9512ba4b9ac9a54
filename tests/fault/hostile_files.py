#!/usr/bin/env python3
"""Runs the program on every broken and odd file of a folder with an EXPECT.md and checks that its outcome is one of
those listed there, the counts it states, the limits of time and memory, and that the outputs are finite and the same
in every run.

Usage: hostile_files.py PROGRAM FOLDER [SECONDS [MEGABYTES]]; 0 is no limit. Exit code 77 without the folder."""

import hashlib
import itertools
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

FAILED = {65, 66, 71}  # exit codes of a file that is refused
# A million placed shells: legal, and drawn; not written as geometry, which would be gigabytes.
LARGE = {"d09_million_instances.xml": (20, 1)}  # times the limits of processor seconds and megabytes
OUTPUTS = ["out.png", "out.csv", "out.json"]
MORE_OUTPUTS = ["out.csv", "out.json", "out.obj", "out.step", "out.dxf", "out.svg", "out.ply"]
NOT_FINITE = re.compile(rb"(?<![\w./-])[-+]?(nan|inf|infinity)(?![\w./-])", re.IGNORECASE)
TEXTS = {".csv", ".json", ".obj", ".step", ".dxf", ".svg"}
HANG = 300  # seconds


def expectations(text):
    """Name, allowed outcomes and what is said of the result, for each row of the tables about files."""
    for line in text.splitlines():
        cells = [cell.replace("\\|", "|").strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if len(cells) >= 4 and cells[0].endswith(".xml") and re.fullmatch(r"(OK|WARN|ERR)(\|(OK|WARN|ERR))*", cells[2]):
            yield cells[0], cells[2].split("|"), cells[3]


class Run:
    """One run of the program: exit code, messages, processor seconds and peak megabytes."""

    def __init__(self, program, source, folder, outputs):
        command = [program, str(source)]
        for name in outputs:
            command += ["--save-mesh" if name.endswith(".ply") else "-o", str(folder / name)]
        with open(folder / "messages", "wb+") as messages:
            child = subprocess.Popen(command, stdout=messages, stderr=messages, stdin=subprocess.DEVNULL)
            status, usage = self.wait(child.pid)
            child.returncode = 0  # it has been waited for
            messages.seek(0)
            self.messages = messages.read().decode(errors="replace")
        self.code = os.waitstatus_to_exitcode(status)
        self.seconds = usage.ru_utime + usage.ru_stime
        self.megabytes = usage.ru_maxrss / 1024
        self.outputs = {name: self.digest(folder / name) for name in outputs if (folder / name).exists()}
        self.head = self.first_lines(folder / "out.json") if self.code == 0 else ""

    @staticmethod
    def first_lines(path):
        with open(path, errors="replace") as file:
            return "".join(itertools.islice(file, 3))

    # Outputs are not held: what this process takes counts as the child's too.
    @staticmethod
    def digest(path):
        whole, finite, text = hashlib.sha256(), True, path.suffix in TEXTS
        with open(path, "rb") as file:
            for line in file if text else iter(lambda: file.read(1 << 20), b""):
                whole.update(line)
                finite = finite and not (text and NOT_FINITE.search(line))
        return whole.hexdigest(), finite

    @staticmethod
    def wait(pid):
        end = time.monotonic() + HANG
        while time.monotonic() < end:
            done, status, usage = os.wait4(pid, os.WNOHANG)
            if done:
                return status, usage
            time.sleep(0.005)
        os.kill(pid, signal.SIGKILL)
        return os.wait4(pid, 0)[1:]

    def outcome(self):
        if self.code == 0:
            return "WARN" if ": warning: " in self.messages else "OK"
        return "ERR" if self.code in FAILED else f"exit code {self.code}"


def wrong_counts(said, counts):
    """What the expectation says and the result does not."""
    if re.search(r"after welding|\bor\b|other counted|one cube drawn|empty patch", said):
        return []  # several results are right
    patterns = {"vertices": r"\bV (\d+)", "triangles": r"\bF (\d+)", "patches": r"\b(\d+) patch(?:es)?\b",
                "loops": r"\b(\d+) loops? of \d+ edges"}
    wrong = []
    for name, pattern in patterns.items():
        found = re.search(pattern, said)
        if found and not (name == "vertices" and "isolated" in said) and counts[name] != int(found[1]):
            wrong.append(f"{counts[name]} {name}, not {found[1]}")
    return wrong


def check_run(run, allowed, said, limits):
    """What is wrong with one run of a file; empty if nothing."""
    wrong = [] if run.outcome() in allowed else [f"{run.outcome()} where {'|'.join(allowed)} is expected"]
    if limits[0] and run.seconds > limits[0]:
        wrong.append(f"{run.seconds:.1f} s")
    if limits[1] and run.megabytes > limits[1]:
        wrong.append(f"{run.megabytes:.0f} MB")
    if "Sanitizer" in run.messages or "runtime error" in run.messages:
        wrong.append("a sanitizer's report")
    if run.code != 0:
        if run.outputs:
            wrong.append("outputs in spite of an error")
        if not 1 <= run.messages.count("\n") <= 4:
            wrong.append(f"{run.messages.count(chr(10))} lines of messages")
        return wrong
    wrong += [f"{output} is not finite" for output, (_, finite) in run.outputs.items() if not finite]
    counts = {}
    for name, count in re.findall(r'"(\w+)":(\d+)', run.head):
        counts.setdefault(name, int(count))
    return wrong + wrong_counts(said, counts)


def differences(run, again):
    return [f"{output} differs between runs" for output in run.outputs.keys() & again.outputs.keys()
            if run.outputs[output] != again.outputs[output]]


def main(program, folder, *limits):
    expected = pathlib.Path(folder) / "EXPECT.md"
    if not expected.exists():
        print(f"{expected} is not there")
        return 77
    limits = [float(limit) for limit in (*limits, *("0",) * 2)][:2]
    files, failures, slowest, largest = 0, 0, (0, ""), (0, "")
    for name, allowed, said in expectations(expected.read_text()):
        source = expected.parent / name
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as two:
            run = Run(program, source, pathlib.Path(one), OUTPUTS)
            again = Run(program, source, pathlib.Path(two), OUTPUTS[1:] if name in LARGE else MORE_OUTPUTS)
        files += 1
        if name not in LARGE:
            slowest, largest = max(slowest, (run.seconds, name)), max(largest, (run.megabytes, name))
        own_limits = [limit * times for limit, times in zip(limits, LARGE.get(name, (1, 1)))]
        for wrong in [*check_run(run, allowed, said, own_limits), *check_run(again, allowed, said, own_limits),
                      *differences(run, again)]:
            failures += 1
            print(f"{name}: {wrong}\n    {run.messages[:1000] + again.messages[:1000]}".rstrip())
    print(f"{files} files, {failures} failures; slowest {slowest[0]:.2f} s {slowest[1]}, "
          f"largest {largest[0]:.0f} MB {largest[1]}")
    return 1 if failures or files == 0 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
