// SPDX-License-Identifier: BSD-3-Clause
// Draws a vtkPolyData, or several on one page: the worker of vtkTransportVectorWriter.
#ifndef RectifiedTransport_TransportVectorWriter_h
#define RectifiedTransport_TransportVectorWriter_h

#include "Bridge/Drawing/PolyDataShapes.h"
#include "Bridge/Drawing/ShapeGroups.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Drawing/PageLayout.h"
#include "Core/Parallel/Progress.h"

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
class vtkDataArray;
class vtkScalarsToColors;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Drawing;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// One of the data sets on a page. What is later lies on top.
struct LayerData
{
  PolyDataShapes Shapes;
  vtkAbstractArray* Colours; // nullptr: black
  bool HasColoursOnPoints;
  vtkDataArray* Radii; // one a point; nullptr: PointRadius
  ShapeGroups Groups;  // LayerArray
};

// The members are the properties of that class.
struct TransportVectorWriter
{
  PageSettings Page;
  double PointRadius;
  bool FillOutlines;
  bool HasShortPath;               // Order
  vtkScalarsToColors* LookupTable; // nullptr: VTK's colours over the range of the values

  // Throws Failure for values out of range.
  void Check() const;

  // Throws Failure, Cancelled and std::bad_alloc.
  void Run(const std::vector<LayerData>& data, Drawing& drawing, Progress& progress) const;
};

} // namespace RectifiedTransport::Bridge

#endif
