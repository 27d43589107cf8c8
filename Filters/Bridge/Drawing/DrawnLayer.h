// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_DrawnLayer_h
#define RectifiedTransport_DrawnLayer_h

#include "Bridge/Drawing/OutlinedRegions.h"
#include "Bridge/Drawing/PolyDataShapes.h"
#include "Bridge/Drawing/ShapeColours.h"
#include "Bridge/Drawing/TransportVectorWriter.h"
#include "Bridge/Points/DoubleTuples.h"
#include "Core/Parallel/Progress.h"

#include "vtkPoints.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace RectifiedTransport::Bridge
{

// One of the data sets while it is drawn.
class DrawnLayer
{
public:
  DrawnLayer(const DrawnData& data, vtkScalarsToColors* table, Progress& progress)
    : Shapes(data.Shapes)
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
  }

  const double* At(vtkIdType point) const { return this->Points.data() + 3 * point; }
  // In units of the data.
  double RadiusAt(vtkIdType point) const
  {
    return this->Radii ? this->Radii->data()[point] : this->Radius;
  }
  bool NeedsRadius() const { return !this->Radii; }
  // As polygons, which without colours are outlined alone.
  void FillOutlines()
  {
    if (this->Colours.AreGiven())
    {
      this->Regions = findOutlinedRegions(this->Shapes.Data()).Regions;
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
  bool IsOutline(vtkIdType cell) const
  {
    return !this->Outlines.empty() && this->Outlines[static_cast<std::size_t>(cell)];
  }

  const PolyDataShapes& Shapes;
  DoubleTuples Points;
  ShapeColours Colours;
  std::optional<DoubleTuples> Radii;
  double Radius = 0.0;
  std::vector<std::vector<Outline>> Regions; // to be filled
  std::vector<char> Outlines;                // whether a cell is one of theirs
};

} // namespace RectifiedTransport::Bridge

#endif
