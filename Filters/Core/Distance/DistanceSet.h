// SPDX-License-Identifier: BSD-3-Clause
// The distances between all pairs of densities in one box. Those that are known are kept for the
// next set of densities, whatever their order.
#ifndef RectifiedTransport_DistanceSet_h
#define RectifiedTransport_DistanceSet_h

#include "../Geometry/GridSize.h"
#include "../Geometry/Points.h"
#include "../Parallel/Context.h"
#include "CertifiedDistance.h"
#include "DensityMoments.h"
#include "ReferenceImages.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

class Progress;

enum class DistanceMethod
{
  Linearized, // ReferenceImages.h
  Certified   // CertifiedDistance.h: densities have the same number of cells
};

// Densities are added one after the other, so that few need memory at a time, then Find. Ranks
// divide maps and pairs among them: each has all densities. All that takes a context is collective,
// and throws InvalidDensity, std::bad_alloc and Cancelled.
class DistanceSet
{
public:
  // The same numbers for equal values on a grid of as many cells in a box of the same sides alone.
  using Name = std::vector<std::uint64_t>;
  using Values = std::shared_ptr<const double>; // one per cell, axis 0 fastest

  // Forgets the densities, but not what is known. The box has one to three axes of these lengths.
  void Begin(DistanceMethod method, const std::vector<double>& sides);
  // Returns whether maps should be made before more densities are added.
  bool Add(const Name& name, const GridSize<3>& cells, Values values, const Context& context);

  // Whether maps are missing, and what they need: maps that are made together need the most memory.
  bool LacksMaps() const { return !this->Waiting.empty(); }
  double CellsOfMaps() const;
  double MemoryForMaps() const;
  void MakeMaps(const Context& context);

  // The squared distances of the pairs (0, 1), (0, 2) ... (1, 2) ..., after MakeMaps. Linearized is
  // above the distance, and the moments of the densities bound it from below. Keeps what is known
  // of these densities alone.
  double MemoryForPairs() const;
  std::vector<SquaredBracket> Find(const Context& context);

  // The number of maps and pairs of Certified that have been found, on all ranks.
  std::int64_t NumberOfSolutions() const { return this->Solutions; }

private:
  using NamePair = std::pair<Name, Name>;
  struct Density
  {
    Name Key;
    GridSize<3> Cells;
    Values Cell; // released as soon as nothing needs them
    DensityMoments Moments;
  };

  int Dimension() const { return static_cast<int>(this->Sides.size()); }
  template <int D>
  void MakeMapsIn(Progress& progress);
  template <int D>
  void FindMissing(Progress& progress);
  template <int D>
  SquaredBracket FindPair(const NamePair& pair, const Context& context) const;
  std::vector<NamePair> MissingPairs() const;
  void KeepOnlyGiven();
  std::map<NamePair, SquaredBracket>& Known()
  {
    return this->Pairs[static_cast<std::size_t>(this->Method)];
  }

  std::int64_t Solutions = 0;
  DistanceMethod Method = DistanceMethod::Linearized;
  std::vector<double> Sides;
  std::vector<Density> Given;
  std::vector<std::size_t> Waiting; // densities that have no map yet
  std::map<Name, std::shared_ptr<const ReferenceImages>> Maps;
  std::array<std::map<NamePair, SquaredBracket>, 2> Pairs; // by method
};

} // namespace RectifiedTransport

#endif
