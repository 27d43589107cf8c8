// SPDX-License-Identifier: BSD-3-Clause
// An array of a distributed image as a density.
#ifndef RectifiedTransport_PiecesDensity_h
#define RectifiedTransport_PiecesDensity_h

#include "Bridge/Density/DensityImage.h"
#include "Bridge/Density/InputDensity.h"

#include <memory>

namespace RectifiedTransport::Bridge
{

class PiecesDensity final : public InputDensity
{
public:
  // `name` is the array's name. Collective. Throws Failure for errors that do not depend on the
  // values.
  PiecesDensity(std::unique_ptr<const ImagePieces> pieces, const std::string& name, bool onPoints,
    const DensityRules& rules);
  ~PiecesDensity() override;

  // For whole tables it gathers the whole image on each rank; otherwise no rank gets all of it.
  std::string NameOfArray() const override { return this->ArrayName; }
  void Prepare(FlowTables tables, Progress& progress) override;
  const DensityValues* Values() const override;
  void ReleaseGathered() override { this->Gathered.reset(); }

  const ImagePieces* Pieces() const override { return this->Distribution.get(); }
  vtkSmartPointer<vtkImageData> ImageIn(const Extent& extent) const override;
  void SampleArrays(const Extent& extent, ConstPointSpan<3> particles, Progress& progress,
    vtkPointData* output) const override;

private:
  // Boxes of grid cells, for the core.
  template <int D>
  class Boxes final : public DistributedDensity<D>
  {
  public:
    explicit Boxes(const PiecesDensity& density)
      : Density(density)
    {
    }
    std::shared_ptr<const DensityValues> Gather(
      const GridSize<D>& low, const GridSize<D>& high) const override;

  private:
    const PiecesDensity& Density;
  };

  std::uint64_t Fingerprint(Progress& progress) const override;
  AnyDistributed Distributed() const override
  {
    return { &this->Line, &this->Plane, &this->Space };
  }
  const Extent& OwnExtent() const;
  std::vector<TupleBox> OwnTuples() const;
  std::unique_ptr<DensityImage> Gather(const Extent& extent) const;
  void PreparePieces(Progress& progress);

  const std::unique_ptr<const ImagePieces> Distribution;
  const std::string ArrayName;
  std::unique_ptr<DensityImage> Gathered; // all of it, if needed
  const Boxes<1> Line{ *this };
  const Boxes<2> Plane{ *this };
  const Boxes<3> Space{ *this };
};

} // namespace RectifiedTransport::Bridge

#endif
