// SPDX-License-Identifier: BSD-3-Clause
// The ranks of MPI that this process belongs to.
#ifndef RectifiedTransport_MpiController_h
#define RectifiedTransport_MpiController_h

#include "Bridge/VTKCompatibility.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkMPIController;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// The global controller if it is one of MPI. Only if VTK has MPI.
vtkMPIController* mpiController();

bool haveSeveralRanks();

// Whether there are several ranks, as many pieces as ranks, and the requested piece is this rank's.
bool isPieceOfRanks(int piece, int pieces);

// One of several pieces of data.
struct DataPiece
{
  int Number;
  int Count;
};

// The piece of this rank: all data if there is one.
DataPiece pieceOfRank();

// MPI's name of the machine that this rank runs on; empty without MPI.
std::string machineOfRank();

} // namespace RectifiedTransport::Bridge

#endif
