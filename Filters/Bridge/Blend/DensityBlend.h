// SPDX-License-Identifier: BSD-3-Clause
// Interpolates densities by their maps from one pivot: the weighted means of the particles'
// positions, as points and as a density (Sections 3.4, 5.2 and 5.3). Each rank maps its share of
// the particles and keeps it.
#ifndef RectifiedTransport_DensityBlend_h
#define RectifiedTransport_DensityBlend_h

#include "Bridge/Blend/BlendPositions.h"
#include "Bridge/Blend/LinearizedMap.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Run/Settings/OptimalSettings.h"
#include "Bridge/Run/Settings/TableSettings.h"
#include "Bridge/Store/Store.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Blend/BlendWeights.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Splat/Splat.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
class vtkDataObject;
class vtkImageData;
class vtkInformation;
class vtkInformationVector;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

struct SplatTarget;

struct BlendInput
{
  std::unique_ptr<InputDensity> Density;
  std::string Name;         // in messages
  std::string PositionName; // of the array of the particles' positions; empty for none
  double Weight = 0.0;      // at least 0; all sum to 1
};

struct BlendSettings
{
  int Dimensions[3]; // of commonGrid
  int ParticlesPerCell;
  BlendedMass Mode;
  FlowOptions Flow;
  TableSetting Tables;
  OptimalSetting Optimal;
  SplatOptions Splat;
  bool ComparesEnds = false; // of two inputs: gives TransportCost and Displacement
};

// The outputs of vtkTransportBlend: the density on port 0, the particles on port 1.
struct BlendOutput
{
  explicit BlendOutput(vtkInformationVector* outputs);

  vtkInformation* Announced; // the pipeline information of the density
  vtkImageData* Density;
  vtkPolyData* Particles;
};

// On all ranks.
struct BlendReport
{
  std::int64_t Particles = 0;
  std::int64_t Moved = 0;         // out of empty cells of the densities, by new maps
  std::vector<std::string> Steps; // a warning for each new map that does not keep its tolerance
};

struct BlendMass
{
  double All;
  double Each; // of a particle
};

class DensityBlend
{
public:
  // Keeps the maps of these inputs for the next call. Builds tables in `tables` and releases them.
  // Each rank gets the part of the image that it wants and the particles at positions that it owns.
  // Collective. Throws Failure, which names the input, and Cancelled.
  BlendReport Run(const std::vector<BlendInput>& inputs, const BlendSettings& settings,
    FlowCache& tables, Progress& progress, const BlendOutput& output);

private:
  std::size_t MatchMaps(const std::vector<BlendInput>& inputs,
    const LinearizedMapSettings& settings, Progress& progress);
  // Returns how many particles of this rank the new maps moved, and their warnings.
  BlendReport MakeMaps(const std::vector<BlendInput>& inputs, const LinearizedMapSettings& settings,
    FlowCache& tables, Progress& progress);
  const LinearizedMap& MapOf(std::size_t input) const;
  // With an optimal map or its bound: finds the particles' positions anew where anything that they
  // depend on has changed. Else takes those of the maps. Adds warnings.
  std::shared_ptr<const BlendPositions> FindPositions(const std::vector<BlendInput>& inputs,
    const BlendSettings& settings, const ImageGrid& geometry, std::int64_t particles,
    Progress& progress, std::vector<std::string>& warnings);
  void TakeMeans(
    const std::vector<BlendInput>& inputs, const BlendPositions& found, Progress& progress);
  double TotalMass(const std::vector<BlendInput>& inputs, BlendedMass mode) const;
  void WriteParticles(const std::vector<BlendInput>& inputs, const BlendPositions& found,
    const ImageGrid& geometry, double massEach, Progress& progress, vtkPolyData* output);
  void WriteVertices(Progress& progress, vtkPolyData* output);
  void WriteDensity(const std::vector<BlendInput>& inputs, const BlendPositions& found,
    const SplatTarget& target, const BlendMass& mass, Extent wanted, Progress& progress,
    vtkImageData* output);

  std::vector<StoreSlot> Maps;            // by the inputs
  StoreSlot Found;                        // BlendPositions
  vtkSmartPointer<vtkCellArray> Vertices; // reused while the number of particles is the same
  // The arrays of the last output, reused if they have no other owner: the system clears new
  // memory, and that takes as long as all other work after the maps.
  vtkSmartPointer<vtkDoubleArray> Means;
  vtkSmartPointer<vtkDoubleArray> Masses;
  vtkSmartPointer<vtkDoubleArray> Density;
};

} // namespace RectifiedTransport::Bridge

#endif
