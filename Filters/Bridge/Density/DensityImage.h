// SPDX-License-Identifier: BSD-3-Clause
// An array of an image as a density: its grid, its values, and what identifies its content.
#ifndef RectifiedTransport_DensityImage_h
#define RectifiedTransport_DensityImage_h

#include "Bridge/Density/DensityReader.h"
#include "Bridge/Density/UnusualValues.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class ImagePieces;
class Progress;

class DensityImage
{
public:
  // The modification times of the array, the ghost arrays and the image itself.
  using Times = std::array<std::uint64_t, 4>;
  // All that the tables of a density depend on: a hash of the values and the ghost arrays, and the
  // parameters of reading them. The hash is 0 if an array is not contiguous in memory.
  using Content = std::array<std::uint64_t, 12>;

  // `array` is point or cell data of `image`. Throws Failure for errors that do not depend on its
  // values.
  DensityImage(vtkImageData* image, vtkDataArray* array, bool onPoints, const DensityRules& rules);
  // Of an image that lies on several ranks, all of which make it and call Prepare and GetContent
  // together; `name` is that of the array.
  DensityImage(std::unique_ptr<const ImagePieces> pieces, const std::string& name, bool onPoints,
    const DensityRules& rules);
  ~DensityImage();
  DensityImage(const DensityImage&) = delete;
  DensityImage& operator=(const DensityImage&) = delete;

  const ImageGrid& Grid() const { return this->Geometry; }
  vtkImageData* Image() const;
  // Where the image lies on several ranks; else nullptr.
  const ImagePieces* Pieces() const { return this->Distribution.get(); }
  // What messages call it.
  const std::string& GetName() const { return this->Name; }
  const Times& GetTimes() const { return this->Changed; }
  // The content without the hash.
  const Content& GetReading() const { return this->Reading; }
  // Computed once, as the work of the current stage. Throws Cancelled.
  const Content& GetContent(Progress& progress);

  // Computes what reading needs of all values, such as the largest one. To be called before Source.
  // Of an image on several ranks, it gathers the whole image on each.
  void Prepare(Progress& progress);
  template <int D>
  DensitySource<D> Source() const
  {
    return { this->Geometry.Size<D>(), this->Values() };
  }
  const DensityValues& Values() const
  {
    return this->Gathered ? this->Gathered->Values() : *this->Reader;
  }

  // Gives up what Prepare gathered; Source needs it.
  void ReleaseGathered();

  // In place of Prepare, for an image on several ranks: none of them gets all of it.
  void PrepareShared(Progress& progress);
  // The part of it in an extent, after PrepareShared; each rank may want another one.
  std::unique_ptr<DensityImage> GatherBox(const std::array<int, 6>& extent) const;

  // What Prepare or PrepareShared found of the values, which is all but the summary of the
  // densities.
  const UnusualValues& Unusual() const;
  // Of data sets that were resampled: what messages say of their values.
  void SetFindings(const std::vector<std::string>& lines);
  // What precedes a line where a filter has several inputs.
  void SetInputName(const std::string& name) { this->InputName = name; }
  // Who hears of values that are probably not meant, in a line each, and of the content that they
  // are in; without lines the content is not given.
  using Listener =
    std::function<void(const std::vector<std::string>& lines, const Content& content)>;
  void SetListener(const Listener& listener) { this->Tell = listener; }
  // Called once the values have been read, by this filter or another one; by all ranks.
  void TellUnusual(const UnusualValues& values, Progress& progress);

  // Throws the Failure for values that are no density.
  [[noreturn]] void ThrowInvalid(const DensitySummary& summary) const;

private:
  void FindReading();
  std::unique_ptr<DensityImage> GatherPart(const std::array<int, 6>& extent) const;
  bool NeedsWhite() const;
  void FindBlanks(vtkImageData* image);
  void BlankCellsOfHiddenPoints(Progress& progress);
  LargestValue FindWhite(Progress& progress) const;
  LowestValue FindClamped(Progress& progress) const;
  double White() const;
  std::vector<std::string> Describe(const UnusualValues& values) const;

  ImageGrid Geometry;
  vtkSmartPointer<vtkImageData> Input;
  vtkSmartPointer<vtkDataArray> Array;
  const std::unique_ptr<const ImagePieces> Distribution;
  const std::string ArrayName; // where there are pieces
  UnusualValues Known;
  std::vector<std::string> Findings;
  bool HasFindings = false;
  std::string InputName;
  Listener Tell;
  std::unique_ptr<DensityImage> Gathered; // after Prepare
  const DensityRules Rules;
  const std::string Name;
  std::unique_ptr<DensityReader> Reader;
  std::array<vtkSmartPointer<vtkDataArray>, 3> Sources; // the array, the ghost arrays or null
  Times Changed;
  Content Reading;
  Content Hashed{}; // all 0 before GetContent

  // Ghost flags of the cells and of the points, where the density is cell data.
  const unsigned char* CellFlags = nullptr;
  const unsigned char* HiddenPoints = nullptr;
  std::vector<unsigned char> CombinedFlags; // of both, from BlankCellsOfHiddenPoints on
};

} // namespace RectifiedTransport

#endif
