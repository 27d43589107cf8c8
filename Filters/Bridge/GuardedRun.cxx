// SPDX-License-Identifier: BSD-3-Clause
#include "GuardedRun.h"

#include "Failure.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

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
  withdrawExtents(outputs);
}

} // namespace

void withdrawExtents(vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const int none[6] = { 0, -1, 0, -1, 0, -1 };
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* output = outputs->GetInformationObject(i);
    vtkDataObject* data = vtkDataObject::GetData(output);
    if (!data || data->GetExtentType() != VTK_3D_EXTENT)
    {
      continue;
    }
    output->Set(Pipeline::WHOLE_EXTENT(), none, 6);
    output->Set(Pipeline::UPDATE_EXTENT(), none, 6);
    output->Remove(Pipeline::COMBINED_UPDATE_EXTENT()); // it would come back from there
    output->Remove(Pipeline::UPDATE_EXTENT_INITIALIZED());
    vtkExecutive** consumers = vtkExecutive::CONSUMERS()->GetExecutives(output);
    for (int j = 0; j < vtkExecutive::CONSUMERS()->Length(output); ++j)
    {
      withdrawExtents(consumers[j]->GetOutputInformation());
    }
  }
}

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
