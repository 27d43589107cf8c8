// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/Pipeline/InputFields.h"

#include "vtkAbstractArray.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformationVector.h"

#include <set>
#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

// visit(fields, array) for each array that has a name.
template <class Visit>
void visitFields(vtkInformationVector* objects, const Visit& visit)
{
  for (int i = 0; i < objects->GetNumberOfInformationObjects(); ++i)
  {
    vtkDataObject* data = vtkDataObject::GetData(objects, i);
    vtkFieldData* fields = data ? data->GetFieldData() : nullptr;
    // From the last one on, as visit may remove the array.
    for (int k = fields ? fields->GetNumberOfArrays() : 0; k-- > 0;)
    {
      vtkAbstractArray* array = fields->GetAbstractArray(k);
      if (array->GetName())
      {
        visit(fields, array);
      }
    }
  }
}

} // namespace

void removeReplacedFields(const std::vector<vtkInformationVector**>& inputVectors,
  int numberOfPorts, vtkInformationVector* outputVector)
{
  std::set<vtkAbstractArray*> given;
  for (vtkInformationVector** inputVector : inputVectors)
  {
    for (int port = 0; port < numberOfPorts; ++port)
    {
      visitFields(inputVector[port],
        [&given](vtkFieldData*, vtkAbstractArray* array) { given.insert(array); });
    }
  }
  std::set<std::string> replaced;
  visitFields(outputVector, [&](vtkFieldData*, vtkAbstractArray* array) {
    if (given.count(array) == 0)
    {
      replaced.insert(array->GetName());
    }
  });
  visitFields(outputVector, [&](vtkFieldData* fields, vtkAbstractArray* array) {
    if (given.count(array) > 0 && replaced.count(array->GetName()) > 0)
    {
      fields->RemoveArray(array->GetName());
    }
  });
}

} // namespace RectifiedTransport::Bridge
