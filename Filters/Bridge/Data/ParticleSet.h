// SPDX-License-Identifier: BSD-3-Clause
// Particles from the core's index space to a vtkPolyData: memory for seeds and positions, and their
// conversion to VTK's arrays.
#ifndef RectifiedTransport_ParticleSet_h
#define RectifiedTransport_ParticleSet_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDoubleArray;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class LengthScale;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Positions of particles, each at one time or at several along a path. In 3D index and physical
// coordinates share memory.
template <int D>
class ParticleSet
{
public:
  // Allocates memory for `count` particles at `times` times each. Throws Failure, for any `count`,
  // if there is not enough memory; `purpose` completes "not enough memory for". `seedsGiven`: the
  // caller writes PhysicalSeeds.
  ParticleSet(const ImageGrid& geometry, const std::string& purpose, double count,
    std::int64_t times, bool seedsGiven);

  std::int64_t Count() const { return this->NumberOfParticles; }
  // The particles are `Count` of the `all` particles of several ranks, from number `first` on.
  void SetShare(std::int64_t first, std::int64_t all)
  {
    this->FirstId = first;
    this->AllParticles = all;
  }

  // In index space; the positions of a particle are consecutive.
  PointSpan<D> Seeds();
  PointSpan<D> Positions();
  // In physical space.
  PointSpan<3> PhysicalSeeds();

  // Writes points with vertices, SeedId, SeedPosition, Displacement and Mass, or for several times
  // polylines with SeedId, Time and Mass, and does not keep them; seeds and positions are undefined
  // afterwards. Returns the mean squared displacement of the particles of all ranks. Collective.
  // Throws Failure and Cancelled.
  double Write(
    double totalMass, const std::vector<double>& times, Progress& progress, vtkPolyData* output);

private:
  template <class WriteParticle>
  double WriteEach(const LengthScale& scale, Progress& progress, const WriteParticle& write) const;
  void ToPhysicalSeed(std::int64_t particle, const double* index, double* seed) const;
  void ToPhysical(
    const double* index, const double* indexSeed, const double* seed, double* x) const;

  const ImageGrid& Geometry;
  std::int64_t NumberOfParticles;
  std::int64_t FirstId = 0;
  std::int64_t AllParticles;
  std::int64_t Times;
  bool SeedsGiven;
  vtkSmartPointer<vtkDoubleArray> SeedPosition;
  vtkSmartPointer<vtkDoubleArray> Points;
  LargeBuffer<double> SeedBuffer;
  LargeBuffer<double> PositionBuffer;
};

} // namespace RectifiedTransport::Bridge

#endif
