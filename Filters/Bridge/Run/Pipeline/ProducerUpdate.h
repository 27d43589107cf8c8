// SPDX-License-Identifier: BSD-3-Clause
// Producers of inputs, updated in REQUEST_INFORMATION.
//
// A filter should look at data only in REQUEST_DATA. But if the extent of an image output depends
// on points or cells, VTK 9.1 to 9.6 have no other request in which to announce it. Filters
// downstream that know no extent, or a wrong one, get no data or read past the end of the image
// (TestAnnounced.py, TestUpstreamRequest.cxx).
#ifndef RectifiedTransport_ProducerUpdate_h
#define RectifiedTransport_ProducerUpdate_h

#include "Bridge/VTKCompatibility.h"

#include "vtkType.h"

#include <map>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkInformation;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Ranks;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// For one filter. Remembers what it updated, so that a producer runs once for each change.
class ProducerUpdate
{
public:
  // Updates the producer of an input: this rank's piece or, for one rank, what was requested last.
  // If the input changes with time, `output` gets TIME_DEPENDENT_INFORMATION. The executive then
  // sends another request, for the time that is requested downstream.
  void Run(vtkAlgorithm* filter, int port, int connection, vtkInformation* input,
    vtkInformation* output, const Ranks& ranks);

  // Whether inputs were updated since the last Clear.
  bool HasAny() const { return !this->Updated.empty(); }
  void Clear() { this->Updated.clear(); }

private:
  struct Update
  {
    const vtkAlgorithm* Producer; // compared, never dereferenced
    int Port;
    vtkMTimeType Time;
  };
  std::map<std::pair<int, int>, Update> Updated; // the last of each port and connection
};

// Updates the producer of an input, of what is requested from it now. Returns whether it could.
bool updateInput(vtkAlgorithm* filter, int port, int connection);

} // namespace RectifiedTransport::Bridge

#endif
