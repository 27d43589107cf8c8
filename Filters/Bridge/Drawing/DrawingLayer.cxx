// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Drawing/DrawingLayer.h"

#include "Core/Drawing/DotPath.h"
#include "Core/Drawing/PolygonBatch.h"

#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <array>
#include <cstddef>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// Draws one data set onto a page. Polygons with given colours are collected in PolygonBatch and
// drawn before the next shape of another kind, because what comes later lies on top.
class LayerPainter
{
public:
  LayerPainter(const DrawingLayer& layer, const PageLayout& layout, Drawing& drawing)
    : Painted(layer)
    , Layout(layout)
    , Page(drawing)
    , Areas(drawing)
  {
  }

  // All outlines of a region are one path, filled by the even-odd rule: an outline within another
  // one is a hole.
  // The colour is that of the first outline's cell, or the mean of all points.
  void PaintRegions(const vtkVariant& group)
  {
    std::vector<vtkIdType> points;
    std::vector<PagePath> area;
    for (const std::vector<Outline>& region : this->Painted.Regions)
    {
      area.clear();
      points.clear();
      for (const Outline& outline : region)
      {
        this->SetPath(outline.Points.data(), static_cast<vtkIdType>(outline.Points.size()));
        area.push_back(this->Path);
        points.insert(points.end(), outline.Points.begin(), outline.Points.end());
      }
      const Shape shape{ ShapeKind::Polygon, points.data(), static_cast<vtkIdType>(points.size()),
        region[0].Cell };
      if (this->Painted.Groups.Of(shape) == group)
      {
        this->Page.FillPolygons(area, FillRule::Odd, this->Painted.Colours.Of(shape));
      }
    }
  }

  // Draws one shape over what is there: polygons are filled if they have colours and stroked
  // otherwise.
  void Paint(const Shape& shape)
  {
    const Colour colour = this->Painted.Colours.Of(shape);
    this->SetPath(shape.Points, shape.Count);
    if (shape.Kind == ShapeKind::Polygon && this->Painted.Colours.AreGiven())
    {
      this->Areas.Add(this->Path, colour);
      return;
    }
    this->Areas.Draw();
    if (shape.Kind == ShapeKind::Dot)
    {
      // From units of the data to millimetres. A radius from an array may be 0: it draws nothing.
      const double radius = this->Layout.Scale() * this->Painted.RadiusAt(shape.Points[0]);
      if (radius > 0.0)
      {
        this->Page.FillDisc(this->Path.front(), radius, colour);
      }
    }
    else if (shape.Kind == ShapeKind::Line)
    {
      this->PaintLine(shape, colour);
    }
    else
    {
      this->Page.Stroke(this->Path, true, colour);
    }
  }

  // Call it after the last shape.
  void End() { this->Areas.Draw(); }

private:
  // Sets the current path to points of the data, on the page in millimetres; its memory is reused.
  void SetPath(const vtkIdType* points, vtkIdType count)
  {
    this->Path.clear();
    for (vtkIdType i = 0; i < count; ++i)
    {
      this->Path.push_back(this->Layout.At(this->Painted.At(points[i])));
    }
  }

  // With colours on points each segment has its own.
  void PaintLine(const Shape& line, Colour colour)
  {
    // Outlines that are filled get a black stroke. The path is closed, so that it does not need the
    // last point, which repeats the first one: joins of strokes would differ there.
    if (this->Painted.IsOutline(line.Cell))
    {
      this->Path.pop_back();
      this->Page.Stroke(this->Path, true, {});
      return;
    }
    if (!this->Painted.Colours.AreOnPoints())
    {
      this->Page.Stroke(this->Path, false, colour);
      return;
    }
    PagePath segment;
    for (vtkIdType i = 0; i + 1 < line.Count; ++i)
    {
      const auto first = this->Path.begin() + i;
      segment.assign(first, first + 2);
      this->Page.Stroke(
        segment, false, this->Painted.Colours.Of({ line.Kind, line.Points + i, 2, line.Cell }));
    }
  }

  const DrawingLayer& Painted;
  const PageLayout& Layout;
  Drawing& Page;
  PolygonBatch Areas;
  PagePath Path;
};

} // namespace

DrawingLayer::DrawingLayer(
  const LayerData& data, bool fillsOutlines, vtkScalarsToColors* table, Progress& progress)
  : Shapes(data.Shapes)
  , Groups(data.Groups)
  , Points(data.Shapes.Data()->GetPoints()->GetData(), progress)
{
  if (data.Colours)
  {
    this->Colours = ShapeColours(data.Colours, data.HasColoursOnPoints, table);
  }
  if (data.Radii)
  {
    this->Radii.emplace(data.Radii, progress);
  }
  // Without colours regions would hide each other in black.
  if (fillsOutlines && this->Colours.AreGiven())
  {
    this->Regions = findOutlineRegions(this->Shapes.Data()).Regions;
    // One flag a cell: lines that are outlines are stroked as closed paths.
    this->Outlines.assign(static_cast<std::size_t>(this->Shapes.Data()->GetNumberOfCells()), 0);
    for (const std::vector<Outline>& region : this->Regions)
    {
      for (const Outline& outline : region)
      {
        this->Outlines[static_cast<std::size_t>(outline.Cell)] = 1;
      }
    }
  }
}

void DrawingLayer::Draw(const PageLayout& layout, Drawing& drawing, const vtkVariant& group,
  bool hasShortPath, Progress& progress) const
{
  LayerPainter painter(*this, layout, drawing);
  painter.PaintRegions(group); // below the rest
  // Filled polygons first, then lines and dots, in the order of PolyDataShapes.
  std::vector<Point<2>> places;
  std::vector<std::array<vtkIdType, 2>> dots; // point and cell
  this->Shapes.ForEach(progress, [&](const Shape& shape) {
    if (this->Groups.Of(shape) != group)
    {
      return;
    }
    if (!hasShortPath || shape.Kind != ShapeKind::Dot)
    {
      painter.Paint(shape);
      return;
    }
    places.push_back(layout.At(this->At(shape.Points[0])));
    dots.push_back({ shape.Points[0], shape.Cell });
  });
  for (const std::int64_t i : shortPath(places, progress))
  {
    const auto& [point, cell] = dots[static_cast<std::size_t>(i)];
    painter.Paint({ ShapeKind::Dot, &point, 1, cell });
  }
  painter.End();
}

} // namespace RectifiedTransport::Bridge
