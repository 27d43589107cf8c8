// SPDX-License-Identifier: BSD-3-Clause
// The density of an input, as it is read, on another grid.
#ifndef RectifiedTransport_DensityOnGrid_h
#define RectifiedTransport_DensityOnGrid_h

#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Geometry/ImageGrid.h"

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class InputDensity;

// Writes the tuples `wanted` of a grid that covers the density's, along the same axes: the values
// themselves, to the bit, where both have the same cells up to rounding; else the means over the
// cells of the grid, by exact overlap. Each rank may want another box. Collective. Throws Failure
// and Cancelled.
void writeDensityOn(const ImageGrid& grid, InputDensity& density, const TupleBox& wanted,
  Progress& progress, double* values);

} // namespace RectifiedTransport::Bridge

#endif
