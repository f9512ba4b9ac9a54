#!/usr/bin/env python3
"""Exports models with export_all into a folder that is removed afterwards, and checks what other programs read.
Usage: read_back.py EXPORT_ALL [FILE or FOLDER]...; without files, models made by export_all itself. Of a folder its
models are read, .xz files are unpacked first. Exit code 77: the folders are absent or hold none."""

import lzma
import pathlib
import subprocess
import sys
import tempfile

import check_exports

SUFFIXES = {".xml", ".swp", ".stl", ".obj", ".ply", ".off"}
SKIPPED = 77


def models(names):
    for path in map(pathlib.Path, names):
        if path.is_file():
            yield path
        elif path.is_dir():
            yield from (file for file in sorted(path.iterdir()) if pathlib.Path(file.name.removesuffix(".xz")).suffix in SUFFIXES)


def unpacked(file, folder):
    if file.suffix != ".xz":
        return file
    out = folder / file.stem
    out.write_bytes(lzma.open(file).read())
    return out


def check_file(program, file, work):
    plain = unpacked(file, work)
    subprocess.run([program, work / "out", plain], check=True)
    status = check_exports.main([work / "out" / plain.stem])
    if plain != file:
        plain.unlink()
    return status


def main(program, *names):
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        if not names:
            subprocess.run([program, work], check=True)
            return check_exports.main(sorted(work.iterdir()))
        files = list(models(names))
        if not files:
            print("skipped: no models in", *names)
            return SKIPPED
        return max([check_file(program, file, work) for file in files])


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
