// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Splat/SplatOnRanks.h"

#include "Bridge/Points/PointMasses.h"
#include "Bridge/Ranks/DistributedPoints.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Splat/DistributedSplat.h"
#include "Bridge/Splat/MassSplat.h"
#include "Core/Parallel/RankOrder.h"
#include "Core/Parallel/RankShare.h"

#include "vtkDoubleArray.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// The tuples of an image, x fastest, that a rank sums up, and the layers of it that hold them.
struct TupleRange
{
  TupleBox Layers;
  std::int64_t First; // from the layers' first one on
  std::int64_t Count;
};

// Whole chunks, as even shares as may be.
TupleRange rangeOf(const TupleBox& whole, int ranks, int rank)
{
  std::size_t slowest = 2;
  while (slowest > 0 && whole.Cells[slowest] == 1)
  {
    --slowest;
  }
  const std::int64_t count = whole.Count();
  const std::int64_t layer = count / whole.Cells[slowest];
  const RankShare chunks((count + splatSumChunk - 1) / splatSumChunk, ranks, rank);
  const std::int64_t first = std::min(count, chunks.First * splatSumChunk);
  const std::int64_t last = std::min(count, (chunks.First + chunks.Count) * splatSumChunk);
  TupleRange range{ whole, first % layer, last - first };
  range.Layers.Low[slowest] += first / layer;
  range.Layers.Cells[slowest] = last > first ? (last - 1) / layer + 1 - first / layer : 0;
  return range;
}

double inOrder(
  const DistributedPoints& points, const double* masses, const Ranks& ranks, Progress& progress)
{
  if (onAllRanks(ranks, masses == nullptr))
  {
    return static_cast<double>(points.All());
  }
  const std::int64_t count = points.Counted().Count();
  const RankOrder order(count, points.Keys(), PointMasses::Chunk, ranks, progress);
  const std::vector<double> share =
    order.Bring([=](std::int64_t i) { return masses ? masses[i] : 1.0; });
  const double total = sumChunks(share.data(), order.Count(), PointMasses::Chunk, ranks);
  if (!std::isfinite(total))
  {
    std::ostringstream message;
    message << "The points' masses sum to " << total << "; the sum must be a double";
    throw Failure(message.str());
  }
  return total;
}

// Of the counted points, nullptr for 1 each.
class CountedMasses
{
public:
  CountedMasses(const DistributedPoints& points, const PointMasses& masses)
    : Values(masses.Values())
  {
    const CountedPoints& counted = points.Counted();
    if (this->Values && counted.Count() < points.Set()->GetNumberOfPoints())
    {
      for (std::int64_t i = 0; i < counted.Count(); ++i)
      {
        this->Copies.push_back(masses.Values()[counted.Point(i)]);
      }
      this->Values = this->Copies.data();
    }
  }
  const double* data() const { return this->Values; }

private:
  std::vector<double> Copies;
  const double* Values;
};

RankSplat splatHere(const RankSplatInput& input, Progress& progress, vtkDoubleArray* cells)
{
  constexpr double endOfSplat = 0.95;
  Progress work(progress.Stage());
  work.BeginStage(endOfSplat);
  const std::int64_t outside = splatPoints(input.Points.Set()->GetPoints()->GetData(),
    input.Masses.Values(), 1.0, input.Target, work, cells);
  work.BeginStage(1.0);
  return { outside,
    input.Target.Options.Boundary == SplatBoundary::Renormalize
      ? input.Masses.Total()
      : splatMassIn(cells, input.Target, work) };
}

} // namespace

RankSplat splatOnRanks(const RankSplatInput& input, const RankSplatBoxes& boxes, Progress& progress,
  vtkDoubleArray* cells)
{
  const Ranks& ranks = progress.Group();
  if (!ranks.AreSeveral())
  {
    return splatHere(input, progress, cells);
  }
  const CountedMasses masses(input.Points, input.Masses);
  const auto places = input.Points.TuplesOf(input.Points.Set()->GetPoints()->GetData());
  const auto splat = [&](const TupleBox& box, vtkDoubleArray* to) {
    return splatDistributed(
      places, masses.data(), 1.0, input.Points.Keys(), input.Target, box, progress, to);
  };
  if (input.Target.Options.Boundary == SplatBoundary::Renormalize)
  {
    const double total = inOrder(input.Points, masses.data(), ranks, progress);
    return { splat(boxes.Wanted, cells), total };
  }
  // What is dropped is known from the cells only: all of them, wanted or not.
  std::vector<TupleBox> held;
  for (int rank = 0; rank < ranks.Count(); ++rank)
  {
    held.push_back(rangeOf(boxes.Whole, ranks.Count(), rank).Layers);
  }
  const TupleRange own = rangeOf(boxes.Whole, ranks.Count(), ranks.Own());
  const auto values =
    newArray<vtkDoubleArray>("Density", 1, static_cast<vtkIdType>(own.Layers.Count()));
  const std::int64_t outside = splat(own.Layers, values);
  const double sum = sumChunks(values->GetPointer(0) + own.First, own.Count, splatSumChunk, ranks);
  exchangeBoxes(held, boxes.Wanted, ranks, values, cells);
  return { outside, input.Target.DivideByVolume ? sum * input.Target.Geometry.CellMeasure() : sum };
}

} // namespace RectifiedTransport
