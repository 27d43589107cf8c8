// SPDX-License-Identifier: BSD-3-Clause
// What moves the points of a filter, by the properties Method and Certify: the flow of a density or
// its optimal map, and what certifies its cost.
#ifndef RectifiedTransport_DensityTransport_h
#define RectifiedTransport_DensityTransport_h

#include "Bridge/Settings/OptimalSettings.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/OptimalMap/OptimalMap.h"

#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
class vtkDoubleArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// What an optimal map depends on besides the values of the density, which may be those of boxes of
// different sides. Without values: of no such map.
struct OptimalMapKey
{
  OptimalMapKey() = default;
  OptimalMapKey(const OptimalSetting& setting, const ImageGrid& grid)
    : Tolerance(setting.Tolerance)
    , Sides(grid.Lengths<3>())
  {
    std::fill(this->Sides.begin() + grid.Dimension(), this->Sides.end(), 0.0);
  }
  bool operator==(const OptimalMapKey& other) const
  {
    return this->Tolerance == other.Tolerance && this->Sides == other.Sides;
  }

  double Tolerance = 0.0;
  Point<3> Sides{};
};

// What a filter tells about the map that it took.
struct TransportReport
{
  bool IsOptimal = false;
  std::string Warning; // why the flow moves the points with Method Optimal; else empty

  // Ends a warning about samples that more steps would help.
  const char* WithSteps(const char* advice) const { return this->IsOptimal ? "" : advice; }
};

template <int D>
class DensityTransport
{
public:
  // `map` is the optimal map in LengthScale's units, solved; nullptr if the setting needs none. The
  // flow must outlive this. Throws Failure and Cancelled.
  DensityTransport(const RectifiedFlow<D>& flow, const ImageGrid& grid,
    const OptimalSetting& setting, std::shared_ptr<const OptimalMap<D>> map, Progress& progress);

  const PointTransport<D>& Points() const;
  // What the bound is from; nullptr if none is wanted.
  const OptimalMap<D>* Certificate() const { return this->Map.get(); }
  const TransportReport& Report() const { return this->Found; }
  // Of Points: empty for the flow.
  const OptimalMapKey& MapKey() const { return this->Key; }

  // Adds TransportCostLowerBound and OptimalityGap of a map of this cost, if there is a
  // certificate. Throws std::overflow_error as LengthScale.
  void AddBound(double cost, vtkDataObject* output) const;
  // The array Slack of pairs of seeds and images, in squared physical units; there is a
  // certificate. Throws Failure and Cancelled.
  vtkSmartPointer<vtkDoubleArray> Slack(
    ConstPointSpan<D> seeds, ConstPointSpan<D> images, Progress& progress) const;

private:
  const RectifiedFlow<D>& Flow;
  LengthScale Scale;
  const ImageGrid Grid;
  std::shared_ptr<const OptimalMap<D>> Map;
  TransportReport Found;
  OptimalMapKey Key;
};

} // namespace RectifiedTransport::Bridge

#endif
