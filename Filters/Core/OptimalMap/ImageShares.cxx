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

// Images of parts of cells need not lie close: what a cell between them gets too little comes from
// its neighbours.
constexpr double fineness = 0.5;
constexpr double finenessOfLight = 0.25;

// The cells about an image.
template <int Dimension>
struct CellsAbout
{
  static constexpr int Count = 1 << Dimension;

  std::int64_t Cell[Count] = { 0 };
  double Mass[Count];
  double Square[Count] = { 0.0 }; // of the way there, in squared diagonals
  double Ways[Dimension][2];      // to lower and higher cells, in parts of the whole grid
  double Spread = 0.0;            // the mean square of the ways from the image itself
};

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
      this->PartOfSquare[axis] = length * length / this->Shares.SquaredDiagonal;
      this->Last[axis] = cells - 1.0;
      this->Part[axis] = 1.0 / cells;
      this->SquareOfCell[axis] = this->PartOfSquare[axis] * this->Part[axis] * this->Part[axis];
    }
  }

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
      [&](std::int64_t first, std::int64_t last) {
        const IntegerSums::Part part(integers);
        const double meanMass = 1.0 / static_cast<double>(count);
        ImageSamples<Dimension> samples(corners, { fineness, finenessOfLight, meanMass });
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
  struct CostOfImage
  {
    std::int64_t All = 0;
    std::int64_t OfSpread = 0;
  };

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
          got[1 + axis] += toInteger(about.Mass[c] * about.Ways[axis][(c >> axis) & 1]);
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

  // With a mass shared among them by hats.
  CellsAbout<Dimension> FindCells(
    const GridSize<Dimension>& from, double mass, const Point<Dimension>& image) const
  {
    CellsAbout<Dimension> about;
    about.Mass[0] = mass;
    std::int64_t stride = 1;
    int count = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double at = std::clamp(image[axis] - 0.5, 0.0, this->Last[axis]);
      const auto low = static_cast<std::int64_t>(at);
      const double high = at - static_cast<double>(low);
      const std::int64_t step = low + 1 < this->Shares.Size[axis] ? stride : 0;
      double squares[2];
      for (int i = 0; i < 2; ++i)
      {
        const double way = static_cast<double>(low + i - from[axis]) * this->Part[axis];
        about.Ways[axis][i] = way;
        squares[i] = this->PartOfSquare[axis] * (way * way);
      }
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

  // Only cells with mass get some; if none has any, one of them gets all, from where it goes on.
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
  Point<Dimension> Last{};         // cell
  Point<Dimension> Part{};         // of the whole grid that a cell is
  Point<Dimension> SquareOfCell{}; // its side, in squared diagonals
  Point<Dimension> PartOfSquare{}; // of the box's squared diagonal that its squared side is
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

template decltype(shareImages<1>) shareImages<1>;
template decltype(shareImages<2>) shareImages<2>;
template decltype(shareImages<3>) shareImages<3>;

} // namespace RectifiedTransport
