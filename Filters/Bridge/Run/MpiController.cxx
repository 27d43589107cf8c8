// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/MpiController.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkMPIController.h"
#endif

namespace RectifiedTransport::Bridge
{

#if VTK_MODULE_ENABLE_VTK_ParallelMPI

vtkMPIController* mpiController()
{
  return vtkMPIController::SafeDownCast(vtkMultiProcessController::GetGlobalController());
}

bool haveSeveralRanks()
{
  vtkMPIController* controller = mpiController();
  return controller && controller->GetNumberOfProcesses() > 1;
}

bool isPieceOfRanks(int piece, int pieces)
{
  return haveSeveralRanks() && pieces == mpiController()->GetNumberOfProcesses() &&
    piece == mpiController()->GetLocalProcessId();
}

DataPiece pieceOfRank()
{
  if (!haveSeveralRanks())
  {
    return { 0, 1 };
  }
  return { mpiController()->GetLocalProcessId(), mpiController()->GetNumberOfProcesses() };
}

std::string machineOfRank()
{
  return haveSeveralRanks() ? vtkMPIController::GetProcessorName() : "";
}

#else

bool haveSeveralRanks()
{
  return false;
}

bool isPieceOfRanks(int, int)
{
  return false;
}

DataPiece pieceOfRank()
{
  return { 0, 1 };
}

std::string machineOfRank()
{
  return {};
}

#endif

} // namespace RectifiedTransport::Bridge
