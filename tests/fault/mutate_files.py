#!/usr/bin/env python3
"""Cuts and changes small samples of every format and checks that the program refuses or reads each of them: never a
signal, an internal error or a hang.

Usage: mutate_files.py PROGRAM SAMPLES [COUNT [SEED]]: COUNT prefixes, spread evenly, and COUNT files with some bits
flipped, bytes changed, a stretch cut out or doubled, for each sample. SAMPLES is the folder of stud.xml."""

import collections
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

DOCUMENTED = {0, 65, 71}  # exit codes: read, refused, beyond a limit
CHUNK = 250               # files in one batch


def collect(program, samples, work):
    """A sample of every format: the mesh formats as the program writes them."""
    small = samples / "assembly/shell_id32.xml"
    paths = [samples / "stud.xml", small, *sorted((samples / "samples/swp").glob("*.swp"))]
    for kind in ("stl", "obj", "ply", "off", "net"):
        for text in ([], ["--mesh-text"]) if kind in ("stl", "ply") else ([],):
            path = work / f"mesh{len(text)}.{kind}"
            subprocess.run([program, "-q", small, "--save-mesh", path, *text], check=True)
            paths.append(path)
    stream = work / "stream.mcw"
    subprocess.run([program, "-q", work / "mesh0.off", "--subdivide", "1", "--save-wavelet", stream], check=True)
    return [*paths, stream]


def prefixes(content, count):
    for k in range(count):
        yield content[:k * len(content) // count]


def mutations(content, count, generator):
    for _ in range(count):
        changed = bytearray(content)
        kind = generator.randrange(4)
        place = generator.randrange(len(changed))
        length = generator.randrange(1, 1 + min(64, len(changed) - place))
        if kind == 0:
            for _ in range(generator.randrange(1, 9)):
                changed[generator.randrange(len(changed))] ^= 1 << generator.randrange(8)
        elif kind == 1:
            changed[place:place + length] = generator.randbytes(length)
        elif kind == 2:
            del changed[place:place + length]
        else:
            changed[place:place] = changed[place:place + length]
        yield bytes(changed)


def run(program, files, folder):
    """Runs one batch; gives the exit code and message of every file."""
    report = folder / "report.json"
    options = ["-q", "-j", "2", "--timeout", "60", "--max-memory", "4GB", "--max-triangles", "1000000"]
    subprocess.run([program, *options, *files, "-o", folder / "{stem}.csv", "--report", f"json:{report}"],
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
    for line in report.read_text().splitlines():
        record = json.loads(line)
        yield pathlib.Path(record["file"]), record["exit_code"], record.get("message", "")


def chunks(items, size):
    chunk = []
    for item in items:
        chunk.append(item)
        if len(chunk) == size:
            yield chunk
            chunk = []
    if chunk:
        yield chunk


def main(program, samples, count="10", seed="1"):
    program, count = os.path.abspath(program), int(count)
    generator, codes, failures = random.Random(int(seed)), collections.Counter(), 0
    with tempfile.TemporaryDirectory() as name:
        paths = collect(program, pathlib.Path(samples), pathlib.Path(name))
        for path in paths:
            content = path.read_bytes()
            changed = [*prefixes(content, count), *mutations(content, count, generator)]
            for chunk in chunks(changed, CHUNK):
                with tempfile.TemporaryDirectory() as work:
                    files = [pathlib.Path(work) / f"{k:04}{path.suffix}" for k in range(len(chunk))]
                    for file, bytes_of_file in zip(files, chunk):
                        file.write_bytes(bytes_of_file)
                    for file, code, message in run(program, files, pathlib.Path(work)):
                        codes[code] += 1
                        if code not in DOCUMENTED:
                            failures += 1
                            kept = pathlib.Path(tempfile.gettempdir()) / f"mutated-{failures}{path.suffix}"
                            kept.write_bytes(file.read_bytes())
                            print(f"{path.name}, kept as {kept}: exit code {code}: {message}")
    print(f"{len(paths)} samples, {sum(codes.values())} files, exit codes {dict(sorted(codes.items()))}, "
          f"{failures} failures")
    return 1 if failures or not codes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
