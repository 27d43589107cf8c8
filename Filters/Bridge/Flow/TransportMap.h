// SPDX-License-Identifier: BSD-3-Clause
// The map between the uniform measure and a density, or between two densities: the worker of
// vtkTransportMap.
#ifndef RectifiedTransport_TransportMap_h
#define RectifiedTransport_TransportMap_h

#include "Bridge/Plan/FlowCache.h"

namespace RectifiedTransport::Bridge
{

// What a filter keeps of a map to another density: the flow of that one, and the optimal map.
struct TargetCache
{
  FlowCache Tables;
  StoreSlot Map;
};

// The density that a map leads to from another one.
struct TargetDensity
{
  // Throws Failure for grids of different axes, planes or directions.
  TargetDensity(const InputDensity& source, const std::string& sourceName, InputDensity& target,
    const std::string& targetName, TargetCache& cache);

  InputDensity& Density;
  std::string SourceName; // in messages
  std::string Name;
  ImageGrid Box; // that holds both
  TargetCache& Cache;
};

// The members are the properties of that class.
struct TransportMap : TransportSettings
{
  bool Backward = false;                    // to the uniform measure; has no effect with a target
  bool EqualizeAreas = false;               // only for Backward
  std::array<int, 3> SampleDimensions = {}; // 0 keeps the number of the density's values

  struct Report
  {
    ImageGrid Grid; // the grid of all samples
    double Samples;
    std::vector<FlowReport> Flows; // with a target that of the source, then that of the target
    TransportReport Transport;
    std::int64_t MovedToMass; // from empty cells of the density that the map leads to
    std::int64_t Folded;
    bool ShowsFolds;    // enough for a warning
    bool IsUncorrected; // EqualizeAreas has changed nothing
  };

  // The grid of the samples on the density's domain. Throws Failure.
  ImageGrid SampleGrid(const InputDensity& density) const;

  // Writes the map's fields, sampled on a grid on the density's domain, into an image, which gets
  // this grid. If it is the density's grid, the image also gets the arrays of the input. Each rank
  // gets the part of the grid in the extent that it wants. `target` may be nullptr. Collective.
  // Throws Failure and Cancelled.
  Report Run(InputDensity& density, TargetDensity* target, const std::array<int, 6>& wanted,
    FlowCache& cache, Progress& progress, vtkImageData* output) const;
};

} // namespace RectifiedTransport::Bridge

#endif
