// SPDX-License-Identifier: BSD-3-Clause
#include "GuardedRun.h"

#include "Failure.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkInformationVector.h"

#include <new>
#include <string>

namespace RectifiedTransport
{

namespace
{

void emptyOutputs(vtkInformationVector* outputs)
{
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    if (vtkDataObject* output = vtkDataObject::GetData(outputs, i))
    {
      output->Initialize();
    }
  }
}

} // namespace

int runGuarded(
  vtkAlgorithm* algorithm, vtkInformationVector* outputs, const std::function<int()>& body)
{
  std::string error;
  try
  {
    return body();
  }
  catch (const Aborted&)
  {
    emptyOutputs(outputs);
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    error = "Not enough memory";
  }
  catch (const std::exception& exception)
  {
    error = exception.what();
  }
  emptyOutputs(outputs);
  vtkErrorWithObjectMacro(algorithm, << error);
  return 0;
}

} // namespace RectifiedTransport
