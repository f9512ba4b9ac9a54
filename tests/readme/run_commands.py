#!/usr/bin/env python3
"""Runs every command of the README that starts with `meshcontour`, in a folder that has the files it names, and checks
that it succeeds and writes what it says.

    run_commands.py ROOT PROGRAM"""

import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile


def prepare(folder, root):
    shutil.copytree(root / "data", folder / "data")
    (folder / "parts").mkdir()
    (folder / "out").mkdir()
    for name in ("in.xml", "parts/first.xml", "parts/second.xml"):
        shutil.copy(root / "data/stud.xml", folder / name)


def outputs(words, folder):
    names = [words[i + 1] for i, word in enumerate(words[:-1]) if word in ("-o", "--save-mesh", "--report")]
    views = dict(zip(words, words[1:])).get("--view", "iso").split(",")
    for name in names:
        name = name.split(":", 1)[-1]
        yield from [name.format(stem=stem, dir="parts", n=n, view=view)
                    for n, stem in ((1, "first"), (2, "second")) for view in views]


def main():
    root, program = pathlib.Path(sys.argv[1]), sys.argv[2]
    commands = re.findall(r"^    (meshcontour .+)$", (root / "README.md").read_text(), re.M)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        prepare(folder, root)
        for command in commands:
            words = shlex.split(command)
            done = subprocess.run(["bash", "-c", "set -- " + command + '; shift; exec "$0" "$@"', program], cwd=folder,
                                  capture_output=True, text=True)
            missing = [output for output in outputs(words, folder) if not (folder / output).exists()]
            print(f"{done.returncode} {command}")
            if done.returncode != 0 or missing:
                print(done.stderr, *missing, sep="\n")
                return 1
    return 0 if commands else 1


if __name__ == "__main__":
    sys.exit(main())
