// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Image/CommonFrame.h"

#include "Bridge/Run/Failure.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

constexpr double rounding = 1e-9;       // of lengths that are meant to be the same
constexpr double planeTolerance = 1e-6; // of the longest side: single precision
constexpr const char* property = "Dimensions";

using Sides = std::array<ImageFrame::Side, 3>;

Sides sidesOf(const FramePart& part)
{
  return { part.Frame.GetSide(0, part.OnPoints), part.Frame.GetSide(1, part.OnPoints),
    part.Frame.GetSide(2, part.OnPoints) };
}

std::string axesOf(const Sides& sides)
{
  std::string axes;
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (sides[i].IsAxis)
    {
      axes += axes.empty() ? "" : " and ";
      axes += "xyz"[i];
    }
  }
  return axes.empty() ? "no axis" : "the axes " + axes;
}

double lengthOf(const ImageFrame::Side& side)
{
  return std::abs(side.Spacing) * side.Cells;
}

double longestOf(const Sides& sides)
{
  double longest = 0.0;
  for (const ImageFrame::Side& side : sides)
  {
    longest = std::max(longest, side.IsAxis ? lengthOf(side) : 0.0);
  }
  return longest;
}

void requireAlike(const FramePart& first, const FramePart& other)
{
  const Sides a = sidesOf(first);
  const Sides b = sidesOf(other);
  std::ostringstream message;
  if (axesOf(a) != axesOf(b))
  {
    message << first.Name << " has " << axesOf(a) << ", " << other.Name << " has " << axesOf(b)
            << "; all must have the same number of dimensions, along the same axes";
    throw Failure(message.str());
  }
  if (!first.Frame.HasDirectionOf(other.Frame))
  {
    message << first.Name << " and " << other.Name
            << " have different direction matrices; all must have the same one (Resample To Image "
               "makes it so)";
    throw Failure(message.str());
  }
  if (!first.Frame.HasInverse())
  {
    message << first.Name << " has a direction matrix without an inverse, and its geometry is not "
            << "that of " << other.Name << "; give axes of one point a direction of their own";
    throw Failure(message.str());
  }
  const double longest = std::max(longestOf(a), longestOf(b));
  for (std::size_t i = 0; i < 3; ++i)
  {
    const char axis = "xyz"[i];
    if (a[i].IsAxis && a[i].Spacing * b[i].Spacing < 0.0)
    {
      message << "Along " << axis << " the spacing of " << first.Name << " is " << a[i].Spacing
              << " and that of " << other.Name << " is " << b[i].Spacing
              << "; both must have the same sign";
      throw Failure(message.str());
    }
    if (!a[i].IsAxis && std::abs(a[i].Low - b[i].Low) > planeTolerance * longest)
    {
      message << first.Name << " lies at " << axis << " = " << a[i].Low << ", " << other.Name
              << " at " << axis << " = " << b[i].Low
              << "; images that are flat along an axis must lie in one plane";
      throw Failure(message.str());
    }
  }
}

bool isSame(const Sides& a, const Sides& b)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (a[i].IsAxis &&
      (a[i].Cells != b[i].Cells ||
        std::abs(a[i].Spacing - b[i].Spacing) > rounding * std::abs(a[i].Spacing) ||
        std::abs(a[i].Low - b[i].Low) > rounding * lengthOf(a[i])))
    {
      return false;
    }
  }
  return true;
}

// Along one axis: from the lowest to the highest end of all, at the finest spacing.
struct Union
{
  double Low;
  double Length;
  double Finest;
  double Cells; // rounded up; may be more than fits into an integer
  double Sign;
};

Union uniteSides(const std::vector<Sides>& all, std::size_t axis)
{
  const double sign = all.front()[axis].Spacing < 0.0 ? -1.0 : 1.0;
  double low = sign * all.front()[axis].Low;
  double high = low;
  double finest = std::abs(all.front()[axis].Spacing);
  for (const Sides& sides : all)
  {
    const ImageFrame::Side& side = sides[axis];
    low = std::min(low, sign * side.Low);
    high = std::max(high, sign * side.Low + lengthOf(side));
    finest = std::min(finest, std::abs(side.Spacing));
  }
  const double cells = std::max(1.0, std::ceil((high - low) / finest * (1.0 - rounding)));
  return { low, high - low, finest, cells, sign };
}

} // namespace

ImageFrame commonFrame(const std::vector<FramePart>& parts, const int dimensions[3])
{
  const FramePart& first = parts.front();
  std::vector<Sides> all{ sidesOf(first) };
  bool same = true;
  for (const FramePart& part : parts)
  {
    if (part.Frame == first.Frame && part.OnPoints == first.OnPoints)
    {
      continue;
    }
    requireAlike(first, part);
    all.push_back(sidesOf(part));
    same = same && isSame(all.front(), all.back());
  }
  if (same)
  {
    return first.Frame.WithValues(dimensions, first.OnPoints, property);
  }

  constexpr double most = 1 << 30; // cells an axis, as in the core
  Sides sides = all.front();
  std::array<Union, 3> unions;
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (!sides[i].IsAxis)
    {
      continue;
    }
    unions[i] = uniteSides(all, i);
    if (!(unions[i].Cells <= most) && dimensions[i] == 0)
    {
      std::ostringstream message;
      message << "The box of all inputs at the finest spacing has " << unions[i].Cells
              << " cells along "
              << "xyz"[i] << "; give " << property << " of at most 1073741824";
      throw Failure(message.str());
    }
    const double cells = std::min(unions[i].Cells, most);
    sides[i].Low = unions[i].Sign * unions[i].Low;
    sides[i].Cells = static_cast<int>(cells);
    sides[i].Spacing = unions[i].Sign * unions[i].Length / cells;
  }
  const ImageFrame exact =
    first.Frame.WithSides(sides, first.OnPoints).WithValues(dimensions, first.OnPoints, property);
  for (std::size_t i = 0; i < 3; ++i)
  {
    sides[i] = exact.GetSide(i, first.OnPoints);
    if (sides[i].IsAxis && dimensions[i] == 0)
    {
      sides[i].Spacing = unions[i].Sign * unions[i].Finest;
    }
    if (sides[i].IsAxis)
    {
      sides[i].Low = unions[i].Sign * unions[i].Low;
    }
  }
  return first.Frame.WithSides(sides, first.OnPoints);
}

} // namespace RectifiedTransport
