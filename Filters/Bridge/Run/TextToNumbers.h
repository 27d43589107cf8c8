// SPDX-License-Identifier: BSD-3-Clause
// Arrays of text as numbers. Readers of files give text where a type of the file has no type of
// VTK, such as whole numbers of 64 bits in shapefiles and GeoJSON.
#ifndef RectifiedTransport_TextToNumbers_h
#define RectifiedTransport_TextToNumbers_h

#include "Bridge/VTKCompatibility.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <functional>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

struct TextToNumbers
{
  // A numeric array as it is; one of text as doubles of its name. nullptr if one of its texts is no
  // number.
  vtkSmartPointer<vtkDataArray> Array;
  // Without an array of numbers, which texts are none: "2 of 9 texts are no numbers, the first
  // 'n/a' at index 3". Empty if there is no array at all.
  std::string Wrong;
};

// `placeOf` names a tuple in messages in place of its index. Empty texts are NaN if they mark
// missing data.
TextToNumbers parseNumbers(vtkAbstractArray* array, bool emptyIsNaN = false,
  const std::function<std::string(vtkIdType tuple)>& placeOf = nullptr);

} // namespace RectifiedTransport::Bridge

#endif
