// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/MovedClouds.h"

#include "Bridge/Run/Memory.h"
#include "Bridge/Temporal/CloudRows.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkDataObject.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

// Of a cell's length, if its places are the centres of a finer grid.
template <int D>
double partOfCell(const PivotLattice<D>& lattice)
{
  return std::pow(static_cast<double>(lattice.Places.size()), -1.0 / D);
}

// Those of all ranks, in their order.
template <class T>
std::vector<T> ofAllRanks(const Ranks& ranks, const T* own, std::int64_t count)
{
  if (!ranks.AreSeveral())
  {
    return std::vector<T>(own, own + count);
  }
  std::vector<std::int64_t> starts = { 0 };
  for (const std::int64_t part : gatherValues(ranks, count))
  {
    starts.push_back(starts.back() + part);
  }
  std::vector<T> all(static_cast<std::size_t>(starts.back()));
  std::copy_n(own, count, all.data() + starts[static_cast<std::size_t>(ranks.Own())]);
  gatherParts(ranks, starts, all.data());
  return all;
}

double stretch(double before, double after, bool hasBefore, bool hasAfter)
{
  if (hasBefore && hasAfter)
  {
    const double less = std::min(before, after);
    const double more = std::max(before, after);
    return more < 2.0 * less ? 0.5 * (less + more) : less;
  }
  return hasBefore ? before : hasAfter ? after : 1.0;
}

using Counters = std::unique_ptr<std::atomic<std::int64_t>[]>;

// A plain addition on one thread, which takes a fifth of the time.
inline void add(std::atomic<std::int64_t>& to, double value, bool isAlone)
{
  const auto units = static_cast<std::int64_t>(value + 0.5);
  if (isAlone)
  {
    to.store(to.load(std::memory_order_relaxed) + units, std::memory_order_relaxed);
    return;
  }
  to.fetch_add(units, std::memory_order_relaxed);
}

template <int D>
void addCloud(const CloudRow (&rows)[D], const GridSize<D>& size, double mass, bool isAlone,
  std::atomic<std::int64_t>* cells)
{
  if constexpr (D == 1)
  {
    for (int i = 0; i < rows[0].Count; ++i)
    {
      add(cells[rows[0].First + i], mass * rows[0].Parts[i], isAlone);
    }
  }
  else
  {
    const int planes = D == 3 ? rows[D - 1].Count : 1;
    for (int k = 0; k < planes; ++k)
    {
      const std::int64_t plane = D == 3 ? (rows[D - 1].First + k) * size[1] : 0;
      const double ofPlane = D == 3 ? mass * rows[D - 1].Parts[k] : mass;
      for (int j = 0; j < rows[1].Count; ++j)
      {
        const std::int64_t start = (plane + rows[1].First + j) * size[0] + rows[0].First;
        const double ofRow = ofPlane * rows[1].Parts[j];
        for (int i = 0; i < rows[0].Count; ++i)
        {
          add(cells[start + i], ofRow * rows[0].Parts[i], isAlone);
        }
      }
    }
  }
}

template <int D>
void deposit(const MovedClouds& clouds, const ImageGrid& geometry, int exponent, Progress& progress,
  std::atomic<std::int64_t>* cells)
{
  // In two steps, neither of which overflows.
  const double scales[2] = { std::ldexp(1.0, exponent / 2),
    std::ldexp(1.0, exponent - exponent / 2) };
  const GridSize<D> size = geometry.Size<D>();
  const CloudPlaces<D> places(clouds, geometry);
  const bool isAlone = progress.Threads().Concurrency() == 1;
  progress.For(
    clouds.Points->GetNumberOfTuples(), grain, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        double index[D];
        places.Centre(i, index);
        CloudRow rows[D];
        for (int axis = 0; axis < D; ++axis)
        {
          rows[axis] = cloudRow(index[axis], places.Length(i, axis), size[axis]);
        }
        addCloud<D>(rows, size, clouds.Masses[i] * scales[0] * scales[1], isAlone, cells);
      }
    });
}

// Adds what the other ranks have of the tuples that this one wants.
std::vector<std::int64_t> sumOfRanks(const std::atomic<std::int64_t>* cells, const TupleBox& all,
  const TupleBox& wanted, const Ranks& ranks)
{
  const auto part = [&](const TupleBox& box) {
    std::vector<std::int64_t> values(static_cast<std::size_t>(box.Count()));
    for (std::int64_t i = 0; i < box.Count(); ++i)
    {
      values[static_cast<std::size_t>(i)] =
        cells[all.NumberOf(box.CellOf(i))].load(std::memory_order_relaxed);
    }
    return values;
  };
  if (!ranks.AreSeveral())
  {
    return part(wanted);
  }
  std::vector<std::vector<std::int64_t>> parts;
  for (const TupleBox& box : gatherValues(ranks, wanted))
  {
    parts.push_back(part(box));
  }
  std::vector<std::int64_t> sum(static_cast<std::size_t>(wanted.Count()), 0);
  for (const std::vector<std::int64_t>& values : exchangeValues(ranks, std::move(parts)))
  {
    std::transform(values.begin(), values.end(), sum.begin(), sum.begin(), std::plus<>());
  }
  return sum;
}

} // namespace

template <int D>
std::vector<float> cloudsInCells(const PivotLattice<D>& lattice, std::int64_t count)
{
  return std::vector<float>(
    static_cast<std::size_t>(D * count), static_cast<float>(partOfCell<D>(lattice)));
}

template <int D>
std::vector<float> cloudsAtImages(const PivotLattice<D>& lattice, const ImageGrid& here,
  const ImageGrid& there, const std::vector<std::int64_t>& numbers, ConstPointSpan<D> images,
  Progress& progress)
{
  const Ranks& ranks = progress.Group();
  const std::vector<std::int64_t> allNumbers =
    ofAllRanks(ranks, numbers.data(), static_cast<std::int64_t>(numbers.size()));
  const std::vector<double> all = ofAllRanks(ranks, images.data(), D * images.size());
  const std::int64_t places = lattice.NumberOfParticles();
  constexpr std::int64_t none = -1;
  std::vector<std::int64_t> where(static_cast<std::size_t>(places), none);
  for (std::size_t i = 0; i < allNumbers.size(); ++i)
  {
    where[static_cast<std::size_t>(allNumbers[i])] = static_cast<std::int64_t>(i);
  }
  const GridSize<D>& size = lattice.Lattice;
  const Point<D> unit = lengthsInCells<D>(there, here);
  const double part = partOfCell<D>(lattice);
  std::vector<float> sizes(static_cast<std::size_t>(D * images.size()));
  progress.For(images.size(), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      const std::int64_t number = numbers[static_cast<std::size_t>(i)];
      std::int64_t rest = number % static_cast<std::int64_t>(numberOfCells<D>(size));
      std::int64_t step = 1;
      for (int axis = 0; axis < D; ++axis)
      {
        const std::int64_t at = rest % size[axis];
        const auto distance = [&](std::int64_t neighbour) {
          return std::abs(all[static_cast<std::size_t>(D * neighbour + axis)] - images[i][axis]) *
            unit[axis];
        };
        const std::int64_t before = at > 0 ? where[static_cast<std::size_t>(number - step)] : none;
        const std::int64_t after =
          at + 1 < size[axis] ? where[static_cast<std::size_t>(number + step)] : none;
        const double factor = stretch(before == none ? 0.0 : distance(before),
          after == none ? 0.0 : distance(after), before != none, after != none);
        sizes[static_cast<std::size_t>(D * i + axis)] = static_cast<float>(factor * part);
        rest /= size[axis];
        step *= size[axis];
      }
    }
  });
  return sizes;
}

void splatClouds(const MovedClouds& clouds, const ImageGrid& geometry, double most,
  const TupleBox& wanted, Progress& progress, vtkDoubleArray* density)
{
  // Sums of at most twice `most`, with rounding, stay below 2^62.
  const int exponent = most > 0.0 ? 60 - std::ilogb(most) : 0;
  const std::int64_t cells = geometry.NumberOfCells();
  const int owner = geometry.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
  const TupleBox all = tuplesOf(geometry.Extent(), owner, geometry.Extent());
  withMemory("the sums of the cells", 16.0 * static_cast<double>(cells), [&]() {
    const Counters counters(new std::atomic<std::int64_t>[static_cast<std::size_t>(cells)]());
    dispatchDimension(geometry.Dimension(), deposit<1>, deposit<2>, deposit<3>)(
      clouds, geometry, exponent, progress, counters.get());
    const std::vector<std::int64_t> sums =
      sumOfRanks(counters.get(), all, wanted, progress.Group());
    double* to = density->GetPointer(0);
    const double measure = geometry.CellMeasure();
    std::transform(sums.begin(), sums.end(), to,
      [=](std::int64_t sum) { return std::ldexp(static_cast<double>(sum), -exponent) / measure; });
  });
}

template std::vector<float> cloudsInCells<1>(const PivotLattice<1>&, std::int64_t);
template std::vector<float> cloudsInCells<2>(const PivotLattice<2>&, std::int64_t);
template std::vector<float> cloudsInCells<3>(const PivotLattice<3>&, std::int64_t);
template std::vector<float> cloudsAtImages<1>(const PivotLattice<1>&, const ImageGrid&,
  const ImageGrid&, const std::vector<std::int64_t>&, ConstPointSpan<1>, Progress&);
template std::vector<float> cloudsAtImages<2>(const PivotLattice<2>&, const ImageGrid&,
  const ImageGrid&, const std::vector<std::int64_t>&, ConstPointSpan<2>, Progress&);
template std::vector<float> cloudsAtImages<3>(const PivotLattice<3>&, const ImageGrid&,
  const ImageGrid&, const std::vector<std::int64_t>&, ConstPointSpan<3>, Progress&);

} // namespace RectifiedTransport::Bridge
