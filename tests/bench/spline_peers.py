#!/usr/bin/env python3
"""Splines of bench_fit_splines beside those of FITPACK (scipy) and OpenCASCADE (GeomAPI_PointsToBSpline).

Control points at equal true distance: the fewest that the other library needs, over a grid of its own
tolerances, to be as near to the true curve as ours is. Times: ours beside one call of FITPACK with the smoothing
factor, found before by bisection, that just keeps the tolerance at the points; of FITPACK's routine alone, without the
Python around it. Ours includes the search for the knots and the certificate. Run by the Python of scripts/extended_env.

usage: spline_peers.py FILE.json [times]    times: these alone
"""

import json
import sys
import time

import numpy as np
from scipy.interpolate import BSpline, _fitpack, splprep
from scipy.spatial import cKDTree

CURVE_SAMPLES = 6000
GRID = np.geomspace(0.02, 4, 48)  # tolerances of the peers, multiples of ours


def polyline_distance(samples, polyline, tree, closed):
    """Largest distance of the samples to a dense polyline: to the two segments at the nearest vertex."""
    nearest = tree.query(samples)[1]
    count = len(polyline)
    best = np.full(len(samples), np.inf)
    for first in (nearest - 1, nearest):
        first = first % count if closed else np.clip(first, 0, count - 2)
        start, chord = polyline[first], polyline[(first + 1) % count] - polyline[first]
        share = np.einsum("ij,ij->i", samples - start, chord) / np.einsum("ij,ij->i", chord, chord)
        feet = start + np.clip(share, 0, 1)[:, None] * chord
        best = np.minimum(best, np.linalg.norm(samples - feet, axis=1))
    return best.max()


class Truth:
    def __init__(self, entry):
        self.points = np.array(entry["points"])
        self.closed = entry["closed"]
        self.tree = cKDTree(self.points)

    def distance(self, curve):
        """Hausdorff distance of a curve, a BSpline on its whole domain, and the truth."""
        domain = np.linspace(curve.t[3], curve.t[-4], CURVE_SAMPLES, endpoint=not self.closed)
        samples = curve(domain)
        back = polyline_distance(self.points, samples, cKDTree(samples), self.closed)
        return max(polyline_distance(samples, self.points, self.tree, self.closed), back)


def ours(fit):
    return BSpline(np.array(fit["knots"]), np.array(fit["control_points"]), 3)


def fitpack(points, closed, smoothing):
    """Number of control points, the curve, and the largest distance at the points."""
    rows = np.vstack([points, points[:1]]) if closed else points
    (knots, coefficients, degree), parameters = splprep(rows.T, s=smoothing, per=closed, quiet=1)
    curve = BSpline(knots, np.array(coefficients).T, degree)
    at_points = np.linalg.norm(curve(parameters) - rows, axis=1).max()
    return len(knots) - 4 - (3 if closed else 0), curve, at_points


def opencascade(points, closed, tolerance):
    """Number of control points and the curve; a closed one has no more than a common point at its ends."""
    from OCP.collections import Array1_gp_Pnt
    from OCP.GeomAbs import GeomAbs_C2
    from OCP.GeomAPI import GeomAPI_PointsToBSpline
    from OCP.gp import gp_Pnt
    rows = np.vstack([points, points[:1]]) if closed else points
    array = Array1_gp_Pnt(1, len(rows))
    for i, row in enumerate(rows):
        array.SetValue(i + 1, gp_Pnt(*row))
    curve = GeomAPI_PointsToBSpline(array, 3, 3, GeomAbs_C2, tolerance).Curve()
    poles = [curve.Pole(i + 1) for i in range(curve.NbPoles())]
    knots = [curve.Knot(i + 1) for i in range(curve.NbKnots()) for _ in range(curve.Multiplicity(i + 1))]
    control_points = np.array([(p.X(), p.Y(), p.Z()) for p in poles])
    return len(poles) - (1 if closed else 0), BSpline(np.array(knots), control_points, curve.Degree())


def fewest(results, distance):
    """Fewest control points among (count, true distance) that are as near."""
    counts = [count for count, near in results if near <= distance]
    return min(counts) if counts else None


def results_of(library, truth, tolerances):
    """(control points, true distance) of a library at each of its tolerances where it finds anything."""
    results = []
    for tolerance in tolerances:
        try:
            count, curve, *_ = library(tolerance)
        except RuntimeError:
            continue
        results.append((count, truth.distance(curve)))
    return results


def compare_counts(data, truths):
    print("run           sagitta  tolerance  ours  true distance  FITPACK  OpenCASCADE")
    lost = 0
    for fit in data["fits"]:
        truth, points = truths[fit["run"]], np.array(fit["points"])
        distance = truth.distance(ours(fit))
        tolerances = GRID * fit["tolerance"]
        libraries = [
            lambda tolerance: fitpack(points, truth.closed, len(points) * tolerance**2 / 3),
            lambda tolerance: opencascade(points, truth.closed, tolerance),
        ]
        peers = [fewest(results_of(library, truth, tolerances), distance) for library in libraries]
        more = any(count is not None and count < fit["control_count"] for count in peers)
        lost += more
        print(f"{fit['run']:12} {fit['sagitta']:8.0e} {fit['relative_tolerance']:10.0e}"
              f" {fit['control_count']:5} {distance / fit['tolerance']:14.2f} {peers[0] or '-':>8}"
              f" {peers[1] or '-':>12}{'  more' if more else ''}", flush=True)
    print(f"more control points than a peer: {lost} of {len(data['fits'])}")


def keeping_smoothing(points, closed, tolerance):
    """The largest smoothing factor that keeps the tolerance at the points, to 5 %."""
    low, high = 0.0, len(points) * tolerance**2
    for _ in range(12):
        middle = (low + high) / 2
        if fitpack(points, closed, middle)[2] <= tolerance:
            low = middle
        else:
            high = middle
    return low


def fitpack_seconds(points, closed, smoothing):
    """Number of control points and the shortest time of a call of parcur or clocur, as splprep calls it."""
    rows = np.vstack([points, points[:1]]) if closed else points
    count, none = len(rows), np.array([], float)
    shortest = np.inf
    for _ in range(3 if count > 10_000 else 20 if count > 100 else 500):
        parameters = np.zeros(count)
        start = time.process_time()
        knots, *_ = _fitpack._parcur(rows.ravel(), np.ones(count), parameters, 0.0, 1.0, 3, 0, 0, smoothing, none,
                                     count + 6, none, np.array([], np.int32), int(closed))
        shortest = min(shortest, time.process_time() - start)
    return len(knots) - 4 - (3 if closed else 0), shortest


def compare_times(data, truths):
    print("run           points  ours: controls  milliseconds  FITPACK: controls  milliseconds  share")
    for fit in data["sizes"]:
        closed, points = truths[fit["run"]].closed, np.array(fit["points"])
        smoothing = keeping_smoothing(points, closed, fit["tolerance"])
        count, shortest = fitpack_seconds(points, closed, smoothing)
        print(f"{fit['run']:12} {len(points):7} {fit['control_count']:15} {1e3 * fit['seconds']:13.3f}"
              f" {count:18} {1e3 * shortest:13.3f} {fit['seconds'] / shortest:6.2f}", flush=True)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        data = json.load(file)
    truths = {name: Truth(entry) for name, entry in data["truth"].items()}
    compare_times(data, truths)
    if sys.argv[2:] != ["times"]:
        compare_counts(data, truths)


if __name__ == "__main__":
    main()
