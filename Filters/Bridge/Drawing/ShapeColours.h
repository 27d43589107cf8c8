// SPDX-License-Identifier: BSD-3-Clause
// The colours of what is drawn, from an array.
#ifndef RectifiedTransport_ShapeColours_h
#define RectifiedTransport_ShapeColours_h

#include "Bridge/Drawing/PolyDataShapes.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Drawing/Drawing.h"

#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
class vtkScalarsToColors;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Whether values are colours themselves: three or four bytes.
bool areColours(vtkAbstractArray* array);

class ShapeColours
{
public:
  // All black.
  ShapeColours() = default;
  // An array with a tuple a point or a cell. Tuples of three or four bytes are colours; others are
  // mapped by the table.
  ShapeColours(vtkAbstractArray* array, bool onPoints, vtkScalarsToColors* table);

  bool AreGiven() const { return this->Bytes != nullptr; }
  bool AreOnPoints() const { return this->AreGiven() && this->OnPoints; }
  // On points the mean of all of the shape's points.
  Colour Of(const Shape& shape) const;

private:
  vtkSmartPointer<vtkUnsignedCharArray> Bytes;
  bool OnPoints = false;
};

} // namespace RectifiedTransport::Bridge

#endif
