// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCollectiveAlgorithm.h"

#include "Bridge/Blocks/GatheredInputs.h"
#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Ranks/FieldBroadcast.h"
#include "Bridge/Ranks/RankConsistency.h"
#include "Bridge/Run/ExceptionBarrier.h"
#include "Bridge/Run/Inputs/InputExtents.h"
#include "Bridge/Run/Inputs/InputRequests.h"
#include "Bridge/Run/Pipeline/ConsumerExtents.h"
#include "Bridge/Run/Pipeline/InputFields.h"
#include "Bridge/Run/Pipeline/OutputInformation.h"
#include "Bridge/Run/Pipeline/ProducerUpdate.h"
#include "Bridge/Run/Pipeline/RequestedTimes.h"
#include "Bridge/Run/RankRun.h"
#include "Bridge/Run/SMPExecutor.h"
#include "Core/Messages/Failure.h"
#include "Core/Messages/MessageText.h"

#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

namespace
{
// Gives an output of the type vtkPointSet the input's type, as vtkPointSetAlgorithm does.
void makeOutputLike(vtkPointSet* input, vtkInformationVector* outputVector, int port)
{
  vtkPointSet* output = vtkPointSet::GetData(outputVector, port);
  if (output && (!input || output->GetDataObjectType() == input->GetDataObjectType()))
  {
    return;
  }
  // Without an output data object the executive would not reach the check of the inputs' types.
  const auto made = vtkSmartPointer<vtkPointSet>::Take(
    input ? input->NewInstance() : static_cast<vtkPointSet*>(vtkPolyData::New()));
  outputVector->GetInformationObject(port)->Set(vtkDataObject::DATA_OBJECT(), made);
}
} // namespace

//------------------------------------------------------------------------------
vtkCollectiveAlgorithm::vtkCollectiveAlgorithm()
  : Whole(new InputRequests)
  , Early(new ProducerUpdate)
{
}

//------------------------------------------------------------------------------
vtkCollectiveAlgorithm::~vtkCollectiveAlgorithm() = default;

//------------------------------------------------------------------------------
const char* vtkCollectiveAlgorithm::GetThreadingAsString()
{
  return threadingText(this->Threading);
}

//------------------------------------------------------------------------------
void vtkCollectiveAlgorithm::SetInputData(int port, vtkDataObject* input)
{
  this->SetInputDataInternal(port, input);
}

//------------------------------------------------------------------------------
void vtkCollectiveAlgorithm::WarnOfFormerProperty(const char* names, const char* value)
{
  if (value && *value)
  {
    vtkWarningMacro("The state file is of before " << names << ", and has " << value
                                                   << "; load the plugin in the client, too, and "
                                                      "open it again, or set the property");
  }
}

//------------------------------------------------------------------------------
// A fork() copies only the calling thread. VTK's own classes, too, run serially in such a child: a
// pool of threads that is not there would let them wait forever.
vtkTypeBool vtkCollectiveAlgorithm::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkTypeBool result = 0;
  withThreadsOfThisProcess(
    [&]() { result = this->ProcessCaught(request, inputVector, outputVector); });
  return result;
}

//------------------------------------------------------------------------------
vtkTypeBool vtkCollectiveAlgorithm::ProcessCaught(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  try
  {
    if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
    {
      return this->RequestDataObject(request, inputVector, outputVector);
    }
    if (this->NeedsSecond && inputVector[1]->GetNumberOfInformationObjects() == 0)
    {
      return this->ProcessWithoutSecond(request, outputVector);
    }
    if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
    {
      // The executive has copied times and arrays of the first input; RequestInformation starts
      // from what holds for all inputs, and may replace it.
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
      // Record reads the requested piece, on which the requests of the inputs depend.
      // UpdateSeparately comes last: it updates inputs with the complete requests.
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
    // The next request has to find the members as after a run without errors, wherever this one
    // stopped. The other ranks learn of the failure from the run, in handleException, which also
    // ends it.
    this->IsAlone = false;
    this->HasNextPass = false;
    this->EndPasses();
    this->Whole->Separate().End();
    const std::unique_ptr<RankRun> run = std::move(this->Run);
    this->WasAborted = isCancelled();
    this->Failed = !this->WasAborted;
    if (this->WasAborted && (!run || run->IsFirst()))
    {
      vtkWarningMacro("The run was aborted: the output is empty until the next update");
    }
    const int result = handleException(this, outputVector, run.get());
    // Before the data, an error ends the update: else they would be made all the same.
    return this->Failed && !request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()) ? 0 : result;
  }
}

//------------------------------------------------------------------------------
bool vtkCollectiveAlgorithm::NeedsInput(int port)
{
  return (port == 1 && this->NeedsSecond) ||
    !this->GetInputPortInformation(port)->Has(vtkAlgorithm::INPUT_IS_OPTIONAL());
}

//------------------------------------------------------------------------------
int vtkCollectiveAlgorithm::ProcessWithoutSecond(
  vtkInformation* request, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    announceEmptyExtents(outputVector);
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    fail("The second input, Target or Density, is missing; choose it on ParaView's panel, or "
         "connect input port 1");
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkCollectiveAlgorithm::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time)
{
  if (std::exchange(this->WasAborted, false))
  {
    this->SetAbortExecute(0); // else this run would end at once, too
    this->Modified();
  }
  *time = this->GetMTime();
  return 1;
}

//------------------------------------------------------------------------------
int vtkCollectiveAlgorithm::ProcessInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  try
  {
    // RequestInformation may update producers. What other consumers have requested upstream is
    // restored when this leaves the scope.
    const RequestedTimes kept(this);
    this->Whole->RequestFirstTimes(this, inputVector, outputVector);
    const int result = this->RequestInformation(request, inputVector, outputVector);
    this->EndRun();
    return result;
  }
  // RequestData reports it, once.
  catch (const FailedElsewhere&)
  {
    this->Run = nullptr;
  }
  catch (const Failure& failure)
  {
    // The others would wait for this rank's next exchange: they end with FailedElsewhere. The
    // request itself succeeds, with empty extents, so that the executive goes on to RequestData.
    if (const std::unique_ptr<RankRun> run = std::move(this->Run))
    {
      run->Fail(failure.what());
    }
  }
  announceEmptyExtents(outputVector);
  return 1;
}

//------------------------------------------------------------------------------
// Runs passes until RequestData asks for no more; each one requests other data from port 0, such as
// the next time step. VTK's executives would send the filter's own requests again only with
// CONTINUE_EXECUTING, which RequestNextPass avoids.
int vtkCollectiveAlgorithm::ProcessData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Failed = false;
  warnOfGhostArrayType(this, inputVector);
  int result = this->ProcessPass(request, inputVector, outputVector);
  while (std::exchange(this->HasNextPass, false))
  {
    this->RequestUpdateExtent(request, inputVector, outputVector);
    if (!updateInput(this, 0, 0))
    {
      const double time = inputVector[0]->GetInformationObject(0)->Get(
        vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
      fail("The input could not be made at the time ", time,
        "; mend the error of the filter or reader before this one");
    }
    result = this->ProcessPass(request, inputVector, outputVector);
  }
  // An image may hold less than was requested, as where the extent follows from the data. Filters
  // downstream that cannot be told must not execute: they would read past its end.
  return clearUnmetRequests(outputVector) ? result : 0;
}

//------------------------------------------------------------------------------
// One pass. BeginRun is where ranks meet; exchanges before it would have no partner. The properties
// are compared first, because with different ones ranks would take different branches of
// RequestData and wait for each other. Extents are checked before anything counts points by them.
int vtkCollectiveAlgorithm::ProcessPass(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  clearImages(outputVector);
  this->Run = this->Whole->BeginRun(this, inputVector);
  if (this->Run)
  {
    requireSameProperties(this, *this->Run);
  }
  vtkInformationVector** inputs = this->Whole->Separate().Inputs(this, inputVector);
  requireExtents(this, inputs);
  this->Whole->Require(this, inputs, this->Run.get());
  int result = 1;
  // Ranks gather the data on the first one, or share the work. A process that runs alone has
  // everything in piece 0: other pieces stay empty, so that a union of pieces has each point once.
  if (this->Run && !this->Gathered.empty())
  {
    result = this->GatherAndRun(request, inputs, outputVector);
  }
  else if (!this->IsLaterPiece(request, outputVector))
  {
    result = this->MakeOutputs(request, inputs, outputVector);
  }
  this->EndRun();
  this->Whole->Separate().End();
  return result;
}

//------------------------------------------------------------------------------
int vtkCollectiveAlgorithm::MakeOutputs(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const int result = this->RequestData(request, inputVector, outputVector);
  removeReplacedFields({ this->GetExecutive()->GetInputInformation(), inputVector },
    this->GetNumberOfInputPorts(), outputVector);
  return result;
}

//------------------------------------------------------------------------------
void vtkCollectiveAlgorithm::EndPasses() {}

//------------------------------------------------------------------------------
// The first rank runs RequestData for all, of the data of all ranks. IsAlone makes it the only rank
// that GetRanks returns: an exchange within RequestData would wait for ranks that are not there.
int vtkCollectiveAlgorithm::GatherAndRun(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  std::map<int, GatheredKind> kinds;
  for (const auto& [port, policy] : this->Gathered)
  {
    kinds[port] = policy == PORT_GATHERED_POINTS ? GatheredKind::Points
      : policy == PORT_GATHERED_SURFACE          ? GatheredKind::Surface
                                                 : GatheredKind::Density;
  }
  GatheredInputs inputs(inputVector, kinds, *this->Run);
  int result = 1;
  if (this->Run->Own() == 0)
  {
    this->IsAlone = true;
    result = this->MakeOutputs(request, inputs.Vectors(), outputVector);
    this->IsAlone = false;
  }
  this->ShareOutputs(*this->Run, outputVector);
  // The others have those of their inputs, which the executive passed on.
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    broadcastFields(vtkDataObject::GetData(outputVector, port)->GetFieldData(), *this->Run);
  }
  return result;
}

//------------------------------------------------------------------------------
void vtkCollectiveAlgorithm::ShareOutputs(const Ranks&, vtkInformationVector*) {}

//------------------------------------------------------------------------------
void vtkCollectiveAlgorithm::EndRun()
{
  if (this->Run)
  {
    this->Run->End();
    this->Run = nullptr;
  }
}

//------------------------------------------------------------------------------
// The inputs are now at the requested time, which they were not in RequestInformation.
// The executive sends this request after RequestUpdateTime, if an early update has asked for it.
int vtkCollectiveAlgorithm::ProcessTimeDependentInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!this->Early->HasAny())
  {
    return 1;
  }
  vtkInformation* output = outputVector->GetInformationObject(0);
  const ImageGrid before = announcedGrid(output, true);
  this->Early->Clear();
  const int result = this->ProcessInformation(request, inputVector, outputVector);
  // Filters downstream have copied the extent of the other time in REQUEST_INFORMATION. They are
  // told again, and Modified() makes this filter execute for the new extent.
  if (result && !(announcedGrid(output, true) == before))
  {
    this->Modified();
    updateConsumerInformation(output);
  }
  return result;
}

//------------------------------------------------------------------------------
int vtkCollectiveAlgorithm::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    const char* type = this->GetOutputPortInformation(port)->Get(vtkDataObject::DATA_TYPE_NAME());
    if (type && std::string(type) == "vtkPointSet")
    {
      makeOutputLike(vtkPointSet::GetData(inputVector[0]), outputVector, port);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkCollectiveAlgorithm::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1;
}

//------------------------------------------------------------------------------
const Ranks& vtkCollectiveAlgorithm::UpdateInputOnRanks(
  int port, vtkInformationVector** inputVector, vtkInformationVector* outputVector, int connection)
{
  if (!this->Run)
  {
    this->Run = this->Whole->BeginWithoutPieces(this, port, inputVector);
  }
  this->Early->Run(this, port, connection, inputVector[port]->GetInformationObject(connection),
    outputVector->GetInformationObject(0), this->GetRanks());
  return this->GetRanks();
}

//------------------------------------------------------------------------------
int vtkCollectiveAlgorithm::RequestUpdateTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1;
}

//------------------------------------------------------------------------------
int vtkCollectiveAlgorithm::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // Ports are requested whole first; a partitioned one then asks for this rank's piece instead, of
  // the whole extent that the executive divides.
  this->Whole->RequestOutputs(request, outputVector);
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    if (this->Whole->IsNeeded(port))
    {
      vtkCollectiveAlgorithm::RequestWhole(inputVector[port]);
      this->Whole->RequestPartitioned(port, inputVector[port]);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkCollectiveAlgorithm::AddInputPort(
  PortPolicyType policy, const std::vector<const char*>& types, PortInputsType inputs)
{
  const int port = this->GetNumberOfInputPorts();
  this->SetNumberOfInputPorts(port + 1);
  vtkInformation* info = this->GetInputPortInformation(port);
  for (const char* type : types)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
  }
  // ParaView's dialog goes on without a second input: the executive's errors would be many.
  const bool isSecond = inputs == PORT_ONE_INPUT && port > 0;
  this->NeedsSecond = this->NeedsSecond || isSecond;
  if (inputs != PORT_ONE_INPUT || isSecond)
  {
    info->Set(inputs == PORT_SEVERAL_INPUTS ? vtkAlgorithm::INPUT_IS_REPEATABLE()
                                            : vtkAlgorithm::INPUT_IS_OPTIONAL(),
      1);
  }
  switch (policy)
  {
    case PORT_WHOLE:
      break;
    case PORT_PIECES:
      this->Whole->Except(port);
      break;
    case PORT_PARTITIONED_POINTS:
    case PORT_PARTITIONED_DENSITY:
      this->Whole->Partition(port, policy == PORT_PARTITIONED_POINTS);
      break;
    default:
      this->Whole->Partition(port, policy != PORT_GATHERED_DENSITY);
      this->Gathered[port] = policy;
  }
}

//------------------------------------------------------------------------------
void vtkCollectiveAlgorithm::AddOutputPort(const char* type)
{
  const int port = this->GetNumberOfOutputPorts();
  this->SetNumberOfOutputPorts(port + 1);
  this->GetOutputPortInformation(port)->Set(vtkDataObject::DATA_TYPE_NAME(), type);
}

//------------------------------------------------------------------------------
int vtkCollectiveAlgorithm::FillInputPortInformation(int, vtkInformation*)
{
  return 1;
}

//------------------------------------------------------------------------------
int vtkCollectiveAlgorithm::FillOutputPortInformation(int, vtkInformation*)
{
  return 1;
}

//------------------------------------------------------------------------------
const Ranks& vtkCollectiveAlgorithm::GetRanks() const
{
  return this->IsAlone || !this->Run ? static_cast<const Ranks&>(SoloRanks::Get()) : *this->Run;
}

//------------------------------------------------------------------------------
void vtkCollectiveAlgorithm::WarnOnFirstRank(const std::string& text)
{
  if (!text.empty() && this->GetRanks().IsFirst())
  {
    vtkWarningMacro(<< messageText(text));
  }
}

//------------------------------------------------------------------------------
void vtkCollectiveAlgorithm::WarnOnFirstRank(const std::vector<std::string>& texts)
{
  for (const std::string& text : texts)
  {
    this->WarnOnFirstRank(text);
  }
}

//------------------------------------------------------------------------------
bool vtkCollectiveAlgorithm::IsLaterPiece(
  vtkInformation* request, vtkInformationVector* outputVector)
{
  if (this->Run || this->GetNumberOfInputPorts() == 0 || this->GetNumberOfOutputPorts() == 0 ||
    this->Whole->HasPieces())
  {
    return false;
  }
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const int port = std::max(0, request->Get(Pipeline::FROM_OUTPUT_PORT()));
  return outputVector->GetInformationObject(port)->Get(Pipeline::UPDATE_PIECE_NUMBER()) > 0;
}

//------------------------------------------------------------------------------
void vtkCollectiveAlgorithm::RequestWhole(vtkInformationVector* port)
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
void vtkCollectiveAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Threading: " << this->GetThreadingAsString() << "\n";
}
VTK_ABI_NAMESPACE_END
