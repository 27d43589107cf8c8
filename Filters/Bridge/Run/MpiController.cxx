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

DataPiece pieceOfRank()
{
  vtkMPIController* controller = mpiController();
  return controller
    ? DataPiece{ controller->GetLocalProcessId(), controller->GetNumberOfProcesses() }
    : DataPiece{ 0, 1 };
}

std::string machineOfRank()
{
  return haveSeveralRanks() ? vtkMPIController::GetProcessorName() : "";
}

#else

DataPiece pieceOfRank()
{
  return { 0, 1 };
}

std::string machineOfRank()
{
  return {};
}

#endif

bool haveSeveralRanks()
{
  return pieceOfRank().Count > 1;
}

bool isPieceOfRanks(int piece, int pieces)
{
  const DataPiece own = pieceOfRank();
  return own.Count > 1 && pieces == own.Count && piece == own.Number;
}

} // namespace RectifiedTransport::Bridge
