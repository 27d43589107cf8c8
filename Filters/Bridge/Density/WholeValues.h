// SPDX-License-Identifier: BSD-3-Clause
// The values of a density as an array, on every rank all of them.
#ifndef RectifiedTransport_WholeValues_h
#define RectifiedTransport_WholeValues_h

#include "Bridge/Density/InputDensity.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Stages.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <memory>
#include <string>

namespace RectifiedTransport::Bridge
{

// What ranks gather for it stays until density.ReleaseGathered(). Collective. Throws Failure and
// Cancelled.
template <int D>
vtkSmartPointer<vtkDoubleArray> wholeValues(
  InputDensity& density, const std::string& name, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  density.Prepare(FlowTables::Whole, progress);
  const std::shared_ptr<const DensityValues> whole = density.Source<D>().Whole();
  const std::int64_t cells = density.Grid().NumberOfCells();
  auto values = newArray<vtkDoubleArray>(name, 1, cells);
  double* to = values->GetPointer(0);
  progress.For(cells, grain,
    [&](std::int64_t first, std::int64_t last) { whole->Read(first, last - first, to + first); });
  return values;
}

} // namespace RectifiedTransport::Bridge

#endif
