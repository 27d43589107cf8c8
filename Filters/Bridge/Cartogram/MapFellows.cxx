// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cartogram/MapFellows.h"

#include "Bridge/Points/ParticleCells.h"
#include "Bridge/Points/PointInput.h"
#include "Bridge/Run/Memory.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cstddef>
#include <cstdint>

namespace RectifiedTransport
{

namespace
{

constexpr int spaces = 16;          // between the lines along each axis
constexpr std::int64_t parts = 512; // of a line
constexpr std::int64_t pointsOfLine = parts + 1;
constexpr std::int64_t lineCount = 2 * (spaces + 1);

} // namespace

MapFellows::MapFellows(
  const MapPlace& place, const std::vector<OverlayPart>& overlay, Progress& progress)
  : Place(place)
  , Overlay(overlay)
{
  const auto side = static_cast<double>(place.Box.Side);
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    for (int line = 0; line <= spaces; ++line)
    {
      for (std::int64_t i = 0; i <= parts; ++i)
      {
        Point<2> point;
        point[axis] = side * line / spaces;
        point[1 - axis] = side * static_cast<double>(i) / static_cast<double>(parts);
        this->Moved.push_back(point);
      }
    }
  }
  for (const OverlayPart& part : overlay)
  {
    const std::size_t moved = this->Moved.size();
    const std::size_t before = this->OverlayBefore.size();
    const auto count = static_cast<std::size_t>(part.Input->GetNumberOfPoints());
    this->Moved.resize(moved + count);
    this->OverlayBefore.resize(before + count);
    visitPoints(part.Input, "Overlay", progress, [&](std::int64_t i, const double* x) {
      const auto at = static_cast<std::size_t>(i);
      this->OverlayBefore[before + at] = { x[0], x[1], x[2] };
      this->Moved[moved + at] = place.ToIndex({ x[0], x[1], x[2] });
    });
  }
  this->Before = this->Moved;
}

void MapFellows::WriteGraticule(vtkPolyData* output, Progress& progress) const
{
  constexpr std::int64_t count = lineCount * pointsOfLine;
  const auto points = newArray<vtkDoubleArray>("Points", 3, count);
  for (std::int64_t i = 0; i < count; ++i)
  {
    const auto at = static_cast<std::size_t>(i);
    points->SetTypedTuple(i, this->Place.Blended(this->Before[at], this->Moved[at], 0.0).data());
  }
  setParticles(output, points, pointsOfLine, progress);
}

void MapFellows::WriteOverlay(Progress& progress) const
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  constexpr auto first = static_cast<std::size_t>(lineCount * pointsOfLine);
  std::size_t before = 0;
  for (const OverlayPart& part : this->Overlay)
  {
    const std::int64_t count = part.Input->GetNumberOfPoints();
    const auto places = newArray<vtkDoubleArray>("Points", 3, count);
    progress.For(count, grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const std::size_t at = before + static_cast<std::size_t>(i);
        const Point<3> place = this->Place.Blended(this->Before[first + at],
          this->Moved[first + at], this->Place.Frame.Distance(this->OverlayBefore[at]));
        places->SetTypedTuple(i, place.data());
      }
    });
    vtkNew<vtkPoints> points;
    points->SetData(places);
    part.Output->SetPoints(points);
    before += static_cast<std::size_t>(count);
  }
}

} // namespace RectifiedTransport
