// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cartogram/MapFellows.h"

#include "Bridge/Points/PointInput.h"

#include "vtkCellArray.h"
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
constexpr std::int64_t parts = 256; // of a line
constexpr std::int64_t pointsOfLine = parts + 1;
constexpr std::int64_t lineCount = 2 * (spaces + 1);

} // namespace

MapFellows::MapFellows(const MapPlace& place, vtkPointSet* overlay, Progress& progress)
  : Place(place)
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
  if (overlay)
  {
    const std::size_t first = this->Moved.size();
    this->Overlay.resize(static_cast<std::size_t>(overlay->GetNumberOfPoints()));
    this->Moved.resize(first + this->Overlay.size());
    visitPoints(overlay, "Overlay", progress, [&](std::int64_t i, const double* x) {
      const auto at = static_cast<std::size_t>(i);
      this->Overlay[at] = { x[0], x[1], x[2] };
      this->Moved[first + at] = place.ToIndex(this->Overlay[at]);
    });
  }
  this->Before = this->Moved;
}

void MapFellows::WriteGraticule(vtkPolyData* output) const
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  for (std::int64_t line = 0; line < lineCount; ++line)
  {
    lines->InsertNextCell(static_cast<int>(pointsOfLine));
    for (std::int64_t i = 0; i < pointsOfLine; ++i)
    {
      const auto at = static_cast<std::size_t>(line * pointsOfLine + i);
      const Point<3> place = this->Place.Blended(this->Before[at], this->Moved[at], 0.0);
      lines->InsertCellPoint(points->InsertNextPoint(place.data()));
    }
  }
  output->SetPoints(points);
  output->SetLines(lines);
}

void MapFellows::WriteOverlay(vtkPointSet* output) const
{
  constexpr auto first = static_cast<std::size_t>(lineCount * pointsOfLine);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(this->Overlay.size()));
  for (std::size_t i = 0; i < this->Overlay.size(); ++i)
  {
    const Point<3> place = this->Place.Blended(this->Before[first + i], this->Moved[first + i],
      this->Place.Frame.Distance(this->Overlay[i]));
    points->SetPoint(static_cast<vtkIdType>(i), place.data());
  }
  output->SetPoints(points);
}

} // namespace RectifiedTransport
