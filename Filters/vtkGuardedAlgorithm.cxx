// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGuardedAlgorithm.h"

#include "Bridge/Blocks/GatheredInputs.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/PointInput.h"
#include "Bridge/Ranks/SameProperties.h"
#include "Bridge/Run/ExceptionBarrier.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/InputExtents.h"
#include "Bridge/Run/RankRun.h"
#include "Bridge/Run/RequestedTimes.h"
#include "Bridge/Run/SMPExecutor.h"
#include "Bridge/Run/WholeInputs.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace
{
// The executive copies the times of the first input only; the outputs depend on those of all.
void publishTimes(
  vtkInformationVector** inputVector, int numberOfPorts, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  std::set<double> steps;
  std::set<double> ends;
  for (int port = 0; port < numberOfPorts; ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputVector[port]->GetInformationObject(i);
      if (input->Has(Pipeline::TIME_STEPS()))
      {
        const double* times = input->Get(Pipeline::TIME_STEPS());
        steps.insert(times, times + input->Length(Pipeline::TIME_STEPS()));
      }
      if (input->Has(Pipeline::TIME_RANGE()))
      {
        const double* range = input->Get(Pipeline::TIME_RANGE());
        ends.insert(range, range + input->Length(Pipeline::TIME_RANGE()));
      }
    }
  }
  const std::vector<double> times(steps.begin(), steps.end());
  for (int i = 0; i < outputVector->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* output = outputVector->GetInformationObject(i);
    if (!times.empty())
    {
      output->Set(Pipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    }
    if (!ends.empty())
    {
      const double range[2] = { *ends.begin(), *ends.rbegin() };
      output->Set(Pipeline::TIME_RANGE(), range, 2);
    }
  }
}

// The executive copies the array information of the first input, which holds for no output.
void removeArrayInformation(vtkInformationVector* outputVector)
{
  for (int i = 0; i < outputVector->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* output = outputVector->GetInformationObject(i);
    output->Remove(vtkDataObject::POINT_DATA_VECTOR());
    output->Remove(vtkDataObject::CELL_DATA_VECTOR());
  }
}

// The executive leaves the extent of an image and the scalars of its points from the last run.
void clearImages(vtkInformationVector* outputVector)
{
  for (int i = 0; i < outputVector->GetNumberOfInformationObjects(); ++i)
  {
    if (vtkImageData* image = vtkImageData::GetData(outputVector, i))
    {
      image->SetExtent(0, -1, 0, -1, 0, -1);
      image->GetPointData()->Initialize();
    }
  }
}

// A rank's own piece; for one rank, what was requested last. What is requested upstream, as of an
// input that this one depends on, stays as it is.
void updatePiece(vtkAlgorithm* producer, int port, const RectifiedTransport::Ranks& ranks)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const RectifiedTransport::RequestedTimes kept(producer);
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

//------------------------------------------------------------------------------
vtkGuardedAlgorithm::vtkGuardedAlgorithm()
  : Threading(THREADING_AUTO)
  , Whole(new RectifiedTransport::WholeInputs)
{
}

//------------------------------------------------------------------------------
vtkGuardedAlgorithm::~vtkGuardedAlgorithm() = default;

//------------------------------------------------------------------------------
const char* vtkGuardedAlgorithm::GetThreadingAsString()
{
  return RectifiedTransport::threadingText(this->Threading);
}

//------------------------------------------------------------------------------
void vtkGuardedAlgorithm::SetInputData(int port, vtkDataObject* input)
{
  this->SetInputDataInternal(port, input);
}

//------------------------------------------------------------------------------
vtkTypeBool vtkGuardedAlgorithm::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  try
  {
    if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
    {
      return this->RequestDataObject(request, inputVector, outputVector);
    }
    if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
    {
      publishTimes(inputVector, this->GetNumberOfInputPorts(), outputVector);
      removeArrayInformation(outputVector);
      return this->ProcessInformation(request, inputVector, outputVector);
    }
    if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_TIME_DEPENDENT_INFORMATION()))
    {
      return this->ProcessTimeDependentInformation(request, inputVector, outputVector);
    }
    if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_TIME()))
    {
      return this->RequestUpdateTime(request, inputVector, outputVector);
    }
    if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
    {
      this->Whole->Record(this, request, inputVector, outputVector);
      const int result = this->RequestUpdateExtent(request, inputVector, outputVector);
      this->Whole->UpdateSeparately(this, inputVector, outputVector);
      return result;
    }
    if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
    {
      return this->ProcessData(request, inputVector, outputVector);
    }
    return this->Superclass::ProcessRequest(request, inputVector, outputVector);
  }
  catch (...)
  {
    this->IsAlone = false;
    this->Whole->Separate().End();
    const std::unique_ptr<RectifiedTransport::RankRun> run = std::move(this->Run);
    return RectifiedTransport::handleException(this, outputVector, run.get());
  }
}

//------------------------------------------------------------------------------
int vtkGuardedAlgorithm::ProcessInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  try
  {
    const RectifiedTransport::RequestedTimes kept(this);
    this->Whole->RequestFirstTimes(this, inputVector, outputVector);
    const int result = this->RequestInformation(request, inputVector, outputVector);
    this->EndRun();
    return result;
  }
  // RequestData reports it, once.
  catch (const RectifiedTransport::FailedElsewhere&)
  {
    this->Run = nullptr;
  }
  catch (const RectifiedTransport::Failure& failure)
  {
    if (const std::unique_ptr<RectifiedTransport::RankRun> run = std::move(this->Run))
    {
      run->Fail(failure.what());
    }
  }
  RectifiedTransport::announceEmptyExtents(outputVector);
  return 1;
}

//------------------------------------------------------------------------------
int vtkGuardedAlgorithm::ProcessData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  clearImages(outputVector);
  this->Run = this->Whole->BeginRun(this, inputVector);
  if (this->Run)
  {
    RectifiedTransport::requireSameProperties(this, *this->Run);
  }
  vtkInformationVector** inputs = this->Whole->Separate().Inputs(this, inputVector);
  RectifiedTransport::requireExtents(this, inputs);
  this->Whole->Require(this, inputs, this->Run.get());
  const int result = this->Run && !this->Gathered.empty()
    ? this->GatherAndRun(request, inputs, outputVector)
    : this->RequestData(request, inputs, outputVector);
  this->EndRun();
  this->Whole->Separate().End();
  return RectifiedTransport::clearUnmetRequests(outputVector) ? result : 0;
}

//------------------------------------------------------------------------------
int vtkGuardedAlgorithm::GatherAndRun(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using RectifiedTransport::GatheredKind;
  std::map<int, GatheredKind> kinds;
  for (const auto& [port, type] : this->Gathered)
  {
    kinds[port] = type == GATHERED_POINTS ? GatheredKind::Points
      : type == GATHERED_SURFACE          ? GatheredKind::Surface
                                          : GatheredKind::Density;
  }
  RectifiedTransport::GatheredInputs inputs(inputVector, kinds, *this->Run);
  int result = 1;
  if (this->Run->Own() == 0)
  {
    this->IsAlone = true;
    result = this->RequestData(request, inputs.Vectors(), outputVector);
    this->IsAlone = false;
  }
  this->ShareOutputs(*this->Run, outputVector);
  return result;
}

//------------------------------------------------------------------------------
void vtkGuardedAlgorithm::ShareOutputs(const RectifiedTransport::Ranks&, vtkInformationVector*) {}

//------------------------------------------------------------------------------
void vtkGuardedAlgorithm::EndRun()
{
  if (this->Run)
  {
    this->Run->End();
    this->Run = nullptr;
  }
}

//------------------------------------------------------------------------------
// The inputs are now at the requested time, which they were not in RequestInformation.
int vtkGuardedAlgorithm::ProcessTimeDependentInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (this->Updated.empty())
  {
    return 1;
  }
  vtkInformation* output = outputVector->GetInformationObject(0);
  const RectifiedTransport::ImageGrid before = RectifiedTransport::announcedGrid(output, true);
  this->Updated.clear();
  const int result = this->ProcessInformation(request, inputVector, outputVector);
  if (result && !(RectifiedTransport::announcedGrid(output, true) == before))
  {
    this->Modified();
    RectifiedTransport::updateConsumerInformation(output);
  }
  return result;
}

//------------------------------------------------------------------------------
int vtkGuardedAlgorithm::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1; // the executive makes outputs of the ports' DATA_TYPE_NAME
}

//------------------------------------------------------------------------------
void vtkGuardedAlgorithm::MakeOutputLike(
  vtkInformationVector* input, vtkInformationVector* outputVector, int port)
{
  vtkPointSet* like = vtkPointSet::GetData(input);
  vtkPointSet* output = vtkPointSet::GetData(outputVector, port);
  if (like && (!output || output->GetDataObjectType() != like->GetDataObjectType()))
  {
    const auto made = vtkSmartPointer<vtkPointSet>::Take(like->NewInstance());
    outputVector->GetInformationObject(port)->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  else if (!output)
  {
    // Without an output data object the executive would not reach the check of the inputs' types.
    const auto made = vtkSmartPointer<vtkPolyData>::New();
    outputVector->GetInformationObject(port)->Set(vtkDataObject::DATA_OBJECT(), made);
  }
}

//------------------------------------------------------------------------------
int vtkGuardedAlgorithm::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1;
}

//------------------------------------------------------------------------------
void vtkGuardedAlgorithm::UpdateInputBeforeData(
  int port, vtkInformationVector** inputVector, vtkInformationVector* outputVector, int connection)
{
  this->UpdateInputPiece(
    port, inputVector, outputVector, connection, RectifiedTransport::SoloRanks::Get());
}

//------------------------------------------------------------------------------
const RectifiedTransport::Ranks& vtkGuardedAlgorithm::UpdateInputOnRanks(
  int port, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!this->Run)
  {
    this->Run = this->Whole->BeginWithoutPieces(this, port, inputVector);
  }
  this->UpdateInputPiece(port, inputVector, outputVector, 0, this->GetRanks());
  return this->GetRanks();
}

//------------------------------------------------------------------------------
void vtkGuardedAlgorithm::UpdateInputPiece(int port, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector, int connection, const RectifiedTransport::Ranks& ranks)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* input = inputVector[port]->GetInformationObject(connection);
  if (input && (input->Has(Pipeline::TIME_STEPS()) || input->Has(Pipeline::TIME_RANGE())))
  {
    outputVector->GetInformationObject(0)->Set(Pipeline::TIME_DEPENDENT_INFORMATION(), 1);
  }
  int outputPort = 0;
  vtkAlgorithm* producer = this->GetInputAlgorithm(port, connection, outputPort);
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

//------------------------------------------------------------------------------
int vtkGuardedAlgorithm::RequestUpdateTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1;
}

//------------------------------------------------------------------------------
int vtkGuardedAlgorithm::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Whole->RequestOutputs(request, outputVector);
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    if (this->Whole->IsNeeded(port))
    {
      vtkGuardedAlgorithm::RequestWhole(inputVector[port]);
      this->Whole->RequestShared(port, inputVector[port]);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkGuardedAlgorithm::PassPieces(int port)
{
  this->Whole->Except(port);
}

//------------------------------------------------------------------------------
void vtkGuardedAlgorithm::ShareAmongRanks(int port, bool takesPoints)
{
  this->Whole->Share(port, takesPoints);
}

//------------------------------------------------------------------------------
const RectifiedTransport::Ranks& vtkGuardedAlgorithm::GetRanks() const
{
  return this->IsAlone || !this->Run
    ? static_cast<const RectifiedTransport::Ranks&>(RectifiedTransport::SoloRanks::Get())
    : *this->Run;
}

//------------------------------------------------------------------------------
void vtkGuardedAlgorithm::WarnOnFirstRank(const std::string& text)
{
  if (this->GetRanks().IsFirst())
  {
    vtkWarningMacro(<< text);
  }
}

//------------------------------------------------------------------------------
void vtkGuardedAlgorithm::GatherOnFirstRank(int port, GatheredType type)
{
  this->ShareAmongRanks(port, type != GATHERED_DENSITY);
  this->Gathered[port] = type;
}

//------------------------------------------------------------------------------
bool vtkGuardedAlgorithm::IsLaterPiece(
  vtkInformation* request, vtkInformationVector* outputVector) const
{
  if (this->Run)
  {
    return false;
  }
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const int port = std::max(0, request->Get(Pipeline::FROM_OUTPUT_PORT()));
  return outputVector->GetInformationObject(port)->Get(Pipeline::UPDATE_PIECE_NUMBER()) > 0;
}

//------------------------------------------------------------------------------
void vtkGuardedAlgorithm::RequestWhole(vtkInformationVector* port)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int i = 0; i < port->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* input = port->GetInformationObject(i);
    input->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    if (input->Has(Pipeline::WHOLE_EXTENT()))
    {
      int extent[6];
      input->Get(Pipeline::WHOLE_EXTENT(), extent);
      input->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
    }
  }
}

//------------------------------------------------------------------------------
void vtkGuardedAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Threading: " << this->GetThreadingAsString() << "\n";
}
VTK_ABI_NAMESPACE_END
