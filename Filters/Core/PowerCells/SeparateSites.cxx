// SPDX-License-Identifier: BSD-3-Clause
#include "Core/PowerCells/SeparateSites.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// A hash table of squares whose side is the distance: sites that are too near each other are in the
// same or in neighbouring squares.
class SiteSquares
{
public:
  SiteSquares(PointSpan<2> sites, double distance, const SiteBounds& bounds)
    : Sites(sites)
    , Distance(distance)
    , Bounds(bounds)
  {
    this->Squares.reserve(static_cast<std::size_t>(sites.size()));
    this->Next.assign(static_cast<std::size_t>(sites.size()), none);
  }

  void Place(std::int64_t site)
  {
    // The spiral is around the given place. Its state is kept with the square, so that many
    // coincident sites do not repeat its first places.
    const Point<2> given = { this->Sites[site][0], this->Sites[site][1] };
    Square& home = this->Squares[this->SquareOf(given)];
    Point<2> x = given;
    while (!this->IsFree(x))
    {
      // The k-th place on a Vogel spiral has the radius 2 distance sqrt(k) and the angle k times
      // the golden angle (these are its cosine and sine), so that places are evenly dense and about
      // as far apart as the distance.
      constexpr double cosine = -0.73736887807831990;
      constexpr double sine = 0.67549029426152362;
      home.Turn = { cosine * home.Turn[0] - sine * home.Turn[1],
        sine * home.Turn[0] + cosine * home.Turn[1] };
      const double radius = 2.0 * this->Distance * std::sqrt(static_cast<double>(++home.Tried));
      for (std::size_t a = 0; a < 2; ++a)
      {
        // In thin bounds the places are on a line, alternately on both sides.
        const bool isAlone = this->IsThin(1 - a);
        const double along = (home.Tried % 2 == 0 ? 0.5 : -0.5) * static_cast<double>(home.Tried);
        const double place =
          given[a] + (isAlone ? 2.0 * this->Distance * along : radius * home.Turn[a]);
        x[a] = std::clamp(place, this->Bounds.Low[a], this->Bounds.High[a]);
      }
    }
    this->Sites[site][0] = x[0];
    this->Sites[site][1] = x[1];
    // The site is listed in the square of its final place.
    std::int64_t& first = this->Squares[this->SquareOf(x)].First;
    this->Next[static_cast<std::size_t>(site)] = first;
    first = site;
  }

private:
  static constexpr std::int64_t none = -1;
  using Key = std::array<std::int64_t, 2>;
  struct Hash
  {
    std::size_t operator()(const Key& key) const
    {
      // Multiplication and shifts spread the bits of neighbouring squares over the table.
      const auto mix = [](std::uint64_t x) {
        x = (x ^ (x >> 31)) * 0x9e3779b97f4a7c15;
        return x ^ (x >> 29);
      };
      return static_cast<std::size_t>(
        mix(static_cast<std::uint64_t>(key[0]) + 3 * mix(static_cast<std::uint64_t>(key[1]))));
    }
  };
  struct Square
  {
    std::int64_t First = none;    // first of the sites that are placed here
    std::int64_t Tried = 0;       // places on the spiral that were tried
    Point<2> Turn = { 1.0, 0.0 }; // direction of the last of them
  };

  Key SquareOf(const Point<2>& x) const
  {
    // Squares of sites far away from small bounds would have numbers beyond 64 bits.
    static constexpr double most = 1e18;
    const auto along = [this](double place) {
      return static_cast<std::int64_t>(std::clamp(std::floor(place / this->Distance), -most, most));
    };
    return { along(x[0]), along(x[1]) };
  }

  bool IsThin(std::size_t axis) const
  {
    return this->Bounds.High[axis] - this->Bounds.Low[axis] < 4.0 * this->Distance;
  }

  // Tests the nine squares that may hold a site nearer than the distance.
  bool IsFree(const Point<2>& x) const
  {
    const Key square = this->SquareOf(x);
    for (std::int64_t i = 0; i < 9; ++i)
    {
      const auto found = this->Squares.find({ square[0] + i % 3 - 1, square[1] + i / 3 - 1 });
      std::int64_t site = found == this->Squares.end() ? none : found->second.First;
      for (; site != none; site = this->Next[static_cast<std::size_t>(site)])
      {
        const double* other = this->Sites[site];
        const double square2 =
          (x[0] - other[0]) * (x[0] - other[0]) + (x[1] - other[1]) * (x[1] - other[1]);
        if (square2 < this->Distance * this->Distance)
        {
          return false;
        }
      }
    }
    return true;
  }

  const PointSpan<2> Sites;
  const double Distance;
  const SiteBounds Bounds;
  std::unordered_map<Key, Square, Hash> Squares;
  std::vector<std::int64_t> Next; // the next site in the same square
};

} // namespace

void separateSites(
  PointSpan<2> sites, double distance, const SiteBounds& bounds, Progress& progress)
{
  SiteSquares squares(sites, distance, bounds);
  progress.ForEachInOrder(
    sites.size(), 1, [&squares](std::int64_t site) { squares.Place(site); }, 1 << 10);
}

} // namespace RectifiedTransport
