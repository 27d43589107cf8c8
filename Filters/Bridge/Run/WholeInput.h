// SPDX-License-Identifier: BSD-3-Clause
// Inputs that lie on several ranks, which no filter can work on yet: found before they make a wrong
// result.
#ifndef RectifiedTransport_WholeInput_h
#define RectifiedTransport_WholeInput_h

#include "Bridge/VTKCompatibility.h"

#include <cstdint>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
class vtkInformation;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// Throws Failure for an image that holds less than its pipeline announces. `what` begins the
// message.
void requireWholeExtent(vtkInformation* input, const std::string& what);

// A number that follows from the sizes, the places and samples of the values of data sets, and of
// those that composites hold; 0 where there is nothing in them.
std::uint64_t fingerprintOf(const std::vector<vtkDataObject*>& data);

// How the ranks of a host that asks each of its processes for its piece compare their inputs.
enum class RankAgreement
{
  Same,
  FirstOnly, // others have nothing
  Differs,   // each has something of its own
  NoAnswer,  // in ten seconds: not all ranks run the filter
};

// Whether a consumer that asks for `piece` of `pieces` asks for this rank's share of as many as
// there are ranks, and there are others.
bool sharesWithRanks(int piece, int pieces);

// Compares the fingerprint of a rank's data with those of the others: all must be the same, except
// that others than the first rank may have nothing. `subject` names the filter and the input.
// `rank` is then another one. Never waits without end. For sharesWithRanks only.
RankAgreement compareRanks(const std::string& subject, std::uint64_t fingerprint, int& rank);

} // namespace RectifiedTransport

#endif
