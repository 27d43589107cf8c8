// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/Inputs/SeparateInputs.h"

#include "Bridge/Run/Pipeline/RequestedTimes.h"
#include "Core/Messages/Failure.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

// A connection of an input, and all that it depends on, its producer among it.
struct SeparateInputs::Branch
{
  vtkAlgorithm* Producer;
  int OutputPort;
  int Port;
  int Index;
  vtkInformation* Information; // the producer's, with what is requested of it
  Algorithms Upstream;
  // The last source with times on which another input depends, too.
  struct SharedSource
  {
    std::size_t Depth; // how many algorithms it depends on, itself included; 0 without a source
    TimeRange Times;
  };
  SharedSource Source{ 0, {} };

  // The deepest source counts, which is nearest to the input; with equal depth that of earlier
  // times, so that the choice does not depend on the order of a set of pointers.
  void Take(const SharedSource& source)
  {
    const bool isEarlier =
      source.Depth == this->Source.Depth && source.Times.First < this->Source.Times.First;
    this->Source = source.Depth > this->Source.Depth || isEarlier ? source : this->Source;
  }
  SeparateInputs::Output Given() const { return { this->Producer, this->OutputPort }; }
};

namespace
{

// What is requested of an output.
vtkSmartPointer<vtkInformation> requestOf(vtkInformation* output)
{
  auto request = vtkSmartPointer<vtkInformation>::New();
  request->CopyEntry(output, Pipeline::UPDATE_TIME_STEP());
  request->CopyEntry(output, Pipeline::UPDATE_EXTENT());
  request->CopyEntry(output, Pipeline::UPDATE_PIECE_NUMBER());
  request->CopyEntry(output, Pipeline::UPDATE_NUMBER_OF_PIECES());
  request->CopyEntry(output, Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS());
  return request;
}

// Puts a request back that an update of another branch has overwritten. Append does not remove a
// key that the request lacks, so that a time of another request must be removed here.
void applyRequest(vtkInformation* request, vtkInformation* output)
{
  output->Append(request);
  if (!request->Has(Pipeline::UPDATE_TIME_STEP()))
  {
    output->Remove(Pipeline::UPDATE_TIME_STEP());
  }
}

// The time that data say they are of; none where their source does not tell.
std::optional<double> dataTime(vtkDataObject* data)
{
  vtkInformation* information = data ? data->GetInformation() : nullptr;
  return information && information->Has(vtkDataObject::DATA_TIME_STEP())
    ? std::optional<double>(information->Get(vtkDataObject::DATA_TIME_STEP()))
    : std::nullopt;
}

// Whether data are of a time that they may have, where `asked` was requested: a source without data
// at that time gives those at the step before or after it.
bool isTimeOf(double time, double asked, vtkInformation* output, const TimeRange& announced)
{
  // The nearest steps on both sides of what was asked for. Without steps, the source makes any time
  // within its range.
  double before = announced.Steps > 0 ? announced.First : asked;
  double after = announced.Steps > 0 ? announced.Last : asked;
  for (int i = 0; i < announced.Steps; ++i)
  {
    const double step = output->Get(Pipeline::TIME_STEPS(), i);
    before = step <= asked ? std::max(before, step) : before;
    after = step >= asked ? std::min(after, step) : after;
  }
  return time == asked || time == before || time == after ||
    time == std::clamp(asked, announced.First, announced.Last);
}

// Whether a filter has one time of several that an input has.
// Such a filter, for example one that forces a time, requests that time whatever is asked of it.
bool choosesOne(vtkAlgorithm* filter, const TimeRange& announced)
{
  bool areSeveral = false;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < filter->GetNumberOfInputConnections(port); ++i)
    {
      const auto given = announcedTimes(filter->GetInputInformation(port, i));
      areSeveral = areSeveral || (given && given->First != given->Last);
    }
  }
  return areSeveral && announced.First == announced.Last;
}

// The time that an output was last made for, which the executive keeps for itself.
// The key is protected in the executive's class, so that only a subclass can name it.
struct ExecutiveKeys : Pipeline
{
  static vtkInformationDoubleKey* MadeFor() { return PREVIOUS_UPDATE_TIME_STEP(); }
};

// Whether a filter has made an output of data of another time than was requested.
bool isMistimed(vtkAlgorithm* filter, int port)
{
  vtkInformation* output = filter->GetOutputInformation(port);
  const auto announced = announcedTimes(output);
  const auto time = dataTime(filter->GetOutputDataObject(port));
  // Sources make what is requested. Without announced times or the data's own, nothing can be said.
  if (filter->GetTotalNumberOfInputConnections() == 0 || !announced || !time)
  {
    return false;
  }
  if (choosesOne(filter, *announced))
  {
    return *time != announced->First;
  }
  return output->Has(ExecutiveKeys::MadeFor()) &&
    !isTimeOf(*time, output->Get(ExecutiveKeys::MadeFor()), output, *announced);
}

// The information of a port with other data of some connections.
// The executive's own information must not change: it outlives this execution.
vtkSmartPointer<vtkInformationVector> copyWith(vtkInformationVector* inputs, int port,
  const std::map<std::pair<int, int>, vtkDataObject*>& replaced)
{
  auto vector = vtkSmartPointer<vtkInformationVector>::New();
  for (int i = 0; i < inputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkNew<vtkInformation> copy;
    copy->Copy(inputs->GetInformationObject(i));
    const auto found = replaced.find({ port, i });
    if (found != replaced.end())
    {
      copy->Set(vtkDataObject::DATA_OBJECT(), found->second);
    }
    vector->Append(copy);
  }
  return vector;
}

} // namespace

SeparateInputs::SeparateInputs() = default;

SeparateInputs::~SeparateInputs() = default;

// The data of one chosen time have always the same time.
SeparateInputs::State SeparateInputs::StateOf(const Output& output)
{
  // A filter counts as the same as long as it was not modified, and still gives that time.
  const auto announced = announcedTimes(output.first->GetOutputInformation(output.second));
  const bool hasOne = announced && choosesOne(output.first, *announced);
  const auto time = dataTime(output.first->GetOutputDataObject(output.second));
  return { output.first->GetMTime(), hasOne ? time : std::nullopt };
}

// The connections that depend on a source with times on which another one depends, too. Those that
// depend on most come first: what is an input itself, and the source of others, is made last.
std::vector<SeparateInputs::Branch> SeparateInputs::FindBranches(
  vtkAlgorithm* filter, vtkInformationVector** inputVector)
{
  // First all connections with what they depend on, and for each algorithm the outputs that depend
  // on it; then the sources that two or more different outputs share.
  std::vector<Branch> branches;
  std::map<vtkAlgorithm*, std::set<Output>> dependents;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < filter->GetNumberOfInputConnections(port); ++i)
    {
      Branch branch{ nullptr, 0, port, i, inputVector[port]->GetInformationObject(i), {} };
      branch.Producer = filter->GetInputAlgorithm(port, i, branch.OutputPort);
      // Data that were set without a producer, and other executives, have no requests to keep
      // apart.
      if (branch.Producer && Pipeline::SafeDownCast(branch.Producer->GetExecutive()))
      {
        branch.Upstream = upstreamOf(branch.Producer);
        for (vtkAlgorithm* upstream : branch.Upstream)
        {
          dependents[upstream].insert(branch.Given());
        }
        branches.push_back(std::move(branch));
      }
    }
  }
  for (Branch& branch : branches)
  {
    for (vtkAlgorithm* source : branch.Upstream)
    {
      const auto times = timesOf(source);
      // Two connections to one output are one dependent: they get the same data anyway.
      if (times && dependents.at(source).size() > 1)
      {
        branch.Take({ upstreamOf(source).size(), *times });
      }
    }
  }
  const auto sharesNone = [](const Branch& branch) { return branch.Source.Depth == 0; };
  branches.erase(std::remove_if(branches.begin(), branches.end(), sharesNone), branches.end());
  std::stable_sort(branches.begin(), branches.end(), [](const Branch& one, const Branch& other) {
    return one.Upstream.size() > other.Upstream.size();
  });
  return branches;
}

void SeparateInputs::RequestFirstTimes(vtkAlgorithm* filter, vtkInformationVector** inputVector)
{
  const std::vector<Branch> branches = FindBranches(filter, inputVector);
  const auto hasTimesOfSource = [](const Branch& branch) {
    return announcedTimes(branch.Information) == branch.Source.Times;
  };
  // Inputs that announce what their source does agree on a first time without help.
  if (std::all_of(branches.begin(), branches.end(), hasTimesOfSource))
  {
    return;
  }
  // An input without times makes its data the same way whatever is requested.
  for (const Branch& branch : branches)
  {
    if (const auto times = announcedTimes(branch.Information))
    {
      branch.Information->Set(Pipeline::UPDATE_TIME_STEP(),
        std::clamp(branch.Source.Times.First, times->First, times->Last));
    }
  }
}

void SeparateInputs::Update(vtkAlgorithm* filter, vtkInformationVector** inputVector)
{
  this->End();
  const std::vector<Branch> branches = FindBranches(filter, inputVector);
  if (branches.empty())
  {
    return;
  }
  // Order matters: stale steps go first, then each input is made; if another filter has mixed up
  // times before, what it left is invalidated and each input is made again, once.
  this->InvalidateCachedSteps(branches);
  this->UpdateEach(branches);
  if (this->DropMistimed(branches))
  {
    this->UpdateEach(branches);
    this->UntimedOutputs.clear();
    for (const Output& output : Mistimed(branches))
    {
      this->UntimedOutputs[output] = StateOf(output);
    }
  }
  // From here on their data count as made by this filter, until their time says otherwise.
  for (auto& [cachingFilter, time] : this->CachingFilters)
  {
    time = cachingFilter->GetOutputDataObject(0)->GetUpdateTime();
  }
}

// Filters that make data of several time steps, as Temporal Interpolator does, keep these steps,
// and do not tell what their data are made of. They begin again where another filter has updated
// them.
void SeparateInputs::InvalidateCachedSteps(const std::vector<Branch>& branches)
{
  std::map<vtkAlgorithm*, vtkMTimeType> cachingFilters;
  for (const Branch& branch : branches)
  {
    for (vtkAlgorithm* filter : branch.Upstream)
    {
      vtkDataObject* data =
        filter->IsA("vtkMultiTimeStepAlgorithm") ? filter->GetOutputDataObject(0) : nullptr;
      if (data && cachingFilters.emplace(filter, 0).second)
      {
        const auto found = this->CachingFilters.find(filter);
        if (found == this->CachingFilters.end() || found->second != data->GetUpdateTime())
        {
          filter->Modified();
        }
      }
    }
  }
  this->CachingFilters = cachingFilters;
}

void SeparateInputs::UpdateEach(const std::vector<Branch>& branches)
{
  this->End();
  // Requests are saved first, because an update of one branch passes its own upstream, also to the
  // producers of other branches.
  std::vector<vtkSmartPointer<vtkInformation>> requests;
  for (const Branch& branch : branches)
  {
    requests.push_back(requestOf(branch.Information));
  }
  for (std::size_t i = 0; i < branches.size(); ++i)
  {
    const Branch& branch = branches[i];
    applyRequest(requests[i], branch.Information);
    // Other consumers of the same algorithms find their requests as before.
    const RequestedTimes kept(branch.Producer);
    auto* pipeline = Pipeline::SafeDownCast(branch.Producer->GetExecutive());
    if (!pipeline->Update(branch.OutputPort) && this->Failed.empty())
    {
      this->Failed = "Input port " + std::to_string(branch.Port) +
        " could not be updated; mend the error of a filter before it";
    }
    // The shallow copy keeps the arrays when the producer makes the data of the next branch.
    if (vtkDataObject* data = branch.Producer->GetOutputDataObject(branch.OutputPort))
    {
      auto copy = vtkSmartPointer<vtkDataObject>::Take(data->NewInstance());
      copy->ShallowCopy(data);
      this->Data.push_back({ branch.Port, branch.Index, data, data->GetUpdateTime(), copy });
    }
  }
  for (std::size_t i = 0; i < branches.size(); ++i)
  {
    applyRequest(requests[i], branches[i].Information);
  }
}

// A filter that is none of ours may have requested several times together, so that filters before
// it got data of another time than they asked for: the executive does not make them again for that
// time, and some filters keep them. Returns whether there are such, which the next update then
// makes anew. Filters that do not tell which time their data have are not tried again.
bool SeparateInputs::DropMistimed(const std::vector<Branch>& branches)
{
  const std::set<Output> wrong = Mistimed(branches);
  const auto isKnown = [this](const Output& output) {
    const auto found = this->UntimedOutputs.find(output);
    return found != this->UntimedOutputs.end() && found->second == StateOf(output);
  };
  if (std::all_of(wrong.begin(), wrong.end(), isKnown))
  {
    return false;
  }
  for (const Output& output : wrong)
  {
    for (vtkAlgorithm* filter : upstreamOf(output.first))
    {
      // Sources stay as they are: they make what is requested, and reading a file again takes long.
      if (filter->GetTotalNumberOfInputConnections() > 0)
      {
        filter->Modified();
      }
    }
  }
  return true;
}

// The outputs before these inputs whose data are not of the time that was requested.
std::set<SeparateInputs::Output> SeparateInputs::Mistimed(const std::vector<Branch>& branches)
{
  std::set<Output> wrong;
  for (const Branch& branch : branches)
  {
    for (vtkAlgorithm* filter : branch.Upstream)
    {
      for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
      {
        if (isMistimed(filter, port))
        {
          wrong.insert({ filter, port });
        }
      }
    }
  }
  return wrong;
}

// While the executive iterates over blocks the input is one of them, and cannot be replaced.
vtkInformationVector** SeparateInputs::Inputs(
  vtkAlgorithm* filter, vtkInformationVector** inputVector)
{
  if (!this->Failed.empty())
  {
    throw Failure(this->Failed);
  }
  // The executive may have made an input once more after Update. If that was in the same data
  // object, the copy has the contents of the right time. Another data object is none that Update
  // has made.
  std::map<std::pair<int, int>, vtkDataObject*> replaced;
  for (const UpdatedInput& made : this->Data)
  {
    if (made.Data->GetUpdateTime() == made.Time)
    {
      continue;
    }
    if (vtkDataObject::GetData(inputVector[made.Port], made.Index) != made.Data)
    {
      throw Failure("Input port " + std::to_string(made.Port) +
        " was made anew for another input; give each input a source of its own");
    }
    replaced[{ made.Port, made.Index }] = made.Copy;
  }
  if (replaced.empty())
  {
    return inputVector;
  }
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    this->Vectors.push_back(copyWith(inputVector[port], port, replaced));
    this->Pointers.push_back(this->Vectors.back());
  }
  return this->Pointers.data();
}

void SeparateInputs::End()
{
  this->Data.clear();
  this->Failed.clear();
  this->Vectors.clear();
  this->Pointers.clear();
}

} // namespace RectifiedTransport::Bridge
