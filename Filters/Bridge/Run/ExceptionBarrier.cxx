// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/ExceptionBarrier.h"

#include "Bridge/Run/Pipeline/ConsumerExtents.h"
#include "Bridge/Run/RankRun.h"
#include "Core/Flow/NoMemoryForFlowMap.h"
#include "Core/Messages/MessageText.h"
#include "Core/Parallel/Context.h"
#include "Core/Parallel/MemoryPlan.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkInformationVector.h"

#include <exception>
#include <new>
#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

bool emptyOutputs(vtkInformationVector* outputs)
{
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    if (vtkDataObject* output = vtkDataObject::GetData(outputs, i))
    {
      output->Initialize();
    }
  }
  return announceEmptyExtents(outputs);
}

} // namespace

int handleException(vtkAlgorithm* algorithm, vtkInformationVector* outputs, RankRun* run)
{
  std::string error;
  try
  {
    throw;
  }
  catch (const Cancelled&)
  {
    if (run)
    {
      run->Cancel();
    }
    return emptyOutputs(outputs) ? 1 : 0;
  }
  catch (const FailedElsewhere&)
  {
    // Reported by the first rank.
  }
  catch (const NoMemoryForFlowMap& map)
  {
    error = MemoryPlan{ "a flow map (FlowMaps Off needs none)", map.MemorySize() }.DescribeLack();
  }
  catch (const std::bad_alloc&)
  {
    error = "Not enough memory";
  }
  catch (const std::exception& exception)
  {
    error = exception.what();
  }
  const bool isEmptied = emptyOutputs(outputs);
  error = run ? run->Fail(error) : error;
  if (!error.empty())
  {
    vtkErrorWithObjectMacro(algorithm, << messageText(error));
  }
  return isEmptied ? 1 : 0;
}

bool isCancelled()
{
  try
  {
    throw;
  }
  catch (const Cancelled&)
  {
    return true;
  }
  catch (...)
  {
    return false;
  }
}

} // namespace RectifiedTransport::Bridge
