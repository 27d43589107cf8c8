// SPDX-License-Identifier: BSD-3-Clause
// vtkSurfaceSampler on real meshes: patches hold particles in proportion to their area, and the
// particles keep their distances.
#include "MeshFile.h"
#include "SurfaceSamplerTest.h"

#include "Core/Quality/NearestNeighbours.h"

#include "vtkIdList.h"
#include "vtkTriangle.h"

#include <algorithm>
#include <vector>

namespace
{

using RectifiedTransport::ConstPointSpan;

Values triangleAreas(vtkPolyData* mesh)
{
  Values areas;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    auto* triangle = vtkTriangle::SafeDownCast(mesh->GetCell(cell));
    areas.push_back(triangle ? triangle->ComputeArea() : 0.0);
  }
  return areas;
}

// The relative L2 error of the numbers of particles in patches of about 64, each grown over
// neighbouring triangles.
double patchError(vtkPolyData* mesh, const Values& areas, const Values& counts, double particles)
{
  mesh->BuildLinks();
  const double expected = particles / sumOf(areas); // per area
  std::vector<bool> isTaken(areas.size(), false);
  double squares = 0.0;
  double all = 0.0;
  vtkNew<vtkIdList> neighbours;
  for (vtkIdType seed = 0; seed < mesh->GetNumberOfCells(); ++seed)
  {
    std::vector<vtkIdType> patch;
    double mass = 0.0;
    double count = 0.0;
    if (!isTaken[static_cast<std::size_t>(seed)])
    {
      patch.push_back(seed);
      isTaken[static_cast<std::size_t>(seed)] = true;
    }
    std::size_t next = 0;
    for (; next < patch.size() && mass < 64.0; ++next)
    {
      const vtkIdType cell = patch[next];
      mass += expected * areas[static_cast<std::size_t>(cell)];
      count += counts[static_cast<std::size_t>(cell)];
      vtkIdType size = 0;
      const vtkIdType* ids = nullptr;
      mesh->GetCellPoints(cell, size, ids);
      for (vtkIdType i = 0; i < size; ++i)
      {
        mesh->GetCellEdgeNeighbors(cell, ids[i], ids[(i + 1) % size], neighbours);
        for (vtkIdType k = 0; k < neighbours->GetNumberOfIds(); ++k)
        {
          const vtkIdType other = neighbours->GetId(k);
          if (!isTaken[static_cast<std::size_t>(other)])
          {
            isTaken[static_cast<std::size_t>(other)] = true;
            patch.push_back(other);
          }
        }
      }
    }
    for (; next < patch.size(); ++next) // on the border of the patch
    {
      isTaken[static_cast<std::size_t>(patch[next])] = false;
    }
    squares += (count - mass) * (count - mass);
    all += mass * mass;
  }
  return std::sqrt(squares / all);
}

// The mean distance of nearest neighbours, by the largest possible one in the plane.
double spacingOf(vtkPolyData* particles, double area)
{
  const Values points = coordinates(particles);
  const auto count = static_cast<std::int64_t>(points.size() / 3);
  Values distances(points.size() / 3);
  RectifiedTransport::nearestDistances(ConstPointSpan<3>(points.data(), count), distances.data());
  const auto number = static_cast<double>(count);
  return sumOf(distances) / number / std::sqrt(2.0 / std::sqrt(3.0) * area / number);
}

void checkMesh(Checks& checks, const std::string& name, double spacing)
{
  auto mesh = readMesh(RECTIFIEDTRANSPORT_MESHES "/" + name + ".off");
  checks.That(mesh != nullptr, "a mesh", __LINE__, name);
  if (!mesh)
  {
    return;
  }
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  Messages messages(sampler);
  sampler->SetInputData(mesh);
  vtkPolyData* particles = runSampler(sampler);
  checks.That(particles->GetNumberOfPoints() == 8192, "a number", __LINE__, name);
  checks.That(messages.Errors.empty() && messages.Warnings.empty(), "quiet", __LINE__, name);
  const Values areas = triangleAreas(mesh);
  Values counts(areas.size(), 0.0);
  for (const double cell : arrayValues(pointArray(particles, "CellId")))
  {
    counts[static_cast<std::size_t>(cell)] += 1.0;
  }
  const double error = patchError(mesh, areas, counts, 8192.0);
  checks.That(error < 0.06, "in proportion", __LINE__, name + " " + std::to_string(error));
  const double found = spacingOf(particles, sumOf(areas));
  checks.That(found > spacing, "apart", __LINE__, name + " " + std::to_string(found));
  std::cout << name << ": error " << error << ", spacing " << found << "\n";
}

} // namespace

int TestSurfaceSamplerMeshes(int, char*[])
{
  Checks checks;
  checkMesh(checks, "nefertiti", 0.77);
  checkMesh(checks, "lion-head", 0.64);
  checkMesh(checks, "mannequin-devil", 0.64);
  return checks.Result();
}
