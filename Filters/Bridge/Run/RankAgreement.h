// SPDX-License-Identifier: BSD-3-Clause
// Comparison of data among the ranks of MPI.
#ifndef RectifiedTransport_RankAgreement_h
#define RectifiedTransport_RankAgreement_h

#include "Bridge/VTKCompatibility.h"

#include <cstdint>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkMPIController;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// The result of comparing the inputs of all ranks.
enum class RankAgreement
{
  Same,
  FirstOnly, // only rank 0 has data
  Differs,
  NoAnswer, // within ten seconds: not all ranks execute the filter
};

// The global controller, where it is one of MPI; only where VTK has it.
vtkMPIController* mpiController();

bool haveSeveralRanks();

// Whether there are several ranks and the requested piece is this rank's, of as many pieces as
// there are ranks.
bool sharesWithRanks(int piece, int pieces);

// Compares the fingerprint of this rank's data with those of the others: all must be equal, or 0 on
// all ranks but the first. `subject` names the filter and the input. Sets `rank` to the one that
// differs or does not answer. Waits at most ten seconds. Only where sharesWithRanks is true.
RankAgreement compareRanks(const std::string& subject, std::uint64_t fingerprint, int& rank);

} // namespace RectifiedTransport

#endif
