// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Points/PointInput.h"

#include "Bridge/Run/Inputs/InputBlock.h"
#include "Core/Geometry/PointBounds.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkDataObject.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

namespace
{

struct BoundsOfPoints
{
  PointBounds Found;

  template <class ArrayT>
  void operator()(ArrayT* array, Progress& progress)
  {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
    const auto ofChunk = [array](std::int64_t first, std::int64_t last) {
      PointBounds bounds;
      for (const auto tuple : vtk::DataArrayTupleRange<3>(array, first, last))
      {
        const double x[3] = { static_cast<double>(tuple[0]), static_cast<double>(tuple[1]),
          static_cast<double>(tuple[2]) };
        if (std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]))
        {
          bounds.Add(x);
        }
      }
      return bounds;
    };
    this->Found = reduceChunks(progress, array->GetNumberOfTuples(), grain, PointBounds(), ofChunk,
      [](PointBounds all, const PointBounds& chunk) {
        all.Add(chunk);
        return all;
      });
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
  const Point<3>& low = pass.Found.Low;
  const Point<3>& high = pass.Found.High;
  const std::array<double, 6> all =
    boundsOfAll(progress.Group(), { low[0], high[0], low[1], high[1], low[2], high[2] });
  std::copy_n(all.begin(), 6, bounds);
}

} // namespace RectifiedTransport::Bridge
