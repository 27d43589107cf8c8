// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surface/PolygonCutter.h"

#include "vtkCellArray.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport::Bridge
{

PolygonCutter::PolygonCutter(vtkPoints* points, double rounding)
  : Points(points)
  , Rounding(rounding)
{
}

bool PolygonCutter::Cut(vtkIdType count, const vtkIdType* corners, vtkCellArray* triangles)
{
  if (count < 4)
  {
    if (count == 3)
    {
      triangles->InsertNextCell(3, corners);
    }
    return true;
  }
  this->Corners.resize(static_cast<std::size_t>(count));
  Ring ring(this->Corners.size());
  std::array<double, 3> low{};
  std::array<double, 3> high{};
  for (std::size_t i = 0; i < ring.size(); ++i)
  {
    ring[i] = i;
    this->Points->GetPoint(corners[i], this->Corners[i].data());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double x = this->Corners[i][axis];
      low[axis] = i == 0 ? x : std::min(low[axis], x);
      high[axis] = i == 0 ? x : std::max(high[axis], x);
    }
  }
  this->Size = std::max({ high[0] - low[0], high[1] - low[1], high[2] - low[2] });
  bool isCut = this->CutRing(ring);
  if (!isCut)
  {
    ring = this->WithoutEqual(ring);
    isCut = this->CutRing(ring);
  }
  for (std::size_t before = ring.size() + 1; !isCut && ring.size() < before;)
  {
    before = ring.size();
    ring = this->WithoutEqual(this->WithoutStraight(ring));
    isCut = this->CutRing(ring);
  }
  if (isCut)
  {
    this->Append(ring, corners, triangles);
  }
  return isCut;
}

// A ring of less than three corners has no triangles.
bool PolygonCutter::CutRing(const Ring& ring)
{
  this->Ids->Reset();
  if (ring.size() < 3)
  {
    return true;
  }
  const auto count = static_cast<vtkIdType>(ring.size());
  this->Polygon->PointIds->SetNumberOfIds(count);
  this->Polygon->Points->SetDataTypeToDouble();
  this->Polygon->Points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    this->Polygon->PointIds->SetId(i, i);
    this->Polygon->Points->SetPoint(i, this->Corners[ring[static_cast<std::size_t>(i)]].data());
  }
  return this->Polygon->Triangulate(0, this->Ids, this->IgnoredPoints) != 0 &&
    this->Ids->GetNumberOfIds() == 3 * (count - 2);
}

PolygonCutter::Ring PolygonCutter::WithoutEqual(const Ring& ring) const
{
  Ring kept;
  for (const std::size_t corner : ring)
  {
    if (kept.empty() || !this->IsSamePlace(kept.back(), corner))
    {
      kept.push_back(corner);
    }
  }
  while (kept.size() > 1 && this->IsSamePlace(kept.front(), kept.back()))
  {
    kept.pop_back();
  }
  return kept;
}

// Without corners on the line through their neighbours, no two of which are neighbours.
PolygonCutter::Ring PolygonCutter::WithoutStraight(const Ring& ring) const
{
  if (ring.size() < 3)
  {
    return ring;
  }
  Ring kept;
  bool isLastLeftOut = false;
  for (std::size_t i = 0; i < ring.size(); ++i)
  {
    const std::size_t last = ring[(i + ring.size() - 1) % ring.size()];
    const std::size_t next = ring[(i + 1) % ring.size()];
    const bool isEnd = i + 1 == ring.size() && kept.front() != ring.front();
    isLastLeftOut = !isLastLeftOut && !isEnd && this->IsStraight(last, ring[i], next);
    if (!isLastLeftOut)
    {
      kept.push_back(ring[i]);
    }
  }
  return kept;
}

bool PolygonCutter::IsSamePlace(std::size_t a, std::size_t b) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!(std::abs(this->Corners[a][axis] - this->Corners[b][axis]) <= this->Rounding))
    {
      return false;
    }
  }
  return true;
}

// The distance from b to the line from a to c, or to the point that a and c are.
bool PolygonCutter::IsStraight(std::size_t a, std::size_t b, std::size_t c) const
{
  constexpr double part = 1e-7; // of the size: vtkPolygon has tolerances of its own
  double u[3];
  double v[3];
  double square = 0.0;
  double along = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    u[i] = this->Corners[c][i] - this->Corners[a][i];
    v[i] = this->Corners[b][i] - this->Corners[a][i];
    square += u[i] * u[i];
    along += u[i] * v[i];
  }
  double distance = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double across = v[i] - (square > 0.0 ? along / square * u[i] : 0.0);
    distance += across * across;
  }
  const double tolerance = std::max(this->Rounding, part * this->Size);
  return std::sqrt(distance) <= tolerance || this->IsSamePlace(a, c);
}

void PolygonCutter::Append(
  const Ring& ring, const vtkIdType* corners, vtkCellArray* triangles) const
{
  const auto insert = [&](std::size_t a, std::size_t b, std::size_t c) {
    const vtkIdType ids[3] = { corners[a], corners[b], corners[c] };
    triangles->InsertNextCell(3, ids);
  };
  const auto corner = [&](vtkIdType i) {
    return ring[static_cast<std::size_t>(this->Ids->GetId(i))];
  };
  for (vtkIdType i = 0; i < this->Ids->GetNumberOfIds(); i += 3)
  {
    insert(corner(i), corner(i + 1), corner(i + 2));
  }
  const std::size_t count = this->Corners.size();
  if (ring.size() < 3) // all corners are on one line
  {
    for (std::size_t i = 2; i < count; ++i)
    {
      insert(0, i - 1, i);
    }
    return;
  }
  // Those that were left out between two that were kept, as a fan from the first of these.
  for (std::size_t i = 0; i < ring.size(); ++i)
  {
    const std::size_t next = ring[(i + 1) % ring.size()];
    for (std::size_t out = (ring[i] + 1) % count; out != next; out = (out + 1) % count)
    {
      insert(ring[i], out, (out + 1) % count);
    }
  }
}

} // namespace RectifiedTransport::Bridge
