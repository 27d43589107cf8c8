// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Boxes/BoxUnion.h"

#include <algorithm>

namespace RectifiedTransport
{

// The first box that has a value gives it; a later one must have the same.
bool findValueOwners(const std::vector<UnionBox>& boxes, const LatticePart<3>& all,
  const std::function<bool(std::size_t, std::int64_t, std::size_t, std::int64_t)>& areSame,
  ValueOwners& owners)
{
  return std::all_of(boxes.begin(), boxes.end(), [&](const UnionBox& box) {
    return visitRuns(box, all, [&](std::int64_t from, std::int64_t to, std::int64_t count) {
      for (std::int64_t i = 0; i < count; ++i)
      {
        std::int32_t& owner = owners.Boxes[static_cast<std::size_t>(to + i)];
        std::int64_t& value = owners.Values[static_cast<std::size_t>(to + i)];
        if (owner < 0)
        {
          owner = static_cast<std::int32_t>(box.Number);
          value = from + i;
        }
        else if (!areSame(static_cast<std::size_t>(owner), value, box.Number, from + i))
        {
          return false;
        }
      }
      return true;
    });
  });
}

} // namespace RectifiedTransport
