// SPDX-License-Identifier: BSD-3-Clause
// The ranks of MPI that this process belongs to.
#ifndef RectifiedTransport_MpiController_h
#define RectifiedTransport_MpiController_h

#include "Bridge/VTKCompatibility.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkMPIController;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// The global controller, where it is one of MPI; only where VTK has it.
vtkMPIController* mpiController();

bool haveSeveralRanks();

// Whether there are several ranks and the requested piece is this rank's, of as many pieces as
// there are ranks.
bool sharesWithRanks(int piece, int pieces);

} // namespace RectifiedTransport

#endif
