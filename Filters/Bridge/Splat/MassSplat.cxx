// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Splat/MassSplat.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkDoubleArray.h"

#include <cmath>
#include <functional>
#include <numeric>
#include <sstream>

namespace RectifiedTransport::Bridge
{

namespace
{

template <class Real>
struct MassPoints
{
  ConstPointSpan<3, Real> Points;
  const double* Masses;
  double MassEach;
};

template <int D, class Real>
SplatReport splatInto(
  const MassPoints<Real>& input, const SplatTarget& target, Progress& progress, double* cells)
{
  const ImageGrid& geometry = target.Geometry;
  const SplatParticles<D, Real> particles{ input.Points, input.Masses, input.MassEach,
    geometry.ToIndexMap<D>() };
  const double bytes = 8.0 * static_cast<double>(input.Points.size());
  return withMemory("putting the points in order", bytes, [&]() {
    return splatMass<D, Real>(
      particles, geometry.Size<D>(), target.Options, target.Scale(), cells, progress);
  });
}

template <class Real>
std::int64_t splatAll(const MassPoints<Real>& input, const SplatTarget& target, Progress& progress,
  vtkDoubleArray* array)
{
  double* cells = array->GetPointer(0);
  const auto splat = dispatchDimension(
    target.Geometry.Dimension(), splatInto<1, Real>, splatInto<2, Real>, splatInto<3, Real>);
  return splat(input, target, progress, cells).Outside;
}

} // namespace

void requireFiniteDensity(
  double mass, const SplatTarget& target, const char* what, const char* rule)
{
  const double measure = target.DivideByVolume ? target.Geometry.CellMeasure() : 1.0;
  if (!std::isfinite(1.0 / measure) || !std::isfinite(mass / measure))
  {
    std::ostringstream message;
    message << what << " of " << mass
            << " in all make densities past the largest double in cells of " << measure
            << "; make the masses smaller, " << rule;
    throw Failure(message.str());
  }
}

std::int64_t splatPoints(vtkDataArray* points, const double* masses, double massEach,
  const SplatTarget& target, Progress& progress, vtkDoubleArray* cells)
{
  const vtkIdType count = points->GetNumberOfTuples();
  if (auto* single = vtkAOSDataArrayTemplate<float>::FastDownCast(points))
  {
    return splatAll<float>(
      { { single->GetPointer(0), count }, masses, massEach }, target, progress, cells);
  }
  vtkSmartPointer<vtkDataArray> copy;
  auto* whole = vtkAOSDataArrayTemplate<double>::FastDownCast(points);
  if (!whole)
  {
    copy = newArray<vtkDoubleArray>("Points", 3, count);
    copy->DeepCopy(points);
    whole = vtkAOSDataArrayTemplate<double>::FastDownCast(copy);
  }
  return splatAll<double>(
    { { whole->GetPointer(0), count }, masses, massEach }, target, progress, cells);
}

double splatMassIn(vtkDoubleArray* cells, const SplatTarget& target, Progress& progress)
{
  const vtkIdType count = cells->GetNumberOfTuples();
  const double* values = cells->GetPointer(0);
  const double sum = reduceChunks(
    progress, count, splatSumChunk, 0.0,
    [values](std::int64_t first, std::int64_t last) {
      return std::accumulate(values + first, values + last, 0.0);
    },
    std::plus<>());
  return target.DivideByVolume ? sum * target.Geometry.CellMeasure() : sum;
}

} // namespace RectifiedTransport::Bridge
