// SPDX-License-Identifier: BSD-3-Clause
// The data sets of a filter that takes several inputs: connections, and blocks of composite data.
#ifndef RectifiedTransport_ConnectedInputs_h
#define RectifiedTransport_ConnectedInputs_h

#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/VTKCompatibility.h"

#include <cstddef>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Ranks;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct ConnectedInput
{
  vtkDataObject* Data;
  int Port;
  int Connection;    // its index on the port
  std::string Block; // the name of a block of composite data; else empty
};

struct ConnectedInputs
{
  std::vector<ConnectedInput> All;
  SkippedLeaves Skipped;
};

// The leaves of composite data that may be densities, where these are inputs; other data are one.
ConnectedInputs gatherInputs(
  vtkInformationVector** inputVector, int numberOfPorts, bool blocksAreInputs);

// The data of one connection.
ConnectedInputs gatherBlocks(vtkDataObject* data, bool blocksAreInputs);

// Throws Failure if ranks have different numbers of inputs. Collective.
void requireSameNumber(std::size_t inputs, const Ranks& ranks);

// What to say of leaves that are passed over; empty for none. Throws Failure if there are no
// others.
std::string describeSkipped(const ConnectedInputs& connected);

} // namespace RectifiedTransport::Bridge

#endif
