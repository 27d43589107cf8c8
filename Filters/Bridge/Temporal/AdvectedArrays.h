// SPDX-License-Identifier: BSD-3-Clause
// The other arrays of two images, whose values move along with the mass.
#ifndef RectifiedTransport_AdvectedArrays_h
#define RectifiedTransport_AdvectedArrays_h

#include "Bridge/Ranks/DistributedSplat.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Series/SeriesLabels.h"
#include "Core/Series/SeriesParticles.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// The image of a step, and the name of its density's array, which is not advected.
struct AdvectedImage
{
  vtkSmartPointer<vtkImageData> Image;
  ImageGrid Grid; // with the density's association
  std::string Density;
};

// Arrays of two images that have nothing between their values: integers, bits and texts. They move
// along with the mass. See SeriesLabels.
class AdvectedLabels
{
public:
  // Takes arrays of the points or cells (`owner`) of both images. Throws Failure.
  void Make(int owner, const std::vector<std::string>& names, const AdvectedImage& first,
    const AdvectedImage& second, const SeriesParticles& particles);
  // Adds the arrays on an extent of the image. Collective. The same for every number of threads and
  // ranks. Throws Failure and Cancelled.
  void Write(const SeriesSnapshot& moment, const ImageGrid& geometry, const Extent& wanted,
    Progress& progress, vtkImageData* output) const;

private:
  struct Labels
  {
    std::string Name;
    std::array<vtkSmartPointer<vtkAbstractArray>, 2> Arrays; // first and second image
  };

  int Owner = 0; // vtkDataObject::POINT or CELL
  SeriesLabels OfParticles;
  std::vector<Labels> Arrays;
  std::vector<std::vector<std::int64_t>> Equal; // one list an array, see findEqual
};

// Adds the arrays of an image that may be advected, as they are, to an output: those with a name,
// but neither the density nor ghosts.
void passAdvected(const AdvectedImage& image, vtkImageData* output);

// A floating-point value is the mean, by mass, of those of the particles around a cell or point.
// Each of them moves linearly in time from the value where the particle begins to that where it
// ends. Where there is no mass, the value at the place itself does so. Other arrays are labels.
class AdvectedArrays
{
public:
  // Takes the arrays that both images have with one type and number of components. Throws Failure
  // and Cancelled.
  void Make(const AdvectedImage& first, const AdvectedImage& second,
    const SeriesParticles& particles, const ImageGrid& geometry, Progress& progress);
  // The names of arrays that one of the two lacks.
  const std::vector<std::string>& Missing() const { return this->MissingNames; }
  // Adds the arrays on an extent of the image. Collective.
  void Write(const SeriesSnapshot& moment, const ImageGrid& geometry, const SplatOptions& splat,
    const Extent& wanted, Progress& progress, vtkImageData* output) const;

private:
  using Ends = std::array<vtkSmartPointer<vtkDoubleArray>, 2>; // in the first and the second image
  struct Advected
  {
    std::string Name;
    int Owner;                              // vtkDataObject::POINT or CELL
    vtkSmartPointer<vtkAbstractArray> Like; // for the type and the names of components
    Ends OfParticles;
    Ends InPlace; // the values at the tuples of the whole geometry
  };
  void MakeOf(int owner, const AdvectedImage& first, const AdvectedImage& second,
    const SeriesParticles& particles, const ImageGrid& geometry, Progress& progress);
  void WriteOne(const Advected& advected, const SeriesSnapshot& moment, const SplatTarget& target,
    const TupleBox& wanted, vtkDoubleArray* mass, Progress& progress, vtkImageData* output) const;

  std::vector<Advected> Arrays;
  std::array<AdvectedLabels, 2> Labels; // cells, then points
  std::vector<std::string> MissingNames;
};

} // namespace RectifiedTransport::Bridge

#endif
