// SPDX-License-Identifier: BSD-3-Clause
// One of the data sets while it is drawn.
#ifndef RectifiedTransport_DrawingLayer_h
#define RectifiedTransport_DrawingLayer_h

#include "Bridge/Data/DoubleTuples.h"
#include "Bridge/Drawing/OutlineRegions.h"
#include "Bridge/Drawing/PolyDataShapes.h"
#include "Bridge/Drawing/ShapeColours.h"
#include "Bridge/Drawing/TransportVectorWriter.h"
#include "Core/Drawing/PageLayout.h"
#include "Core/Parallel/Progress.h"

#include <optional>
#include <vector>

namespace RectifiedTransport::Bridge
{

class DrawingLayer
{
public:
  // If `fillsOutlines` and there are colours, closed lines bound polygons.
  DrawingLayer(
    const LayerData& data, bool fillsOutlines, vtkScalarsToColors* table, Progress& progress);

  const double* At(vtkIdType point) const { return this->Points.data() + 3 * point; }
  // In units of the data.
  double RadiusAt(vtkIdType point) const
  {
    return this->Radii ? this->Radii->data()[point] : this->Radius;
  }
  bool NeedsRadius() const { return !this->Radii; }
  bool IsOutline(vtkIdType cell) const
  {
    return !this->Outlines.empty() && this->Outlines[static_cast<std::size_t>(cell)];
  }
  // Draws the shapes of a group. With a short path the dots come in its order. Throws Failure, if
  // the drawing cannot be written, and Cancelled.
  void Draw(const PageLayout& layout, Drawing& drawing, const vtkVariant& group, bool hasShortPath,
    Progress& progress) const;

  const PolyDataShapes& Shapes;
  const ShapeGroups& Groups;
  DoubleTuples Points;
  ShapeColours Colours;
  std::optional<DoubleTuples> Radii;
  double Radius = 0.0;
  std::vector<std::vector<Outline>> Regions; // to be filled
  std::vector<char> Outlines;                // whether a cell is one of theirs
};

} // namespace RectifiedTransport::Bridge

#endif
