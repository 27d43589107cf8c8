// SPDX-License-Identifier: BSD-3-Clause
// An array of an image as a density: where its cells lie, what they hold, and what tells it from
// another one.
#ifndef RectifiedTransport_DensityImage_h
#define RectifiedTransport_DensityImage_h

#include "Bridge/Density/DensityReader.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class Progress;

class DensityImage
{
public:
  // When the array, the ghost arrays and the image itself last changed.
  using Times = std::array<std::uint64_t, 4>;
  // All that the tables of a density depend on: the bits of the values and of the ghost arrays, as
  // a hash, and how they are read. The hash is 0 if the values are not in memory as they are.
  using Content = std::array<std::uint64_t, 12>;

  // Throws Failure where the array cannot be a density whatever its values. `array` belongs to the
  // points or the cells of `image`.
  DensityImage(vtkImageData* image, vtkDataArray* array, bool onPoints, const DensityRules& rules);
  ~DensityImage();
  DensityImage(const DensityImage&) = delete;
  DensityImage& operator=(const DensityImage&) = delete;

  const ImageGrid& Grid() const { return this->Place; }
  const Times& GetTimes() const { return this->Changed; }
  // The content without the hash.
  const Content& GetReading() const { return this->Reading; }
  // Found once, as the work of the current stage. Throws Cancelled.
  const Content& GetContent(Progress& progress);

  // Finds what single cells cannot tell, such as the largest value. Call it before reading.
  void Prepare(Progress& progress);
  template <int D>
  DensitySource<D> Source() const
  {
    return { this->Place.Size<D>(), *this->Reader };
  }

  // Throws the Failure that says what is wrong with the density, in the user's terms.
  [[noreturn]] void Explain(const DensitySummary& summary) const;

private:
  void FindBlanks(vtkImageData* image);
  void BlankCellsOfHiddenPoints(Progress& progress);
  double FindWhite(Progress& progress) const;

  ImageGrid Place;
  vtkSmartPointer<vtkDataArray> Array;
  const DensityRules Rules;
  const std::string Name;
  std::unique_ptr<DensityReader> Reader;
  std::array<vtkSmartPointer<vtkDataArray>, 3> Sources; // all that is read; some may be null
  Times Changed;
  Content Reading;
  Content Hashed{}; // all 0 before GetContent

  const unsigned char* CellFlags = nullptr;    // of an array of the cells
  const unsigned char* HiddenPoints = nullptr; // beside it
  std::vector<unsigned char> CombinedFlags;
};

} // namespace RectifiedTransport

#endif
