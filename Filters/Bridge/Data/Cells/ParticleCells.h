// SPDX-License-Identifier: BSD-3-Clause
// The points and vtkCells of particles: each has its own range of consecutive points. Their active
// scalars.
#ifndef RectifiedTransport_ParticleCells_h
#define RectifiedTransport_ParticleCells_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
class vtkDataArray;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// They throw Failure and Cancelled.
vtkSmartPointer<vtkCellArray> newParticleCells(
  vtkIdType count, vtkIdType pointsEach, Progress& progress);
// Sets the points of particles, and their cells: vertices, or lines of several points.
void setParticles(
  vtkPolyData* output, vtkDataArray* points, vtkIdType pointsEach, Progress& progress);
// Makes the masses active, which tools take first, where no other scalars are.
void activateMass(vtkPolyData* particles);

} // namespace RectifiedTransport::Bridge

#endif
