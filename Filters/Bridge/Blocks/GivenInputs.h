// SPDX-License-Identifier: BSD-3-Clause
// The data sets of a filter that takes several inputs: connections, and blocks of composite data.
#ifndef RectifiedTransport_GivenInputs_h
#define RectifiedTransport_GivenInputs_h

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

struct GivenInput
{
  vtkDataObject* Data;
  int Port;
  int Connection;    // its index on the port
  std::string Block; // the name of a block of composite data; else empty
};

struct GivenInputs
{
  std::vector<GivenInput> All;
  OtherLeaves Others;
};

// The leaves of composite data that may be densities, where these are inputs; other data are one.
GivenInputs gatherInputs(
  vtkInformationVector** inputVector, int numberOfPorts, bool blocksAreInputs);

// The data of one connection.
GivenInputs gatherBlocks(vtkDataObject* data, bool blocksAreInputs);

// Throws Failure if ranks have different numbers of inputs. Collective.
void requireSameNumber(std::size_t inputs, const Ranks& ranks);

// What to say of leaves that are passed over; empty for none. Throws Failure if there are no
// others.
std::string describeOthers(const GivenInputs& given);

} // namespace RectifiedTransport::Bridge

#endif
