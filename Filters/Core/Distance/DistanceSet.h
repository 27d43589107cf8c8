// SPDX-License-Identifier: BSD-3-Clause
// The distances between all pairs of densities in one box. Known distances are kept for the next
// set of densities, in any order.
#ifndef RectifiedTransport_DistanceSet_h
#define RectifiedTransport_DistanceSet_h

#include "../Geometry/ImageGrid.h"
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

// A distance between two densities and its bounds, in physical lengths.
struct DistancePair
{
  double Distance = 0.0;
  double Lower = 0.0;
  double Upper = 0.0;
};

// Densities are added one after the other, so that few need memory at a time, then Find. Ranks
// divide maps and pairs among them: each has all densities. All that takes a context is collective,
// and throws InvalidDensity, std::bad_alloc and Cancelled.
class DistanceSet
{
public:
  using Name = std::vector<std::uint64_t>;      // the same numbers for equal values alone
  using Values = std::shared_ptr<const double>; // one per cell, axis 0 fastest

  // Forgets the densities, but not what is known.
  void Begin(DistanceMethod method);
  // The grids of all densities fill the same box. Returns whether maps should be made before more
  // densities are added.
  bool Add(Name name, const ImageGrid& grid, Values values, const Context& context);

  // Whether maps are missing, and what they need: maps that are made together need the most memory.
  bool LacksMaps() const { return !this->Waiting.empty(); }
  double CellsOfMaps() const;
  double MemoryForMaps() const;
  void MakeMaps(const Context& context);

  // Returns the pairs (0, 1), (0, 2) ... (1, 2) ..., after MakeMaps. The distance is the lower
  // bound with Certified, and the upper bound with Linearized, for which the moments of the
  // densities give the lower one. Keeps only what is known of these densities.
  double MemoryForPairs() const;
  std::vector<DistancePair> Find(const Context& context);

  // The number of maps and pairs of Certified that have been found, on all ranks.
  std::int64_t NumberOfSolutions() const { return this->Solutions; }

private:
  using NamePair = std::pair<Name, Name>;
  struct Density
  {
    Name Key; // its name, its cells and the sides of its box
    GridSize<3> Cells;
    Values Cell; // released as soon as nothing needs them
    DensityMoments Moments;
  };

  int Dimension() const { return this->Box.Dimension(); }
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
  ImageGrid Box; // the box of the first density
  std::vector<Density> Given;
  std::vector<std::size_t> Waiting; // densities that have no map yet
  std::map<Name, std::shared_ptr<const ReferenceImages>> Maps;
  std::array<std::map<NamePair, SquaredBracket>, 2> Pairs; // by method
};

} // namespace RectifiedTransport

#endif
