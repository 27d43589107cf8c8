// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Quality/ParticleQuality.h"

#include "Bridge/Density/DensityImage.h"
#include "Bridge/Density/FlowCache.h"
#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Points/PointInput.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/Progress.h"
#include "Core/Quality/NearestNeighbours.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
constexpr double farOutside = 1e150; // sizes of the domain; the square is a number

// A numeric array of the particles, nullptr if there is none of that name.
vtkDataArray* findArray(vtkPointSet* particles, const char* name, int components)
{
  vtkAbstractArray* found = particles->GetPointData()->GetAbstractArray(name);
  auto* array = vtkDataArray::SafeDownCast(found);
  if (found && (!array || array->GetNumberOfComponents() != components))
  {
    const int count = array ? array->GetNumberOfComponents() : 0;
    std::ostringstream message;
    message << "The array '" << name << "' of the particles ";
    if (array)
    {
      message << "has " << count << (count == 1 ? " component" : " components");
    }
    else
    {
      message << "is not numeric";
    }
    message << "; it must be numeric and have " << components;
    throw Failure(message.str());
  }
  if (array && array->GetNumberOfTuples() != particles->GetNumberOfPoints())
  {
    std::ostringstream message;
    message << "The array '" << name << "' of the particles has " << array->GetNumberOfTuples()
            << " tuples, but there are " << particles->GetNumberOfPoints()
            << " particles; there must be one for each";
    throw Failure(message.str());
  }
  return array;
}

[[noreturn]] void failValue(const char* name, double value, std::int64_t particle, const char* rule)
{
  std::ostringstream message;
  message << "The array '" << name << "' of the particles has the value " << value << " at index "
          << particle << "; " << rule;
  throw Failure(message.str());
}

// The diameter of the balls of the densest lattice packing in which each point has a cell of this
// measure, which is the largest distance that points can all keep: a regular row, the hexagonal
// lattice, the face-centred cubic lattice. (Lagae and Dutre, "A Comparison of Methods for
// Generating Poisson Disk Distributions", Computer Graphics Forum 27(1), 2008, Section 2.2: twice
// their r_max.)
template <int D>
double largestSpacing(double measure)
{
  return D == 1 ? measure
    : D == 2    ? std::sqrt(2.0 / std::sqrt(3.0) * measure)
                : cubeRoot(std::sqrt(2.0) * measure);
}

template <int D>
class QualityRun
{
public:
  QualityRun(vtkPointSet* particles, const CountedPoints& counted, const ImageGrid& geometry,
    std::int64_t blockSize, const SharedFlow& flow, Progress& progress)
    : Input(particles)
    , Counted(counted)
    , Geometry(geometry)
    , Scale(geometry)
    , BlockSize(blockSize)
    , Flow(flow.Flow<D>())
    , Work(progress)
    , Count(counted.Count())
    , Size(geometry.Size<D>())
    , Blocks(1)
  {
    for (int a = 0; a < D; ++a)
    {
      this->BlockCounts[a] = (this->Size[a] - 1) / this->BlockSize + 1;
      this->Blocks *= this->BlockCounts[a];
    }
    constexpr double eachParticle = 2 * sizeof(double) + 3 * sizeof(double) + sizeof(std::int64_t);
    constexpr double eachTree = 6 * sizeof(double);
    const std::string purpose = "the comparison of " + std::to_string(this->Count) +
      " particles with " + std::to_string(this->Blocks) + " blocks (see BlockSize)";
    const double bytes = static_cast<double>(this->Count) * (eachParticle + eachTree) +
      static_cast<double>(this->Blocks) * 2 * sizeof(double);
    requireMemory(purpose, bytes);
    withMemory(purpose, bytes, [&]() {
      this->Points = LargeBuffer<double>(3 * this->Count);
      this->Block = LargeBuffer<std::int64_t>(this->Count);
      this->Share = LargeBuffer<double>(this->Count);
      this->Spacing = LargeBuffer<double>(this->Count);
      this->Found = LargeBuffer<double>(this->Blocks);
      this->Expected = LargeBuffer<double>(this->Blocks);
    });
  }

  ParticleQuality Measure(double tablesDone)
  {
    const auto stage = [&](double part) {
      this->Work.BeginStage(tablesDone + part * (1.0 - tablesDone));
    };
    stage(0.1);
    this->Place();
    stage(0.2);
    this->ReadShares();
    stage(0.3);
    this->MeasureCost();
    stage(0.35);
    this->CompareBlocks(stage);
    stage(0.7);
    this->FindNeighbours();
    stage(0.95);
    this->Relate();
    stage(1.0);
    this->Average();
    return this->Quality;
  }

private:
  // Runs kernel(first, last) in order on this thread: for sums, whose order then never changes.
  template <class Kernel>
  void InOrder(std::int64_t count, const Kernel& kernel)
  {
    this->Work.ForInOrder(count, grain, kernel);
  }

  // Finds the points that count, and which block each is in: -1 if it is outside of the domain.
  void Place()
  {
    std::atomic<std::int64_t> outside{ 0 };
    std::atomic<std::int64_t> inEmpty{ 0 };
    const double tolerance = this->Geometry.BorderTolerance();
    visitPoints(
      this->Input, "input point set", this->Work, [&](std::int64_t point, const double* x) {
        const std::int64_t i = this->Counted.NumberOf(point);
        if (i < 0)
        {
          return;
        }
        std::transform(x, x + 3, this->Points.data() + 3 * i, [this](double coordinate) {
          return std::clamp(this->Scale.ToUnits(coordinate), -farOutside, farOutside);
        });
        Point<D> index;
        this->Geometry.template ToIndex<D>(x, index.data());
        this->Geometry.template ClampToDomain<D>(index.data());
        double nearest[3];
        this->Geometry.template ToPhysical<D>(index.data(), nearest);
        if (std::hypot(x[0] - nearest[0], x[1] - nearest[1], x[2] - nearest[2]) > tolerance)
        {
          ++outside;
          this->Block.data()[i] = -1;
          return;
        }
        if (!this->Flow.HasMass(index))
        {
          ++inEmpty;
        }
        std::int64_t block = 0;
        for (int a = D - 1; a >= 0; --a)
        {
          const auto cell = std::min(static_cast<std::int64_t>(index[a]), this->Size[a] - 1);
          block = block * this->BlockCounts[a] + cell / this->BlockSize;
        }
        this->Block.data()[i] = block;
      });
    this->Quality.Particles = this->Count;
    this->Quality.Outside = outside;
    this->Quality.InEmptyCells = inEmpty;
  }

  // The share of each particle in the mass of all: by Mass, else equal.
  void ReadShares()
  {
    double* share = this->Share.data();
    vtkDataArray* masses = findArray(this->Input, "Mass", 1);
    if (!masses)
    {
      std::fill_n(share, this->Count, 1.0 / static_cast<double>(this->Count));
      return;
    }
    double total = 0.0;
    this->InOrder(this->Count, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        share[i] = masses->GetComponent(this->Counted.Point(i), 0);
        total += share[i];
      }
    });
    for (std::int64_t i = 0; i < this->Count; ++i)
    {
      if (!(share[i] >= 0.0) || std::isinf(share[i]))
      {
        failValue(
          "Mass", share[i], this->Counted.Point(i), "every mass must be finite and not negative");
      }
    }
    if (!(total > 0.0) || std::isinf(total))
    {
      std::ostringstream message;
      message << "The array 'Mass' of the particles sums to " << total
              << "; the sum must be positive and a double";
      throw Failure(message.str());
    }
    for (std::int64_t i = 0; i < this->Count; ++i)
    {
      share[i] /= total;
    }
  }

  void MeasureCost()
  {
    vtkDataArray* displacements = findArray(this->Input, "Displacement", 3);
    if (!displacements)
    {
      return;
    }
    double cost = 0.0;
    std::int64_t wrong = -1;
    double wrongComponent = 0.0;
    this->InOrder(this->Count, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        double squared = 0.0;
        for (int r = 0; r < 3; ++r)
        {
          const double component = displacements->GetComponent(this->Counted.Point(i), r);
          squared += component * component;
          if (wrong < 0 && !std::isfinite(squared))
          {
            wrong = i;
            wrongComponent = component;
          }
        }
        cost += this->Share.data()[i] * squared;
      }
    });
    if (wrong >= 0)
    {
      failValue(
        "Displacement", wrongComponent, this->Counted.Point(wrong), "its square must be finite");
    }
    this->Quality.TransportCost = cost;
  }

  // The relative L2 distance of two densities that are constant on blocks.
  template <class Stage>
  void CompareBlocks(const Stage& stage)
  {
    double* found = this->Found.data();
    double* expected = this->Expected.data();
    std::fill_n(found, this->Blocks, 0.0);
    this->InOrder(this->Count, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        if (this->Block.data()[i] >= 0)
        {
          found[this->Block.data()[i]] += this->Share.data()[i];
        }
      }
    });
    stage(0.4);
    this->Work.For(this->Blocks, grain, [=](std::int64_t first, std::int64_t last) {
      for (std::int64_t block = first; block < last; ++block)
      {
        const auto [low, high] = this->BlockBox(block);
        expected[block] = this->Flow.Share(low, high);
      }
    });
    stage(0.45);
    double difference = 0.0;
    double norm = 0.0;
    this->InOrder(this->Blocks, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t block = first; block < last; ++block)
      {
        const auto [low, high] = this->BlockBox(block);
        double measure = 1.0;
        for (int a = 0; a < D; ++a)
        {
          measure *= high[a] - low[a];
        }
        const double off = found[block] - expected[block];
        difference += off * off / measure;
        norm += expected[block] * expected[block] / measure;
      }
    });
    this->Quality.DensityError = std::sqrt(difference / norm);
  }

  std::pair<Point<D>, Point<D>> BlockBox(std::int64_t block) const
  {
    Point<D> low;
    Point<D> high;
    for (int a = 0; a < D; ++a)
    {
      const std::int64_t first = block % this->BlockCounts[a] * this->BlockSize;
      low[a] = static_cast<double>(first);
      high[a] = static_cast<double>(std::min(first + this->BlockSize, this->Size[a]));
      block /= this->BlockCounts[a];
    }
    return { low, high };
  }

  void FindNeighbours()
  {
    withMemory("the neighbours of the particles",
      8.0 * sizeof(double) * static_cast<double>(this->Count), [&]() {
        nearestDistances(
          { this->Points.data(), this->Count }, this->Spacing.data(), this->Work.Stage());
      });
  }

  // Divides the distance of each nearest neighbour by the largest spacing that the density has room
  // for there; -1 where there is no such.
  void Relate()
  {
    Point<D> aspect = this->Geometry.template Lengths<D>();
    for (int a = 0; a < D; ++a)
    {
      aspect[a] = static_cast<double>(this->Size[a]) / this->Scale.ToUnits(aspect[a]);
    }
    const double side = this->Scale.ToUnits(root<D>(this->Geometry.CellMeasure()));
    double* spacing = this->Spacing.data();
    constexpr std::int64_t smallGrain = 256;
    this->Work.For(
      this->Count, smallGrain,
      [=](std::int64_t first, std::int64_t last) {
        for (std::int64_t i = first; i < last; ++i)
        {
          const double share = this->Share.data()[i];
          if (this->Block.data()[i] < 0 || !(share > 0.0) || std::isinf(spacing[i]))
          {
            spacing[i] = -1.0;
            continue;
          }
          double x[3];
          std::transform(this->Points.data() + 3 * i, this->Points.data() + 3 * (i + 1), x,
            [this](double units) { return this->Scale.FromUnits(units); });
          Point<D> index;
          this->Geometry.template ToIndex<D>(x, index.data());
          this->Geometry.template ClampToDomain<D>(index.data());
          spacing[i] /= largestSpacing<D>(this->Flow.MeasureOfShare(index, aspect, share)) * side;
        }
      },
      16 * smallGrain);
  }

  void Average()
  {
    double sum = 0.0;
    double smallest = std::numeric_limits<double>::infinity();
    std::int64_t related = 0;
    this->InOrder(this->Count, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        const double spacing = this->Spacing.data()[i];
        if (spacing >= 0.0)
        {
          sum += spacing;
          smallest = std::min(smallest, spacing);
          ++related;
        }
      }
    });
    if (!std::isfinite(sum))
    {
      throw Failure("MeanSpacing passes the largest double; the spacings of the density along its "
                    "axes must be more alike");
    }
    if (related > 0)
    {
      this->Quality.SmallestSpacing = smallest;
      this->Quality.MeanSpacing = sum / static_cast<double>(related);
    }
  }

  vtkPointSet* Input;
  const CountedPoints& Counted;
  const ImageGrid& Geometry;
  const LengthScale Scale;
  const std::int64_t BlockSize;
  const RectifiedFlow<D>& Flow;
  Progress& Work;
  const std::int64_t Count;
  const GridSize<D> Size;
  GridSize<D> BlockCounts;
  std::int64_t Blocks;
  LargeBuffer<double> Points; // in units of Scale
  LargeBuffer<std::int64_t> Block;
  LargeBuffer<double> Share;
  LargeBuffer<double> Spacing;
  LargeBuffer<double> Found; // shares of the mass in each block
  LargeBuffer<double> Expected;
  ParticleQuality Quality;
};

template <int D>
ParticleQuality measure(vtkPointSet* particles, const CountedPoints& counted,
  const DensityImage& density, int blockSize, const SharedFlow& cache, Progress& progress,
  double tablesDone)
{
  QualityRun<D> run(particles, counted, density.Grid(), blockSize, cache, progress);
  ParticleQuality quality = run.Measure(tablesDone);
  quality.TotalMass = cache.TotalMass();
  return quality;
}

} // namespace

ParticleQuality measureQuality(vtkPointSet* particles, const CountedPoints& counted,
  DensityImage& density, int blockSize, FlowCache& cache, Progress& progress)
{
  // Nanoseconds, as measured.
  const double tables =
    cache.IsOutdated(density) ? 10.0 * static_cast<double>(density.Grid().NumberOfCells()) : 0;
  const double rest = 4000.0 * static_cast<double>(counted.Count());
  const double tablesDone = tables / (tables + rest);
  const SharedFlow& flow = cache.Update(density, progress, tablesDone);
  switch (density.Grid().Dimension())
  {
    case 1:
      return measure<1>(particles, counted, density, blockSize, flow, progress, tablesDone);
    case 2:
      return measure<2>(particles, counted, density, blockSize, flow, progress, tablesDone);
    default:
      return measure<3>(particles, counted, density, blockSize, flow, progress, tablesDone);
  }
}

} // namespace RectifiedTransport
