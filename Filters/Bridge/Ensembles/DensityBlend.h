// SPDX-License-Identifier: BSD-3-Clause
// Interpolates densities by their maps from one pivot: the weighted means of the particles'
// positions, as points and as a density (Sections 3.4, 5.2 and 5.3). Each rank maps its share of
// the particles and keeps it.
#ifndef RectifiedTransport_DensityBlend_h
#define RectifiedTransport_DensityBlend_h

#include "Bridge/Ensembles/BlendPositions.h"
#include "Bridge/VTKCompatibility.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
class vtkImageData;
class vtkInformationVector;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

class DensityBlend
{
public:
  // Keeps the maps of these inputs for the next call. Builds tables in `tables` and releases them.
  // The outputs are those of vtkTransportBlend: the density on port 0, the particles on port 1.
  // Each rank gets the part of the image that it wants and the particles at positions that it owns.
  // Collective. Throws Failure, which names the input, and Cancelled.
  BlendReport Run(const std::vector<BlendInput>& inputs, const BlendSettings& settings,
    FlowCache& tables, Progress& progress, vtkInformationVector* outputs);

private:
  void TakeMeans(const BlendRun& run, const BlendPositions& found, Progress& progress);
  void WriteParticles(const BlendRun& run, const BlendPositions& found, double mass,
    Progress& progress, vtkPolyData* output);
  void WriteDensity(const BlendRun& run, const BlendPositions& found, double mass,
    Progress& progress, vtkImageData* output);

  LinearizedMaps Maps;
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
