// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/Pipeline/ConsumerExtents.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkInformationExecutivePortVectorKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cstddef>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

// VTK's extent without points: each axis ends before it begins.
const int emptyExtent[6] = { 0, -1, 0, -1, 0, -1 };

// Only structured data have extents, which the executive checks; others are requested by pieces.
bool isStructured(vtkInformation* output)
{
  vtkDataObject* data = vtkDataObject::GetData(output);
  return data && data->GetExtentType() == VTK_3D_EXTENT;
}

// Whether a requested extent is held by another one. The empty request is always met.
bool isWithin(const int* part, const int* whole)
{
  const bool isEmpty = part[0] > part[1] || part[2] > part[3] || part[4] > part[5];
  return isEmpty ||
    (part[0] >= whole[0] && part[1] <= whole[1] && part[2] >= whole[2] && part[3] <= whole[3] &&
      part[4] >= whole[4] && part[5] <= whole[5]);
}

// The announced extent of an output; empty if it announces none.
std::array<int, 6> wholeExtent(vtkInformation* output)
{
  std::array<int, 6> extent{ 0, -1, 0, -1, 0, -1 };
  if (output->Has(Pipeline::WHOLE_EXTENT()))
  {
    output->Get(Pipeline::WHOLE_EXTENT(), extent.data());
  }
  return extent;
}

// Makes a filter downstream execute for an empty extent. The executive keeps the extent in three
// keys: without the other two it takes the one that is set here.
void clearUpdateExtent(vtkInformation* output)
{
  output->Set(Pipeline::UPDATE_EXTENT(), emptyExtent, 6);
  output->Remove(Pipeline::COMBINED_UPDATE_EXTENT()); // else the executive would restore it
  output->Remove(Pipeline::UPDATE_EXTENT_INITIALIZED());
}

// Visits the structured outputs of an output's consumers, and those of their consumers in turn.
// Returns whether all were reached.
template <class Visit>
bool visitConsumers(vtkInformation* output, const Visit& visit)
{
  // A deleted filter remains in CONSUMERS(), as a dangling pointer, but holds no reference to the
  // information object any more. Which entry it is cannot be determined.
  // The information object has one owner besides its consumers: the executive that produces it.
  const int count = vtkExecutive::CONSUMERS()->Length(output);
  if (output->GetReferenceCount() != count + 1)
  {
    return false;
  }
  bool isComplete = true;
  vtkExecutive** consumers = vtkExecutive::CONSUMERS()->GetExecutives(output);
  for (int i = 0; i < count; ++i)
  {
    // Outputs that are not structured end the search: nothing downstream of them depends on an
    // extent.
    vtkInformationVector* outputs = consumers[i]->GetOutputInformation();
    for (int j = 0; j < outputs->GetNumberOfInformationObjects(); ++j)
    {
      vtkInformation* next = outputs->GetInformationObject(j);
      if (isStructured(next))
      {
        visit(next);
        isComplete = visitConsumers(next, visit) && isComplete;
      }
    }
  }
  return isComplete;
}

// The requested pieces of the structured outputs downstream of an output.
struct PieceRequest
{
  vtkInformation* Output;
  std::array<int, 3> Values; // the values of the keys, see pieceKeys
};

// In a function, as the keys of VTK are created when its library is loaded.
std::array<vtkInformationIntegerKey*, 3> pieceKeys()
{
  return { Pipeline::UPDATE_PIECE_NUMBER(), Pipeline::UPDATE_NUMBER_OF_PIECES(),
    Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS() };
}

std::vector<PieceRequest> pieceRequests(vtkInformation* output)
{
  std::vector<PieceRequest> requests;
  visitConsumers(output, [&requests](vtkInformation* next) {
    if (next->Has(Pipeline::UPDATE_NUMBER_OF_PIECES()))
    {
      requests.push_back({ next, {} });
      for (std::size_t i = 0; i < pieceKeys().size(); ++i)
      {
        requests.back().Values[i] = next->Get(pieceKeys()[i]);
      }
    }
  });
  return requests;
}

// UpdateInformation of a consumer reaches only that one, so that the filters downstream of it
// follow, one after the other, from the producer on.
bool updateInformationOfConsumers(vtkInformation* output)
{
  // Extents of earlier requests go first: they may be outside the new whole extent, which is an
  // error of the executive.
  const bool isComplete = visitConsumers(output, clearUpdateExtent);
  const int count = isComplete ? vtkExecutive::CONSUMERS()->Length(output) : 0;
  for (int i = 0; i < count; ++i)
  {
    vtkExecutive* consumer = vtkExecutive::CONSUMERS()->GetExecutives(output)[i];
    vtkInformationVector* outputs = consumer->GetOutputInformation();
    consumer->UpdateInformation();
    for (int j = 0; j < outputs->GetNumberOfInformationObjects(); ++j)
    {
      updateInformationOfConsumers(outputs->GetInformationObject(j));
    }
  }
  return isComplete;
}

} // namespace

bool announceEmptyExtents(vtkInformationVector* outputs)
{
  // Outputs were emptied after an error or an abort. Filters downstream execute nevertheless, and
  // must not read what was announced before.
  const auto announceEmpty = [](vtkInformation* output) {
    output->Set(Pipeline::WHOLE_EXTENT(), emptyExtent, 6);
    clearUpdateExtent(output);
  };
  bool isComplete = true;
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* output = outputs->GetInformationObject(i);
    if (isStructured(output))
    {
      announceEmpty(output);
      isComplete = visitConsumers(output, announceEmpty) && isComplete;
    }
    else if (output->Has(Pipeline::UPDATE_EXTENT()))
    {
      clearUpdateExtent(output); // left from a structured data object of this port
    }
  }
  return isComplete;
}

void announceToViews(vtkInformation* output, const std::array<int, 6>& before)
{
  const std::array<int, 6> whole = wholeExtent(output);
  if (whole == before || !isStructured(output))
  {
    return;
  }
  // What the image really holds. Requests outside are met with nothing, instead of a read past its
  // end.
  const int* made =
    vtkDataObject::GetData(output)->GetInformation()->Get(vtkDataObject::DATA_EXTENT());
  const auto request = [made](vtkInformation* information) {
    information->Set(Pipeline::UPDATE_EXTENT(), made, 6);
    information->Remove(Pipeline::COMBINED_UPDATE_EXTENT()); // else the executive would restore it
  };
  const bool isComplete = visitConsumers(output, [&](vtkInformation* next) {
    vtkExecutive* executive = vtkExecutive::PRODUCER()->GetExecutive(next);
    const int* requested = next->Get(Pipeline::UPDATE_EXTENT());
    // ParaView's filter passes the data on unchanged, so that it may announce the same extent. Any
    // other filter computes its extent by itself.
    if (executive->GetAlgorithm()->IsA("vtkPVPostFilter") && wholeExtent(next) == before)
    {
      next->CopyEntry(output, Pipeline::WHOLE_EXTENT());
      request(next);
    }
    else if (requested && !isWithin(requested, made))
    {
      clearUpdateExtent(next);
    }
  });
  // Where a consumer cannot be reached, its request may be one of the extent before.
  if (isComplete)
  {
    request(output);
  }
}

bool updateConsumerInformation(vtkInformation* output)
{
  // The executive would request piece 0 of 1, and on several ranks the request is another one.
  const std::vector<PieceRequest> requests = pieceRequests(output);
  const bool isComplete = updateInformationOfConsumers(output);
  for (const PieceRequest& request : requests)
  {
    for (std::size_t i = 0; i < pieceKeys().size(); ++i)
    {
      request.Output->Set(pieceKeys()[i], request.Values[i]);
    }
  }
  return isComplete;
}

bool clearUnmetRequests(vtkInformationVector* outputs)
{
  bool isComplete = true;
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* output = outputs->GetInformationObject(i);
    // Later pieces of an image are empty, or a series has a smaller grid at this time.
    const int* requested = output->Get(Pipeline::UPDATE_EXTENT());
    if (requested && isStructured(output) &&
      !isWithin(requested,
        vtkDataObject::GetData(output)->GetInformation()->Get(vtkDataObject::DATA_EXTENT())))
    {
      // Else this filter would not execute for the next consumer.
      output->Remove(vtkDataObject::ALL_PIECES_EXTENT());
      isComplete = visitConsumers(output, clearUpdateExtent) && isComplete;
    }
  }
  return isComplete;
}

} // namespace RectifiedTransport::Bridge
