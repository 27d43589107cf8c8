// SPDX-License-Identifier: BSD-3-Clause
// The density of one input, as it was read, on its way with a blend's particles.
#ifndef RectifiedTransport_MovedInput_h
#define RectifiedTransport_MovedInput_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Geometry/ImageGrid.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkDoubleArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class InputDensity;

struct MovedInput
{
  InputDensity& Density;
  double OwnMass; // of the density
  double Mass;    // that it gets
  // The positions of this rank's particles in the density, and where they are now.
  vtkDoubleArray* From;
  vtkDoubleArray* To;
};

// Writes the density, with its mass, on the wanted tuples of a grid that covers its domain. Nothing
// has moved. To the bit, if the masses and the cells are the same. Collective. Throws Failure and
// Cancelled.
void writeInput(const MovedInput& input, const ImageGrid& grid, const TupleBox& wanted,
  Progress& progress, double* values);

// Adds the density of its cells, each moved by the mean move of the particles in it; cells without
// particles stay. The same bits for every number of threads and ranks. Collective. Throws Failure
// and Cancelled.
void addMovedInput(const MovedInput& input, const ImageGrid& grid, const TupleBox& wanted,
  Progress& progress, double* density);

} // namespace RectifiedTransport::Bridge

#endif
