// SPDX-License-Identifier: BSD-3-Clause
// Numbers in the field data of an output.
#ifndef RectifiedTransport_FieldValue_h
#define RectifiedTransport_FieldValue_h

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

#include <vector>

namespace RectifiedTransport::Bridge
{

// Adds an array of several numbers, in tuples of so many. It replaces an array of the same name.
inline void addFieldValues(
  vtkDataObject* output, const char* name, const std::vector<double>& values, int components = 1)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  for (const double value : values)
  {
    array->InsertNextValue(value);
  }
  output->GetFieldData()->AddArray(array);
}

inline void addFieldValue(vtkDataObject* output, const char* name, double value)
{
  addFieldValues(output, name, { value });
}

} // namespace RectifiedTransport::Bridge

#endif
