#!/usr/bin/env python3
"""Exports models with export_all into a folder that is removed afterwards, and checks what other programs read.
Usage: read_back.py EXPORT_ALL [FILE...]; .xz files are unpacked first."""

import lzma
import pathlib
import subprocess
import sys
import tempfile

import check_exports


def unpacked(file, folder):
    if file.suffix != ".xz":
        return file
    out = folder / file.stem
    out.write_bytes(lzma.open(file).read())
    return out


def main(program, *files):
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        if not files:
            subprocess.run([program, work / "sample"], check=True)
            return check_exports.main([work / "sample"])
        status = 0
        for file in map(pathlib.Path, files):
            plain = unpacked(file, work)
            subprocess.run([program, work / "out", plain], check=True)
            status |= check_exports.main([work / "out" / plain.stem])
        return status


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
