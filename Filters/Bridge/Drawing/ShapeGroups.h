// SPDX-License-Identifier: BSD-3-Clause
// The groups of what is drawn, which are layers of the file: one for each value of an array.
#ifndef RectifiedTransport_ShapeGroups_h
#define RectifiedTransport_ShapeGroups_h

#include "Bridge/Drawing/PolyDataShapes.h"

#include "vtkAbstractArray.h"
#include "vtkVariant.h"

#include <string>

namespace RectifiedTransport::Bridge
{

struct ShapeGroups
{
  vtkAbstractArray* Array; // one component a point or a cell; nullptr: no shape has a value
  bool OnPoints;
  std::string Name;

  // On points the value of the shape's first one. Without a value it is invalid and less than all
  // others.
  vtkVariant Of(const Shape& shape) const
  {
    const vtkIdType tuple = this->OnPoints ? shape.Points[0] : shape.Cell;
    return this->Array && tuple >= 0 ? this->Array->GetVariantValue(tuple) : vtkVariant();
  }
};

} // namespace RectifiedTransport::Bridge

#endif
