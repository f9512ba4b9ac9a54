"""What an export must hold: the loops of model.json, each instance placed, evaluated with numpy and scipy alone."""

import csv
import json
from dataclasses import dataclass, field

import numpy as np
from scipy.interpolate import BSpline

FRACTIONS = np.linspace(0, 1, 9)


@dataclass
class Segment:
    kind: str                 # line, arc, circle, ellipse, bspline
    points: np.ndarray        # at FRACTIONS of its parameter
    length: float
    radius: float = 0.0       # of an arc or circle
    full: bool = False        # a whole circle or ellipse: where it starts is not told by every format
    dense: np.ndarray = None  # many points, for distances
    center: np.ndarray = None


@dataclass
class Loop:
    name: str
    layer: str
    closed: bool
    segments: list = field(default_factory=list)
    polygon: np.ndarray = None  # instead of segments

    def ends(self):
        return self.segments[0].points[0], self.segments[-1].points[-1]


def turned(vector, axis, angles):
    """The vector turned about the axis by each of the angles [Rodrigues]."""
    along = axis * (axis @ vector)
    return along + np.outer(np.cos(angles), vector - along) + np.outer(np.sin(angles), np.cross(axis, vector))


def ellipse_axes(s):
    """Centre, half axes as vectors, and the angle of the start."""
    center, axis, major = (np.array(s[k], float) for k in ("center", "axis", "major"))
    minor = s["ratio"] * np.cross(axis, major)
    start = np.array(s["start"], float) - center
    return center, major, minor, np.arctan2(start @ minor / (minor @ minor), start @ major / (major @ major))


def evaluator(s):
    """The segment as a function of fractions of its parameter."""
    start, end = np.array(s["start"], float), np.array(s["end"], float)
    if s["type"] == "line":
        return lambda u: start + np.outer(u, end - start)
    if s["type"] in ("arc", "circle"):
        center, axis, angle = np.array(s["center"]), np.array(s["axis"], float), s["angle"]
        return lambda u: center + turned(start - center, axis, np.asarray(u) * angle)
    if s["type"] == "ellipse":
        center, major, minor, first = ellipse_axes(s)
        at = lambda u: first + np.asarray(u) * s["angle"]
        return lambda u: center + np.outer(np.cos(at(u)), major) + np.outer(np.sin(at(u)), minor)
    knots, points, degree = np.array(s["knots"], float), np.array(s["control_points"], float), s["degree"]
    weights = np.array(s.get("weights", np.ones(len(points))))
    spline = BSpline(knots, np.column_stack([points * weights[:, None], weights]), degree)
    low, high = knots[degree], knots[len(points)]

    def evaluate(u):
        h = spline(low + np.asarray(u) * (high - low))
        return h[:, :3] / h[:, 3:]

    return evaluate


def breaks(s):
    """Fractions between which the segment is smooth."""
    if s["type"] != "bspline":
        return np.linspace(0, 1, 9)
    knots = np.array(s["knots"], float)
    inner = np.unique(knots[s["degree"]:len(s["control_points"]) + 1])
    return (inner - inner[0]) / (inner[-1] - inner[0])


NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)


def arc_length(s, matrix):
    """By Gauss quadrature between the breaks, the speed by an exact derivative of what is integrated."""
    linear = matrix[:3, :3]
    at = evaluator(s)
    if s["type"] in ("line",):
        return float(np.linalg.norm(linear @ (at([1.0]) - at([0.0]))[0]))
    pieces = breaks(s)
    if len(pieces) < 32:  # a model's own curve may be of few and wild ones
        pieces = np.unique(np.concatenate([np.linspace(a, b, 17) for a, b in zip(pieces[:-1], pieces[1:])]))
    middles, halves = (pieces[1:] + pieces[:-1]) / 2, np.diff(pieces) / 2
    nodes = (middles[:, None] + np.outer(halves, NODES)).ravel()
    return float(np.outer(halves, WEIGHTS).ravel() @ np.linalg.norm(speed(s, nodes) @ linear.T, axis=1))


def speed(s, u):
    start = np.array(s["start"], float)
    if s["type"] in ("arc", "circle"):
        center, axis, angle = np.array(s["center"]), np.array(s["axis"], float), s["angle"]
        return angle * np.cross(axis, turned(start - center, axis, np.asarray(u) * angle))
    if s["type"] == "ellipse":
        _, major, minor, first = ellipse_axes(s)
        t = first + np.asarray(u) * s["angle"]
        return s["angle"] * (np.outer(np.cos(t), minor) - np.outer(np.sin(t), major))
    knots, points, degree = np.array(s["knots"], float), np.array(s["control_points"], float), s["degree"]
    weights = np.array(s.get("weights", np.ones(len(points))))
    spline = BSpline(knots, np.column_stack([points * weights[:, None], weights]), degree)
    low, high = knots[degree], knots[len(points)]
    v = low + np.asarray(u) * (high - low)
    h, d = spline(v), spline.derivative()(v)
    return (high - low) * (d[:, :3] - h[:, :3] / h[:, 3:] * d[:, 3:]) / h[:, 3:]


def place(points, matrix):
    return np.asarray(points) @ matrix[:3, :3].T + matrix[:3, 3]


def placed_segment(s, matrix):
    at = evaluator(s)
    scale = abs(np.linalg.det(matrix[:3, :3])) ** (1 / 3)
    count = 257 if s["type"] != "bspline" else 1 + max(8 * len(breaks(s)), 1024)
    return Segment(kind=s["type"], points=place(at(FRACTIONS), matrix), length=arc_length(s, matrix),
                   radius=s.get("radius", 0.0) * scale, full=s["type"] == "circle" or abs(s.get("angle", 0) - 2 * np.pi) < 1e-12,
                   dense=place(at(np.linspace(0, 1, count)), matrix),
                   center=place([s["center"]], matrix)[0] if "center" in s else None)


def placements(doc):
    """(shell, matrix, suffix of the names) of each instance."""
    ids = [instance["shell"] for instance in doc["instances"]]
    number = {}
    for instance in doc["instances"]:
        shell = instance["shell"]
        number[shell] = number.get(shell, 0) + 1
        suffix = f"_instance_{number[shell]}" if ids.count(shell) > 1 else ""
        yield shell, np.array(instance["placement"], float).reshape(4, 4).T, suffix


def polygons(folder):
    """The vertices of loops.csv, placed, by the loops' names."""
    loops = {}
    with open(folder / "loops.csv", encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            key = row["shell"], f"shell_{row['shell']}_patch_{row['patch']}_loop_{row['loop']}"
            loops.setdefault(key, []).append([float(row[c]) for c in "xyz"])
    with open(folder / "model.json", encoding="utf-8") as file:
        doc = json.load(file)
    return {name + suffix: place(points, matrix) for shell, matrix, suffix in placements(doc)
            for (owner, name), points in loops.items() if owner == shell}


def millimetres(folder):
    """In one unit of the model; an unknown unit is written as a millimetre."""
    with open(folder / "model.json", encoding="utf-8") as file:
        metres = json.load(file)["model"]["metres_per_unit"]
    return 1000 * metres if metres else 1.0


def triangles(folder):
    """Of all instances."""
    with open(folder / "model.json", encoding="utf-8") as file:
        doc = json.load(file)
    return sum(patch["triangles"] for instance in doc["instances"] for patch in doc["patches"]
               if patch["shell"] == instance["shell"])


def load(path):
    """The expected loops in the order of the geometry files."""
    with open(path, encoding="utf-8") as file:
        doc = json.load(file)
    loops = []
    for shell, matrix, suffix in placements(doc):
        for patch in doc["patches"]:
            if patch["shell"] != shell:
                continue
            layer = f"shell_{shell}_patch_{patch['patch']}"
            for loop in patch["loops"]:
                entry = Loop(f"{layer}_loop_{loop['loop']}{suffix}", layer, loop["closed"])
                segments = loop["segments"]
                if loop.get("fallback"):
                    entry.polygon = place([s["start"] for s in segments], matrix)
                else:
                    entry.segments = [placed_segment(s, matrix) for s in segments]
                loops.append(entry)
    for i, line in enumerate(doc.get("annotations", [])):
        if len(line["points"]) > 1:
            name = f"annotation_{line['name'] or i + 1}"
            loops.append(Loop(name, name, False, polygon=np.array(line["points"], float)))
    for i, curve in enumerate(doc.get("curves", [])):
        name = f"curve_{curve['name'] or i + 1}"
        closed = curve["start"] == curve["end"]
        loops.append(Loop(name, name, closed, [placed_segment(curve, np.eye(4))]))
    return loops


def size_of(loops):
    points = np.concatenate([loop.polygon if loop.polygon is not None else np.concatenate([s.points for s in loop.segments])
                             for loop in loops])
    return float(np.linalg.norm(np.ptp(points, axis=0)))
