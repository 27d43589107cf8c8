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

// Adds an array of several numbers. It replaces an array of the same name.
inline void addFieldValues(
  vtkDataObject* output, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double value : values)
  {
    array->InsertNextValue(value);
  }
  output->GetFieldData()->AddArray(array);
}

// The same, of one tuple.
inline void addFieldTuple(
  vtkDataObject* output, const char* name, const std::vector<double>& components)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(components.size()));
  array->InsertNextTuple(components.data());
  output->GetFieldData()->AddArray(array);
}

inline void addFieldValue(vtkDataObject* output, const char* name, double value)
{
  addFieldValues(output, name, { value });
}

} // namespace RectifiedTransport::Bridge

#endif
