// SPDX-License-Identifier: BSD-3-Clause
// The one kernel source of an advection, compiled once per instruction set (FlowKernels*.cxx).
// Everything has internal linkage and nothing of the standard library is called: the linker must
// not pick code that is compiled for a wide instruction set for the rest of the program.
//
// Lengths are in grid cells and places in index space: the domain is [0, S_0] x ... x [0, S_d-1], S
// the numbers of cells. Time t is in [0, 1]; velocities are in cells a unit of time. A block of
// particles is kept as a structure of arrays: an array of [BlockSize] has a number of each particle
// (a lane), one of [Dimension][BlockSize] a vector of each. What is called interleaved has the
// coordinates of each particle together: [particle][Dimension]. All lanes are computed, whether
// they hold a particle or not: loops of constant length vectorize best. No lane's result depends on
// another lane, so that it does not matter how particles are put in blocks.
#include "Core/Flow/Kernels/FlowKernels.h"

#include <cstring>

#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

// Helpers become part of the kernel that calls them: a lane loop must see the constants of its
// template, and calls between lane loops would cost more than the loops.
#define RT_INLINE inline __attribute__((always_inline))

namespace RectifiedTransport
{

namespace
{

#include "Core/Flow/Kernels/Vectors.txx"

// The arithmetic of one lane, which devices share. The files below loop over the lanes.
#include "Core/Flow/Kernels/Shared/Language.h"

#include "Core/Flow/Kernels/Shared/AdamsWeights.h"
#include "Core/Flow/Kernels/Shared/BoxMoments.h"
#include "Core/Flow/Kernels/Shared/Velocity.h"

#include "Core/Flow/Kernels/Shared/Multistep.h"

#include "Core/Flow/Kernels/Shared/MapRead.h"

#include "Core/Flow/Kernels/BoxMoments.txx"
#include "Core/Flow/Kernels/FlowVelocity.txx"

#include "Core/Flow/Kernels/FlowLanes.txx"

#include "Core/Flow/Kernels/MultistepLanes.txx"

#include "Core/Flow/Kernels/FlowMapLanes.txx"
#include "Core/Flow/Kernels/FlowMultistep.txx"
#include "Core/Flow/Kernels/FlowMultistepBackward.txx"

#include "Core/Flow/Kernels/FlowMapNodes.txx"

#include "Core/Flow/Kernels/FlowUniformSteps.txx"

#include "Core/Flow/Kernels/FlowAdaptive.txx"

// The kernel AdvectBlock of FlowKernels.h: dispatches on the method and the direction.
template <int Dimension>
std::int64_t advectBlock(const FlowJob<Dimension>& job, const double* seeds,
  const std::int64_t* index, int count, int pass, bool* unresolved)
{
  if (job.Integrator == Integrator::Adaptive)
  {
    return advectAdaptive<Dimension>(job, seeds, index, count, pass, unresolved);
  }
  if (job.Integrator == Integrator::Multistep)
  {
    return job.Backward ? multistepBackward<Dimension>(job, seeds, index, count, pass, unresolved)
                        : multistepForward<Dimension>(job, seeds, index, count, pass, unresolved);
  }
  return advectUniformSteps<Dimension>(job, seeds, index, count, pass, unresolved);
}

} // namespace

template <>
FlowKernels<1> flowKernelsOf<1, RECTIFIEDTRANSPORT_SET>()
{
  return { &advectBlock<1>, &advanceNodes<1>, &readMap<1> };
}

template <>
FlowKernels<2> flowKernelsOf<2, RECTIFIEDTRANSPORT_SET>()
{
  return { &advectBlock<2>, &advanceNodes<2>, &readMap<2> };
}

template <>
FlowKernels<3> flowKernelsOf<3, RECTIFIEDTRANSPORT_SET>()
{
  return { &advectBlock<3>, &advanceNodes<3>, &readMap<3> };
}

} // namespace RectifiedTransport
