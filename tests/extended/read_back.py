#!/usr/bin/env python3
"""Exports models with export_all into a folder that is removed afterwards, and checks what other programs read.
Usage: read_back.py EXPORT_ALL [FILE or FOLDER]...; without files, models made by export_all itself. Of a folder its
models are read, .xz files are unpacked first. Files are checked by a process a processor. Exit code 77: the folders are
absent or hold none."""

import concurrent.futures
import contextlib
import io
import lzma
import pathlib
import shutil
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
    """Whether it failed, and what is to be printed."""
    plain = unpacked(file, work)
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        done = subprocess.run([program, work / "out", plain], capture_output=True, text=True)
        if done.returncode != 0:
            print(f"{plain.name}: not exported: {done.stderr.strip()}")
        failed = done.returncode != 0 or check_exports.main([work / "out" / plain.stem]) != 0
    if plain != file:
        plain.unlink()
    shutil.rmtree(work / "out" / plain.stem, ignore_errors=True)
    return failed, text.getvalue()


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
        failures = 0
        with concurrent.futures.ProcessPoolExecutor() as pool:
            checks = [pool.submit(check_file, program, file, work) for file in files]
            for check in checks:
                failed, text = check.result()
                failures += failed
                print(text, end="", flush=True)
        print(f"{len(files)} models, {failures} of them read back differently")
        return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
