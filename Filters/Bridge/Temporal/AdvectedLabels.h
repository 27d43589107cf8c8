// SPDX-License-Identifier: BSD-3-Clause
// Arrays of two images that have nothing between their values: integers, bits and texts. They move
// along with the mass.
#ifndef RectifiedTransport_AdvectedLabels_h
#define RectifiedTransport_AdvectedLabels_h

#include "Bridge/Ranks/TupleBoxes.h"
#include "Bridge/Temporal/LabelVotes.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"

#include "vtkAbstractArray.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
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

struct AdvectedMoment;
struct AdvectedImage;
struct MovingParticles;

// Whether the values of an array are labels.
bool isOfLabels(vtkAbstractArray* array);

// A particle brings the tuple of the cell, or nearest point, of its own step; one of both steps
// brings both tuples, with its mass divided by the time. A cell or point gets the tuple that has
// most of the mass there; of two that have as much, that of the first step. Without mass, it gets
// the tuple at the place itself, of the nearer step.
class AdvectedLabels
{
public:
  // Takes arrays of the points or cells (`owner`) of both images. Throws Failure.
  void Make(int owner, const std::vector<std::string>& names, const AdvectedImage& first,
    const AdvectedImage& second, const MovingParticles& particles);
  // Adds the arrays on an extent of the image. Collective. The same for every number of threads and
  // ranks. Throws Failure and Cancelled.
  void Write(const AdvectedMoment& moment, const ImageGrid& geometry, const Extent& wanted,
    Progress& progress, vtkImageData* output) const;
  bool IsEmpty() const { return this->Arrays.empty(); }

private:
  struct Labels
  {
    std::string Name;
    std::array<vtkSmartPointer<vtkAbstractArray>, 2> Arrays; // of the first and the second image
    // For each tuple, those of the first array before those of the second one: the number of the
    // first equal one.
    std::vector<vtkIdType> Equal;
  };

  vtkIdType InPlace(
    const ImageGrid& grid, const TupleBox& box, std::int64_t number, double part) const;

  int Owner = 0;                  // vtkDataObject::POINT or CELL
  std::array<ImageGrid, 2> Grids; // their cells have the tuples
  BroughtTuples OfParticles;
  std::vector<Labels> Arrays;
};

} // namespace RectifiedTransport::Bridge

#endif
