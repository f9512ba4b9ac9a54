#!/usr/bin/env python3
"""Checks that includes point strictly down (app > pipeline > stages > model > base), that stages never include each
other, and that every third-party library stays in its room. Prints what breaks a rule; exit code 1 if anything does."""

import pathlib
import re
import sys

STAGES = {"read", "sweep", "multires", "boundary", "fit", "graph", "render", "write", "report"}
# What a room may include of the others' private headers, besides its own.
BELOW = {"base": set(), "model": {"base"}, "pipeline": {"base", "model"} | STAGES}
BELOW.update({stage: {"base", "model"} for stage in STAGES})
# Where a library's headers may be included: a folder or a file's beginning.
LIBRARIES = {
    r"CLI/": ["app/command_line", "app/documentation", "app/help", "app/option_group"],
    r"CGAL/|boost/": ["lib/include/meshcontour/surface_mesh.hpp", "lib/src/boundary/", "lib/src/graph/",
                      "lib/src/model/", "lib/src/multires/", "lib/src/sweep/", "tests/"],
    r"GL/|EGL/": ["lib/src/render/", "tests/bench/"],
    r"stb/|stb_|libdeflate": ["lib/src/write/png", "tests/"],
    r"tinyxml2": ["lib/src/read/", "tests/"],
    r"tbb/|oneapi/": ["lib/src/base/parallel"],
    r"nlohmann/": ["app/outcome", "lib/src/write/", "lib/src/report/", "tests/"],
    r"zstd": ["lib/src/multires/"],
    r"fmt/": ["app/", "lib/src/", "tests/"],
    r"catch2/": ["tests/"],
}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.M)


def room_of(path):
    parts = path.parts
    return parts[2] if parts[:2] == ("lib", "src") and len(parts) > 3 else None


def faults(root, path):
    relative = path.relative_to(root)
    place = relative.as_posix()
    room = room_of(relative)
    for quote, name in INCLUDE.findall(path.read_text(encoding="utf-8")):
        for pattern, allowed in LIBRARIES.items():
            if re.match(pattern, name) and not any(place.startswith(prefix) for prefix in allowed):
                yield f"{place}: {name} belongs to {', '.join(allowed)}"
        if quote != '"' or name.startswith("meshcontour/"):
            continue
        target = name.split("/")[0] if "/" in name else room
        private = (root / "lib/src" / name).exists()
        if place.startswith("app/") and private:
            yield f"{place}: {name} is private to the library"
        if place.startswith("lib/include/"):
            yield f"{place}: a public header includes the private {name}"
        if room and private and target != room and target not in BELOW.get(room, set()):
            yield f"{place}: {room} must not include {name}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    sources = [p for folder in ("app", "lib", "tests") for p in sorted((root / folder).rglob("*.[ch]pp"))]
    found = [fault for path in sources for fault in faults(root, path)]
    print("\n".join(found) if found else f"{len(sources)} files, every include points down")
    return 1 if found or not sources else 0


if __name__ == "__main__":
    sys.exit(main())
