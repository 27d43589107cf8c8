// SPDX-License-Identifier: BSD-3-Clause
// Any data object with a density, as an image with a density.
#ifndef RectifiedTransport_ResampledDensity_h
#define RectifiedTransport_ResampledDensity_h

#include "Bridge/Blocks/BlockValues.h"
#include "Bridge/Blocks/DataContent.h"
#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/Density/DensityReader.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class Progress;

// Keeps the last image. It is made again only if the data sets or the parameters change.
class ResampledDensity
{
public:
  // The arrays of the blocks have one name and association; at least one block has an array. Blocks
  // without it carry no mass but are part of the domain. Throws Failure and Cancelled.
  void Update(const std::vector<DensityBlock>& blocks, bool onPoints, int dimension, int resolution,
    const DensityRules& rules, Progress& progress);

  vtkImageData* Image() const;
  vtkDataArray* Array() const { return this->Density; }
  bool IsOnPoints() const { return this->OnPoints; }
  // Whether the image's values are already densities, with the rules applied: the data sets are not
  // images that tile a lattice.
  bool IsResampled() const { return this->Resampled; }
  // The data sets, if the image was resampled.
  const std::vector<BlockValues>& Meshes() const { return this->Blocks; }
  // Warnings about data that carry no mass.
  const std::vector<std::string>& Warnings() const { return this->Lost; }
  // Findings about values that are probably not meant, if the image was resampled.
  const std::vector<std::string>& Findings() const { return this->Unusual; }

private:
  bool Join(const std::vector<DensityBlock>& blocks, bool onPoints);
  void Resample(const std::vector<DensityBlock>& blocks, bool onPoints, int dimension,
    int resolution, const DensityRules& rules, Progress& progress);
  void Attach(const std::vector<DensityBlock>& blocks);

  DataContent Content; // of the last Update
  vtkSmartPointer<vtkImageData> Made;
  vtkDataArray* Density = nullptr;
  bool OnPoints = false;
  bool Resampled = false;
  std::vector<BlockValues> Blocks;
  std::vector<std::string> Unusual;
  std::vector<std::string> Lost;
};

} // namespace RectifiedTransport

#endif
