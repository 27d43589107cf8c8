// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Solid/SolidTriangles.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/PolygonCutter.h"
#include "Bridge/Surface/PolygonInput.h"
#include "Core/Parallel/Stages.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;

using Place = std::array<double, 3>;

Place normalOf(const Place& a, const Place& b, const Place& c)
{
  Place u;
  Place v;
  Place normal;
  for (std::size_t i = 0; i < 3; ++i)
  {
    u[i] = b[i] - a[i];
    v[i] = c[i] - a[i];
  }
  vtkMath::Cross(u.data(), v.data(), normal.data());
  return normal;
}

// Whether a quad is cut from corner 1 to 3, not from 0 to 2.
bool isCutFromOne(const std::array<Place, 4>& corners)
{
  const auto isWithin = [&corners](std::size_t i) {
    const Place one = normalOf(corners[i], corners[i + 1], corners[i + 2]);
    const Place other = normalOf(corners[i], corners[i + 2], corners[(i + 3) % 4]);
    return vtkMath::Dot(one.data(), other.data()) > 0.0;
  };
  if (isWithin(0) != isWithin(1))
  {
    return isWithin(1);
  }
  const double zero = vtkMath::Distance2BetweenPoints(corners[0].data(), corners[2].data());
  const double one = vtkMath::Distance2BetweenPoints(corners[1].data(), corners[3].data());
  if (zero != one)
  {
    return one < zero;
  }
  const auto lowest = std::min_element(corners.begin(), corners.end());
  return (lowest - corners.begin()) % 2 == 1;
}

class PolygonCut
{
public:
  PolygonCut(vtkPolyData* surface, const ClosedMesh& mesh)
    : Surface(surface)
    , Mesh(mesh)
  {
    vtkCellArray* polygons = surface->GetPolys();
    const vtkIdType ids = polygons->GetNumberOfConnectivityIds();
    requireMemory("the triangles of the input surface",
      4.0 * static_cast<double>(ids + polygons->GetNumberOfCells()) * sizeof(vtkIdType));
    this->Triangles->AllocateEstimate(
      std::max<vtkIdType>(1, ids - 2 * polygons->GetNumberOfCells()), 3);
  }

  void CutPolygons(Progress& progress)
  {
    vtkCellArray* polygons = this->Surface->GetPolys();
    vtkNew<vtkIdList> corners;
    progress.ForInOrder(
      polygons->GetNumberOfCells(), Grain,
      [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t polygon = first; polygon < last; ++polygon)
        {
          polygons->GetCellAtId(polygon, corners);
          this->MergeCorners(corners);
          this->CutPolygon(corners);
        }
      },
      RandomAccessUnits);
  }

  // Those of more than four corners, and strips.
  void CutOthers(Progress& progress)
  {
    if (this->Others->GetNumberOfCells() + this->Surface->GetNumberOfStrips() == 0)
    {
      return;
    }
    // triangulate() asks for the same, and does not say whether that is what fails.
    requireMemory("the triangles of the input surface",
      12.0 *
        static_cast<double>(this->Others->GetNumberOfConnectivityIds() +
          this->Surface->GetStrips()->GetNumberOfConnectivityIds()) *
        sizeof(vtkIdType));
    try
    {
      this->Triangles->Append(triangulate(
        this->Surface->GetPoints(), this->Others, this->Surface->GetStrips(), progress));
    }
    catch (const Failure&)
    {
      this->CutEach(progress);
    }
  }

  vtkSmartPointer<vtkCellArray> Take() { return this->Triangles.Get(); }

private:
  void MergeCorners(vtkIdList* corners) const
  {
    vtkIdType kept = 0;
    for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
    {
      const vtkIdType corner = this->Mesh.FirstOf(corners->GetId(i));
      if (kept == 0 || corner != corners->GetId(kept - 1))
      {
        corners->SetId(kept++, corner);
      }
    }
    while (kept > 1 && corners->GetId(0) == corners->GetId(kept - 1))
    {
      --kept;
    }
    corners->SetNumberOfIds(kept);
  }

  void CutPolygon(vtkIdList* corners)
  {
    const vtkIdType count = corners->GetNumberOfIds();
    if (count == 4)
    {
      std::array<Place, 4> places;
      for (int i = 0; i < 4; ++i)
      {
        this->Surface->GetPoint(corners->GetId(i), places[static_cast<std::size_t>(i)].data());
      }
      this->CutFan(corners, isCutFromOne(places) ? 1 : 0);
    }
    else if (count == 3)
    {
      this->Triangles->InsertNextCell(corners);
    }
    else if (count > 4)
    {
      this->Others->InsertNextCell(corners);
    }
  }

  // Triangles from one corner.
  void CutFan(vtkIdList* corners, vtkIdType from)
  {
    const vtkIdType count = corners->GetNumberOfIds();
    for (vtkIdType i = 1; i + 1 < count; ++i)
    {
      const vtkIdType triangle[3] = { corners->GetId(from), corners->GetId((from + i) % count),
        corners->GetId((from + i + 1) % count) };
      this->Triangles->InsertNextCell(3, triangle);
    }
  }

  // What cannot be cut becomes a fan.
  void CutEach(Progress& progress)
  {
    vtkPoints* points = this->Surface->GetPoints();
    PolygonCutter cutter(points, roundingOf(points));
    vtkNew<vtkIdList> corners;
    for (vtkIdType polygon = 0; polygon < this->Others->GetNumberOfCells(); ++polygon)
    {
      this->Others->GetCellAtId(polygon, corners);
      if (!cutter.Cut(corners->GetNumberOfIds(), corners->GetPointer(0), this->Triangles))
      {
        this->CutFan(corners, 0);
      }
      progress.Check();
    }
    vtkNew<vtkCellArray> none;
    this->Triangles->Append(triangulate(points, none, this->Surface->GetStrips(), progress));
  }

  vtkPolyData* Surface;
  const ClosedMesh& Mesh;
  vtkNew<vtkCellArray> Triangles;
  vtkNew<vtkCellArray> Others;
};

} // namespace

vtkSmartPointer<vtkCellArray> cutIntoTriangles(
  vtkPolyData* surface, const ClosedMesh& mesh, Progress& progress)
{
  if (isAllTriangles(surface))
  {
    return surface->GetPolys();
  }
  PolygonCut cut(surface, mesh);
  Stages stages(progress, { { "polygons", 1 }, { "others", 1 } });
  cut.CutPolygons(stages["polygons"]);
  cut.CutOthers(stages["others"]);
  return cut.Take();
}

} // namespace RectifiedTransport::Bridge
