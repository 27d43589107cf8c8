// SPDX-License-Identifier: BSD-3-Clause
// Data sets that were resampled to an image, as a density.
#ifndef RectifiedTransport_MeshInput_h
#define RectifiedTransport_MeshInput_h

#include "Bridge/Density/DensityImage.h"
#include "Bridge/Resampling/ResampledDensity.h"

namespace RectifiedTransport
{

class MeshInput final : public DensityImage
{
public:
  // `made` must outlive this object. The rules apply to images that tile a lattice.
  MeshInput(const ResampledDensity& made, const DensityRules& rules);

  // From the data sets, unless they are images that tile a lattice.
  void SampleArrays(const Extent& extent, ConstPointSpan<3> particles, Progress& progress,
    vtkPointData* output) const override;

protected:
  std::vector<std::string> Describe(const UnusualValues& values) const override;

  const ResampledDensity& Made;
};

} // namespace RectifiedTransport

#endif
