// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/PointInput.h"

#include "Bridge/Run/Inputs/InputBlock.h"
#include "Core/Geometry/PointBounds.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkDataObject.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

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
  const auto add = [](std::int64_t, const double* x, PointBounds& part) { part.Add(x); };
  const PointBounds found = reducePoints<PointBounds>(points, progress, add).Found;
  const std::array<double, 6> all = boundsOfAll(progress.Group(),
    { found.Low[0], found.High[0], found.Low[1], found.High[1], found.Low[2], found.High[2] });
  std::copy_n(all.begin(), 6, bounds);
}

} // namespace RectifiedTransport::Bridge
