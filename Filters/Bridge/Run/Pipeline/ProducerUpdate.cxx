// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/Pipeline/ProducerUpdate.h"

#include "Bridge/Run/Pipeline/RequestedTimes.h"
#include "Core/Parallel/Ranks.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace RectifiedTransport::Bridge
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

// A rank's own piece; for one rank, what was requested last. What is requested upstream, as of an
// input that this one depends on, stays as it is.
void updatePiece(vtkAlgorithm* producer, int port, const Ranks& ranks)
{
  const RequestedTimes kept(producer);
  if (!ranks.AreSeveral())
  {
    producer->Update(port);
    return;
  }
  vtkNew<vtkInformationVector> requests;
  requests->SetNumberOfInformationObjects(producer->GetNumberOfOutputPorts());
  vtkInformation* request = requests->GetInformationObject(port);
  request->Set(Pipeline::UPDATE_PIECE_NUMBER(), ranks.Own());
  request->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), ranks.Count());
  request->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  producer->Update(port, requests);
}

} // namespace

void ProducerUpdate::Run(vtkAlgorithm* filter, int port, int connection, vtkInformation* input,
  vtkInformation* output, const Ranks& ranks)
{
  if (input && (input->Has(Pipeline::TIME_STEPS()) || input->Has(Pipeline::TIME_RANGE())))
  {
    output->Set(Pipeline::TIME_DEPENDENT_INFORMATION(), 1);
  }
  int outputPort = 0;
  vtkAlgorithm* producer = filter->GetInputAlgorithm(port, connection, outputPort);
  auto* pipeline =
    vtkDemandDrivenPipeline::SafeDownCast(producer ? producer->GetExecutive() : nullptr);
  if (!pipeline)
  {
    return;
  }
  // While the executive iterates over blocks the producer's output is replaced by one of them; the
  // producer must not run then.
  vtkDataObject* data = producer->GetOutputDataObject(outputPort);
  const auto updated = this->Updated.find({ port, connection });
  if (updated != this->Updated.end() && producer == updated->second.Producer &&
    outputPort == updated->second.Port && data && !data->GetDataReleased() &&
    pipeline->GetPipelineMTime() == updated->second.Time)
  {
    return;
  }
  updatePiece(producer, outputPort, ranks);
  this->Updated[{ port, connection }] = { producer, outputPort, pipeline->GetPipelineMTime() };
}

bool updateInput(vtkAlgorithm* filter, int port, int connection)
{
  int outputPort = 0;
  vtkAlgorithm* producer = filter->GetInputAlgorithm(port, connection, outputPort);
  auto* pipeline = Pipeline::SafeDownCast(producer ? producer->GetExecutive() : nullptr);
  if (!pipeline)
  {
    return false;
  }
  const RequestedTimes kept(producer);
  return pipeline->Update(outputPort) != 0;
}

} // namespace RectifiedTransport::Bridge
