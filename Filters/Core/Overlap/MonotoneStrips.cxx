// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Overlap/MonotoneStrips.h"

#include <cstddef>

namespace RectifiedTransport
{

std::int32_t MonotoneStrips::Begin(std::int32_t point)
{
  if (this->Ended.empty())
  {
    this->Ended.push_back(static_cast<std::int32_t>(this->All.size()));
    this->All.emplace_back();
  }
  const std::int32_t strip = this->Ended.back();
  this->Ended.pop_back();
  this->At(strip).Chain.assign(1, point);
  return strip;
}

void MonotoneStrips::Add(std::int32_t strip, std::int32_t point, StripSide side)
{
  // A point on the other side sees the whole chain: a fan covers it. On the same side, triangles
  // are cut off while the chain's end is convex as seen from inside.
  Strip& grown = this->At(strip);
  std::vector<std::int32_t>& chain = grown.Chain;
  if (chain.size() > 1 && side != grown.Side)
  {
    this->EmitFan(grown, point);
    chain.assign(1, chain.back());
  }
  grown.Side = side;
  while (chain.size() > 1)
  {
    const auto corners = TriangleOf(side, chain[chain.size() - 2], chain.back(), point);
    // A reflex or straight chain end is not visible from the point.
    if (!turnsLeft(
          this->Numbered(corners[0]), this->Numbered(corners[1]), this->Numbered(corners[2])))
    {
      break;
    }
    this->Emit(corners);
    chain.pop_back();
  }
  chain.push_back(point);
}

// At the end the remaining chain is convex or opposite to the point: a fan.
void MonotoneStrips::End(std::int32_t strip, std::int32_t point)
{
  this->EmitFan(this->At(strip), point);
  this->Ended.push_back(strip);
}

// The edge from the last point to this one divides the strip into two. The chain stays with the
// part on whose side its points are; the other part begins with the last point alone.
std::array<std::int32_t, 2> MonotoneStrips::Divide(std::int32_t strip, std::int32_t point)
{
  // The side on which the chain's points are.
  const bool isRight = this->At(strip).Chain.size() > 1 && this->At(strip).Side == StripSide::Right;
  const std::int32_t other = this->Begin(this->At(strip).Chain.back());
  this->Add(strip, point, isRight ? StripSide::Right : StripSide::Left);
  this->Add(other, point, isRight ? StripSide::Left : StripSide::Right);
  return isRight ? std::array<std::int32_t, 2>{ strip, other }
                 : std::array<std::int32_t, 2>{ other, strip };
}

std::array<std::int32_t, 3> MonotoneStrips::TriangleOf(
  StripSide side, std::int32_t low, std::int32_t high, std::int32_t point)
{
  return side == StripSide::Left ? std::array<std::int32_t, 3>{ point, high, low }
                                 : std::array<std::int32_t, 3>{ low, high, point };
}

void MonotoneStrips::EmitFan(const Strip& strip, std::int32_t point)
{
  for (std::size_t i = 0; i + 1 < strip.Chain.size(); ++i)
  {
    this->Emit(TriangleOf(strip.Side, strip.Chain[i], strip.Chain[i + 1], point));
  }
}

void MonotoneStrips::Emit(const std::array<std::int32_t, 3>& corners)
{
  // Triangles without area beyond rounding are not written: points on a line.
  double error = 0.0;
  if (doubleArea(this->Numbered(corners[0]).X, this->Numbered(corners[1]).X,
        this->Numbered(corners[2]).X, error) > 0.0)
  {
    this->Triangles.push_back(corners);
  }
}

} // namespace RectifiedTransport
