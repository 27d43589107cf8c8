// SPDX-License-Identifier: BSD-3-Clause
// Which labels have most of the mass of clouds in each cell.
#ifndef RectifiedTransport_LabelVotes_h
#define RectifiedTransport_LabelVotes_h

#include "Core/Geometry/LatticePart.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;
class Ranks;

// The mass of a cloud for one tuple.
template <int D>
struct LabelVote
{
  double Centre[D]; // in index space
  float Lengths[D]; // in cells
  double Mass;
  std::int64_t Tuple;
  std::int64_t Number; // number of the cloud among those of all ranks
};

template <int D>
class LabelVotes
{
public:
  // Prepares the votes in a part of a grid. Each rank gets the votes of all ranks that reach its
  // part, in the order of their numbers. Collective. Throws std::bad_alloc.
  LabelVotes(std::vector<LabelVote<D>> votes, const GridSize<D>& size, const LatticePart<D>& part,
    const Ranks& ranks);

  // Returns for each cell of the part the label with most of the mass there, the smallest one if
  // masses are equal; -1 without mass. equal[t] is the label that tuple t counts for. Throws
  // std::bad_alloc and Cancelled.
  std::vector<std::int64_t> Count(const std::vector<std::int64_t>& equal, Progress& progress) const;

private:
  const GridSize<D> Size;
  const LatticePart<D> Part;
  std::vector<LabelVote<D>> Votes;
  std::vector<std::int64_t> Begins; // the first vote of each layer
};

} // namespace RectifiedTransport

#endif
