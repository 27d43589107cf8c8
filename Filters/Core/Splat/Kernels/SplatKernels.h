// SPDX-License-Identifier: BSD-3-Clause
// The range kernels of a splat, one set for each instruction set, and the choice among them.
#ifndef RectifiedTransport_SplatKernels_h
#define RectifiedTransport_SplatKernels_h

#include "Core/Parallel/InstructionSet.h"
#include "Core/Splat/Splat.h"

#include <cstdint>

namespace RectifiedTransport
{

// The number of particles in a block.
constexpr int splatBlock = 64;

// Cells [Low, High) along each axis.
template <int Dimension>
struct CellBox
{
  std::int32_t Low[Dimension];
  std::int32_t High[Dimension];
};

// Where the values of the cells of a box are.
template <int Dimension>
struct CellMemory
{
  double* Cells; // values of the box's cells, axis 0 fastest
  std::int64_t Stride[Dimension];
  std::int64_t Start; // the sum of stride times cell of the box's first cell
};

// The input and parameters that all ranges of one splat share.
template <int Dimension, class Real>
struct SplatJob
{
  SplatParticles<Dimension, Real> Particles;
  std::int32_t Size[Dimension];
  std::int32_t Width;           // cells an axis that a particle reaches
  std::int32_t Span[Dimension]; // the lesser of Width and Size
  bool Renormalize;
  double Scale;
  CellBox<Dimension> Box; // the cells that are in memory
  CellMemory<Dimension> Memory;

  // The Gaussian alone: its cutoff and 1 / sigma^2, in cells, and exp(-k^2 / 2 sigma^2).
  double Cut;
  double PerVariance;
  const double* AtOffset;
};

// Adds particles [first, first + count) or, with an index, particles first + index[0], ..., first +
// index[count - 1], in this order, to the cells of a box (nullptr: the whole grid). `scratch` has
// Width doubles for each axis; only the Gaussian needs it. Returns how many particles are outside,
// among those whose first cell along the last axis is in the box.
template <int Dimension, class Real>
using AddParticles = std::int64_t (*)(const SplatJob<Dimension, Real>& job, std::int64_t first,
  const std::uint32_t* index, std::int64_t count, const CellBox<Dimension>* box, double* scratch);

// Finds the first of the cells that particles [first, first + count) reach: Span cells from there
// on, along axis a from cells[3 i + a]. Returns how many are outside.
template <int Dimension, class Real>
using FindCells = std::int64_t (*)(
  const SplatJob<Dimension, Real>& job, std::int64_t first, int count, std::int32_t* cells);

// A box of all cells that particles [first, first + count), count > 0, reach.
template <int Dimension, class Real>
using BoxOfParticles = CellBox<Dimension> (*)(
  const SplatJob<Dimension, Real>& job, std::int64_t first, std::int64_t count);

// The kernels of one SplatKernel.
template <int Dimension, class Real>
struct SplatKernels
{
  std::int32_t Width; // cells an axis; 0 for the Gaussian, whose radius sets it
  AddParticles<Dimension, Real> Add;
  FindCells<Dimension, Real> Find;
  BoxOfParticles<Dimension, Real> Reach;
  double (*Exponential)(double); // with the same bits on every machine
};

template <int Dimension, class Real>
SplatKernels<Dimension, Real> splatKernelsSSE2(SplatKernel kernel);
template <int Dimension, class Real>
SplatKernels<Dimension, Real> splatKernelsAVX2(SplatKernel kernel);

// The sets compute the same bits. AVX512 uses that of AVX2.
template <int Dimension, class Real>
SplatKernels<Dimension, Real> splatKernels(
  SplatKernel kernel, InstructionSet set = instructionSet());

} // namespace RectifiedTransport

#endif
