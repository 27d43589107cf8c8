// SPDX-License-Identifier: BSD-3-Clause
// Where the particles of a blend are in its inputs: by maps from one pivot, a unit box with equally
// many particles in each cell of a grid (Section 3.4), and by optimal maps. The particles are
// divided among the ranks.
#ifndef RectifiedTransport_BlendPositions_h
#define RectifiedTransport_BlendPositions_h

#include "Bridge/Plan/FlowCache.h"
#include "Bridge/Ranks/DistributedSplat.h"
#include "Bridge/Run/Settings/TransportSettings.h"
#include "Core/Blend/BlendWeights.h"
#include "Core/Flow/PivotPositions.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace RectifiedTransport::Bridge
{

struct BlendInput
{
  std::unique_ptr<InputDensity> Density;
  std::string Name;         // in messages
  std::string PositionName; // names the array of the particles' positions; empty for none
  double Weight = 0.0;      // at least 0; all sum to 1
};

// What maps to several densities must have in common for their particles to correspond.
struct LinearizedMapSettings
{
  const ImageGrid& Pivot; // its cells alone count
  std::int64_t PerCell;
  FlowOptions Options;
  TableSetting Tables;
  RankShare Share; // the range of particle numbers that this rank has
};

struct LinearizedMap
{
  // The share's positions, physical, 3 components, in the order of PivotLattice. Read-only.
  vtkSmartPointer<vtkDoubleArray> Positions;
  double TotalMass = 0.0; // density times cell measure, summed
  // Counts this rank's particles. Those that ended in an empty cell of the density were moved to
  // the nearest mass.
  FlowReport Flow;
};

// Counts what happened on all ranks.
struct BlendReport
{
  std::int64_t Particles = 0;
  std::int64_t Moved = 0;         // out of empty cells of the densities, by new maps
  std::vector<std::string> Steps; // a warning for each new map that does not keep its tolerance
};

class LinearizedMaps
{
public:
  // Assigns to each input the kept map of its density, whatever input had it before. Returns how
  // many inputs have none. Collective. Throws Cancelled.
  std::size_t Match(const std::vector<BlendInput>& inputs, const LinearizedMapSettings& settings,
    Progress& progress);
  // Advects the particles to these densities. Builds tables in `tables` and releases them. Returns
  // how many particles of this rank the new maps moved, and their warnings. Collective. Throws
  // Failure, which names the input, and Cancelled.
  BlendReport Make(const std::vector<BlendInput>& inputs, const LinearizedMapSettings& settings,
    FlowCache& tables, Progress& progress);

  const LinearizedMap& operator[](std::size_t input) const
  {
    return *this->Slots[input].Cached<const LinearizedMap>();
  }
  const DataIdentity& Identity(std::size_t input) const { return this->Slots[input].Identity(); }

private:
  std::vector<StoreSlot> Slots; // by the inputs
};

struct BlendSettings : TransportSettings
{
  int Dimensions[3] = {}; // the arguments of commonGrid
  int ParticlesPerCell = 0;
  BlendedMass Mode = BlendedMass::Linear;
  SplatOptions Splat = {};
  std::string ArrayName = {}; // what the density is called; empty: as the inputs call theirs
  bool ComparesEnds = false;  // two inputs also give TransportCost and Displacement
};

// What one run blends.
struct BlendRun
{
  const std::vector<BlendInput>& Inputs;
  const BlendSettings& Settings;
  ImageGrid Geometry; // the grid of the blended density
  double Particles;   // their number on all ranks together
};

struct BlendPositions
{
  // By the inputs. Those of the flow, if that is the Method, and of inputs without weight.
  std::vector<vtkSmartPointer<vtkDoubleArray>> Positions;
  // With Method Optimal or Certify, see OptimalPositions.
  vtkSmartPointer<vtkDoubleArray> Slack;
  double Bound = 0.0;
  double Cost = 0.0; // between two inputs that of the particles
  std::vector<double> Functional;
  // Between two inputs y - x of the particles' positions x and y in them.
  vtkSmartPointer<vtkDoubleArray> Displacements;
};

// Throws Failure if there is no memory for one of the optimal maps and the particles, on all ranks.
void requireMemoryForMaps(const BlendRun& run, const Ranks& ranks);

// With an optimal map or its bound, finds this rank's particles anew where anything that they
// depend on is not that of the positions that are kept; else takes those of the maps. Adds
// warnings. Collective. Throws Failure and Cancelled.
std::shared_ptr<const BlendPositions> findPositions(const BlendRun& run, const LinearizedMaps& maps,
  StoreSlot& kept, Progress& progress, std::vector<std::string>& warnings);

} // namespace RectifiedTransport::Bridge

#endif
