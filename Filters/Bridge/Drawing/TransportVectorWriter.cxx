// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Drawing/TransportVectorWriter.h"

#include "Bridge/Drawing/DotRadius.h"
#include "Bridge/Drawing/Drawing.h"
#include "Bridge/Drawing/DrawnLayer.h"
#include "Bridge/Drawing/LayerPainter.h"
#include "Bridge/Drawing/PageLayout.h"
#include "Bridge/Points/CopiedTuples.h"
#include "Bridge/Run/ArrayList.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/PropertyCheck.h"
#include "Core/Parallel/Stages.h"

#include "vtkDataArray.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace RectifiedTransport::Bridge
{

namespace
{

std::string titleOf(const char* property, vtkAbstractArray* array)
{
  return std::string(property) + " '" + (array->GetName() ? array->GetName() : "") + "'";
}

// Where shapes lie, and of what kind they are.
struct Extent
{
  DrawnBounds Points;
  DrawnBounds Dots;              // without a radius of their own
  DrawnBounds Rest;              // with the others' radii
  std::int64_t NumberOfDots = 0; // of Dots
  bool HasStrokes = false;
};

void requireFinite(const double* point, vtkIdType number)
{
  if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
  {
    fail("The input has a point that is NaN or infinite, at index ", number,
      "; all coordinates must be finite");
  }
}

void requireRadius(double radius, vtkIdType number)
{
  if (!(radius >= 0.0) || !std::isfinite(radius))
  {
    fail("RadiusArray has the value ", radius, " at index ", number,
      "; every radius must be finite and not negative");
  }
}

bool isStroked(const DrawnLayer& layer, const Shape& shape)
{
  return shape.Kind == ShapeKind::Line ||
    (shape.Kind == ShapeKind::Polygon && !layer.Colours.AreGiven());
}

// Those without a radius of their own.
LargeBuffer<double> dotsOf(
  const std::vector<DrawnLayer>& layers, std::int64_t count, Progress& progress)
{
  LargeBuffer<double> dots = withMemory({ "the places of " + std::to_string(count) + " dots",
                                          3.0 * sizeof(double) * static_cast<double>(count) },
    [&]() { return LargeBuffer<double>(3 * count); });
  double* next = dots.data();
  for (const DrawnLayer& layer : layers)
  {
    layer.Shapes.ForEach(progress, [&](const Shape& shape) {
      if (shape.Kind == ShapeKind::Dot && layer.NeedsRadius())
      {
        next = std::copy_n(layer.At(shape.Points[0]), 3, next);
      }
    });
  }
  return dots;
}

void include(const DrawnLayer& layer, const Shape& shape, Extent& extent)
{
  extent.HasStrokes = extent.HasStrokes || isStroked(layer, shape);
  const bool isDot = shape.Kind == ShapeKind::Dot;
  for (vtkIdType i = 0; i < shape.Count; ++i)
  {
    const vtkIdType number = shape.Points[i];
    const double* point = layer.At(number);
    requireFinite(point, number);
    extent.Points.Include(point);
    if (isDot && layer.NeedsRadius())
    {
      extent.Dots.Include(point);
      ++extent.NumberOfDots;
      continue;
    }
    const double radius = isDot ? layer.RadiusAt(number) : 0.0;
    requireRadius(radius, number);
    extent.Rest.Include(point, radius);
  }
}

Extent extentOf(const std::vector<DrawnLayer>& layers, Progress& progress)
{
  Extent extent;
  for (const DrawnLayer& layer : layers)
  {
    layer.Shapes.ForEach(progress, [&](const Shape& shape) { include(layer, shape, extent); });
  }
  return extent;
}

// Of dots that are all at one place.
double radiusWithoutNeighbours(const DrawnBounds& points)
{
  constexpr double share = 0.01; // of the longest side
  const double longest = std::max({ points.Length(0), points.Length(1), points.Length(2) });
  return longest > 0.0 ? share * longest : 1.0;
}

using PageBounds = std::array<double, 6>;

bool isGiven(const PageBounds& bounds)
{
  return bounds != PageBounds{};
}

void requirePageBounds(const PageBounds& bounds)
{
  int ascending = 0;
  int equal = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = bounds[2 * axis + 1] - bounds[2 * axis];
    ascending += length > 0.0 && std::isfinite(length) ? 1 : 0;
    equal += length == 0.0 ? 1 : 0;
  }
  if (isGiven(bounds) && (ascending < 2 || ascending + equal < 3))
  {
    fail("PageBounds are ", bounds[0], " ", bounds[1], " ", bounds[2], " ", bounds[3], " ",
      bounds[4], " ", bounds[5],
      "; they must be the lowest and highest x, y and z, and longer than 0 along two axes, or all "
      "0");
  }
}

PageLayout layoutInBounds(const TransportVectorWriter& writer, const DrawnBounds& drawn)
{
  constexpr double farthest = 1e6; // millimetres, for numbers that all readers take
  const PageBounds& bounds = writer.PageBounds;
  DrawnBounds shown;
  shown.Include(std::array<double, 3>{ bounds[0], bounds[2], bounds[4] }.data());
  shown.Include(std::array<double, 3>{ bounds[1], bounds[3], bounds[5] }.data());
  const PageLayout layout(shown.LongestAxes(), shown, { writer.Width, writer.PageMargin });
  for (const double* corner : { drawn.LowerCorner(), drawn.UpperCorner() })
  {
    for (const double distance : layout.At(corner))
    {
      if (!(std::abs(distance) <= farthest))
      {
        fail("PageBounds are so small that the input reaches ", std::abs(distance),
          " mm from the page; it may reach ", farthest, " mm: cut it with Clip or Threshold");
      }
    }
  }
  return layout;
}

PageLayout layoutOf(const TransportVectorWriter& writer, const Extent& extent)
{
  const bool inBounds = isGiven(writer.PageBounds);
  const bool fitsStrokes = extent.HasStrokes && !inBounds;
  const double margin = writer.PageMargin + (fitsStrokes ? 0.5 * writer.LineWidth : 0.0);
  if (!(2.0 * margin < writer.Width))
  {
    fail("Width is ", writer.Width, "; it must be more than ", 2.0 * margin,
      fitsStrokes ? ", twice PageMargin and the LineWidth" : ", twice PageMargin");
  }
  return inBounds ? layoutInBounds(writer, extent.Rest)
                  : PageLayout(extent.Points.LongestAxes(), extent.Rest, { writer.Width, margin });
}

// VTK's own colours over the values of all data sets.
vtkSmartPointer<vtkScalarsToColors> tableOf(const std::vector<DrawnData>& data)
{
  constexpr int component = 0;
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (const DrawnData& drawn : data)
  {
    auto* array = vtkDataArray::SafeDownCast(drawn.Colours);
    if (array && !areColours(array))
    {
      double range[2];
      array->GetFiniteRange(range, array->GetNumberOfComponents() == 1 ? component : -1);
      least = std::min(least, range[0]);
      greatest = std::max(greatest, range[1]);
    }
  }
  const auto table = vtkSmartPointer<vtkLookupTable>::New();
  if (least <= greatest)
  {
    table->SetTableRange(least, greatest);
  }
  table->SetVectorModeToMagnitude();
  table->Build();
  return table;
}

// VTK leaves the colours of other arrays unset.
void requireColours(vtkAbstractArray* array, vtkScalarsToColors* table)
{
  if (!vtkDataArray::SafeDownCast(array) && !(table && table->GetIndexedLookup()))
  {
    fail(titleOf("ColorArray", array),
      " has no numbers; choose one that has, or a LookupTable with IndexedLookup and a colour for "
      "each value");
  }
}

} // namespace

void TransportVectorWriter::Check() const
{
  const auto require = [](const char* property, double value, bool isLarge, const char* rule) {
    requireThat(std::isfinite(value) && isLarge, property, value, rule);
  };
  require("Width", this->Width, this->Width > 0.0, "more than 0 (millimetres)");
  require("PageMargin", this->PageMargin, this->PageMargin >= 0.0, "0 or more (millimetres)");
  require("LineWidth", this->LineWidth, this->LineWidth > 0.0, "more than 0 (millimetres)");
  requirePageBounds(this->PageBounds);
  require("PointRadius", this->PointRadius, this->PointRadius >= 0.0,
    "more than 0, or 0 for a radius from the spacing");
}

void TransportVectorWriter::Run(
  const std::vector<DrawnData>& data, Drawing& drawing, Progress& progress) const
{
  std::int64_t shapes = 0;
  std::int64_t points = 0; // where there are radii twice
  vtkSmartPointer<vtkScalarsToColors> table = this->LookupTable;
  for (const DrawnData& drawn : data)
  {
    shapes += drawn.Shapes.Count();
    vtkPolyData* own = drawn.Shapes.Data();
    points += own->GetNumberOfPoints() * (drawn.Radii ? 2 : 1);
    if (drawn.Colours)
    {
      requireTuples(drawn.Colours,
        drawn.HasColoursOnPoints ? own->GetNumberOfPoints() : own->GetNumberOfCells(),
        drawn.HasColoursOnPoints ? "point" : "cell", "input");
      requireColours(drawn.Colours, this->LookupTable);
      table = table ? table : tableOf(data);
    }
    if (drawn.Radii)
    {
      requireScalars(
        drawn.Radii, titleOf("RadiusArray", drawn.Radii), own->GetNumberOfPoints(), "points");
    }
  }

  std::vector<DrawnLayer> layers;
  layers.reserve(data.size());
  Stages stages(progress, { { "points", 1 }, { "extent", 1 }, { "spacing", 3 }, { "drawing", 5 } });
  Progress& reading = stages["points"].Expect(points);
  for (const DrawnData& drawn : data)
  {
    layers.emplace_back(drawn, table, reading);
    if (this->FillOutlines)
    {
      layers.back().FillOutlines();
    }
  }
  Progress& visits = stages["extent"].Expect(2 * shapes);
  Extent extent = extentOf(layers, visits);
  if (extent.NumberOfDots > 0)
  {
    double radius = this->PointRadius;
    if (radius == 0.0)
    {
      const LargeBuffer<double> dots = dotsOf(layers, extent.NumberOfDots, visits);
      radius = radiusOfDots({ dots.data(), extent.NumberOfDots }, stages["spacing"]);
      radius = radius > 0.0 ? radius : radiusWithoutNeighbours(extent.Points);
    }
    for (DrawnLayer& layer : layers)
    {
      layer.Radius = radius;
    }
    extent.Rest.Include(extent.Dots, radius);
  }
  if (extent.Points.IsEmpty())
  {
    fail(points > 0 ? "The input has points, but none that is drawn: its cells have no points, or "
                      "vtkGhostType marks them as duplicates or hidden"
                    : "The input has no points; there is nothing to draw");
  }
  const PageLayout layout = layoutOf(*this, extent);
  const double longest = std::max(layout.Size()[0], layout.Size()[1]);
  if (longest > drawing.LongestSide())
  {
    fail("The page is ", layout.Size()[0], " x ", layout.Size()[1], " mm with Width ", this->Width,
      "; no side may be longer than ", drawing.LongestSide(),
      " mm in this format: Width must be at most ", this->Width * drawing.LongestSide() / longest);
  }

  drawing.Begin(
    { layout.Size(), isGiven(this->PageBounds) ? this->PageMargin : 0.0, this->LineWidth });
  Progress& painting = stages["drawing"].Expect(shapes);
  for (const DrawnLayer& layer : layers)
  {
    paintLayer(layer, layout, drawing, painting);
  }
  drawing.End();
}

} // namespace RectifiedTransport::Bridge
