// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/GrownDensity.h"

#include "Bridge/Density/InputDensity.h"
#include "Bridge/Run/Failure.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Geometry/LatticePart.h"

#include "vtkImageData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// The values of a box of the inner density, in the numbers of the grown grid.
template <int D>
class GrownValues final : public DensityValues
{
public:
  // `inner` has cells of `box`, by their numbers in it.
  GrownValues(std::shared_ptr<const DensityValues> inner, const LatticePart<D>& box,
    const GridSize<D>& grown, double empty)
    : Inner(std::move(inner))
    , Box(box)
    , Whole(LatticePart<D>::WholeOf(grown))
    , Empty(empty)
  {
  }

  void Read(std::int64_t first, std::int64_t count, double* values) const override
  {
    const std::int64_t end = first + count;
    while (first < end)
    {
      GridSize<D> cell = this->Whole.CellOf(first);
      const std::int64_t last = std::min(end, first + this->Whole.Cells[0] - cell[0]);
      const std::int64_t offset = cell[0] - first; // from numbers to the first axis
      std::int64_t low = std::clamp(this->Box.Low[0] - offset, first, last);
      std::int64_t high = std::clamp(this->Box.End(0) - offset, low, last);
      cell[0] = low + offset;
      if (low == high || !this->Box.Contains(cell))
      {
        low = high = last;
      }
      double* row = values - first;
      std::fill(row + first, row + low, this->Empty);
      if (low < high)
      {
        this->Inner->Read(this->Box.NumberOf(cell), high - low, row + low);
      }
      std::fill(row + high, row + last, this->Empty);
      values += last - first;
      first = last;
    }
  }

private:
  const std::shared_ptr<const DensityValues> Inner;
  const LatticePart<D> Box;
  const LatticePart<D> Whole;
  const double Empty;
};

class GrownDensity final : public InputDensity
{
public:
  GrownDensity(std::unique_ptr<InputDensity> inner, const ImageGrid& grid,
    const std::array<std::int64_t, 3>& margin, const EmptyRule& rule)
    : InputDensity(*inner, grid, margin, rule)
    , Inner(std::move(inner))
    , Margin(margin)
  {
    this->Inner->FindEmptyDensity();
  }

  std::string NameOfArray() const override { return this->Inner->NameOfArray(); }
  void Prepare(FlowTables tables, Progress& progress) override
  {
    this->Inner->Prepare(tables, progress);
    this->Known = this->Inner->Unusual();
    this->Empty = this->Inner->EmptyDensity();
    this->Made.reset();
    if (this->Inner->Values())
    {
      using Self = GrownDensity;
      (this
          ->*dispatchDimension(this->Geometry.Dimension(), &Self::Make<1>, &Self::Make<2>, &Self::Make<3>))();
    }
  }
  const DensityValues* Values() const override { return this->Made.get(); }
  void ReleaseGathered() override
  {
    this->Inner->ReleaseGathered();
    if (!this->Inner->Values())
    {
      this->Made.reset();
    }
  }

  const ImagePieces* Pieces() const override { return this->Inner->Pieces(); }
  vtkSmartPointer<vtkImageData> ImageIn(const Extent& extent) const override
  {
    return this->Inner->ImageIn(intersectionOf(extent, this->Inner->Grid().Extent()));
  }
  void SampleArrays(const Extent& extent, ConstPointSpan<3> particles, Progress& progress,
    vtkPointData* output) const override
  {
    this->Inner->SampleArrays(extent, particles, progress, output);
  }

  void TellUnusual(const UnusualValues& values, Progress& progress) override
  {
    UnusualValues inner = values;
    inner.Found.FirstMaximum = this->IndexInInner(values.Found.FirstMaximum);
    this->Inner->TellUnusual(inner, progress);
  }
  const InputDensity& SourceOf(DensitySummary& summary) const override
  {
    summary.FirstNotFinite = this->IndexInInner(summary.FirstNotFinite);
    summary.FirstNegative = this->IndexInInner(summary.FirstNegative);
    return this->Inner->SourceOf(summary);
  }

private:
  template <int D>
  class Boxes final : public DistributedDensity<D>
  {
  public:
    explicit Boxes(const GrownDensity& density)
      : Density(density)
    {
    }
    std::shared_ptr<const DensityValues> Gather(
      const GridSize<D>& low, const GridSize<D>& high) const override
    {
      const LatticePart<D> inner = this->Density.template Box<D>();
      LatticePart<D> wanted{ low, high };
      for (int a = 0; a < D; ++a)
      {
        wanted.Cells[a] = high[a] - low[a];
      }
      const LatticePart<D> common = inner.And(wanted);
      GridSize<D> first{};
      GridSize<D> end{};
      for (int a = 0; a < D && !common.IsEmpty(); ++a)
      {
        first[a] = common.Low[a] - inner.Low[a];
        end[a] = common.End(a) - inner.Low[a];
      }
      return std::make_shared<GrownValues<D>>(
        this->Density.Inner->template Source<D>().Part(first, end), inner,
        this->Density.Grid().template Size<D>(), this->Density.Empty);
    }

  private:
    const GrownDensity& Density;
  };

  std::uint64_t Fingerprint(Progress& progress) const override
  {
    return this->Inner->GetContent(progress)[0];
  }
  AnyDistributed Distributed() const override
  {
    return { &this->Line, &this->Plane, &this->Space };
  }

  template <int D>
  void Make()
  {
    this->Made = std::make_unique<GrownValues<D>>(
      std::shared_ptr<const DensityValues>(std::shared_ptr<void>(), this->Inner->Values()),
      this->Box<D>(), this->Geometry.Size<D>(), this->Empty);
  }

  // The cells of the inner density.
  template <int D>
  LatticePart<D> Box() const
  {
    LatticePart<D> box{ {}, this->Inner->Grid().Size<D>() };
    std::copy_n(this->Margin.begin(), D, box.Low.begin());
    return box;
  }

  // Of a cell that is not of the inner density: -1.
  template <int D>
  std::int64_t NumberInInner(std::int64_t index) const
  {
    const GridSize<D> cell = LatticePart<D>::WholeOf(this->Geometry.Size<D>()).CellOf(index);
    return this->Box<D>().Contains(cell) ? this->Box<D>().NumberOf(cell) : -1;
  }
  std::int64_t IndexInInner(std::int64_t index) const
  {
    using Self = GrownDensity;
    const auto number = dispatchDimension(this->Geometry.Dimension(), &Self::NumberInInner<1>,
      &Self::NumberInInner<2>, &Self::NumberInInner<3>);
    return index < 0 ? index : (this->*number)(index);
  }

  const std::unique_ptr<InputDensity> Inner;
  const std::array<std::int64_t, 3> Margin; // in cells, along the axes of index space
  std::unique_ptr<DensityValues> Made;
  const Boxes<1> Line{ *this };
  const Boxes<2> Plane{ *this };
  const Boxes<3> Space{ *this };
};

template <int D>
std::array<std::int64_t, 3> marginOf(const ImageGrid& grid, double margin)
{
  constexpr double rounding = 1e-9; // of a cell
  const Point<D> lengths = grid.Lengths<D>();
  const double longest = *std::max_element(lengths.begin(), lengths.end());
  std::array<std::int64_t, 3> cells{ 0, 0, 0 };
  for (int a = 0; a < D; ++a)
  {
    const auto size = static_cast<double>(grid.Size<D>()[a]);
    const double around = std::ceil(margin * (longest / lengths[a]) * size - rounding);
    if (!(size + 2.0 * around <= MaximumResolution))
    {
      throw Failure("Margin is " + textOf(margin) + "; it makes more than " +
        std::to_string(MaximumResolution) + " cells along an axis");
    }
    cells[static_cast<std::size_t>(a)] = static_cast<std::int64_t>(around);
  }
  return cells;
}

} // namespace

std::unique_ptr<InputDensity> withMargin(
  std::unique_ptr<InputDensity> density, double margin, const EmptyRule& rule)
{
  if (!density || margin == 0.0)
  {
    return density;
  }
  const ImageGrid& grid = density->Grid();
  const std::array<std::int64_t, 3> cells =
    dispatchDimension(grid.Dimension(), marginOf<1>, marginOf<2>, marginOf<3>)(grid, margin);
  return std::make_unique<GrownDensity>(std::move(density), grid.Grown(cells), cells, rule);
}

} // namespace RectifiedTransport::Bridge
