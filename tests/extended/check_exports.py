#!/usr/bin/env python3
"""Reads the exports of folders back and compares them with its model.json; prints a line a file, fails on the first
difference. Usage: check_exports.py FOLDER..."""

import pathlib
import sys

import numpy as np
from scipy.spatial import cKDTree

import expected as truth
import readers

TIGHT = 1e-9


class Difference(Exception):
    pass


def require(holds, message):
    if not holds:
        raise Difference(message)


def close(a, b, size, tolerance=TIGHT):
    return np.abs(np.asarray(a) - np.asarray(b)).max() <= tolerance * size


def same_points(found, wanted, size):
    """In one direction or the other."""
    return close(found, wanted, size) or close(found[::-1], wanted, size)


def compare_segment(found, wanted, size, name):
    require(found.kind == wanted.kind, f"{name}: {found.kind} instead of {wanted.kind}")
    if found.length > 0:
        require(abs(found.length - wanted.length) <= TIGHT * size, f"{name}: length {found.length!r}, not {wanted.length!r}")
    require(abs(found.radius - wanted.radius) <= TIGHT * size, f"{name}: radius {found.radius!r}, not {wanted.radius!r}")
    if wanted.full:
        require(found.full and close(found.center, wanted.center, size), f"{name}: another centre, or not whole")
        off = cKDTree(wanted.dense).query(found.points)[0].max()
        require(off <= wanted.length / 32, f"{name}: runs elsewhere")
    else:
        require(same_points(found.points, wanted.points, size), f"{name}: runs elsewhere")


def compare_loop(found, wanted, size):
    require(found.closed == wanted.closed, f"{wanted.name}: closed {found.closed}, not {wanted.closed}")
    if wanted.polygon is not None:
        polygon = found.polygon if found.polygon is not None else found.segments[0].polygon
        require(len(polygon) in (len(wanted.polygon), len(wanted.polygon) + wanted.closed), f"{wanted.name}: {len(polygon)} points")
        require(close(polygon[:len(wanted.polygon)], wanted.polygon, size), f"{wanted.name}: runs elsewhere")
        return
    require(len(found.segments) == len(wanted.segments), f"{wanted.name}: {len(found.segments)} segments, not {len(wanted.segments)}")
    for i, (f, w) in enumerate(zip(found.segments, wanted.segments)):
        compare_segment(f, w, size, f"{wanted.name} segment {i + 1}")


def compare_loops(found, wanted, size):
    require(len(found) == len(wanted), f"{len(found)} loops, not {len(wanted)}")
    for f, w in zip(found, wanted):
        compare_loop(f, w, size)


def check_step(path, wanted, size):
    found, valid, entities = readers.read_step(path, truth.millimetres(path.parent))
    require(valid, "OpenCASCADE finds it invalid")
    compare_loops(found, wanted, size)
    return f"{len(found)} loops, {sum(len(f.segments) for f in found)} edges, {entities} entities"


def check_audit(audit):
    messages = [e.message for e in audit.errors + audit.fixes]
    require(not messages, f"audit: {len(audit.errors)} errors, {len(audit.fixes)} fixes: {messages[:3]}")


def check_dxf(path, wanted, size):
    found, audit, _ = readers.read_dxf(path)
    check_audit(audit)
    compare_loops(found, wanted, size)
    return f"{len(found)} loops, {sum(len(f.segments) for f in found)} entities, audit clean"


def check_polyline_dxf(path, wanted, size):
    """Every loop is one polyline; its vertices and bulges lie on the loop."""
    found, audit, document = readers.read_dxf(path)
    check_audit(audit)
    kinds = {e.dxftype() for e in document.modelspace()}
    require(kinds <= {"LWPOLYLINE", "POLYLINE"}, f"{kinds}")
    require(len(found) == len(wanted), f"{len(found)} loops, not {len(wanted)}")
    for f, w in zip(found, wanted):
        require(f.closed == w.closed, f"{w.name}: closed {f.closed}, not {w.closed}")
        if w.polygon is not None:
            require(close(f.polygon, w.polygon, size, 1e-6), f"{w.name}: runs elsewhere")
            continue
        straight = all(s.kind in ("line", "arc", "circle") for s in w.segments)
        length = sum(s.length for s in w.segments)
        if f.segments and straight:
            total = sum(s.length for s in f.segments)
            require(abs(total - length) <= 1e-6 * size, f"{w.name}: length {total!r}, not {length!r}")
        points = np.concatenate([s.points for s in f.segments]) if f.segments else f.polygon
        require(distance_to(w, points).max() <= 2e-3 * length, f"{w.name}: runs elsewhere")
    return f"{len(found)} polylines, audit clean"


def distance_to(loop, points):
    """To the chords of the densely sampled loop that meet at the nearest sample, which is hardly more than to all."""
    chains = [s.dense for s in loop.segments]
    samples = np.concatenate(chains)
    last = np.cumsum([len(c) for c in chains]) - 1
    best, nearest = cKDTree(samples).query(points)
    for first in (nearest - 1, nearest):
        inside = (first >= 0) & ~np.isin(first, last)
        p, start, chord = points[inside], samples[first[inside]], samples[first[inside] + 1] - samples[first[inside]]
        share = np.sum((p - start) * chord, axis=1) / np.maximum(np.sum(chord * chord, axis=1), 1e-300)
        foot = start + np.clip(share, 0, 1)[:, None] * chord
        best[inside] = np.minimum(best[inside], np.linalg.norm(p - foot, axis=1))
    return best


def projected(points):
    """As --view top draws them: x to the right, y up, on a page whose y runs down."""
    return np.asarray(points)[:, :2] * [1, -1]


def check_svg(path, wanted, size):
    found, svg = readers.read_svg(path)
    require(len(found) == len(wanted), f"{len(found)} paths, not {len(wanted)}")
    low = np.array([float(v) for v in svg["viewBox"].split()])
    for (name, curve, closed), w in zip(found, wanted):
        require(name == w.name.replace(" ", "_"), f"{name}, not {w.name}")
        require(closed == w.closed, f"{name}: closed {closed}")
        require(curve.iscontinuous(), f"{name}: has gaps")
        ends = [(s.start, s.end) for s in curve]
        require(not w.closed or abs(ends[0][0] - ends[-1][1]) <= TIGHT * size, f"{name}: is not closed")
        points = np.array([[z.real, z.imag] for s in curve for z in (s.point(t) for t in np.linspace(0, 1, 5))])
        inside = (points >= low[:2] - TIGHT * size) & (points <= low[:2] + low[2:] + TIGHT * size)
        require(inside.all(), f"{name}: leaves the page")
        chain = [w.polygon] if w.polygon is not None else [s.dense for s in w.segments]
        flat = np.concatenate([projected(c) for c in chain])
        spacing = np.linalg.norm(np.diff(np.vstack([flat, flat[:1]]), axis=0), axis=1).max()
        off = cKDTree(flat).query(points)[0].max()
        require(off <= spacing, f"{name}: {off} away")
        require(close(points[0], flat[0], size, 1e-8), f"{name}: starts elsewhere")
        if w.polygon is None and len(w.segments) == 1 and w.segments[0].kind == "line":
            require(abs(curve.length() - np.linalg.norm(flat[-1] - flat[0])) <= 1e-8 * size, f"{name}: length")
    return f"{len(found)} paths"


def check_obj_polylines(path, wanted, size):
    """Through the vertices that loops.csv lists; the model's own curves are sampled."""
    lines = readers.read_obj_polylines(path)
    require(len(lines) == len(wanted), f"{len(lines)} polylines, not {len(wanted)}")
    polygons = truth.polygons(path.parent)
    for line, w in zip(lines, wanted):
        points = polygons.get(w.name, w.polygon)
        if points is None:
            require(distance_to(w, line).max() <= 1e-3 * size, f"{w.name}: runs elsewhere")
            continue
        require(len(line) == len(points) + w.closed, f"{w.name}: {len(line)} points, not {len(points)}")
        require(not w.closed or (line[0] == line[-1]).all(), f"{w.name}: is not closed")
        require(close(line[:len(points)], points, np.abs(points).max(), 1e-6), f"{w.name}: runs elsewhere")
    return f"{len(lines)} polylines, {sum(len(line) for line in lines)} points"


def check_obj_curves(path, wanted, size):
    found = readers.read_obj_curves(path)
    segments = []
    for loop in wanted:
        segments += [None] if loop.polygon is not None else loop.segments
    require(len(found) == len(segments), f"{len(found)} curves, not {len(segments)}")
    for (name, points, clamped), w in zip(found, segments):
        require(clamped, f"{name}: not clamped")
        if w is None:
            continue
        require(name.endswith("_" + w.kind), f"{name}: {w.kind}")
        ends = points[[0, -1]]
        require(close(ends, w.points[[0, -1]], size), f"{name}: ends elsewhere")
        off = cKDTree(w.dense).query(points)[0].max()
        require(off <= w.length / max(len(w.dense) - 1, 1), f"{name}: runs elsewhere")
    return f"{len(found)} curves"


def check_glb(path, wanted, size):
    """Chords of the loops, in metres with y up, and the triangles of all instances."""
    lines, triangles = readers.read_glb(path)
    require(triangles == truth.triangles(path.parent), f"{triangles} triangles")
    if not wanted:
        require(len(lines) == 0, f"{len(lines)} lines of no loops")
        return f"no lines, {triangles} triangles"
    model = lines[..., [0, 2, 1]] * [1, -1, 1] / (truth.millimetres(path.parent) / 1000)
    ends = model.reshape(-1, 3)
    chains = [w.polygon if w.polygon is not None else np.concatenate([s.dense for s in w.segments]) for w in wanted]
    tree = cKDTree(np.concatenate(chains))
    spacing = max(np.linalg.norm(np.diff(c, axis=0), axis=1).max() for c in chains)
    require(tree.query(ends)[0].max() <= spacing, "a line runs elsewhere")
    length = sum(sum(s.length for s in w.segments) for w in wanted if w.polygon is None)
    closed = [np.vstack([w.polygon, w.polygon[:1]]) if w.closed else w.polygon for w in wanted if w.polygon is not None]
    length += sum(np.linalg.norm(np.diff(c, axis=0), axis=1).sum() for c in closed)
    total = np.linalg.norm(model[:, 0] - model[:, 1], axis=1).sum()
    require(abs(total - length) <= 1e-3 * length, f"lines of length {total!r}, not {length!r}")
    return f"{len(lines)} lines, {triangles} triangles"


CHECKS = {
    "model.glb": check_glb,
    "ap242.step": check_step,
    "ap214.step": check_step,
    "curves.dxf": check_dxf,
    "polyline.dxf": check_polyline_dxf,
    "model.svg": check_svg,
    "polylines.obj": check_obj_polylines,
    "curves.obj": check_obj_curves,
}


def main(folders):
    failures = 0
    for folder in map(pathlib.Path, folders):
        wanted = truth.load(folder / "model.json")
        size = truth.size_of(wanted) if wanted else 1.0
        for name, check in CHECKS.items():
            if not (folder / name).exists():
                continue
            try:
                print(f"{folder.name}/{name}: {check(folder / name, wanted, size)}")
            except Exception as fault:  # a reader's own complaint is a difference too
                failures += 1
                print(f"{folder.name}/{name}: DIFFERENT: {fault or type(fault).__name__}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
