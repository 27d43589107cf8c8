// SPDX-License-Identifier: BSD-3-Clause
// An array of an image as the density that the core reads, without a copy.
#ifndef RectifiedTransport_DensityImage_h
#define RectifiedTransport_DensityImage_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Tables/Density.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

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

class DensityReader;
class Executor;
class Progress;

// How the values of an array become a density; see vtkDensityAlgorithm.
struct DensityRules
{
  int Component = -1;
  bool Invert = false;
  bool ClampNegative = false;
};

class DensityImage final : public DensityValues
{
public:
  // What makes two densities the same one, the time of the image aside.
  using Identity = std::array<std::uint64_t, 12>;

  // Throws Failure where the array cannot be a density whatever its values. `array` belongs to the
  // points or the cells of `image`.
  DensityImage(vtkImageData* image, vtkDataArray* array, bool onPoints, const DensityRules& rules);
  ~DensityImage() override;
  DensityImage(const DensityImage&) = delete;
  DensityImage& operator=(const DensityImage&) = delete;

  const ImageGrid& Geometry() const { return this->Place; }
  const Identity& GetIdentity() const { return this->Key; }
  // When the image itself last changed.
  std::uint64_t ImageTime() const { return this->Time; }
  // Of the array's values and the ghost arrays, as the function of that name gives it.
  std::uint64_t Fingerprint(Progress& progress) const;
  // Whether its values are those of points.
  bool IsOnPoints() const { return this->OnPoints; }

  // Finds what single rows cannot tell, such as the largest value. Call it before reading.
  void Prepare(Progress& progress);

  void Read(std::int64_t first, std::int64_t count, double* values) const override;

  // Throws the Failure that says what is wrong with the density, in the user's terms.
  [[noreturn]] void Explain(const DensitySummary& summary) const;

private:
  void FindBlanks(vtkImageData* image, bool onPoints);
  void BlankCellsOfHiddenPoints(Progress& progress);
  void FindWhite(Progress& progress);
  bool IsBlank(std::int64_t cell) const;

  ImageGrid Place;
  bool OnPoints;
  vtkSmartPointer<vtkDataArray> Array;
  std::unique_ptr<DensityReader> Reader;
  DensityRules Rules;
  std::string Name;
  Identity Key;
  std::uint64_t Time;
  std::array<vtkSmartPointer<vtkDataArray>, 3> Sources; // all that is read; some may be null
  double White = 0.0;

  // Cells without mass: those whose flags meet the mask.
  const unsigned char* Flags = nullptr;
  unsigned char FlagMask = 0;
  const unsigned char* HiddenPoints = nullptr;
  std::vector<unsigned char> CombinedFlags;
};

} // namespace RectifiedTransport

#endif
