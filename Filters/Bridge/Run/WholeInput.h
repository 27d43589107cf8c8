// SPDX-License-Identifier: BSD-3-Clause
// Detection of inputs that are distributed over ranks, which the filters do not support: their
// results would be wrong.
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

// Throws Failure for an image whose extent is less than its WHOLE_EXTENT. `what` begins the
// message.
void requireWholeExtent(vtkInformation* input, const std::string& what);

// A hash of the numbers of points and cells, the bounds, and samples of the coordinates and array
// values of data sets and of the leaves of composite ones; 0 where none has points.
std::uint64_t fingerprintOf(const std::vector<vtkDataObject*>& data);

// The result of comparing the inputs of all ranks.
enum class RankAgreement
{
  Same,
  FirstOnly, // only rank 0 has data
  Differs,
  NoAnswer, // within ten seconds: not all ranks execute the filter
};

// Whether there are several ranks and the requested piece is this rank's, of as many pieces as
// there are ranks.
bool sharesWithRanks(int piece, int pieces);

// Compares the fingerprint of this rank's data with those of the others: all must be equal, or 0 on
// all ranks but the first. `subject` names the filter and the input. Sets `rank` to the one that
// differs or does not answer. Waits at most ten seconds. Only where sharesWithRanks is true.
RankAgreement compareRanks(const std::string& subject, std::uint64_t fingerprint, int& rank);

} // namespace RectifiedTransport

#endif
