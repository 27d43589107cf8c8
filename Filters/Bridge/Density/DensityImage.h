// SPDX-License-Identifier: BSD-3-Clause
// An array of an image as a density.
#ifndef RectifiedTransport_DensityImage_h
#define RectifiedTransport_DensityImage_h

#include "Bridge/Density/InputDensity.h"
#include "Core/Tables/Reading/DensityReader.h"
#include "Core/Tables/Reading/OccupiedCells.h"

#include <memory>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

class DensityImage : public InputDensity
{
public:
  // `array` is point or cell data of `image`. Throws Failure for errors that do not depend on its
  // values.
  DensityImage(vtkImageData* image, vtkDataArray* array, bool onPoints, const DensityRules& rules);

  std::string NameOfArray() const override;
  void Prepare(FlowTables tables, Progress& progress) override;
  const DensityValues* Values() const override { return this->Reader.get(); }
  std::shared_ptr<const DensityValues> Part(
    const GridSize<3>& /*low*/, const GridSize<3>& /*high*/) const override
  {
    return { std::shared_ptr<void>(), this->Values() };
  }
  vtkSmartPointer<vtkImageData> ImageIn(const Extent& extent) const override;
  void SampleArrays(const Extent& extent, ConstPointSpan<3> particles, Progress& progress,
    vtkPointData* output) const override;

  // For a part of a whole image, instead of Prepare: find the largest and the clamped values, by
  // their numbers in the part; set the white of the whole image, with which values are read from
  // then on; find the cells of boxes that are not empty, and set what the others count as.
  LargestValue FindWhite(Progress& progress);
  void SetWhite(double white, Progress& progress);
  LowestValue FindClamped(Progress& progress) const;
  OccupiedCells Occupied(const std::vector<TupleBox>& boxes, Progress& progress) const;
  void SetEmpty(double density);

private:
  std::uint64_t Fingerprint(Progress& progress) const override;
  TupleBox AllTuples() const;
  void BlankCellsOfHiddenPoints(Progress& progress);

  const vtkSmartPointer<vtkImageData> Input;
  const vtkSmartPointer<vtkDataArray> Array;
  std::unique_ptr<DensityReader> Reader;
  std::array<vtkSmartPointer<vtkDataArray>, 3> Sources; // the array, the ghost arrays or null

  // If the density is cell data: ghost flags of the cells and of the points.
  const unsigned char* CellFlags = nullptr;
  const unsigned char* HiddenPoints = nullptr;
  std::vector<unsigned char> CombinedFlags; // both kinds of flags, from BlankCellsOfHiddenPoints on
};

} // namespace RectifiedTransport::Bridge

#endif
