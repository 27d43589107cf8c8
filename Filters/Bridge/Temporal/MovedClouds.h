// SPDX-License-Identifier: BSD-3-Clause
// Particles as clouds of the size that their cells have on their way: where neighbours move apart,
// clouds grow with the distance, so that they still fill the space between them evenly.
#ifndef RectifiedTransport_MovedClouds_h
#define RectifiedTransport_MovedClouds_h

#include "Bridge/Ranks/TupleBoxes.h"
#include "Core/Flow/PivotLattice.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/Points.h"

#include "vtkDoubleArray.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Lengths of clouds along the axes of index space, of all particles; interleaved. In lengths of the
// cells of the particle's own step, so that no unit of physical lengths is beyond a float.
struct CloudSizes
{
  std::vector<float> From;
  std::vector<float> To;

  bool IsEmpty() const { return this->From.empty(); }
};

// The lengths of the clouds of particles, in a lattice of cells, at their images: `images` are in
// the index space of `there`, and each particle is at its number in the lattice. Along an axis it
// is the mean of the distances to the images of both neighbours, or the smaller one if they differ
// by a factor of two or more, as where mass comes apart. The images of all ranks count.
// Collective. Throws Cancelled.
template <int D>
std::vector<float> cloudsAtImages(const PivotLattice<D>& lattice, const ImageGrid& here,
  const ImageGrid& there, const std::vector<std::int64_t>& numbers, ConstPointSpan<D> images,
  Progress& progress);
// Where they begin.
template <int D>
std::vector<float> cloudsInCells(const PivotLattice<D>& lattice, std::int64_t count);

struct MovedClouds
{
  vtkDoubleArray* Points; // physical
  const double* Masses;
  const CloudSizes& Sizes;
  std::int64_t First; // the number of the first point among the sizes
  double Part;        // of the way
  // The grids of the two steps. Before this number among the sizes, particles are of the first one.
  const ImageGrid& FirstGrid;
  const ImageGrid& SecondGrid;
  std::int64_t OfFirst;
};

// Writes the density of clouds on the wanted tuples of a grid. Clouds beyond the border are cut
// there and keep their masses. `most`: no cell gets more mass. Sums are of integers, so that
// neither threads nor ranks change a bit. Collective. Throws Failure and Cancelled.
void splatClouds(const MovedClouds& clouds, const ImageGrid& geometry, double most,
  const TupleBox& wanted, Progress& progress, vtkDoubleArray* density);

} // namespace RectifiedTransport::Bridge

#endif
