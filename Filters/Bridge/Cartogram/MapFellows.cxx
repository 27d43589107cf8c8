// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cartogram/MapFellows.h"

#include "Bridge/Points/PointInput.h"
#include "Bridge/Run/Memory.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr int squares = 16;   // along each side of the raster
constexpr int mostParts = 16; // of a square's side

// The squares that a map reaches along an axis, with the raster's margin around it.
struct Reach
{
  int First;
  int Last; // one beyond
};

std::array<Reach, 2> reachOf(const RegionMap& map, double side)
{
  Point<2> low{ HUGE_VAL, HUGE_VAL };
  Point<2> high{ -HUGE_VAL, -HUGE_VAL };
  for (const Point<2>& place : map.Points())
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      low[axis] = std::min(low[axis], place[axis]);
      high[axis] = std::max(high[axis], place[axis]);
    }
  }
  const double margin = 0.5 * (side - std::max(high[0] - low[0], high[1] - low[1]));
  constexpr double rounding = 1e-6;
  std::array<Reach, 2> reach;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    reach[axis] = {
      std::max(0, static_cast<int>(std::floor((low[axis] - margin) / side * squares + rounding))),
      std::min(
        squares, static_cast<int>(std::ceil((high[axis] + margin) / side * squares - rounding)))
    };
  }
  return reach;
}

} // namespace

MapFellows::MapFellows(const MapPlace& place, const RegionMap& map,
  const std::vector<OverlayPart>& overlay, Progress& progress)
  : Place(place)
  , Overlay(overlay)
{
  const auto side = static_cast<double>(place.Box.Side);
  // Not shorter than cells.
  const int parts = std::clamp(static_cast<int>(place.Box.Side / squares), 1, mostParts);
  const std::array<Reach, 2> reach = reachOf(map, side);
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const Reach across = reach[axis];
    const Reach along = reach[1 - axis];
    for (int line = across.First; line <= across.Last; ++line)
    {
      for (int i = parts * along.First; i <= parts * along.Last; ++i)
      {
        Point<2> point;
        point[axis] = side * line / squares;
        point[1 - axis] = side * i / (squares * parts);
        this->Moved.push_back(point);
      }
      this->LineEnds.push_back(this->Moved.size());
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
    });
    place.Projection.Require(this->OverlayBefore, before, "Overlay");
    for (std::size_t i = 0; i < count; ++i)
    {
      Point<3>& projected = this->OverlayBefore[before + i];
      projected = place.Projection.Project(projected);
      this->Moved[moved + i] = place.ToIndex(projected);
    }
  }
  this->Before = this->Moved;
}

void MapFellows::WriteGraticule(vtkPolyData* output) const
{
  const std::size_t count = this->LineEnds.back();
  const auto number = [](std::size_t i) { return static_cast<vtkIdType>(i); };
  const auto coordinates = newArray<vtkDoubleArray>("Points", 3, number(count));
  const auto ids = newArray<vtkIdTypeArray>("Ids", 1, number(count));
  const auto offsets = newArray<vtkIdTypeArray>("Offsets", 1, number(this->LineEnds.size() + 1));
  for (std::size_t i = 0; i < count; ++i)
  {
    ids->SetValue(number(i), number(i));
    coordinates->SetTypedTuple(
      number(i), this->Place.Blended(this->Before[i], this->Moved[i], 0.0).data());
  }
  offsets->SetValue(0, 0);
  for (std::size_t line = 0; line < this->LineEnds.size(); ++line)
  {
    offsets->SetValue(number(line + 1), number(this->LineEnds[line]));
  }
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  vtkNew<vtkCellArray> lines;
  lines->SetData(offsets, ids);
  output->SetPoints(points);
  output->SetLines(lines);
}

void MapFellows::WriteOverlay(Progress& progress) const
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  const std::size_t first = this->LineEnds.back();
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
        // So far away that its index is infinite, its way is less than rounding.
        const bool isFinite = std::all_of(
          place.begin(), place.end(), [](double coordinate) { return std::isfinite(coordinate); });
        places->SetTypedTuple(i, isFinite ? place.data() : this->OverlayBefore[at].data());
      }
    });
    vtkNew<vtkPoints> points;
    points->SetData(places);
    part.Output->SetPoints(points);
    before += static_cast<std::size_t>(count);
  }
}

} // namespace RectifiedTransport::Bridge
