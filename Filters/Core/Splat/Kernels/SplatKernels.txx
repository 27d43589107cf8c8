// SPDX-License-Identifier: BSD-3-Clause
// The one kernel source of a splat, compiled once per instruction set (SplatKernels*.cxx), by the
// same rules as FlowKernels.txx: internal linkage, and nothing of the standard library.
#include "Core/Splat/Kernels/SplatKernels.h"

#define RT_INLINE inline __attribute__((always_inline))

namespace RectifiedTransport
{

namespace
{

#include "Core/Splat/Kernels/SplatBlock.txx"

#include "Core/Splat/Kernels/SplatFixed.txx"

#include "Core/Splat/Kernels/SplatGaussian.txx"

template <class Splat, int Dimension, class Real>
SplatKernels<Dimension, Real> kernelsOf()
{
  return { Splat::Width, &Splat::Add, &Splat::Find, &Splat::Reach, &exponential };
}

} // namespace

template <int Dimension, class Real>
SplatKernels<Dimension, Real> RECTIFIEDTRANSPORT_KERNELS(SplatKernel kernel)
{
  switch (kernel)
  {
    case SplatKernel::NearestCell:
      return kernelsOf<FixedSplat<Dimension, NearestCellWeights, Real>, Dimension, Real>();
    case SplatKernel::TriangularShapedCloud:
      return kernelsOf<FixedSplat<Dimension, TriangularShapedCloudWeights, Real>, Dimension,
        Real>();
    case SplatKernel::Gaussian:
      return kernelsOf<GaussianSplat<Dimension, Real>, Dimension, Real>();
    default:
      return kernelsOf<FixedSplat<Dimension, CloudInCellWeights, Real>, Dimension, Real>();
  }
}

template SplatKernels<1, float> RECTIFIEDTRANSPORT_KERNELS<1, float>(SplatKernel);
template SplatKernels<2, float> RECTIFIEDTRANSPORT_KERNELS<2, float>(SplatKernel);
template SplatKernels<3, float> RECTIFIEDTRANSPORT_KERNELS<3, float>(SplatKernel);
template SplatKernels<1, double> RECTIFIEDTRANSPORT_KERNELS<1, double>(SplatKernel);
template SplatKernels<2, double> RECTIFIEDTRANSPORT_KERNELS<2, double>(SplatKernel);
template SplatKernels<3, double> RECTIFIEDTRANSPORT_KERNELS<3, double>(SplatKernel);

} // namespace RectifiedTransport
