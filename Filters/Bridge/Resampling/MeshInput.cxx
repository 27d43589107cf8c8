// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Resampling/MeshInput.h"

#include "Bridge/Lattices/PlacesInLattice.h"
#include "Bridge/Points/SampledArrays.h"
#include "Bridge/Resampling/PlacesInMeshes.h"
#include "Core/Parallel/Progress.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

namespace RectifiedTransport
{

MeshInput::MeshInput(const ResampledDensity& made, const DensityRules& rules)
  : DensityImage(
      made.Image(), made.Array(), made.IsOnPoints(), made.IsResampled() ? DensityRules() : rules)
  , Made(made)
{
}

void MeshInput::SampleArrays(
  const Extent& extent, ConstPointSpan<3> particles, Progress& progress, vtkPointData* output) const
{
  if (!this->Made.IsResampled())
  {
    DensityImage::SampleArrays(extent, particles, progress, output);
    return;
  }
  const std::vector<BlockValues>& meshes = this->Made.Meshes();
  constexpr double partOfSearch = 0.5;
  progress.BeginStage(progress.StageEnd() + partOfSearch * (1.0 - progress.StageEnd()));
  ArraySource source{ {}, "input", false };
  for (const BlockValues& mesh : meshes)
  {
    source.Sets.push_back(mesh.Data());
  }
  if (const CellLattice* lattice = meshes.front().Lattice())
  {
    const PlacesInLattice places(*lattice, meshes, particles, progress);
    sampleArrays(source, places, progress, 1.0, output);
    return;
  }
  const PlacesInMeshes places(meshes, this->Grid(), particles, progress);
  sampleArrays(source, places, progress, 1.0, output);
}

std::vector<std::string> MeshInput::Describe(const UnusualValues& values) const
{
  return this->Made.IsResampled() ? this->Made.Findings() : DensityImage::Describe(values);
}

} // namespace RectifiedTransport
