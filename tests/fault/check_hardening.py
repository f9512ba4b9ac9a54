#!/usr/bin/env python3
"""Checks that a program was linked and compiled with the hardening of release builds.

Usage: check_hardening.py PROGRAM. Exit code 77 without readelf."""

import shutil
import subprocess
import sys


def readelf(option, program):
    return subprocess.run(["readelf", option, "-W", program], check=True, capture_output=True, text=True).stdout


def main(program):
    if shutil.which("readelf") is None:
        print("readelf is not there")
        return 77
    segments = [line.split() for line in readelf("-l", program).splitlines()]
    stack = [line for line in segments if line[:1] == ["GNU_STACK"]]
    checks = {
        "can be moved to any address": " DYN " in readelf("-h", program),
        "address tables are read-only": any(line[:1] == ["GNU_RELRO"] for line in segments),
        "addresses are resolved at the start": "NOW" in readelf("-d", program),
        "the stack holds no code": len(stack) == 1 and "E" not in stack[0][6],
        "the stack is guarded": "__stack_chk_fail" in readelf("-s", program),
        "sizes of copies are checked": "_chk@" in readelf("-s", program).replace("__stack_chk", ""),
        "indices are checked": "__glibcxx_assert_fail" in readelf("-s", program),
    }
    for what, holds in checks.items():
        print(f"{what}: {'yes' if holds else 'NO'}")
    return 0 if all(checks.values()) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
