// SPDX-License-Identifier: BSD-3-Clause
// Boxes of values that are joined to one box of a lattice.
#ifndef RectifiedTransport_BoxUnion_h
#define RectifiedTransport_BoxUnion_h

#include "Core/Geometry/LatticePart.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace RectifiedTransport
{

struct UnionBox
{
  // Whether a value is none of the joined ones, as a copy of another box's.
  bool IsGhost(std::int64_t value) const
  {
    return this->Flags && (this->Flags[value] & this->Mask);
  }

  std::size_t Number;         // that of its image
  LatticePart<3> Box;         // in the lattice
  const unsigned char* Flags; // nullptr for no ghosts
  unsigned char Mask;
};

// Calls visit(from, to, count) for the runs of values of a box that are no ghosts, until it returns
// false. They go to the values `all`. Returns whether it never did.
template <class Visit>
bool visitRuns(const UnionBox& joined, const LatticePart<3>& all, const Visit& visit)
{
  const LatticePart<3>& own = joined.Box;
  for (std::int64_t k = own.Low[2]; k < own.End(2); ++k)
  {
    for (std::int64_t j = own.Low[1]; j < own.End(1); ++j)
    {
      const std::int64_t from = own.NumberOf({ own.Low[0], j, k });
      const std::int64_t to = all.NumberOf({ own.Low[0], j, k });
      for (std::int64_t i = 0; i < own.Cells[0];)
      {
        const bool isGhost = joined.IsGhost(from + i);
        std::int64_t end = i + 1;
        while (end < own.Cells[0] && isGhost == joined.IsGhost(from + end))
        {
          ++end;
        }
        if (!isGhost && !visit(from + i, to + i, end - i))
        {
          return false;
        }
        i = end;
      }
    }
  }
  return true;
}

// Who gives each value of a lattice: the first box that has it, and the value's number there. The
// box is -1 for a value of none.
struct ValueOwners
{
  std::vector<std::int64_t> Values;
  std::vector<std::int32_t> Boxes;
};

// Sets who gives the values `all`; there is memory for them, and none has an owner yet. Returns
// false if a box has another value where the first one gives it: unless areSame(owner, its value,
// box, its value).
bool findValueOwners(const std::vector<UnionBox>& boxes, const LatticePart<3>& all,
  const std::function<bool(std::size_t, std::int64_t, std::size_t, std::int64_t)>& areSame,
  ValueOwners& owners);

} // namespace RectifiedTransport

#endif
