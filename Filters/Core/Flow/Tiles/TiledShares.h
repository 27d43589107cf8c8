// SPDX-License-Identifier: BSD-3-Clause
// Boxes that hold given shares of a large density's mass: narrow ones by the tables of tiles, whose
// halo holds every box that is too narrow for the graded tables (GradedTables.h).
#ifndef RectifiedTransport_TiledShares_h
#define RectifiedTransport_TiledShares_h

#include "Core/Flow/Tiles/GridTiles.h"
#include "Core/Flow/Tiles/TileBins.h"
#include "Core/Flow/Tiles/TilePlan.h"
#include "Core/Flow/Tiles/TileRounds.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Tables/BoxShare.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace RectifiedTransport
{

// For boxes whose sides are in proportion to `aspect`: a box of half sides r * aspect about a
// centre. Those with gradedRatio strides along every axis are wide enough for the graded tables;
// all others must lie in the tile of their centre and its halo.
template <int Dimension>
GridTiles<Dimension> tilesForShares(
  const GridSize<Dimension>& size, const Point<Dimension>& aspect, const TileLimits& limits)
{
  const GridSize<Dimension> strides = gradedStrides<Dimension>(size, limits);
  double half = 0.0; // half sides of the boxes that are wide enough, over the aspect
  for (int axis = 0; axis < Dimension; ++axis)
  {
    if (strides[axis] > 1)
    {
      const double width = gradedRatio * static_cast<double>(strides[axis]);
      half = std::max(half, 0.5 * width / aspect[axis]);
    }
  }
  GridSize<Dimension> halo;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // Not a number where the aspect is infinite: an axis of no length beside the others.
    const double reached = std::ceil(half * aspect[axis]) + 1.0;
    const bool endsBefore = reached < static_cast<double>(size[axis]);
    halo[axis] = endsBefore ? static_cast<std::int64_t>(reached) : size[axis];
  }
  return { size, halo, limits };
}

// Finds, for each centre and share, the measure of the box about the centre that holds the share
// (BoxShare.h): by the graded tables where it is wide, else by those of the tile.
template <int Dimension>
class TiledShares
{
public:
  TiledShares(const DensitySource<Dimension>& density, const GradedTables<Dimension>& graded,
    const GridTiles<Dimension>& tiles, const Point<Dimension>& aspect, Progress& progress)
    : Graded(graded.View())
    , Tiles(tiles)
    , Aspect(aspect)
    , Work(progress)
    , Rounds(density, graded, tiles, progress.Group())
  {
  }

  // Boxes are sorted by tiles, and each tile's tables are made once for all of its boxes.
  void Run(ConstPointSpan<Dimension> centres, const double* shares, double* measures)
  {
    Stages stages(this->Work, { { "sort", 5 }, { "boxes", 95 } });
    const TileBins<std::int64_t> items = this->FindTiles(centres, shares, measures, stages["sort"]);
    this->Rounds.Run(items, Solution{ *this, items, centres, shares, measures }, stages["boxes"]);
    this->Work.EndSlice(1);
  }

  // The most bytes that it takes besides the graded tables and its arguments.
  static double MemoryFor(const GridTiles<Dimension>& tiles, double boxes)
  {
    constexpr double numbers = 2.0 * sizeof(std::int64_t);
    return TileTables<Dimension>::MemoryFor(tiles.MostCells()) + numbers * boxes;
  }

private:
  static constexpr std::int64_t grain = 256;        // boxes a range
  static constexpr std::int64_t units = 16 * grain; // boxes in the first slice

  // What TileRounds does with the tables of a tile.
  struct Solution
  {
    static constexpr double Cell = 0.0025;               // measured, in the time of a box
    static constexpr std::size_t Values = Dimension + 1; // centre and share

    void Run(std::int64_t first, std::int64_t last, Progress& progress)
    {
      progress.For(
        last - first, grain,
        [&](std::int64_t b, std::int64_t e) {
          for (std::int64_t item = first + b; item < first + e; ++item)
          {
            const std::int64_t i = this->Items[item];
            this->Measures[i] = this->Parent.MeasureOf(this->Centres[i], this->Shares[i]);
          }
        },
        units);
    }
    int ValuesEach() const { return Values; }
    template <class GiveOne>
    void Give(std::int64_t item, const GiveOne& give) const
    {
      // A box is its own number: index and particle are the same.
      double values[Values];
      std::copy_n(this->Centres[item], Dimension, values);
      values[Dimension] = this->Shares[item];
      give(values, item, item);
    }
    // Boxes of other ranks with a centre in this tile, as Dimension + 1 doubles each; returns a
    // measure for each.
    Bytes Process(Bytes visitors, Progress& progress)
    {
      const std::vector<double> values = fromBytes<double>(visitors);
      std::vector<double> found(values.size() / Values);
      progress.ForEach(
        static_cast<std::int64_t>(found.size()), grain,
        [&](std::int64_t i) {
          const double* box = values.data() + static_cast<std::size_t>(i) * Values;
          found[static_cast<std::size_t>(i)] = this->Parent.MeasureOf(box, box[Dimension]);
        },
        units);
      return toBytes(found);
    }
    // Writes what another rank found.
    void Take(const char* reply, std::int64_t index, std::int64_t)
    {
      std::memcpy(this->Measures + index, reply, sizeof(double));
    }

    TiledShares& Parent;
    const TileBins<std::int64_t>& Items;
    const ConstPointSpan<Dimension> Centres;
    const double* const Shares;
    double* const Measures;
  };

  static Point<Dimension> toPoint(const double* coordinates)
  {
    Point<Dimension> point;
    std::copy_n(coordinates, Dimension, point.begin());
    return point;
  }

  // The measure by the tile's tables, or by the graded ones if the box is wide.
  double MeasureOf(const double* centre, double share) const
  {
    return measureOfShare<Dimension>(
      this->Graded, this->Rounds.Tables(), toPoint(centre), this->Aspect, share);
  }

  // The boxes by the tile of their centre. Those without a share need no tables. Each range fills a
  // list of its own: the order does not depend on threads.
  TileBins<std::int64_t> FindTiles(
    ConstPointSpan<Dimension> centres, const double* shares, double* measures, Progress& progress)
  {
    const std::int64_t count = centres.size();
    constexpr std::int64_t range = std::int64_t{ 1 } << 14;
    std::vector<std::vector<std::int64_t>> found(
      static_cast<std::size_t>((count + range - 1) / range));
    progress.ForEach(count, range, [&](std::int64_t i) {
      std::vector<std::int64_t>& those = found[static_cast<std::size_t>(i / range)];
      if (i % range == 0)
      {
        those.reserve(static_cast<std::size_t>(std::min(range, count - i)));
      }
      if (shares[i] > 0.0)
      {
        those.push_back(i);
      }
      else
      {
        measures[i] = 0.0;
      }
    });
    return { found, this->Tiles.Count(),
      [&](std::int64_t i) { return this->Tiles.TileOf(toPoint(centres[i])); } };
  }

  const TableView<Dimension>& Graded;
  const GridTiles<Dimension>& Tiles;
  const Point<Dimension>& Aspect;
  Progress& Work;
  TileRounds<Dimension> Rounds;
};

} // namespace RectifiedTransport

#endif
