// SPDX-License-Identifier: BSD-3-Clause
// The job of a splat of particles to a grid, and its kernels.
#ifndef RectifiedTransport_SplatSetup_h
#define RectifiedTransport_SplatSetup_h

#include "Core/Splat/Kernels/SplatKernels.h"

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
    const SplatOptions& options);
  SplatSetup(const SplatSetup&) = delete;
  SplatSetup& operator=(const SplatSetup&) = delete;

  SplatJob<Dimension, Real> Job{};
  SplatKernels<Dimension, Real> Kernels;

private:
  void UseGaussian(double radius);

  std::vector<double> AtOffset; // of the Job
};

} // namespace RectifiedTransport

#endif
