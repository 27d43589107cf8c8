// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Drawing/TransportVectorWriter.h"

#include "Bridge/Data/TupleCopy.h"
#include "Bridge/Drawing/DrawingLayer.h"
#include "Bridge/Run/ArrayList.h"
#include "Bridge/Run/Memory.h"
#include "Core/Drawing/Drawing.h"
#include "Core/Drawing/PageLayout.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/Stages.h"
#include "Core/Quality/DotRadius.h"

#include "vtkDataArray.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace RectifiedTransport::Bridge
{

namespace
{

// The property and the array in messages, "RadiusArray 'r'".
std::string titleOf(const char* property, vtkAbstractArray* array)
{
  return std::string(property) + " '" + (array->GetName() ? array->GetName() : "") + "'";
}

// Whether a shape is drawn with the line width, half of which lies outside of its points.
bool isStroked(const DrawingLayer& layer, const Shape& shape)
{
  return shape.Kind == ShapeKind::Line ||
    (shape.Kind == ShapeKind::Polygon && !layer.Colours.AreGiven());
}

// The positions of the dots without a radius of their own, 3 values a dot.
LargeBuffer<double> dotsOf(
  const std::vector<DrawingLayer>& layers, std::int64_t count, Progress& progress)
{
  LargeBuffer<double> dots = withMemory({ "the places of " + std::to_string(count) + " dots",
                                          3.0 * sizeof(double) * static_cast<double>(count) },
    [&]() { return LargeBuffer<double>(3 * count); });
  double* next = dots.data();
  for (const DrawingLayer& layer : layers)
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

// Adds a shape to what the page must hold: its points, with the radius around a dot that has one.
// Dots that still lack the common radius are only counted with their places.
void include(const DrawingLayer& layer, const Shape& shape, DrawingExtent& extent)
{
  extent.HasStrokes = extent.HasStrokes || isStroked(layer, shape);
  const bool isDot = shape.Kind == ShapeKind::Dot;
  for (vtkIdType i = 0; i < shape.Count; ++i)
  {
    const vtkIdType number = shape.Points[i];
    if (isDot && layer.NeedsRadius())
    {
      extent.IncludeDot(layer.At(number), number);
    }
    else
    {
      extent.Include(layer.At(number), number, isDot ? layer.RadiusAt(number) : 0.0);
    }
  }
}

// VTK's own colours over the values of all data sets.
vtkSmartPointer<vtkScalarsToColors> tableOf(const std::vector<LayerData>& data)
{
  constexpr int component = 0;
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (const LayerData& drawn : data)
  {
    auto* array = vtkDataArray::SafeDownCast(drawn.Colours);
    if (array && !areColours(array))
    {
      double range[2];
      // The magnitude, -1, for arrays of several components, as VTK's mapper shows vectors. NaN and
      // infinity have no place in a range.
      array->GetFiniteRange(range, array->GetNumberOfComponents() == 1 ? component : -1);
      least = std::min(least, range[0]);
      greatest = std::max(greatest, range[1]);
    }
  }
  const auto table = vtkSmartPointer<vtkLookupTable>::New();
  // Without finite values the table keeps its default range from 0 to 1.
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

void includeGroup(const ShapeGroups& given, const Shape& shape, std::set<vtkVariant>& groups)
{
  constexpr std::size_t most = 100;
  constexpr double largest = 1e15; // Doubles below it hold integers exactly.
  const vtkVariant group = given.Of(shape);
  const double value = group.IsNumeric() ? group.ToDouble() : 0.0;
  if (std::floor(value) != value || !(std::abs(value) < largest))
  {
    fail(titleOf("LayerArray", given.Array), " has the value ", value,
      "; layers need whole numbers or texts: choose another array, or round it with Calculator");
  }
  groups.insert(group);
  if (groups.size() - groups.count(vtkVariant()) > most)
  {
    fail(titleOf("LayerArray", given.Array), " has more than ", most,
      " values; each of them is a layer: choose an array with fewer values");
  }
}

// A quarter of the median edge of what is stroked, but not below 0.05 mm, which pens cannot draw.
double widthOfLines(
  const std::vector<DrawingLayer>& layers, const PageLayout& layout, Progress& progress)
{
  std::vector<double> lengths;
  for (const DrawingLayer& layer : layers)
  {
    layer.Shapes.ForEach(progress, [&](const Shape& shape) {
      const vtkIdType edges = shape.Count - (shape.Kind == ShapeKind::Polygon ? 0 : 1);
      for (vtkIdType i = 0; isStroked(layer, shape) && i < edges; ++i)
      {
        const Point<2> a = layout.At(layer.At(shape.Points[i]));
        const Point<2> b = layout.At(layer.At(shape.Points[(i + 1) % shape.Count]));
        lengths.push_back(std::hypot(a[0] - b[0], a[1] - b[1]));
      }
    });
  }
  const auto median = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), median, lengths.end());
  return lengths.empty() ? 0.25 : std::clamp(0.25 * *median, 0.05, 0.25);
}

} // namespace

// Lengths of the page are millimetres, PointRadius is in units of the data. Properties are checked
// before inputs are read, so that their messages come first.
void TransportVectorWriter::Check() const
{
  const auto require = [](const char* property, double value, bool isLarge, const char* rule) {
    requireThat(std::isfinite(value) && isLarge, property, value, rule);
  };
  const PageSettings& page = this->Page;
  require("Width", page.Width, page.Width > 0.0, "more than 0 (millimetres)");
  require("PageMargin", page.Margin, page.Margin >= 0.0, "0 or more (millimetres)");
  require("LineWidth", page.LineWidth, page.LineWidth >= 0.0,
    "more than 0 (millimetres), or 0 for a quarter of the median edge");
  page.CheckBounds();
  require("PointRadius", this->PointRadius, this->PointRadius >= 0.0,
    "more than 0, or 0 for a radius from the spacing");
}

// Three passes: the extent of all shapes, the radius of dots, and the drawing. The extent depends
// on the radius, as dots at the border must fit on the page, so dots enter it without a radius
// first.
void TransportVectorWriter::Run(
  const std::vector<LayerData>& data, Drawing& drawing, Progress& progress) const
{
  std::int64_t shapes = 0;
  std::int64_t points = 0; // where there are radii twice
  vtkSmartPointer<vtkScalarsToColors> table = this->LookupTable;
  for (const LayerData& drawn : data)
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
      // One table for all data sets, so that equal values have equal colours on the whole page.
      table = table ? table : tableOf(data);
    }
    if (drawn.Radii)
    {
      requireScalars(
        drawn.Radii, titleOf("RadiusArray", drawn.Radii), own->GetNumberOfPoints(), "points");
    }
    if (drawn.Groups.Array)
    {
      const bool onPoints = drawn.Groups.OnPoints;
      requireScalars(drawn.Groups.Array, titleOf("LayerArray", drawn.Groups.Array),
        onPoints ? own->GetNumberOfPoints() : own->GetNumberOfCells(),
        onPoints ? "points" : "cells");
    }
  }

  std::vector<DrawingLayer> layers;
  // Layers hold references and large arrays: none is moved as others are added.
  layers.reserve(data.size());
  Stages stages(progress, { { "points", 1 }, { "extent", 1 }, { "spacing", 3 }, { "drawing", 5 } });
  Progress& reading = stages["points"].Expect(points);
  for (const LayerData& drawn : data)
  {
    layers.emplace_back(drawn, this->FillOutlines, table, reading);
  }
  // Further visits may collect the places of dots and the lengths of edges.
  Progress& visits = stages["extent"].Expect(3 * shapes);
  DrawingExtent extent;
  std::set<vtkVariant> groups; // in the order in which they are drawn
  for (const DrawingLayer& layer : layers)
  {
    layer.Shapes.ForEach(visits, [&](const Shape& shape) {
      include(layer, shape, extent);
      includeGroup(layer.Groups, shape, groups);
    });
  }
  if (extent.NumberOfDots > 0)
  {
    double radius = this->PointRadius;
    // PointRadius 0 stands for a radius from the spacing of dots, with which those of equal mass
    // show the density by their area. A single dot has no spacing.
    if (radius == 0.0)
    {
      const LargeBuffer<double> dots = dotsOf(layers, extent.NumberOfDots, visits);
      radius = radiusOfDots({ dots.data(), extent.NumberOfDots }, stages["spacing"]);
      radius = radius > 0.0 ? radius : extent.RadiusWithoutNeighbours();
    }
    // All dots without a radius of their own get the same one, in units of the data; then the
    // extent can include their discs.
    for (DrawingLayer& layer : layers)
    {
      layer.Radius = radius;
    }
    extent.SetRadiusOfDots(radius);
  }
  if (extent.Points.isEmpty())
  {
    fail(points > 0 ? "The input has points, but none that is drawn: its cells have no points, or "
                      "vtkGhostType marks them as duplicates or hidden"
                    : "The input has no points; there is nothing to draw");
  }
  // All that can be wrong with properties and data has been found before the drawing begins.
  PageSettings page = this->Page;
  if (page.LineWidth == 0.0)
  {
    // The page's scale without a border for the lines is less than one per cent off.
    page.LineWidth = widthOfLines(layers, page.Layout(extent, drawing.LongestSide()), visits);
  }
  const PageLayout layout = page.Layout(extent, drawing.LongestSide());
  drawing.Begin({ layout.Size(), page.HasBounds() ? page.Margin : 0.0, page.LineWidth });
  Progress& painting = stages["drawing"].Expect(shapes * static_cast<std::int64_t>(groups.size()));
  for (const vtkVariant& group : groups)
  {
    if (group.IsValid()) // Shapes without a value are in no layer.
    {
      drawing.BeginLayer(data.front().Groups.Name + ' ' +
        (group.IsNumeric() ? std::to_string(group.ToTypeInt64()) : group.ToString()));
    }
    for (const DrawingLayer& layer : layers)
    {
      layer.Draw(layout, drawing, group, this->HasShortPath, painting);
    }
  }
  drawing.End();
}

} // namespace RectifiedTransport::Bridge
