// SPDX-License-Identifier: BSD-3-Clause
// Particles of one tile, gathered from several blocks to be advected together.
#ifndef RectifiedTransport_TileLanes_h
#define RectifiedTransport_TileLanes_h

#include "Core/Flow/Kernels/FlowKernels.h"
#include "Core/Flow/Tiles/TileBins.h"
#include "Core/Geometry/Points.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <numeric>

namespace RectifiedTransport
{

// A block of the kernels has few particles of a tile: it would be mostly idle lanes. Which
// particles are gathered depends on the ranges of the work, but no lane's result depends on the
// others.
template <int Dimension>
class TileLanes
{
public:
  static constexpr int StateSize = 4 * Dimension; // position and three velocities

  // Writes the positions of the resolved particles, or of all if these are kept; the others are
  // added to those that are left. The job is on the tile's tables.
  TileLanes(const FlowJob<Dimension>& job, int pass, bool keepsUnresolved,
    PointSpan<Dimension> positions, ParticleMask& left, std::atomic<std::int64_t>& evaluations)
    : Job(job)
    , Pass(pass)
    , KeepsUnresolved(keepsUnresolved)
    , Positions(positions)
    , Left(left)
    , Evaluations(evaluations)
    , Advect(flowKernels<Dimension>().Advect)
    , Size(valuesOf(job.FromStates))
  {
    this->Job.Output = this->Ends;
    std::iota(this->Numbers, this->Numbers + BlockSize, std::int64_t{ 0 });
  }

  // How many doubles a particle's seed, or its state, has.
  static int valuesOf(bool fromStates) { return fromStates ? StateSize : Dimension; }

  // Takes the seed, or the state, of a particle, for a place in the positions, and advances all if
  // there are no more lanes.
  void Add(const double* values, std::int64_t index, std::int64_t particle)
  {
    std::copy_n(values, this->Size, this->Seeds + this->Count * this->Size);
    this->Index[this->Count] = index;
    this->Particle[this->Count] = particle;
    if (++this->Count == BlockSize)
    {
      this->Advance();
    }
  }

  void Advance()
  {
    if (this->Count == 0)
    {
      return;
    }
    // The kernel writes to Ends: the ends of unresolved particles must not overwrite where they
    // were, unless they are kept.
    bool unresolved[BlockSize] = {};
    this->Evaluations +=
      this->Advect(this->Job, this->Seeds, this->Numbers, this->Count, this->Pass, unresolved);
    for (int i = 0; i < this->Count; ++i)
    {
      if (!unresolved[i] || this->KeepsUnresolved)
      {
        std::copy_n(this->Ends + i * Dimension, Dimension, this->Positions[this->Index[i]]);
      }
      if (unresolved[i])
      {
        this->Left.Add(this->Particle[i]);
      }
    }
    this->Count = 0;
  }

private:
  FlowJob<Dimension> Job;
  const int Pass;
  const bool KeepsUnresolved;
  const PointSpan<Dimension> Positions;
  ParticleMask& Left;
  std::atomic<std::int64_t>& Evaluations;
  const AdvectBlock<Dimension> Advect;
  const int Size;                      // doubles a particle
  int Count = 0;                       // of gathered particles
  double Seeds[BlockSize * StateSize]; // [particle][Size]: seeds or states
  double Ends[BlockSize * Dimension];  // [particle][Dimension], the kernel's output
  std::int64_t Index[BlockSize];       // in the positions
  std::int64_t Particle[BlockSize];    // in the row of particles, for those that are left
  std::int64_t Numbers[BlockSize];     // 0, 1, ...: places in Ends
};

} // namespace RectifiedTransport

#endif
