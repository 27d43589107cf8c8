// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/SeparateInputs.h"

#include "Core/Parallel/Ranks.h"

#include "vtkAlgorithm.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace RectifiedTransport
{

namespace
{

using Arrays = std::set<std::pair<std::uint64_t, std::uint64_t>>; // addresses and times

struct Connection
{
  vtkAlgorithm* Producer;
  int OutputPort;
  int InputPort;
  int Index;
};

void addArrays(vtkDataObject* data, Arrays& arrays)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      addArrays(leaves->GetCurrentDataObject(), arrays);
    }
    return;
  }
  auto* set = vtkDataSet::SafeDownCast(data);
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = set ? set->GetAttributes(owner) : nullptr;
    for (int i = 0; attributes && i < attributes->GetNumberOfArrays(); ++i)
    {
      if (vtkDataArray* array = attributes->GetArray(i))
      {
        arrays.emplace(reinterpret_cast<std::uintptr_t>(array), array->GetMTime());
      }
    }
  }
}

// Whether a source upstream of a filter has times.
bool hasTimes(vtkAlgorithm* filter)
{
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    vtkInformation* output = filter->GetOutputInformation(port);
    if (output->Has(vtkStreamingDemandDrivenPipeline::TIME_STEPS()) ||
      output->Has(vtkStreamingDemandDrivenPipeline::TIME_RANGE()))
    {
      return true;
    }
  }
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < filter->GetNumberOfInputConnections(port); ++i)
    {
      vtkAlgorithm* upstream = filter->GetInputAlgorithm(port, i);
      if (upstream && hasTimes(upstream))
      {
        return true;
      }
    }
  }
  return false;
}

std::vector<Connection> timedConnections(vtkAlgorithm* filter)
{
  std::vector<Connection> connections;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < filter->GetNumberOfInputConnections(port); ++i)
    {
      Connection connection{ nullptr, 0, port, i };
      connection.Producer = filter->GetInputAlgorithm(port, i, connection.OutputPort);
      if (connection.Producer && connection.Producer->GetTotalNumberOfInputConnections() > 0 &&
        hasTimes(connection.Producer))
      {
        connections.push_back(connection);
      }
    }
  }
  return connections;
}

// The arrays that inputs from different producers have in common.
std::vector<std::uint64_t> sharedArrays(
  const std::vector<Connection>& connections, vtkInformationVector** inputVector)
{
  Arrays shared;
  for (std::size_t i = 0; i < connections.size(); ++i)
  {
    Arrays own;
    addArrays(
      vtkDataObject::GetData(inputVector[connections[i].InputPort], connections[i].Index), own);
    for (std::size_t j = 0; j < i; ++j)
    {
      if (connections[j].Producer == connections[i].Producer)
      {
        continue;
      }
      Arrays other;
      addArrays(
        vtkDataObject::GetData(inputVector[connections[j].InputPort], connections[j].Index), other);
      std::set_intersection(
        own.begin(), own.end(), other.begin(), other.end(), std::inserter(shared, shared.end()));
    }
  }
  std::vector<std::uint64_t> flat;
  for (const auto& [address, time] : shared)
  {
    flat.insert(flat.end(), { address, time });
  }
  return flat;
}

// A filter that has data does not ask upstream. A source sees that it has those of another time.
void release(vtkAlgorithm* filter, int outputPort)
{
  if (filter->GetTotalNumberOfInputConnections() == 0)
  {
    return;
  }
  if (vtkDataObject* data = filter->GetOutputDataObject(outputPort))
  {
    data->ReleaseData();
  }
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < filter->GetNumberOfInputConnections(port); ++i)
    {
      int upstreamPort = 0;
      vtkAlgorithm* upstream = filter->GetInputAlgorithm(port, i, upstreamPort);
      if (upstream && hasTimes(upstream))
      {
        release(upstream, upstreamPort);
      }
    }
  }
}

} // namespace

void SeparateInputs::Update(
  vtkAlgorithm* filter, vtkInformationVector** inputVector, const Ranks* ranks)
{
  const std::vector<Connection> connections = timedConnections(filter);
  const std::vector<std::uint64_t> shared = sharedArrays(connections, inputVector);
  if (onAllRanks(ranks, shared.empty() || shared == this->Shared))
  {
    return;
  }
  for (const Connection& connection : connections)
  {
    release(connection.Producer, connection.OutputPort);
    connection.Producer->Update(connection.OutputPort);
  }
  this->Shared = sharedArrays(connections, inputVector);
}

} // namespace RectifiedTransport
