// SPDX-License-Identifier: BSD-3-Clause
// A single number in the field data of an output.
#ifndef RectifiedTransport_FieldValue_h
#define RectifiedTransport_FieldValue_h

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

namespace RectifiedTransport
{

inline void addFieldValue(vtkDataObject* output, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  output->GetFieldData()->AddArray(array);
}

} // namespace RectifiedTransport

#endif
