// SPDX-License-Identifier: BSD-3-Clause
// Where a sampled transport map folds: it turns space over.
#ifndef RectifiedTransport_MapFolds_h
#define RectifiedTransport_MapFolds_h

#include "../Geometry/LatticePart.h"
#include "../Parallel/ExactSum.h"
#include "../Parallel/Progress.h"

#include <cstdint>

namespace RectifiedTransport
{

template <int Dimension>
class RectifiedFlow;

struct FoldCount
{
  std::int64_t Samples = 0;
  ExactSum Area{}; // area of their images, with reversed orientation, in cells of the lattice

  void Add(const FoldCount& other)
  {
    this->Samples += other.Samples;
    this->Area.Add(other.Area);
  }
};

// Counts the samples with det J <= 0, where J is the map's Jacobian matrix, whose cell of the
// lattice has mass. In the corners of the domain, and in 3D at its edges, the map has no
// derivative, and differences may give a negative determinant. So the two outermost samples along
// both axes do not count.
template <int Dimension>
class MapFolds
{
public:
  // For the domain of a density, in whose cells samples need mass; nullptr if all samples count.
  MapFolds(const GridSize<Dimension>& lattice, const RectifiedFlow<Dimension>* density)
    : Lattice(lattice)
    , Density(density)
  {
  }

  // Counts the folds in a part. The determinants are those of the samples of a larger part, axis 0
  // fastest. Throws Cancelled.
  FoldCount Count(const LatticePart<Dimension>& part, const LatticePart<Dimension>& within,
    const double* determinants, Progress& progress) const;
  // The same from the samples' images, as MapDerivatives takes them.
  FoldCount Count(const LatticePart<Dimension>& part, const LatticePart<Dimension>& within,
    const Point<Dimension>& step, ConstPointSpan<Dimension> positions, Progress& progress) const;
  // The samples of a part whose cells have mass.
  std::int64_t CountWithMass(const LatticePart<Dimension>& part, Progress& progress) const;

private:
  template <class Determinants>
  FoldCount CountRows(const LatticePart<Dimension>& part, const Determinants& determinantsOf,
    Progress& progress) const;
  bool IsCorner(const GridSize<Dimension>& sample) const;
  bool HasMass(const GridSize<Dimension>& sample) const;

  const GridSize<Dimension> Lattice;
  const RectifiedFlow<Dimension>* const Density;
};

} // namespace RectifiedTransport

#endif
