# SPDX-License-Identifier: BSD-3-Clause
"""Spreads points over surfaces with Sample Surface and its peers, and measures how evenly.

usage: surface_peers.py [--points N] MESH.off ...

Peers: Open3D (python3-open3d) and VTK's samplers. PYTHONPATH has the build's
lib/python3/dist-packages. One thread, in processor time, once each. Spacing: the distance of the
nearest point, in parts of a hexagonal lattice's with as many points. Patches: the relative L2 error
of the numbers of points in patches that have the area of 64 (a hexagonal lattice has 0.024,
independent points 0.125).
"""
import argparse
import os
import time

os.environ["OMP_NUM_THREADS"] = "1"  # before the libraries are loaded

# pylint: disable=wrong-import-position
import numpy as np
import open3d
from rectifiedtransport import vtkSurfaceSampler
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersModeling import vtkPolyDataPointSampler
from vtkmodules.vtkFiltersPoints import vtkPoissonDiskSampler


class Mesh:
    """The triangles of an OFF file; polygons become fans."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            words = [word for line in file for word in line.split("#")[0].split()]
        points, polygons = int(words[1]), int(words[2])
        self.points = np.array(words[4:4 + 3 * points], float).reshape(-1, 3)
        triangles, at = [], 4 + 3 * points
        for _ in range(polygons):
            corners = [int(word) for word in words[at + 1:at + 1 + int(words[at])]]
            at += 1 + len(corners)
            triangles += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
        self.triangles = np.array(triangles)
        a, b, c = (self.points[self.triangles[:, i]] for i in range(3))
        self.areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2

    def polydata(self):
        data, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
        points.SetData(numpy_to_vtk(self.points, deep=1))
        offsets = np.arange(0, 3 * len(self.triangles) + 1, 3)
        cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=1),
                      numpy_to_vtkIdTypeArray(self.triangles.ravel(), deep=1))
        data.SetPoints(points)
        data.SetPolys(cells)
        return data

    def random_points(self, count, generator):
        """Independent points by area."""
        sums = np.cumsum(self.areas)
        found = np.searchsorted(sums, generator.random(count) * sums[-1])
        found = np.minimum(found, len(sums) - 1)
        root = np.sqrt(generator.random(count))[:, None]
        part = generator.random(count)[:, None]
        a, b, c = (self.points[self.triangles[found, i]] for i in range(3))
        return (1 - root) * a + root * (1 - part) * b + root * part * c


class Patches:
    """Cells of the nearest of some centres, and their shares of the area, by independent points."""

    def __init__(self, mesh, count):
        generator = np.random.default_rng(1)
        number = max(8, count // 64)
        samples = mesh.random_points(64 * number, generator)
        self.centres = samples[:number].copy()
        for _ in range(15):  # Lloyd
            nearest = cKDTree(self.centres).query(samples)[1]
            sizes = np.bincount(nearest, minlength=number)
            for axis in range(3):
                sums = np.bincount(nearest, samples[:, axis], number)
                self.centres[sizes > 0, axis] = (sums / np.maximum(sizes, 1))[sizes > 0]
        self.tree = cKDTree(self.centres)
        counts = np.zeros(number)
        for _ in range(-(-number // 100)):  # 10,000 a patch: the error of the shares is 1 %
            many = mesh.random_points(1000000, generator)
            counts += np.bincount(self.tree.query(many)[1], minlength=number)
        self.shares = counts / counts.sum()

    def error(self, points):
        counts = np.bincount(self.tree.query(points)[1], minlength=len(self.shares))
        right = self.shares * len(points)
        return np.linalg.norm(counts - right) / np.linalg.norm(right)


def sampled_by_us(mesh, count):
    sampler = vtkSurfaceSampler()
    sampler.SetInputDataObject(mesh.polydata())
    sampler.SetNumberOfParticles(count)

    def run():
        sampler.Update()
        return vtk_to_numpy(sampler.GetOutput().GetPoints().GetData())
    return run


def sampled_by_open3d(method):
    def prepare(mesh, count):
        vectors = open3d.utility.Vector3dVector(mesh.points)
        triangles = open3d.utility.Vector3iVector(mesh.triangles.astype(np.int32))
        surface = open3d.geometry.TriangleMesh(vectors, triangles)
        return lambda: np.asarray(getattr(surface, method)(count).points)
    return prepare


def sampled_by_vtk(mesh, count):
    """Ten times as many points at random, and Poisson disks of them. The radius is searched."""
    many = vtkPolyDataPointSampler()
    many.SetInputDataObject(mesh.polydata())
    many.SetPointGenerationModeToRandom()
    spacing = np.sqrt(2 * mesh.areas.sum() / (np.sqrt(3) * count))
    many.SetDistance(spacing / np.sqrt(10))
    disks = vtkPoissonDiskSampler()
    disks.SetInputConnection(many.GetOutputPort())

    def run():
        low, high = 0.3 * spacing, 1.2 * spacing
        for _ in range(12):
            disks.SetRadius((low + high) / 2)
            disks.Update()
            found = disks.GetOutput().GetNumberOfPoints()
            if abs(found - count) <= 0.002 * count:
                break
            low, high = (disks.GetRadius(), high) if found > count else (low, disks.GetRadius())
        return vtk_to_numpy(disks.GetOutput().GetPoints().GetData()).astype(float)
    return run


PEERS = {"Sample Surface": sampled_by_us,
         "Open3D, uniform": sampled_by_open3d("sample_points_uniformly"),
         "Open3D, Poisson disk": sampled_by_open3d("sample_points_poisson_disk"),
         "VTK, Poisson disk": sampled_by_vtk}


def measure(mesh, patches, name, count):
    run = PEERS[name](mesh, count)
    begin = time.process_time()
    points = run()
    seconds = time.process_time() - begin
    hexagonal = np.sqrt(2 * mesh.areas.sum() / (np.sqrt(3) * len(points)))
    nearest = cKDTree(points).query(points, 2)[0][:, 1] / hexagonal
    print(f"  {name}: {len(points):,} points, spacing {nearest.mean():.3f} / {nearest.min():.2f}, "
          f"patches {patches.error(points):.3f}, {seconds:.3f} s", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, default=8192)
    parser.add_argument("meshes", nargs="+")
    arguments = parser.parse_args()
    vtkSMPTools.Initialize(1)
    for path in arguments.meshes:
        mesh = Mesh(path)
        print(f"{os.path.basename(path)}, {len(mesh.triangles):,} triangles", flush=True)
        patches = Patches(mesh, arguments.points)
        for name in PEERS:
            measure(mesh, patches, name, arguments.points)


if __name__ == "__main__":
    main()
