// SPDX-License-Identifier: BSD-3-Clause
// The density of an input of a filter, wherever its values are: what the workers of filters take.
#ifndef RectifiedTransport_InputDensity_h
#define RectifiedTransport_InputDensity_h

#include "Bridge/Density/DensityReader.h"
#include "Bridge/Density/UnusualValues.h"
#include "Bridge/Ranks/TupleBoxes.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Flow/FlowTables.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/Points.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkPointData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class ImagePieces;
class Progress;

// Prepare, GetContent and what is marked so are collective, where the values lie on several ranks.
class InputDensity
{
public:
  // The modification times of the array, the ghost arrays and the image itself.
  using Times = std::array<std::uint64_t, 4>;
  // All that the tables of a density depend on: a hash of the values and the ghost arrays, and the
  // parameters of reading them. The hash is 0 if an array is not contiguous in memory.
  using Content = std::array<std::uint64_t, 12>;

  virtual ~InputDensity();
  InputDensity(const InputDensity&) = delete;
  InputDensity& operator=(const InputDensity&) = delete;

  const ImageGrid& Grid() const { return this->Geometry; }
  // What messages call it.
  const std::string& GetName() const { return this->Name; }
  const Times& GetTimes() const { return this->Changed; }
  // The content without the hash.
  const Content& GetReading() const { return this->Reading; }
  // Computed once, as the work of the current stage. Throws Cancelled.
  const Content& GetContent(Progress& progress);

  // Computes what reading for such tables needs of all values, such as the largest one. To be
  // called before Values and Source. Throws Failure and Cancelled.
  virtual void Prepare(FlowTables tables, Progress& progress) = 0;
  // The values of all cells; nullptr where they lie on several ranks.
  virtual const DensityValues* Values() const = 0;
  template <int D>
  DensitySource<D> Source() const
  {
    const GridSize<D> size = this->Geometry.Size<D>();
    return this->Values() ? DensitySource<D>(size, *this->Values())
                          : DensitySource<D>(size, *std::get<D - 1>(this->Distributed()));
  }
  // Gives up what Prepare gathered; Source needs it.
  virtual void ReleaseGathered() {}

  // Which part of the image each rank has; nullptr where each has all.
  virtual const ImagePieces* Pieces() const { return nullptr; }
  // The image on the grid in an extent, with all arrays of the input. Collective.
  virtual vtkSmartPointer<vtkImageData> ImageIn(const Extent& extent) const = 0;
  // Gives particles in the image in an extent the values of the arrays of the input, as the work of
  // the stages up to the progress 1. Collective. Throws Failure and Cancelled.
  virtual void SampleArrays(const Extent& extent, ConstPointSpan<3> particles, Progress& progress,
    vtkPointData* output) const = 0;

  // What Prepare found of the values: all but the summary of the densities.
  const UnusualValues& Unusual() const { return this->Known; }
  // What precedes a line where a filter has several inputs.
  void SetInputName(const std::string& name) { this->InputName = name; }
  // Who hears of values that are probably not meant, in a line each, and of the content that they
  // are in; without lines the content is not given.
  using Listener =
    std::function<void(const std::vector<std::string>& lines, const Content& content)>;
  void SetListener(const Listener& listener) { this->Tell = listener; }
  // To be called once the values have been read, by this filter or another one. Collective.
  void TellUnusual(const UnusualValues& values, Progress& progress);

  // Throws the Failure for values that are no density.
  [[noreturn]] void ThrowInvalid(const DensitySummary& summary) const;

protected:
  // What differs between arrays of one name.
  struct ArrayForm
  {
    int Type;
    int Components;
    bool HasPointGhosts;
    bool HasCellGhosts;
  };
  using AnyDistributed = std::tuple<const DistributedDensity<1>*, const DistributedDensity<2>*,
    const DistributedDensity<3>*>;

  InputDensity(const std::string& name, const DensityRules& rules);
  // Once, with the grid.
  void SetForm(const ArrayForm& form);
  int Components() const { return static_cast<int>(this->Reading[2]); }
  bool NeedsWhite() const;
  bool Clamps() const { return this->Rules.ClampNegative && !this->Rules.Invert; }
  // What is read as white, once Known has it.
  double White() const;
  // What there is to tell of values, in lines.
  virtual std::vector<std::string> Describe(const UnusualValues& values) const;

  ImageGrid Geometry;
  const DensityRules Rules;
  Times Changed{};
  UnusualValues Known;

private:
  virtual std::uint64_t Fingerprint(Progress& progress) const = 0;
  virtual AnyDistributed Distributed() const { return {}; }

  const std::string Name;
  std::string InputName;
  Listener Tell;
  bool MayBeBlank = false; // by ghost arrays
  Content Reading{};
  Content Hashed{}; // all 0 before GetContent
};

} // namespace RectifiedTransport

#endif
