// SPDX-License-Identifier: BSD-3-Clause
// Values that cannot be interpolated, such as integers and texts, and are advected with particles.
#ifndef RectifiedTransport_SeriesLabels_h
#define RectifiedTransport_SeriesLabels_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Series/SeriesParticles.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// Returns for each tuple of both steps the number of the first tuple that is equal to it. The
// second step's tuples follow all of the first one's. Exactly the equal tuples have the same key.
// Throws std::bad_alloc.
using TupleKey = std::function<std::string(std::size_t step, std::int64_t tuple)>;
std::vector<std::int64_t> findEqual(
  const std::array<std::int64_t, 2>& tuples, const TupleKey& keyOf);

// The tuples of arrays of two steps, those of the second step numbered after all of the first one.
// A particle brings the tuple of the cell, or nearest point, of its own step; a tracked one brings
// both tuples, with its mass divided by the time. A cell or point gets the tuple that has most of
// the mass there; of two that have as much, that of the first step. Without mass, it gets the tuple
// at the place itself, of the nearer step.
class SeriesLabels
{
public:
  SeriesLabels() = default;
  // The cells of `grids` have the tuples of both steps. With `isAcross`, the densities are not in
  // the cells of these grids but around their corners, or the reverse. Then several tuples share a
  // particle's cloud, which is divided into its 2^d orthants. Throws std::bad_alloc.
  SeriesLabels(
    const std::array<ImageGrid, 2>& grids, bool isAcross, const SeriesParticles& particles);

  std::int64_t TuplesOfFirst() const { return this->Grids[0].NumberOfCells(); }
  // Returns the bytes that the votes of so many particles take.
  double BytesOfVotes(std::int64_t particles) const;

  // Numbers of tuples for the wanted cells of a grid.
  using Take = std::function<void(std::size_t array, const std::vector<std::int64_t>& tuples)>;
  // Takes the tuples at a moment, for each of several arrays; equal[array] is that of findEqual.
  // Collective. Throws std::bad_alloc and Cancelled.
  template <int D>
  void Find(const SeriesSnapshot& moment, const ImageGrid& grid, const LatticePart<D>& wanted,
    const std::vector<std::vector<std::int64_t>>& equal, Progress& progress,
    const Take& take) const;

private:
  template <int D>
  void AddTuples(std::size_t end, ConstPointSpan<3> points, const std::vector<float>& lengths);
  template <int D>
  std::int64_t InPlace(const ImageGrid& grid, const GridSize<D>& cell, double part) const;
  double OffsetOf(int part, int axis) const;

  std::array<ImageGrid, 2> Grids;
  int Parts = 1;
  // One tuple for each part of each particle, at both ends of its way.
  std::array<std::vector<std::int64_t>, 2> Tuples;
};

} // namespace RectifiedTransport

#endif
