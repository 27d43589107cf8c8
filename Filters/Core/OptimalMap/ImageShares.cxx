// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/ImageShares.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Samples a cell's side relative to its image's extent. Images of parts of cells need not lie
// close: what a cell between them lacks comes from its neighbours.
constexpr double fineness = 0.5;
constexpr double finenessOfLight = 0.25;

// The cells whose centres surround an image, bit a of their number for the higher one along axis a.
template <int Dimension>
struct CellsAbout
{
  static constexpr int Count = 1 << Dimension;

  std::int64_t Cell[Count] = { 0 };
  double Mass[Count];
  double Square[Count] = { 0.0 }; // squared ways from the source cell, in squared diagonals
  double Offsets[Dimension][2];   // to the lower and higher cells, in parts of the whole grid
  double Spread = 0.0; // the mean square of the ways from the image itself, in squared diagonals
};

// Deposits the parts of the source's cells in the target's. Each is the number of sums a cell: the
// mass alone, or the mass and its first moments of the ways, which ResidualCoupling needs to update
// costs.
template <int Dimension, int Each>
class Sharing
{
public:
  Sharing(const CellDensity<Dimension>& source, const CellDensity<Dimension>& target,
    const NodeGrid<Dimension>& grid, Progress& progress)
    : Source(source)
    , Target(target)
    , Work(progress)
  {
    this->Shares.Size = target.Size();
    this->Shares.Sides = grid.Spacing;
    this->Shares.Each = Each;
    this->Shares.SquaredDiagonal = grid.SquaredDiagonal();
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const auto cells = static_cast<double>(this->Shares.Size[axis]);
      const double length = this->Shares.Sides[axis] * cells;
      // |c_i - c_j|^2 = sum_a PartOfSquare[a] way_a^2 in squared diagonals, for ways in parts of
      // the grid.
      this->PartOfSquare[axis] = length * length / this->Shares.SquaredDiagonal;
      this->Last[axis] = cells - 1.0;
      this->Part[axis] = 1.0 / cells;
      this->SquareOfCell[axis] = this->PartOfSquare[axis] * this->Part[axis] * this->Part[axis];
    }
  }

  // Fixed-point sums (IntegerSums.h) commute, so the bits do not depend on threads.
  CellShares<Dimension> Share(const NodeMap<Dimension>& corners)
  {
    const std::int64_t rows = ImageSamples<Dimension>::NumberOfRows(corners.Grid);
    const std::int64_t each = std::max<std::int64_t>(1, 8192 / this->Shares.Size[0]);
    std::atomic<std::int64_t> cost{ 0 };
    std::atomic<std::int64_t> spread{ 0 };
    const std::int64_t count = this->Target.NumberOfCells();
    IntegerSums integers(count * Each, 4 * count, this->Work);
    this->Work.For(
      rows, each,
      // Samples of a row of source cells, and where each one's image goes.
      [&](std::int64_t first, std::int64_t last) {
        const IntegerSums::Part part(integers);
        const double meanMass = 1.0 / static_cast<double>(count);
        ImageSamples<Dimension> samples(corners, { fineness, finenessOfLight, meanMass });
        // Without an array each sample's mass is a part of 1, to be scaled by the uniform share.
        const double scale = integerUnit * (this->Source.IsUniform() ? this->Source.Share(0) : 1.0);
        CostOfImage own;
        for (std::int64_t row = first; row < last; ++row)
        {
          const std::int64_t begin = row * this->Shares.Size[0];
          GridSize<Dimension> place = this->Shares.PlaceOf(begin);
          samples.ForRow(row, this->Source.data(),
            [&](const CellSample<Dimension>& sample, const Point<Dimension>& image) {
              place[0] = sample.Cell - begin;
              this->ShareImage(place, sample.Mass * scale, image, part.Values(), own);
            });
        }
        // Costs are integers, too: their sum does not depend on the order of the threads.
        cost.fetch_add(own.All, std::memory_order_relaxed);
        spread.fetch_add(own.OfSpread, std::memory_order_relaxed);
      },
      each);
    this->Shares.Cost = cost;
    this->Shares.CostOfSpread = spread;
    this->Shares.Sums = integers.Release(this->Work);
    return std::move(this->Shares);
  }

private:
  // Costs of a chunk's images, in squared diagonals over integerUnit.
  struct CostOfImage
  {
    std::int64_t All = 0;
    std::int64_t OfSpread = 0;
  };

  // Adds an image's mass to the cells about it, with the cost of the ways from its source cell.
  void ShareImage(const GridSize<Dimension>& from, double mass, const Point<Dimension>& image,
    std::int64_t* out, CostOfImage& costs) const
  {
    CellsAbout<Dimension> about = this->FindCells(from, mass, image);
    if (this->Target.HasVoids())
    {
      this->KeepFromVoids(mass, about);
    }
    double cost = 0.0;
    for (int c = 0; c < about.Count; ++c)
    {
      std::int64_t* got = out + about.Cell[c] * Each;
      got[0] += toInteger(about.Mass[c]);
      if constexpr (Each > 1)
      {
        for (int axis = 0; axis < Dimension; ++axis)
        {
          got[1 + axis] += toInteger(about.Mass[c] * about.Offsets[axis][(c >> axis) & 1]);
        }
        cost += about.Mass[c] * about.Square[c];
      }
    }
    if constexpr (Each > 1)
    {
      // What the masses lost by rounding may cost, too.
      costs.All += cost > 0.0 ? static_cast<std::int64_t>(cost) + 1 + about.Count : 0;
      costs.OfSpread += static_cast<std::int64_t>(mass * about.Spread);
    }
  }

  // The cells about an image and the mass that each gets by multilinear weights, as on nodes at the
  // centres of cells. These keep the centroid.
  CellsAbout<Dimension> FindCells(
    const GridSize<Dimension>& from, double mass, const Point<Dimension>& image) const
  {
    CellsAbout<Dimension> about;
    about.Mass[0] = mass;
    std::int64_t stride = 1;
    int count = 1;
    // Beyond the outermost centres all mass goes to the outermost cells.
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double at = std::clamp(image[axis] - 0.5, 0.0, this->Last[axis]);
      const auto low = static_cast<std::int64_t>(at);
      const double high = at - static_cast<double>(low);
      // At the last cell the higher one is the cell itself, with weight 0.
      const std::int64_t step = low + 1 < this->Shares.Size[axis] ? stride : 0;
      double squares[2];
      for (int i = 0; i < 2; ++i)
      {
        const double offset = static_cast<double>(low + i - from[axis]) * this->Part[axis];
        about.Offsets[axis][i] = offset;
        squares[i] = this->PartOfSquare[axis] * (offset * offset);
      }
      // Splitting a mass between two centres at distances h and 1 - h costs h (1 - h) squared
      // cells.
      about.Spread += this->SquareOfCell[axis] * high * (1.0 - high);
      for (int c = 0; c < count; ++c)
      {
        about.Cell[c] += low * stride;
        about.Cell[count + c] = about.Cell[c] + step;
        about.Mass[count + c] = about.Mass[c] * high;
        about.Mass[c] *= 1.0 - high;
        about.Square[count + c] = about.Square[c] + squares[1];
        about.Square[c] += squares[0];
      }
      count *= 2;
      stride *= this->Shares.Size[axis];
    }
    return about;
  }

  // Only cells with mass may get some, in the same proportions. If none has any, one of them gets
  // all, and ResidualCoupling moves it on.
  void KeepFromVoids(double mass, CellsAbout<Dimension>& about) const
  {
    bool isChanged = false;
    double sum = 0.0;
    for (int c = 0; c < about.Count; ++c)
    {
      if (!(this->Target.Share(about.Cell[c]) > 0.0))
      {
        about.Mass[c] = 0.0;
        isChanged = true;
      }
      sum += about.Mass[c];
    }
    // The weights no longer keep the centroid, so the estimate of the spread does not hold.
    about.Spread = isChanged ? 0.0 : about.Spread;
    if (isChanged && sum > 0.0)
    {
      std::for_each(
        about.Mass, about.Mass + about.Count, [=](double& part) { part *= mass / sum; });
    }
    else if (isChanged)
    {
      about.Mass[0] = mass;
    }
  }

  const CellDensity<Dimension>& Source;
  const CellDensity<Dimension>& Target;
  Progress& Work;
  CellShares<Dimension> Shares;
  Point<Dimension> Last{};         // the greatest place of a cell along each axis
  Point<Dimension> Part{};         // a cell's side, as a part of the whole grid's
  Point<Dimension> SquareOfCell{}; // a cell's squared side, in squared diagonals
  Point<Dimension> PartOfSquare{}; // the box's squared side, in squared diagonals
};

} // namespace

template <int Dimension>
CellShares<Dimension> shareImages(const CellDensity<Dimension>& source,
  const CellDensity<Dimension>& target, const NodeMap<Dimension>& corners, bool withCosts,
  Progress& progress)
{
  return withCosts
    ? Sharing<Dimension, 1 + Dimension>(source, target, corners.Grid, progress).Share(corners)
    : Sharing<Dimension, 1>(source, target, corners.Grid, progress).Share(corners);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(shareImages);

} // namespace RectifiedTransport
