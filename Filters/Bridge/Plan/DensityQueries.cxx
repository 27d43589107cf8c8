// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Plan/DensityQueries.h"

#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/DensityInspection.h"
#include "Core/Tables/PlacedCells.h"

#include <cmath>

namespace RectifiedTransport::Bridge
{

namespace
{

// The mass of values that have this summary.
double massOf(InputDensity& density, SuspectValues values, Progress& progress)
{
  const double sum = values.Found.Total;
  DensitySummary found;
  found.Total = sum * density.Grid().CellMeasure();
  if (sum > 0.0 && std::isfinite(sum) && (!(found.Total > 0.0) || std::isinf(found.Total)))
  {
    density.ThrowInvalid(found);
  }
  if (std::isfinite(sum))
  {
    density.ReportSuspect(values, progress);
  }
  return found.Total;
}

template <int D>
void write(const ImageGrid& grid, InputDensity& density, const TupleBox& wanted, Progress& progress,
  double* values)
{
  density.Prepare(FlowTables::Tiled, progress);
  withMemory(
    { "the density on the output's grid", 8.0 * static_cast<double>(wanted.Count()) }, [&]() {
      const CellMeans<D> means(
        placeCells<D>(grid, density.Grid()), grid.Size<D>(), latticePartOf<D>(wanted, grid));
      const auto part = density.Source<D>().Part(means.Low(), means.High());
      means.Write(*part, progress, values);
    });
  density.ReleaseGathered();
}

} // namespace

double massOf(InputDensity& density, Progress& progress)
{
  SuspectValues values = density.Suspect();
  values.Found = summarize(*density.Values(), density.Grid().NumberOfCells(), progress);
  return massOf(density, values, progress);
}

double requireMass(InputDensity& density, const DensityValues& gathered, Progress& progress)
{
  SuspectValues values = density.Suspect();
  values.Found = summarize(gathered, density.Grid().NumberOfCells(), progress);
  try
  {
    requireDensity(values.Found);
  }
  catch (const InvalidDensity& invalid)
  {
    density.ThrowInvalid(invalid.Summary());
  }
  return massOf(density, values, progress);
}

vtkSmartPointer<vtkDoubleArray> wholeValues(
  InputDensity& density, const std::string& name, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  density.Prepare(FlowTables::Whole, progress);
  const std::shared_ptr<const DensityValues> whole = density.Part({}, density.CellsInSpace());
  const std::int64_t cells = density.Grid().NumberOfCells();
  auto values = newArray<vtkDoubleArray>(name, 1, cells);
  double* to = values->GetPointer(0);
  progress.For(cells, grain,
    [&](std::int64_t first, std::int64_t last) { whole->Read(first, last - first, to + first); });
  return values;
}

void requireValues(InputDensity& density, vtkDoubleArray& values)
{
  const DensitySummary found = summarize(values.GetPointer(0), values.GetNumberOfTuples(), 0);
  if (found.NotFinite > 0 || found.Negative > 0 || std::isinf(found.Total))
  {
    density.ThrowInvalid(found);
  }
}

void writeDensityOn(const ImageGrid& grid, InputDensity& density, const TupleBox& wanted,
  Progress& progress, double* values)
{
  dispatchDimension(grid.Dimension(), write<1>, write<2>, write<3>)(
    grid, density, wanted, progress, values);
}

} // namespace RectifiedTransport::Bridge
