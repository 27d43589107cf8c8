// SPDX-License-Identifier: BSD-3-Clause
// An array of a distributed image as a density.
#ifndef RectifiedTransport_PartitionedDensity_h
#define RectifiedTransport_PartitionedDensity_h

#include "Bridge/Density/DensityImage.h"
#include "Bridge/Density/InputDensity.h"

#include <memory>

namespace RectifiedTransport::Bridge
{

class PartitionedDensity final : public InputDensity
{
public:
  // `name` is the array's name. Collective. Throws Failure for errors that do not depend on the
  // values.
  PartitionedDensity(std::unique_ptr<const ImagePieces> pieces, const std::string& name,
    bool onPoints, const DensityRules& rules);
  ~PartitionedDensity() override;

  // For whole tables it gathers the whole image on each rank; otherwise no rank gets all of it.
  std::string NameOfArray() const override { return this->ArrayName; }
  void Prepare(FlowTables tables, Progress& progress) override;
  const DensityValues* Values() const override;
  std::shared_ptr<const DensityValues> Part(
    const GridSize<3>& low, const GridSize<3>& high) const override;
  void ReleaseGathered() override { this->Gathered.reset(); }

  const ImagePieces* Pieces() const override { return this->Distribution.get(); }
  vtkSmartPointer<vtkImageData> ImageIn(const Extent& extent) const override;
  void SampleArrays(const Extent& extent, ConstPointSpan<3> particles, Progress& progress,
    vtkPointData* output) const override;

private:
  std::uint64_t Fingerprint(Progress& progress) const override;
  const std::vector<Extent>& Extents() const; // one a rank
  const Extent& OwnExtent() const;
  vtkDataArray* ArrayIn(vtkImageData* image) const;
  std::vector<TupleBox> OwnTuples() const;
  std::unique_ptr<DensityImage> Gather(const Extent& extent) const;
  void PreparePieces(Progress& progress);

  const std::unique_ptr<const ImagePieces> Distribution;
  const std::string ArrayName;
  std::unique_ptr<DensityImage> Gathered; // all of it, if needed
};

} // namespace RectifiedTransport::Bridge

#endif
