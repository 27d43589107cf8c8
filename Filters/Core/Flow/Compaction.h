// SPDX-License-Identifier: BSD-3-Clause
// What is left of many items after a pass.
#ifndef RectifiedTransport_Compaction_h
#define RectifiedTransport_Compaction_h

namespace RectifiedTransport
{

// Calls move(i, place) for each of `count` items that isLeft(i), in their order, with the places
// from 0 on: place <= i. Returns how many are left.
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
