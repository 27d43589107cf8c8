// SPDX-License-Identifier: BSD-3-Clause
// The displacements of a transport map at the cell centres of a lattice, in physical space, and
// the transport's cost (paper, Section 4.2, Figure 6).
#ifndef RectifiedTransport_MapDisplacement_h
#define RectifiedTransport_MapDisplacement_h

#include "../Geometry/ImageGrid.h"
#include "../Geometry/LatticePart.h"
#include "../Geometry/LengthScale.h"
#include "../Parallel/ExactSum.h"
#include "../Parallel/Progress.h"

#include <cstdint>

namespace RectifiedTransport
{

template <int Dimension>
class RectifiedFlow;

// Weighted squares of displacements, summed exactly, over parts of a lattice in any order.
struct DisplacementSums
{
  ExactSum Cost{};
  ExactSum Weight{};

  void Add(const DisplacementSums& other)
  {
    this->Cost.Add(other.Cost);
    this->Weight.Add(other.Weight);
  }
};

// Image minus centre of each cell of a lattice on the domain of `grid`.
template <int Dimension>
class MapDisplacement
{
public:
  // For a part of the lattice: `positions` are the images, in index space, of a larger part,
  // `within`, axis 0 fastest. A backward map begins at the density: the weight of a cell is its
  // share of the mass of `density`. Otherwise cells have equal weights.
  MapDisplacement(const ImageGrid& grid, const GridSize<Dimension>& lattice,
    const LatticePart<Dimension>& part, const LatticePart<Dimension>& within,
    ConstPointSpan<Dimension> positions, const RectifiedFlow<Dimension>* density);

  // Writes the displacements of the part's cells [first, last), and adds those in `counted` to the
  // sums. The output may overwrite positions that are not needed any more. Throws Cancelled.
  void Write(std::int64_t first, std::int64_t last, const LatticePart<Dimension>& counted,
    PointSpan<3> displacements, DisplacementSums& sums, Progress& progress) const;
  // Adds all cells of the part to the sums. Throws Cancelled.
  void Count(DisplacementSums& sums, Progress& progress) const;

  // Writes what each of the part's cells adds to MeanSquare of the sums of all cells: its cost,
  // in squared physical units. Throws Cancelled.
  void WriteCosts(const double* displacements, const DisplacementSums& sums, double* costs,
    Progress& progress) const;

  // The mean squared displacement, in squared physical units. Throws std::overflow_error if it is
  // beyond the largest double.
  double MeanSquare(const DisplacementSums& sums) const;

private:
  DisplacementSums Sum(std::int64_t first, std::int64_t last, const LatticePart<Dimension>& counted,
    double* displacements, Progress& progress) const;
  void Displace(const GridSize<Dimension>& cell, double* displacement) const;
  double WeightOf(const GridSize<Dimension>& cell) const;

  const ImageGrid& Grid;
  const LengthScale Scale;
  const GridSize<Dimension> Lattice;
  const LatticePart<Dimension> Part;
  const LatticePart<Dimension> Within;
  const GridSize<Dimension> Size;
  const Point<Dimension> Step;
  const ConstPointSpan<Dimension> Positions;
  const RectifiedFlow<Dimension>* const Density;
};

// Writes the displacements of the whole lattice; returns the mean square. In 3D, positions and
// displacements may share memory. Throws std::bad_alloc, std::overflow_error and Cancelled.
template <int Dimension>
double writeDisplacements(const ImageGrid& grid, const GridSize<Dimension>& lattice,
  ConstPointSpan<Dimension> positions, const RectifiedFlow<Dimension>* density,
  PointSpan<3> displacements, const Context& context = Context());

} // namespace RectifiedTransport

#endif
