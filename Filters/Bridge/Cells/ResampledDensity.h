// SPDX-License-Identifier: BSD-3-Clause
// Any data object with a density, as an image with a density.
#ifndef RectifiedTransport_ResampledDensity_h
#define RectifiedTransport_ResampledDensity_h

#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/Cells/BlockValues.h"
#include "Bridge/Density/InputDensity.h"
#include "Core/Resampling/CellLattice.h"
#include "Core/Resampling/CellPieces.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class ClosedSurface;

// Keeps the last image. It is made again only if the data sets or the parameters change.
class ResampledDensity
{
public:
  // Images that tile a lattice are joined, closed surfaces filled and other data sets resampled
  // with `resolution` cells. The density is valid until the next Read. Throws Failure and
  // Cancelled.
  std::unique_ptr<InputDensity> Read(
    const DensityBlocks& blocks, int resolution, const DensityRules& rules, Progress& progress);

  // Warnings about data that carry no mass.
  const std::vector<std::string>& Warnings() const { return this->Lost; }

private:
  class Density;

  void FillSurfaces(const std::vector<DensityBlock>& surfaces, int resolution, Progress& progress);
  void Resample(
    const DensityBlocks& blocks, int resolution, const DensityRules& rules, Progress& progress);
  CellSize AddCells(const ImageGrid& grid, const std::vector<CellValues>& cells, Progress& progress,
    double* values) const;
  void FillEmpty(const ImageGrid& grid, const EmptyRule& rule, Progress& progress, double* values);

  DataIdentity Content; // what the last Read got
  DensityReading How;   // how resampled data were read
  vtkSmartPointer<vtkImageData> Image;
  // If the image was resampled: the data sets with mass, the lattice of their cells if they form
  // one, and findings about values that are probably not meant.
  BlockValues Blocks;
  std::optional<CellLattice> Lattice;
  std::vector<std::string> Suspect;
  std::vector<std::string> Lost;
  double Empty = 0.0;                           // the density of what their cells do not cover
  std::shared_ptr<const ClosedSurface> Surface; // around a solid, in index space
};

} // namespace RectifiedTransport::Bridge

#endif
