// SPDX-License-Identifier: BSD-3-Clause
// A density as the distances to others need it: its values, read once, and what identifies them.
#ifndef RectifiedTransport_DistanceInput_h
#define RectifiedTransport_DistanceInput_h

#include "Bridge/Density/InputDensity.h"
#include "Core/Distance/DensityMoments.h"
#include "Core/Geometry/ImageGrid.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// What the distances of a density depend on: its values, on which grid of which box.
struct DensityKey
{
  std::uint64_t Hash = 0;
  std::array<std::int64_t, 3> Cells{};
  std::array<double, 3> Sides{}; // of the box

  bool operator==(const DensityKey& other) const { return this->All() == other.All(); }
  bool operator<(const DensityKey& other) const { return this->All() < other.All(); }

private:
  std::tuple<std::uint64_t, std::array<std::int64_t, 3>, std::array<double, 3>> All() const
  {
    return { this->Hash, this->Cells, this->Sides };
  }
};

struct DistanceInput
{
  std::string Title; // in messages
  std::string Name;  // of its column
  double Time = std::numeric_limits<double>::quiet_NaN();
  DensityReading Reading;
  ImageGrid Grid;
  double Mass = 0.0;      // density times cell measure
  DensityKey Key;         // Sides are set later, those of one box for all
  DensityMoments Moments; // with Linearized, in the units of Sides
  // Of the cells, axis 0 of index space fastest; released as soon as nothing needs them.
  vtkSmartPointer<vtkDoubleArray> Values;
};

// Reads a density, on ranks the whole one on each. Collective. Throws Failure, without the title,
// and Cancelled.
DistanceInput readDistanceInput(InputDensity& density, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
