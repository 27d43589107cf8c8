// SPDX-License-Identifier: BSD-3-Clause
#include "Splat.h"

#include "Pacer.h"
#include "SplatBlock.h"
#include "SplatGaussian.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

template <int Dimension, class Real, class Stencil>
SplatReport splat(const SplatParticles<Dimension, Real>& particles,
  const SplatGrid<Dimension>& grid, bool renormalize, double scale, double* cells, Pacer& pacer,
  Stencil stencil)
{
  SplatReport report;
  SplatBlock<Dimension> block;
  pacer.BeginStage(1.0, particles.Count);
  for (std::int64_t begin = 0; begin < particles.Count && !report.Cancelled;)
  {
    const std::int64_t slice = std::min(particles.Count - begin, pacer.NextSlice(4096));
    for (std::int64_t first = begin; first < begin + slice; first += splatBlock)
    {
      const int count = static_cast<int>(std::min<std::int64_t>(splatBlock, begin + slice - first));
      report.Outside += block.Load(
        particles, grid, renormalize, scale, count, [first](int i) { return first + i; });
      stencil.Weigh(block);
      for (int i = 0; i < count; ++i)
      {
        stencil.Add(block, i, cells);
      }
    }
    begin += slice;
    report.Cancelled = !pacer.EndSlice(slice);
  }
  return report;
}

} // namespace

template <int Dimension, class Real>
SplatReport splatMass(const SplatParticles<Dimension, Real>& particles,
  const GridSize<Dimension>& size, const SplatOptions& options, double scale, double* cells,
  const Executor&, const Monitor& monitor)
{
  const SplatGrid<Dimension> grid(size);
  const bool renormalize = options.Boundary == SplatBoundary::Renormalize;
  std::fill_n(cells, static_cast<std::int64_t>(numberOfCells<Dimension>(size)), 0.0);
  Pacer pacer(monitor);
  const auto run = [&](auto stencil) {
    return splat(particles, grid, renormalize, scale, cells, pacer, stencil);
  };
  switch (options.Kernel)
  {
    case SplatKernel::NearestCell:
      return run(FixedStencil<Dimension, NearestCellKernel>(grid, renormalize));
    case SplatKernel::TriangularShapedCloud:
      return run(FixedStencil<Dimension, TriangularShapedCloudKernel>(grid, renormalize));
    case SplatKernel::Gaussian:
      if (options.Radius > GaussianKernel::SmallestRadius)
      {
        return run(GaussianStencil<Dimension>(grid, renormalize, options.Radius));
      }
      [[fallthrough]];
    default:
      return run(FixedStencil<Dimension, CloudInCellKernel>(grid, renormalize));
  }
}

template SplatReport splatMass<1, float>(const SplatParticles<1, float>&, const GridSize<1>&,
  const SplatOptions&, double, double*, const Executor&, const Monitor&);
template SplatReport splatMass<2, float>(const SplatParticles<2, float>&, const GridSize<2>&,
  const SplatOptions&, double, double*, const Executor&, const Monitor&);
template SplatReport splatMass<3, float>(const SplatParticles<3, float>&, const GridSize<3>&,
  const SplatOptions&, double, double*, const Executor&, const Monitor&);
template SplatReport splatMass<1, double>(const SplatParticles<1, double>&, const GridSize<1>&,
  const SplatOptions&, double, double*, const Executor&, const Monitor&);
template SplatReport splatMass<2, double>(const SplatParticles<2, double>&, const GridSize<2>&,
  const SplatOptions&, double, double*, const Executor&, const Monitor&);
template SplatReport splatMass<3, double>(const SplatParticles<3, double>&, const GridSize<3>&,
  const SplatOptions&, double, double*, const Executor&, const Monitor&);

} // namespace RectifiedTransport
