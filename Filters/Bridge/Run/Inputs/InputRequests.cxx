// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/Inputs/InputRequests.h"

#include "Bridge/Run/Fingerprint.h"
#include "Bridge/Run/Inputs/InputExtents.h"
#include "Bridge/Run/MpiController.h"
#include "Bridge/Run/RankRun.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkAlgorithm.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <chrono>

namespace RectifiedTransport::Bridge
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

// Whether a data object is one of the blocks of a composite data set. It tells that the executive
// now iterates over blocks, which no key of a request says.
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
// Readers may ignore the requested extent and give a part of the image, such as the piece of one
// rank. Tables of a part would be those of another density.
void requireWholeExtent(vtkInformation* input, const std::string& what)
{
  vtkImageData* image = vtkImageData::GetData(input);
  const int* whole = input->Get(Pipeline::WHOLE_EXTENT());
  if (!image || image->GetNumberOfPoints() == 0 || !whole)
  {
    return;
  }
  // An extent beyond the announced one has all that is needed.
  const int* extent = image->GetExtent();
  bool isWhole = true;
  for (int a = 0; a < 6; a += 2)
  {
    isWhole = isWhole && extent[a] <= whole[a] && extent[a + 1] >= whole[a + 1];
  }
  if (!isWhole)
  {
    throw Failure(what + " is an image of the extent " + textOfExtent(extent) + " out of " +
      textOfExtent(whole) +
      "; it must be whole on every rank: read it so, or gather it before this filter");
  }
}

// A writer, which has no outputs, takes the piece of its rank.
DataPiece requestedPiece(vtkInformation* request, vtkInformationVector* outputs)
{
  vtkInformation* output =
    outputs->GetInformationObject(std::max(0, request->Get(Pipeline::FROM_OUTPUT_PORT())));
  return output ? DataPiece{ output->Get(Pipeline::UPDATE_PIECE_NUMBER()),
    output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) }
                : pieceOfRank();
}

// Programs that call Update() request no time; ParaView and vtkForceTime do.
bool isTimeRequested(vtkInformationVector* outputs)
{
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    if (outputs->GetInformationObject(i)->Has(Pipeline::UPDATE_TIME_STEP()))
    {
      return true;
    }
  }
  return false;
}

// One fingerprint a port, for the data on it.
std::vector<std::uint64_t> fingerprintsOf(const std::vector<std::vector<vtkDataObject*>>& inputs)
{
  std::vector<std::uint64_t> fingerprints;
  for (const std::vector<vtkDataObject*>& port : inputs)
  {
    fingerprints.push_back(sampledFingerprint(port));
  }
  return fingerprints;
}

// Describes the ports with data that are neither the same on all ranks nor on the first one only.
std::string differenceOf(const Ranks& ranks, const std::vector<std::uint64_t>& fingerprints)
{
  // Shape: ranks x ports. A rank without data on a port has the fingerprint 0 there.
  std::vector<std::vector<std::uint64_t>> all;
  for (const Bytes& bytes : ranks.Gather(toBytes(fingerprints)))
  {
    all.push_back(fromBytes<std::uint64_t>(bytes));
  }
  for (std::size_t port = 0; port < fingerprints.size(); ++port)
  {
    for (std::size_t rank = 1; rank < all.size(); ++rank)
    {
      if (all[rank][port] != all[0][port] && all[rank][port] != 0)
      {
        return "The data on input port " + std::to_string(port) +
          " are not the same on rank 0 and on rank " + std::to_string(rank) +
          "; what lies on several ranks must be gathered on the first one, or be whole on each "
          "(Redistribute DataSet with a Number Of Partitions of 1 gathers it)";
      }
    }
  }
  return "";
}

} // namespace

//------------------------------------------------------------------------------
void InputRequests::Record(vtkAlgorithm* filter, vtkInformation* request,
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // The request is the consumer's: what it says is recorded here and used until the next one.
  const DataPiece piece = requestedPiece(request, outputVector);
  if (piece.Count == 1 && this->IsIteratingOverBlocks(filter, inputVector))
  {
    return; // a request of the executive itself
  }
  this->Piece = piece.Number;
  this->NumberOfPieces = piece.Count;
  this->Iterates = false;
  // Weak pointers: the producer may delete or replace its output before the filter runs.
  this->Composites.assign(static_cast<std::size_t>(filter->GetNumberOfInputPorts()), {});
  for (std::size_t port = 0; port < this->Composites.size(); ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      this->Composites[port].emplace_back(vtkCompositeDataSet::GetData(inputVector[port], i));
      // A port that takes any data takes a composite data set as it is; other ports get block by
      // block.
      const auto partitioned = this->Partitioned.find(static_cast<int>(port));
      const bool takesAny = partitioned != this->Partitioned.end() && !partitioned->second;
      this->Iterates = this->Iterates || (this->Composites[port].back() && !takesAny);
    }
  }
}

//------------------------------------------------------------------------------
vtkCompositeDataSet* InputRequests::CompositeAt(int port, int connection) const
{
  const auto p = static_cast<std::size_t>(port);
  const auto c = static_cast<std::size_t>(connection);
  return p < this->Composites.size() && c < this->Composites[p].size()
    ? this->Composites[p][c].Get()
    : nullptr;
}

//------------------------------------------------------------------------------
bool InputRequests::IsIteratingOverBlocks(
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
bool InputRequests::IsPartitioned(int port, vtkInformation* input) const
{
  const auto partitioned = this->Partitioned.find(port);
  // Pieces are exchanged only if every rank runs the filter once, for its own piece of as many as
  // there are ranks. A block is run by one rank alone.
  if (partitioned == this->Partitioned.end() || this->Iterates ||
    !isPieceOfRanks(this->Piece, this->NumberOfPieces))
  {
    return false;
  }
  vtkDataObject* data = vtkDataObject::GetData(input);
  // A port of points takes pieces of images and point sets; other data are needed whole.
  return !partitioned->second || vtkImageData::SafeDownCast(data) ||
    vtkPointSet::SafeDownCast(data);
}

//------------------------------------------------------------------------------
// After a request of all: the executive divides the extent.
void InputRequests::RequestPartitioned(int port, vtkInformationVector* inputs) const
{
  for (int i = 0; i < inputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* input = inputs->GetInformationObject(i);
    if (!this->IsPartitioned(port, input))
    {
      continue;
    }
    input->Set(Pipeline::UPDATE_PIECE_NUMBER(), this->Piece);
    input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), this->NumberOfPieces);
  }
}

//------------------------------------------------------------------------------
void InputRequests::RequestOutputs(vtkInformation* request, vtkInformationVector* outputs) const
{
  if (this->Partitioned.empty() || !isPieceOfRanks(this->Piece, this->NumberOfPieces))
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
void InputRequests::RequestFirstTimes(vtkAlgorithm* filter, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector) const
{
  // A time that is requested downstream is passed on by the executive to all inputs alike.
  if (!isTimeRequested(outputVector) && !this->IsIteratingOverBlocks(filter, inputVector))
  {
    SeparateInputs::RequestFirstTimes(filter, inputVector);
  }
}

//------------------------------------------------------------------------------
void InputRequests::UpdateSeparately(
  vtkAlgorithm* filter, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!this->IsIteratingOverBlocks(filter, inputVector))
  {
    this->RequestFirstTimes(filter, inputVector, outputVector);
    this->Separated.Update(filter, inputVector);
  }
}

//------------------------------------------------------------------------------
std::unique_ptr<RankRun> InputRequests::BeginRun(
  vtkAlgorithm* filter, vtkInformationVector** inputVector) const
{
  if (this->Partitioned.empty() || this->IsIteratingOverBlocks(filter, inputVector))
  {
    return nullptr;
  }
  // Waits for all ranks: from here on, an error on one of them ends the run on all.
  return RankRun::Begin(filter->GetClassName(), this->Piece, this->NumberOfPieces);
}

//------------------------------------------------------------------------------
std::unique_ptr<RankRun> InputRequests::BeginWithoutPieces(
  vtkAlgorithm* filter, int port, vtkInformationVector** inputVector) const
{
  const auto partitioned = this->Partitioned.find(port);
  // A composite data set of points is executed by blocks, of which ranks may have different
  // numbers.
  if (partitioned == this->Partitioned.end() || this->IsIteratingOverBlocks(filter, inputVector) ||
    (partitioned->second && !vtkPointSet::GetData(inputVector[port])))
  {
    return nullptr;
  }
  return RankRun::TryBegin(filter->GetClassName());
}

//------------------------------------------------------------------------------
void InputRequests::Require(
  vtkAlgorithm* filter, vtkInformationVector** inputVector, const RankRun* run)
{
  // The data that have to be whole, by ports. A partitioned port is left out only in a run of all
  // ranks: alone, a rank needs everything.
  Inputs inputs(static_cast<std::size_t>(filter->GetNumberOfInputPorts()));
  vtkMTimeType newest = 0;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    const int connections =
      this->IsNeeded(port) ? inputVector[port]->GetNumberOfInformationObjects() : 0;
    for (int i = 0; i < connections; ++i)
    {
      vtkInformation* input = inputVector[port]->GetInformationObject(i);
      if (run && this->IsPartitioned(port, input))
      {
        continue;
      }
      // Sources announce the grid of the first time step; that of a later one may be smaller.
      const bool mayChange = input->Length(Pipeline::TIME_STEPS()) > 1 &&
        !isPieceOfRanks(this->Piece, this->NumberOfPieces);
      if (!mayChange)
      {
        requireWholeExtent(input, "Input port " + std::to_string(port));
      }
      // A composite data set is compared as a whole, once for all of its blocks.
      vtkDataObject* whole = this->CompositeAt(port, i);
      if (vtkDataObject* data = whole ? whole : vtkDataObject::GetData(input))
      {
        newest = std::max({ newest, data->GetMTime(), data->GetUpdateTime() });
        inputs[static_cast<std::size_t>(port)].push_back(data);
      }
    }
  }
  // In a run every rank compares each time, because an exchange that some ranks skip would not end.
  if (run)
  {
    this->Difference = differenceOf(*run, fingerprintsOf(inputs));
  }
  else if (newest != this->ComparedTime)
  {
    if (!this->Compare(filter, inputs))
    {
      return; // and ask again at the next run
    }
    this->ComparedTime = newest;
  }
  if (!this->Difference.empty())
  {
    throw Failure(this->Difference);
  }
}

//------------------------------------------------------------------------------
// Sets Difference. Returns whether the other ranks answered.
bool InputRequests::Compare(vtkAlgorithm* filter, const Inputs& inputs)
{
  this->Difference.clear();
  if (!isPieceOfRanks(this->Piece, this->NumberOfPieces))
  {
    return true;
  }
  // Those that were the same on all ranks: others may skip the comparison, as times are local.
  const std::vector<std::uint64_t> fingerprints = fingerprintsOf(inputs);
  if (fingerprints == this->Same)
  {
    return true;
  }
  this->Same.clear();
  constexpr std::chrono::seconds longest{ 10 };
  const auto run = RankRun::TryBegin("blocks of " + std::string(filter->GetClassName()), longest);
  if (!run)
  {
    vtkWarningWithObjectMacro(filter,
      << "Not all ranks have run this filter within ten seconds. Whether its data lie on several "
         "ranks, which would make the result wrong, is not known");
    return false;
  }
  this->Difference = differenceOf(*run, fingerprints);
  if (this->Difference.empty())
  {
    this->Same = fingerprints;
  }
  run->End();
  return true;
}

} // namespace RectifiedTransport::Bridge
