// SPDX-License-Identifier: BSD-3-Clause
// What is asked of a density without tables: its mass, and its values as an array or on another
// grid.
#ifndef RectifiedTransport_DensityQueries_h
#define RectifiedTransport_DensityQueries_h

#include "Bridge/Density/InputDensity.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Stages.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <string>

namespace RectifiedTransport::Bridge
{

// Density times cell measure, summed, for a prepared density. Reports values that are probably not
// meant. Throws Failure if the mass is beyond the largest double, and Cancelled. If there are wrong
// values, which the core counts, the result is meaningless.
double massOf(InputDensity& density, Progress& progress);
// The same for a density whose values may be distributed over ranks and have been gathered. Wrong
// values throw Failure. Collective.
double requireMass(InputDensity& density, const DensityValues& gathered, Progress& progress);

// The values as an array, on every rank all of them. What ranks gather for it stays until
// density.ReleaseGathered(). Collective. Throws Failure and Cancelled.
vtkSmartPointer<vtkDoubleArray> wholeValues(
  InputDensity& density, const std::string& name, Progress& progress);

// Throws the Failure for whole values that are no density; here no mass is no failure, as a step of
// a series may have none.
void requireValues(InputDensity& density, vtkDoubleArray& values);

// Writes the tuples `wanted` of a grid that covers the density's, along the same axes: the values
// themselves, to the bit, where both have the same cells up to rounding; else the means over the
// cells of the grid, by exact overlap. Each rank may want another box. Collective. Throws Failure
// and Cancelled.
void writeDensityOn(const ImageGrid& grid, InputDensity& density, const TupleBox& wanted,
  Progress& progress, double* values);

} // namespace RectifiedTransport::Bridge

#endif
