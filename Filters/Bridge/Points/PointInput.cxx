// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Points/PointInput.h"

#include "Bridge/Run/Inputs/InputBlock.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Reduction.h"

#include "vtkDataObject.h"

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>
#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array<double, 6> noBounds = { infinity, -infinity, infinity, -infinity, infinity,
  -infinity };

struct BoundsOfPoints
{
  std::array<double, 6> Found = noBounds;

  template <class ArrayT>
  void operator()(ArrayT* array, Progress& progress)
  {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
    const auto ofChunk = [array](std::int64_t first, std::int64_t last) {
      std::array<double, 6> bounds = noBounds;
      for (const auto tuple : vtk::DataArrayTupleRange<3>(array, first, last))
      {
        const double x[3] = { static_cast<double>(tuple[0]), static_cast<double>(tuple[1]),
          static_cast<double>(tuple[2]) };
        const bool isFinite = std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
        for (std::size_t a = 0; isFinite && a < 3; ++a)
        {
          bounds[2 * a] = std::min(bounds[2 * a], x[a]);
          bounds[2 * a + 1] = std::max(bounds[2 * a + 1], x[a]);
        }
      }
      return bounds;
    };
    const auto join = [](std::array<double, 6> all, const std::array<double, 6>& chunk) {
      for (std::size_t a = 0; a < 3; ++a)
      {
        all[2 * a] = std::min(all[2 * a], chunk[2 * a]);
        all[2 * a + 1] = std::max(all[2 * a + 1], chunk[2 * a + 1]);
      }
      return all;
    };
    this->Found =
      reduceChunks(progress, array->GetNumberOfTuples(), grain, noBounds, ofChunk, join);
  }
};

} // namespace

vtkPointSet* pointSetOf(vtkInformationVector* port)
{
  return requireBlock<vtkPointSet>(
    vtkDataObject::GetData(port), "The input", "a vtkPointSet, as Extract Surface makes one of it");
}

std::array<double, 6> boundsOfAll(const Ranks& ranks, const std::array<double, 6>& own)
{
  std::array<double, 6> all = own;
  for (const std::array<double, 6>& bounds : gatherValues(ranks, own))
  {
    if (bounds[0] > bounds[1])
    {
      continue;
    }
    const bool isFirst = all[0] > all[1];
    for (std::size_t i = 0; i < 6; i += 2)
    {
      all[i] = isFirst ? bounds[i] : std::min(all[i], bounds[i]);
      all[i + 1] = isFirst ? bounds[i + 1] : std::max(all[i + 1], bounds[i + 1]);
    }
  }
  return all;
}

void findBounds(vtkPointSet* points, const Ranks& ranks, double bounds[6])
{
  const SerialExecutor serial;
  Context context(serial);
  context.Group = &ranks;
  Progress progress(context);
  findBounds(points, progress, bounds);
}

void findBounds(vtkPointSet* points, Progress& progress, double bounds[6])
{
  BoundsOfPoints pass;
  if (points && points->GetNumberOfPoints() > 0)
  {
    vtkDataArray* coordinates = points->GetPoints()->GetData();
    using Dispatch = vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Reals>;
    if (!Dispatch::Execute(coordinates, pass, progress))
    {
      pass(coordinates, progress);
    }
  }
  const std::array<double, 6> all = boundsOfAll(progress.Group(), pass.Found);
  std::copy_n(all.begin(), 6, bounds);
}

void NotFinitePoints::Add(std::int64_t count, std::int64_t first)
{
  this->Count += count;
  std::int64_t known = this->First;
  while ((known < 0 || first < known) && !this->First.compare_exchange_weak(known, first))
  {
  }
}

void NotFinitePoints::RequireNone(const std::string& what) const
{
  if (this->Count == 0)
  {
    return;
  }
  std::ostringstream message;
  message << "The " << what << " has " << this->Count
          << (this->Count == 1 ? " point that is" : " points that are")
          << " NaN or infinite, the first at index " << this->First
          << "; all coordinates must be finite";
  throw Failure(message.str());
}

} // namespace RectifiedTransport::Bridge
