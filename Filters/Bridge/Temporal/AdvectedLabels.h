// SPDX-License-Identifier: BSD-3-Clause
// Arrays of two images that have nothing between their values: integers, bits and texts. They move
// along with the mass.
#ifndef RectifiedTransport_AdvectedLabels_h
#define RectifiedTransport_AdvectedLabels_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Series/SeriesLabels.h"

#include "vtkAbstractArray.h"
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

struct AdvectedImage;

// An array of the type and the components of another one. Throws Failure.
vtkSmartPointer<vtkAbstractArray> newLike(
  vtkAbstractArray* array, const std::string& name, vtkIdType tuples);

// Whether the values of an array are labels.
bool isOfLabels(vtkAbstractArray* array);

// See SeriesLabels.
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

} // namespace RectifiedTransport::Bridge

#endif
