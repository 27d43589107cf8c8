// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Drawing/LayerPainter.h"

#include "Bridge/Drawing/Drawing.h"
#include "Bridge/Drawing/DrawnLayer.h"
#include "Bridge/Drawing/PageLayout.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

class LayerPainter
{
public:
  LayerPainter(const DrawnLayer& layer, const PageLayout& layout, Drawing& drawing)
    : Painted(layer)
    , Layout(layout)
    , Page(drawing)
  {
  }

  // Below the rest.
  void PaintRegions()
  {
    std::vector<vtkIdType> points;
    for (const std::vector<Outline>& region : this->Painted.Regions)
    {
      this->Area.clear();
      points.clear();
      for (const Outline& outline : region)
      {
        this->Path.clear();
        for (const vtkIdType point : outline.Points)
        {
          this->Path.push_back(this->Place(point));
        }
        this->Area.push_back(this->Path);
        points.insert(points.end(), outline.Points.begin(), outline.Points.end());
      }
      const auto count = static_cast<vtkIdType>(points.size());
      this->Page.FillPolygons(this->Area, FillRule::Odd,
        this->Painted.Colours.Of({ ShapeKind::Polygon, points.data(), count, region[0].Cell }));
    }
    this->Area.clear();
  }

  void Paint(const Shape& shape)
  {
    const Colour colour = this->Painted.Colours.Of(shape);
    const bool isFilled = shape.Kind == ShapeKind::Polygon && this->Painted.Colours.AreGiven();
    if (!isFilled || !(colour == this->AreaColour) || this->Area.size() == mostPolygons)
    {
      this->PaintArea();
    }
    if (shape.Kind == ShapeKind::Dot)
    {
      const double radius = this->Layout.Scale() * this->Painted.RadiusAt(shape.Points[0]);
      if (radius > 0.0)
      {
        this->Page.FillDisc(this->Place(shape.Points[0]), radius, colour);
      }
      return;
    }
    this->Path.clear();
    for (vtkIdType i = 0; i < shape.Count; ++i)
    {
      this->Path.push_back(this->Place(shape.Points[i]));
    }
    if (shape.Kind == ShapeKind::Line)
    {
      this->PaintLine(shape, colour);
    }
    else if (isFilled)
    {
      this->AddToArea(colour);
    }
    else
    {
      this->Page.Stroke(this->Path, true, colour);
    }
  }

  // Call it after the last shape.
  void PaintArea()
  {
    if (!this->Area.empty())
    {
      this->Page.FillPolygons(this->Area, FillRule::Any, this->AreaColour);
      this->Area.clear();
    }
  }

private:
  // Of an area, so that programs need not take long to read one.
  static constexpr std::size_t mostPolygons = 50000;

  // Where transparent polygons overlap, both count.
  void AddToArea(Colour colour)
  {
    double twice = 0.0; // the area
    for (std::size_t i = 0; i < this->Path.size(); ++i)
    {
      const PagePoint& a = this->Path[i];
      const PagePoint& b = this->Path[(i + 1) % this->Path.size()];
      twice += a[0] * b[1] - a[1] * b[0];
    }
    if (twice < 0.0)
    {
      std::reverse(this->Path.begin() + 1, this->Path.end());
    }
    this->Area.push_back(this->Path);
    this->AreaColour = colour;
    if (colour.Opacity < 255)
    {
      this->PaintArea();
    }
  }

  PagePoint Place(vtkIdType point) const { return this->Layout.At(this->Painted.At(point)); }

  // With colours on points each segment has its own.
  void PaintLine(const Shape& line, Colour colour)
  {
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
    for (vtkIdType i = 0; i + 1 < line.Count; ++i)
    {
      const Shape segment{ ShapeKind::Line, line.Points + i, 2, line.Cell };
      const auto first = this->Path.begin() + i;
      this->Segment.assign(first, first + 2);
      this->Page.Stroke(this->Segment, false, this->Painted.Colours.Of(segment));
    }
  }

  const DrawnLayer& Painted;
  const PageLayout& Layout;
  Drawing& Page;
  PagePath Path;
  PagePath Segment;
  std::vector<PagePath> Area; // of polygons that follow each other and have this colour
  Colour AreaColour;
};

} // namespace

void paintLayer(
  const DrawnLayer& layer, const PageLayout& layout, Drawing& drawing, Progress& progress)
{
  LayerPainter painter(layer, layout, drawing);
  painter.PaintRegions();
  layer.Shapes.ForEach(progress, [&](const Shape& shape) { painter.Paint(shape); });
  painter.PaintArea();
}

} // namespace RectifiedTransport::Bridge
