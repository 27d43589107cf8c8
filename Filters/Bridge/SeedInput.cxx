// SPDX-License-Identifier: BSD-3-Clause
#include "SeedInput.h"

#include "Failure.h"
#include "HostMonitor.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArrayRange.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 13;

struct SeedCounts
{
  std::atomic<std::int64_t> Moved{ 0 };
  std::atomic<std::int64_t> NotFinite{ 0 };
  std::atomic<std::int64_t> FirstNotFinite{ -1 };

  void AddNotFinite(std::int64_t count, std::int64_t first)
  {
    this->NotFinite += count;
    std::int64_t known = this->FirstNotFinite;
    while (
      (known < 0 || first < known) && !this->FirstNotFinite.compare_exchange_weak(known, first))
    {
    }
  }
};

// Places the seeds of a range of tuples.
template <int D>
class PlaceSeeds
{
public:
  PlaceSeeds(const ImageGeometry& geometry, double* indexSeeds, double* physicalSeeds)
    : Geometry(geometry)
    , Size(geometry.Size<D>())
    , Diagonal(geometry.Diagonal())
    , IndexSeeds(indexSeeds)
    , PhysicalSeeds(physicalSeeds)
  {
  }

  template <class ArrayT>
  void operator()(ArrayT* array, const Executor& executor, HostMonitor& host)
  {
    host.Run(executor, array->GetNumberOfTuples(), grain,
      [this, array](std::int64_t first, std::int64_t last) {
        this->Range(vtk::DataArrayTupleRange<3>(array, first, last), first);
      });
  }

  SeedCounts Counts;

private:
  template <class Tuples>
  void Range(const Tuples& tuples, std::int64_t first)
  {
    std::int64_t moved = 0;
    std::int64_t notFinite = 0;
    std::int64_t firstNotFinite = -1;
    std::int64_t i = first;
    for (const auto tuple : tuples)
    {
      const double x[3] = { static_cast<double>(tuple[0]), static_cast<double>(tuple[1]),
        static_cast<double>(tuple[2]) };
      if (std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]))
      {
        moved += this->Place(x, i) ? 1 : 0;
      }
      else
      {
        firstNotFinite = notFinite++ == 0 ? i : firstNotFinite;
      }
      ++i;
    }
    this->Counts.Moved += moved;
    if (notFinite > 0)
    {
      this->Counts.AddNotFinite(notFinite, firstNotFinite);
    }
  }

  bool Place(const double* x, std::int64_t i) const
  {
    double* index = this->IndexSeeds + i * D;
    double* seed = this->PhysicalSeeds + i * 3;
    this->Geometry.template ToIndex<D>(x, index);
    bool inside = true;
    for (int a = 0; a < D; ++a)
    {
      const double nearest = std::clamp(index[a], 0.0, static_cast<double>(this->Size[a]));
      inside = inside && nearest == index[a];
      index[a] = nearest;
    }
    this->Geometry.template ToPhysical<D>(index, seed);
    const double distance = std::hypot(x[0] - seed[0], x[1] - seed[1], x[2] - seed[2]);
    const double rounding =
      1e-12 * (this->Diagonal + std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]));
    if (inside && distance <= rounding)
    {
      std::copy_n(x, 3, seed);
    }
    return distance > 1e-6 * this->Diagonal;
  }

  const ImageGeometry& Geometry;
  GridSize<D> Size;
  double Diagonal;
  double* IndexSeeds;
  double* PhysicalSeeds;
};

} // namespace

template <int D>
std::int64_t readSeeds(vtkPointSet* points, const ImageGeometry& geometry, const Executor& executor,
  HostMonitor& host, double* indexSeeds, double* physicalSeeds)
{
  PlaceSeeds<D> place(geometry, indexSeeds, physicalSeeds);
  vtkDataArray* coordinates = points->GetPoints()->GetData();
  using Dispatch = vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Reals>;
  if (!Dispatch::Execute(coordinates, place, executor, host))
  {
    place(coordinates, executor, host);
  }
  const SeedCounts& counts = place.Counts;
  if (counts.NotFinite > 0)
  {
    std::ostringstream message;
    message << "The input Seeds has " << counts.NotFinite
            << (counts.NotFinite == 1 ? " point that is" : " points that are")
            << " NaN or infinite, the first at index " << counts.FirstNotFinite
            << "; all coordinates must be finite";
    throw Failure(message.str());
  }
  return counts.Moved;
}

template std::int64_t readSeeds<1>(
  vtkPointSet*, const ImageGeometry&, const Executor&, HostMonitor&, double*, double*);
template std::int64_t readSeeds<2>(
  vtkPointSet*, const ImageGeometry&, const Executor&, HostMonitor&, double*, double*);
template std::int64_t readSeeds<3>(
  vtkPointSet*, const ImageGeometry&, const Executor&, HostMonitor&, double*, double*);

} // namespace RectifiedTransport
