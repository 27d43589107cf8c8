// SPDX-License-Identifier: BSD-3-Clause
// The job of a splat of particles to a grid, and its kernels.
#ifndef RectifiedTransport_SplatSetup_h
#define RectifiedTransport_SplatSetup_h

#include "Core/Splat/Kernels/SplatKernels.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension, class Real>
class SplatSetup
{
public:
  // Does not set the cells in memory, the Job's Box and the scale. Throws std::bad_alloc.
  SplatSetup(const SplatParticles<Dimension, Real>& particles, const GridSize<Dimension>& size,
    const SplatOptions& options)
  {
    this->Job.Particles = particles;
    this->Job.Renormalize = options.Boundary == SplatBoundary::Renormalize;
    // The weights of two cells that keep the centroid are those of CloudInCell.
    constexpr double twoCells = 1.0 / 3.0;
    const bool isNarrow = options.Kernel == SplatKernel::Gaussian && options.Radius <= twoCells;
    const SplatKernel kernel = isNarrow ? SplatKernel::CloudInCell : options.Kernel;
    this->Kernels = splatKernels<Dimension, Real>(kernel);
    this->Job.Width = this->Kernels.Width;
    if (kernel == SplatKernel::Gaussian)
    {
      this->UseGaussian(options.Radius);
    }
    for (int a = 0; a < Dimension; ++a)
    {
      this->Job.Size[a] = static_cast<std::int32_t>(size[a]);
      this->Job.Span[a] = std::min(this->Job.Width, this->Job.Size[a]);
    }
  }

  SplatSetup(const SplatSetup&) = delete;
  SplatSetup& operator=(const SplatSetup&) = delete;

  SplatJob<Dimension, Real> Job{};
  SplatKernels<Dimension, Real> Kernels;

private:
  void UseGaussian(double radius)
  {
    // Truncated at three standard deviations. Weights at a distance from the nearest centre are
    // products of exp(-k^2 / 2 s^2), tabulated here, and two exponentials of the offset.
    this->Job.Cut = 3.0 * radius;
    this->Job.PerVariance = 1.0 / (radius * radius);
    this->Job.Width = static_cast<std::int32_t>(2.0 * this->Job.Cut) + 1;
    const int farthest = static_cast<int>(this->Job.Cut + 0.5) + 1;
    for (int k = 0; k <= farthest; ++k)
    {
      const double square = static_cast<double>(k) * k;
      this->AtOffset.push_back(this->Kernels.Exponential(-0.5 * square * this->Job.PerVariance));
    }
    this->Job.AtOffset = this->AtOffset.data();
  }

  std::vector<double> AtOffset; // the table that the Job points to
};

} // namespace RectifiedTransport

#endif
