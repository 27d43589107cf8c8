// SPDX-License-Identifier: BSD-3-Clause
// The vtkCells of particles: each has its own range of consecutive points.
#ifndef RectifiedTransport_ParticleCells_h
#define RectifiedTransport_ParticleCells_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// Runs as the current stage. Throws Failure and Cancelled.
vtkSmartPointer<vtkCellArray> newParticleCells(
  vtkIdType count, vtkIdType pointsEach, Progress& progress);

} // namespace RectifiedTransport

#endif
