// SPDX-License-Identifier: BSD-3-Clause
// Compacts the items that are left after a pass.
#ifndef RectifiedTransport_Compaction_h
#define RectifiedTransport_Compaction_h

namespace RectifiedTransport
{

// Calls move(i, place), in order, for each of `count` items for which isLeft(i); places count from
// 0, place <= i. Returns how many are left.
template <class Number, class IsLeft, class Move>
Number compact(Number count, const IsLeft& isLeft, const Move& move)
{
  Number left = 0;
  for (Number i = 0; i < count; ++i)
  {
    if (isLeft(i))
    {
      move(i, left++);
    }
  }
  return left;
}

} // namespace RectifiedTransport

#endif
