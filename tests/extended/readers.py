"""Exports as independent programs read them: STEP by OpenCASCADE, DXF by ezdxf, SVG by svgpathtools, OBJ polylines
and GLB by VTK, OBJ curves by a reader of its own and scipy. Each gives Found loops in file order."""

import pathlib
from dataclasses import dataclass, field

import numpy as np

from expected import FRACTIONS


@dataclass
class FoundSegment:
    kind: str
    points: np.ndarray
    length: float
    radius: float = 0.0
    full: bool = False
    center: np.ndarray = None
    polygon: np.ndarray = None

    def rescale(self, factor):
        for name in ("points", "length", "radius", "center", "polygon"):
            if getattr(self, name) is not None:
                setattr(self, name, getattr(self, name) * factor)


@dataclass
class FoundLoop:
    name: str = ""
    layer: str = ""
    closed: bool = False
    segments: list = field(default_factory=list)
    polygon: np.ndarray = None


# --- STEP -----------------------------------------------------------------------------------------------------------

def read_step(path, millimetres):
    """One loop a wire or single edge, and whether OpenCASCADE finds the whole shape valid. It reads into millimetres;
    lengths are given back in the model's unit, which has so many."""
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_ShapeEnum
    reader = STEPControl_Reader()
    if reader.ReadFile(str(path)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise ValueError(f"{path}: OpenCASCADE cannot read it")
    check = reader.WS().Model()
    reader.TransferRoots()
    shape = reader.OneShape()
    if shape.IsNull():
        return [], True, check.NbEntities()
    groups = children(shape)
    if any(group.ShapeType() != TopAbs_ShapeEnum.TopAbs_COMPOUND for group in groups):
        groups = [shape]  # a set alone is the shape itself
    loops = [step_loop(element) for group in groups for element in children(group)]
    for segment in (segment for loop in loops for segment in loop.segments):
        segment.rescale(1 / millimetres)
    return loops, BRepCheck_Analyzer(shape).IsValid(), check.NbEntities()


def children(shape):
    from OCP.TopoDS import TopoDS_Iterator
    iterator, out = TopoDS_Iterator(shape), []
    while iterator.More():
        out.append(iterator.Value())
        iterator.Next()
    return out


def step_loop(shape):
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum
    if shape.ShapeType() == TopAbs_ShapeEnum.TopAbs_WIRE:
        return FoundLoop(closed=BRep_Tool.IsClosed_s(shape), segments=[step_edge(edge) for edge in children(shape)])
    segment = step_edge(shape)
    closed = bool(np.linalg.norm(segment.points[0] - segment.points[-1]) <= 1e-9 * max(segment.length, 1e-300))
    return FoundLoop(closed=closed, segments=[segment])


def step_edge(edge):
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.GCPnts import GCPnts_AbscissaPoint
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopoDS import TopoDS
    curve = BRepAdaptor_Curve(TopoDS.Edge(edge))
    kind = str(curve.GetType()).split("GeomAbs_")[-1].lower()
    low, high = curve.FirstParameter(), curve.LastParameter()
    points = np.array([xyz(curve.Value(low + t * (high - low))) for t in FRACTIONS])
    if edge.Orientation() == TopAbs_Orientation.TopAbs_REVERSED:
        points = points[::-1]
    full = kind in ("circle", "ellipse") and abs(high - low - 2 * np.pi) < 1e-12
    conic = curve.Circle() if kind == "circle" else curve.Ellipse() if kind == "ellipse" else None
    out = FoundSegment({"bsplinecurve": "bspline"}.get(kind, kind), points, GCPnts_AbscissaPoint.Length_s(curve, 1e-12), full=full)
    if kind == "circle":
        out.radius = conic.Radius()
        out.kind = "circle" if full else "arc"
    if conic is not None:
        out.center = xyz(conic.Location())
    if kind == "bsplinecurve" and curve.BSpline().Degree() == 1:
        poles = curve.BSpline()
        out.polygon = np.array([xyz(poles.Pole(i)) for i in range(1, poles.NbPoles() + 1)])
    return out


def xyz(p):
    return np.array([p.X(), p.Y(), p.Z()])


# --- DXF ------------------------------------------------------------------------------------------------------------

def read_dxf(path):
    """One loop a polyline, a group or an entity without group; and what the auditor found and would mend."""
    import ezdxf
    document = ezdxf.readfile(path)
    audit = document.audit()
    grouped = {}
    for _, group in document.groups:
        members = sorted(group, key=lambda e: int(e.dxf.handle, 16))  # ezdxf does not keep their order
        for entity in members:
            grouped[entity.dxf.handle] = members
    loops, done = [], set()
    for entity in document.modelspace():
        if entity.dxf.handle in done:
            continue
        members = grouped.get(entity.dxf.handle, [entity])
        done.update(e.dxf.handle for e in members)
        loops.append(dxf_loop(members))
    return loops, audit, document


def dxf_loop(entities):
    first = entities[0]
    out = FoundLoop(layer=first.dxf.layer)
    if first.dxftype() == "LWPOLYLINE":
        out.closed = first.closed
        out.polygon = np.array([tuple(p) for p in first.vertices_in_wcs()])
        out.segments = [dxf_segment(e) for e in first.virtual_entities()] if first.has_arc else []
    elif first.dxftype() == "POLYLINE":
        out.closed = first.is_closed
        out.polygon = np.array([tuple(p) for p in first.points()])
    else:
        out.segments = [dxf_segment(e) for e in entities]
        size = np.linalg.norm(np.ptp(np.concatenate([s.points for s in out.segments]), axis=0))
        out.closed = joined([(s.points[0], s.points[-1]) for s in out.segments], 1e-9 * size)
    return out


def joined(ends, tolerance):
    """Whether the segments, each in either direction, run end to end and return."""
    for point, other in (ends[0], ends[0][::-1]):
        start = other
        for a, b in ends[1:]:
            if np.linalg.norm(a - point) <= tolerance:
                point = b
            elif np.linalg.norm(b - point) <= tolerance:
                point = a
            else:
                break
        else:
            if np.linalg.norm(point - start) <= tolerance:
                return True
    return False


def dxf_segment(e):
    kind = e.dxftype()
    if kind == "LINE":
        a, b = np.array(e.dxf.start), np.array(e.dxf.end)
        return FoundSegment("line", a + np.outer(FRACTIONS, b - a), float(np.linalg.norm(b - a)))
    if kind in ("ARC", "CIRCLE"):
        first, last = (e.dxf.start_angle, e.dxf.end_angle) if kind == "ARC" else (0.0, 360.0)
        sweep = last - first if last > first else last - first + 360
        points = np.array([tuple(p) for p in e.vertices(first + FRACTIONS * sweep)])
        center = np.array(tuple(e.ocs().to_wcs(e.dxf.center)))
        return FoundSegment(kind.lower(), points, float(np.radians(sweep) * e.dxf.radius), e.dxf.radius, kind == "CIRCLE", center)
    if kind == "ELLIPSE":
        first, last = e.dxf.start_param, e.dxf.end_param
        sweep = last - first if last > first else last - first + 2 * np.pi
        points = np.array([tuple(p) for p in e.vertices(first + FRACTIONS * sweep)])
        major = np.array(tuple(e.dxf.major_axis))
        minor = e.dxf.ratio * np.cross(np.array(tuple(e.dxf.extrusion)), major)
        t, w = np.polynomial.legendre.leggauss(400)
        u = first + (t + 1) / 2 * sweep
        speed = np.linalg.norm(np.outer(np.cos(u), minor) - np.outer(np.sin(u), major), axis=1)
        return FoundSegment("ellipse", points, float(np.sum(w * speed) * sweep / 2), full=abs(sweep - 2 * np.pi) < 1e-12,
                            center=np.array(tuple(e.dxf.center)))
    if kind == "SPLINE":
        spline = e.construction_tool()
        low, high = spline.knots()[spline.degree], spline.knots()[spline.count]
        points = np.array([tuple(p) for p in spline.points(low + FRACTIONS * (high - low))])
        return FoundSegment("bspline", points, 0.0)
    raise ValueError(f"unexpected entity {kind}")


# --- SVG ------------------------------------------------------------------------------------------------------------

def read_svg(path):
    """One loop a path, with its name; segments are svgpathtools' own."""
    from svgpathtools import svg2paths2
    paths, attributes, svg = svg2paths2(str(path))
    return [(a["id"], p, a["d"].rstrip().endswith("Z")) for p, a in zip(paths, attributes)], svg


# --- OBJ ------------------------------------------------------------------------------------------------------------

def read_obj_polylines(path):
    """The points of each `l` element, as VTK's single precision holds them."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOGeometry import vtkOBJReader
    reader = vtkOBJReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    if data.GetNumberOfLines() == 0:
        return []
    points = vtk_to_numpy(data.GetPoints().GetData())
    lines = data.GetLines()
    offsets, indices = vtk_to_numpy(lines.GetOffsetsArray()), vtk_to_numpy(lines.GetConnectivityArray())
    return [points[indices[a:b]] for a, b in zip(offsets[:-1], offsets[1:])]


def read_obj_curves(path):
    """Each curv element as (group name, points at FRACTIONS, clamped)."""
    from scipy.interpolate import BSpline
    vertices, out, name, state = [], [], "", {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if not words:
                continue
            if words[0] == "v":
                numbers = [float(w) for w in words[1:]]
                vertices.append(numbers if len(numbers) == 4 else numbers + [1.0])
            elif words[0] == "g":
                name = words[1]
            elif words[0] == "cstype":
                state = {"rational": words[1] == "rat"}
            elif words[0] == "deg":
                state["degree"] = int(words[1])
            elif words[0] == "curv":
                state["range"] = float(words[1]), float(words[2])
                state["points"] = np.array([vertices[int(i) - 1] for i in words[3:]])
            elif words[0] == "parm":
                state["knots"] = np.array([float(w) for w in words[2:]])
            elif words[0] == "end":
                p, k, d = state["points"], state["knots"], state["degree"]
                assert len(k) == len(p) + d + 1, f"{name}: wrong number of knots"
                assert state["range"] == (k[d], k[len(p)]), f"{name}: wrong range"
                assert state["rational"] or np.all(p[:, 3] == 1), f"{name}: weights without rat"
                h = BSpline(k, np.column_stack([p[:, :3] * p[:, 3:], p[:, 3]]), d)(k[d] + FRACTIONS * (k[len(p)] - k[d]))
                clamped = k[0] == k[d] and k[-1] == k[len(p)]
                out.append((name, h[:, :3] / h[:, 3:], clamped))
    return out


# --- GLB ------------------------------------------------------------------------------------------------------------

def read_glb(path):
    """The lines of the meshes of curves as pairs of points, and the number of triangles, as VTK places them: in metres,
    with y up."""
    import json
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
    from vtkmodules.vtkIOGeometry import vtkGLTFReader
    content = pathlib.Path(path).read_bytes()
    meshes = json.loads(content[20:20 + int.from_bytes(content[12:16], "little")]).get("meshes", [])
    reader = vtkGLTFReader()
    reader.SetFileName(str(path))
    reader.Update()
    lines, triangles = [np.zeros((0, 2, 3))], 0

    def visit(block, mesh):
        nonlocal triangles
        if block.IsA("vtkMultiBlockDataSet"):
            for i in range(block.GetNumberOfBlocks()):
                name = block.GetMetaData(i).Get(vtkCompositeDataSet.NAME()) if block.HasMetaData(i) else None
                is_mesh = (name or "").startswith("Mesh_")
                visit(block.GetBlock(i), meshes[int(name[5:])]["name"] if is_mesh else mesh)
            return
        triangles += block.GetNumberOfPolys()
        if block.GetNumberOfLines() > 0 and mesh.endswith(("curves", "annotations")):
            points = vtk_to_numpy(block.GetPoints().GetData()).astype(float)
            lines.append(points[vtk_to_numpy(block.GetLines().GetConnectivityArray()).reshape(-1, 2)])

    visit(reader.GetOutput(), "")
    return np.concatenate(lines), triangles
