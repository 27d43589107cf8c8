// SPDX-License-Identifier: BSD-3-Clause
// Linearized optimal transport: distances between densities by one map each, from the uniform
// measure on their box, after Wang, Slepcev, Basu, Ozolek and Rohde, "A linear optimal
// transportation framework for quantifying and visualizing variations in sets of images",
// International Journal of Computer Vision 101, 2013, doi:10.1007/s11263-012-0566-z.
//
// The root of the mean squared distance between the images of the same samples is a metric, as it
// is the distance between two points of one Euclidean space. It is at least W2, up to the errors of
// the maps: both maps together couple the two densities. For translations of one density it is W2.
#ifndef RectifiedTransport_ReferenceImages_h
#define RectifiedTransport_ReferenceImages_h

#include "../Parallel/Context.h"
#include "../Parallel/LargeBuffer.h"
#include "../Tables/Density.h"

namespace RectifiedTransport
{

// How many samples of the uniform measure are mapped, about. They are the same for all densities in
// a box, whatever their numbers of cells, so that a distance depends on two densities alone.
constexpr double ReferenceSamples = 0x1p16;

// The lattice of these samples in a box of these sides: cells as near to cubes as possible.
template <int Dimension>
GridSize<Dimension> referenceLattice(const Point<Dimension>& sides);

struct ReferenceImages
{
  LargeBuffer<double> Coordinates; // images of the samples, interleaved, in lengths
};

// The images of the samples under the optimal map to a density that fills a box of these sides.
// Collective, as is the density. Throws InvalidDensity, std::bad_alloc and Cancelled.
template <int Dimension>
ReferenceImages mapReference(const DensitySource<Dimension>& density, const Point<Dimension>& sides,
  const Context& context = Context());

// Returns the most bytes that mapReference takes, including its result.
template <int Dimension>
double memoryForReference(const GridSize<Dimension>& cells, const Point<Dimension>& sides);

// The mean squared distance between the images of the same samples, in squared lengths.
template <int Dimension>
double meanSquaredDistance(const ReferenceImages& a, const ReferenceImages& b);

} // namespace RectifiedTransport

#endif
