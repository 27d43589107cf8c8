// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/WholeInputs.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/RankAgreement.h"
#include "Bridge/Run/RankRun.h"

#include "vtkAlgorithm.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cstring>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

// FNV-1a.
class Mixer
{
public:
  template <class Value>
  void Add(Value value)
  {
    unsigned char bytes[sizeof(Value)];
    std::memcpy(bytes, &value, sizeof(Value));
    for (const unsigned char byte : bytes)
    {
      this->State = (this->State ^ byte) * 0x100000001b3;
    }
  }
  std::uint64_t Mixed() const { return this->State; }

private:
  std::uint64_t State = 0xcbf29ce484222325;
};

// Of an array of any length: samples suffice, as pieces of a data set differ nearly everywhere.
constexpr vtkIdType maximumSamples = 4096;

template <class Visit>
void visitSamples(vtkIdType count, const Visit& visit)
{
  const vtkIdType step = std::max<vtkIdType>(1, count / maximumSamples);
  for (vtkIdType i = 0; i < count; i += step)
  {
    visit(i);
  }
}

void addDataSet(vtkDataSet* data, Mixer& mixer)
{
  double bounds[6];
  data->GetBounds(bounds);
  std::for_each(bounds, bounds + 6, [&](double bound) { mixer.Add(bound); });
  mixer.Add(data->GetNumberOfPoints());
  mixer.Add(data->GetNumberOfCells());
  if (!vtkImageData::SafeDownCast(data))
  {
    visitSamples(data->GetNumberOfPoints(), [&](vtkIdType i) {
      double x[3];
      data->GetPoint(i, x);
      std::for_each(x, x + 3, [&](double place) { mixer.Add(place); });
    });
  }
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(owner);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      if (vtkDataArray* array = attributes->GetArray(i))
      {
        visitSamples(array->GetNumberOfTuples(),
          [&](vtkIdType tuple) { mixer.Add(array->GetComponent(tuple, 0)); });
      }
    }
  }
}

// Returns whether it has points.
bool addData(vtkDataObject* data, Mixer& mixer)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    bool hasAny = false;
    const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      hasAny = addData(leaves->GetCurrentDataObject(), mixer) || hasAny;
    }
    return hasAny;
  }
  auto* set = vtkDataSet::SafeDownCast(data);
  if (!set || set->GetNumberOfPoints() == 0)
  {
    return false;
  }
  addDataSet(set, mixer);
  return true;
}

void writeExtent(std::ostream& os, const int* extent)
{
  for (int i = 0; i < 6; ++i)
  {
    os << (i == 0 ? "" : " ") << extent[i];
  }
}

bool isLeafOf(vtkCompositeDataSet* composite, vtkDataObject* data)
{
  const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    if (leaves->GetCurrentDataObject() == data)
    {
      return true;
    }
  }
  return false;
}

// `what` begins the message.
void requireWholeExtent(vtkInformation* input, const std::string& what)
{
  vtkImageData* image = vtkImageData::GetData(input);
  const int* whole = input->Get(Pipeline::WHOLE_EXTENT());
  if (!image || image->GetNumberOfPoints() == 0 || !whole)
  {
    return;
  }
  const int* extent = image->GetExtent();
  bool isWhole = true;
  for (int a = 0; a < 6; a += 2)
  {
    isWhole = isWhole && extent[a] <= whole[a] && extent[a + 1] >= whole[a + 1];
  }
  if (!isWhole)
  {
    std::ostringstream message;
    message << what << " is an image of the extent ";
    writeExtent(message, extent);
    message << " out of ";
    writeExtent(message, whole);
    message << "; it must be whole on every rank: read it so, or gather it before this filter";
    throw Failure(message.str());
  }
}

std::string describeDifference(const std::string& input, const char* here, int rank)
{
  return "The data on " + input + " are not the same " + here + " and on rank " +
    std::to_string(rank) +
    "; what lies on several ranks must be gathered on the first one, or be whole on each "
    "(Redistribute DataSet with a Number Of Partitions of 1 gathers it)";
}

// A hash of the numbers of points and cells, the bounds, and samples of the coordinates and array
// values of data sets and of the leaves of composite ones; 0 where none has points.
std::uint64_t fingerprintOf(const std::vector<vtkDataObject*>& data)
{
  Mixer mixer;
  bool hasAny = false;
  for (vtkDataObject* object : data)
  {
    mixer.Add(hasAny);
    hasAny = addData(object, mixer) || hasAny;
  }
  return hasAny ? std::max<std::uint64_t>(1, mixer.Mixed()) : 0;
}

} // namespace

//------------------------------------------------------------------------------
void WholeInputs::Record(vtkAlgorithm* filter, vtkInformation* request,
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* output =
    outputVector->GetInformationObject(std::max(0, request->Get(Pipeline::FROM_OUTPUT_PORT())));
  const int pieces = output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
  if (pieces == 1 && this->IsIteratingOverBlocks(filter, inputVector))
  {
    return; // a request of the executive itself
  }
  this->Piece = output->Get(Pipeline::UPDATE_PIECE_NUMBER());
  this->NumberOfPieces = pieces;
  this->Composites.assign(static_cast<std::size_t>(filter->GetNumberOfInputPorts()), {});
  for (std::size_t port = 0; port < this->Composites.size(); ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      this->Composites[port].emplace_back(vtkCompositeDataSet::GetData(inputVector[port], i));
    }
  }
}

//------------------------------------------------------------------------------
vtkCompositeDataSet* WholeInputs::CompositeAt(int port, int connection) const
{
  const auto p = static_cast<std::size_t>(port);
  const auto c = static_cast<std::size_t>(connection);
  return p < this->Composites.size() && c < this->Composites[p].size()
    ? this->Composites[p][c].Get()
    : nullptr;
}

//------------------------------------------------------------------------------
bool WholeInputs::IsIteratingOverBlocks(
  vtkAlgorithm* filter, vtkInformationVector** inputVector) const
{
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkCompositeDataSet* composite = this->CompositeAt(port, i);
      if (composite && isLeafOf(composite, vtkDataObject::GetData(inputVector[port], i)))
      {
        return true;
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool WholeInputs::IsShared(int port, vtkInformation* input) const
{
  const auto shared = this->Shared.find(port);
  if (shared == this->Shared.end() || !sharesWithRanks(this->Piece, this->NumberOfPieces))
  {
    return false;
  }
  vtkDataObject* data = vtkDataObject::GetData(input);
  return vtkImageData::SafeDownCast(data) || (shared->second && vtkPointSet::SafeDownCast(data));
}

//------------------------------------------------------------------------------
// After a request of all: the executive divides the extent.
void WholeInputs::RequestShared(int port, vtkInformationVector* inputs) const
{
  for (int i = 0; i < inputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* input = inputs->GetInformationObject(i);
    if (!this->IsShared(port, input))
    {
      continue;
    }
    input->Set(Pipeline::UPDATE_PIECE_NUMBER(), this->Piece);
    input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), this->NumberOfPieces);
  }
}

//------------------------------------------------------------------------------
void WholeInputs::RequestOutputs(vtkInformation* request, vtkInformationVector* outputs) const
{
  if (this->Shared.empty() || !sharesWithRanks(this->Piece, this->NumberOfPieces))
  {
    return;
  }
  vtkInformation* requested =
    outputs->GetInformationObject(std::max(0, request->Get(Pipeline::FROM_OUTPUT_PORT())));
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* output = outputs->GetInformationObject(i);
    for (vtkInformationIntegerKey* key : { Pipeline::UPDATE_PIECE_NUMBER(),
           Pipeline::UPDATE_NUMBER_OF_PIECES(), Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS() })
    {
      output->Set(key, requested->Get(key));
    }
  }
}

//------------------------------------------------------------------------------
std::unique_ptr<RankRun> WholeInputs::BeginRun(
  vtkAlgorithm* filter, vtkInformationVector** inputVector) const
{
  if (this->Shared.empty() || this->IsIteratingOverBlocks(filter, inputVector))
  {
    return nullptr;
  }
  return RankRun::Begin(filter->GetClassName(), this->Piece, this->NumberOfPieces);
}

//------------------------------------------------------------------------------
void WholeInputs::Require(
  vtkAlgorithm* filter, vtkInformationVector** inputVector, const RankRun* run)
{
  Inputs inputs(static_cast<std::size_t>(filter->GetNumberOfInputPorts()));
  vtkMTimeType newest = 0;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    const int connections =
      this->IsNeeded(port) ? inputVector[port]->GetNumberOfInformationObjects() : 0;
    for (int i = 0; i < connections; ++i)
    {
      vtkInformation* input = inputVector[port]->GetInformationObject(i);
      if (run && this->IsShared(port, input))
      {
        continue;
      }
      requireWholeExtent(input, "Input port " + std::to_string(port));
      vtkDataObject* whole = this->CompositeAt(port, i);
      if (vtkDataObject* data = whole ? whole : vtkDataObject::GetData(input))
      {
        newest = std::max({ newest, data->GetMTime(), data->GetUpdateTime() });
        inputs[static_cast<std::size_t>(port)].push_back(data);
      }
    }
  }
  if (run)
  {
    requireSame(*run, inputs);
    return;
  }
  if (newest != this->ComparedTime)
  {
    this->Disagreement.clear();
    if (!this->Compare(filter, inputs))
    {
      return; // and ask again at the next run
    }
    this->ComparedTime = newest;
  }
  if (!this->Disagreement.empty())
  {
    throw Failure(this->Disagreement);
  }
}

//------------------------------------------------------------------------------
// Every rank has the data, or only the first has any.
void WholeInputs::requireSame(const RankRun& run, const Inputs& inputs)
{
  std::vector<std::uint64_t> own;
  for (const std::vector<vtkDataObject*>& port : inputs)
  {
    own.push_back(fingerprintOf(port));
  }
  const std::vector<Bytes> gathered = run.Gather(toBytes(own));
  const auto first = fromBytes<std::uint64_t>(gathered.front());
  for (std::size_t rank = 1; rank < gathered.size(); ++rank)
  {
    const auto other = fromBytes<std::uint64_t>(gathered[rank]);
    for (std::size_t port = 0; port < first.size(); ++port)
    {
      if (other[port] != first[port])
      {
        throw Failure(describeDifference(
          "input port " + std::to_string(port), "on rank 0", static_cast<int>(rank)));
      }
    }
  }
}

//------------------------------------------------------------------------------
// Sets Disagreement. Returns whether the other ranks answered.
bool WholeInputs::Compare(vtkAlgorithm* filter, const Inputs& inputs)
{
  this->EqualFingerprints.resize(inputs.size());
  if (!sharesWithRanks(this->Piece, this->NumberOfPieces))
  {
    return true;
  }
  for (std::size_t port = 0; port < inputs.size(); ++port)
  {
    const std::string name = "input port " + std::to_string(port);
    const std::uint64_t fingerprint = fingerprintOf(inputs[port]);
    // Equal on all ranks before: others may skip the comparison, as modification times are local.
    if (inputs[port].empty() || (fingerprint != 0 && fingerprint == this->EqualFingerprints[port]))
    {
      continue;
    }
    int rank = 0;
    const RankAgreement agreement = compareRanks(filter->GetClassName() + name, fingerprint, rank);
    this->EqualFingerprints[port] = agreement == RankAgreement::Same ? fingerprint : 0;
    if (agreement == RankAgreement::Differs)
    {
      this->Disagreement = describeDifference(name, "here", rank);
      return true;
    }
    if (agreement == RankAgreement::NoAnswer)
    {
      vtkWarningWithObjectMacro(filter,
        << "Rank " << rank << " has not run this filter for ten seconds; whether the data on "
        << name << " lie on several ranks, which would make the result wrong, is not known");
      return false;
    }
  }
  return true;
}

} // namespace RectifiedTransport
