// SPDX-License-Identifier: BSD-3-Clause
// The density of a filter's input, local or distributed, as workers take it.
#ifndef RectifiedTransport_InputDensity_h
#define RectifiedTransport_InputDensity_h

#include "Bridge/Store/DataIdentity.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Flow/FlowTables.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/Points.h"
#include "Core/Tables/Density.h"
#include "Core/Tables/Reading/DensityRules.h"
#include "Core/Tables/Reading/SuspectValues.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
class vtkImageData;
class vtkPointData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class ImagePieces;

// How an array became a density.
struct DensityReading
{
  std::string ArrayName; // empty for an array without a name
  int Components = 1;    // the number of components of the array
  int Component = 0;     // the one that is taken: an index, Luminance or Magnitude
  bool IsInverted = false;
  std::array<double, 2> Range{}; // ValidRange
};
DensityReading readingBy(const DensityRules& rules, const std::string& arrayName, int components);
// The field data DensityArrayName, DensityComponent, DensityInverted and DensityRange of an output:
// one value for each density, two of DensityRange.
void addReadings(vtkDataObject* output, const std::vector<DensityReading>& readings);

// If the values are distributed over ranks, Prepare, Hash and methods marked so are
// collective.
class InputDensity
{
public:
  virtual ~InputDensity();
  InputDensity(const InputDensity&) = delete;
  InputDensity& operator=(const InputDensity&) = delete;

  const ImageGrid& Grid() const { return this->Geometry; }
  // The grid cells along each axis, 1 along axes that the grid lacks.
  GridSize<3> CellsInSpace() const;
  // vtkDataObject::POINT or CELL, by the values.
  int Owner() const;
  // Its name in messages.
  const std::string& GetName() const { return this->Name; }
  // The name of its array; empty if it has none.
  virtual std::string NameOfArray() const = 0;
  const DensityReading& HowRead() const { return this->Read; }
  // Hashes the values and the ghost arrays once; 0 if an array is not contiguous in memory.
  // Throws Cancelled.
  std::uint64_t Hash(Progress& progress) const;
  // All that the tables of a density depend on, to compare it with others while it is there;
  // hashing it is collective. Values that are no contiguous array in memory have no hash.
  DataIdentity Identity() const;

  // Computes what reading for such tables needs from all values, such as the largest value. Call it
  // before Values and Source. Throws Failure and Cancelled.
  virtual void Prepare(FlowTables tables, Progress& progress) = 0;
  // The values of all cells; nullptr if they are distributed over ranks.
  virtual const DensityValues* Values() const = 0;
  template <int D>
  DensitySource<D> Source() const
  {
    const GridSize<D> size = this->Geometry.Size<D>();
    return this->Values() ? DensitySource<D>(size, *this->Values())
                          : DensitySource<D>(size, std::get<Boxes<D>>(this->OnRanks));
  }
  // As DistributedDensity::Gather; axes that the grid lacks have the cells from 0 up to 1. Without
  // an owner where Values has all.
  virtual std::shared_ptr<const DensityValues> Part(
    const GridSize<3>& low, const GridSize<3>& high) const = 0;
  // Releases what Prepare gathered, which Source needs.
  virtual void ReleaseGathered() {}

  // Which part of the image each rank has; nullptr if each rank has all of it.
  virtual const ImagePieces* Pieces() const { return nullptr; }
  // The image on the grid in an extent, with all arrays of the input. Collective.
  virtual vtkSmartPointer<vtkImageData> ImageIn(const Extent& extent) const = 0;
  // Gives particles in the image in an extent the values of the input's arrays. Collective. Throws
  // Failure and Cancelled.
  virtual void SampleArrays(const Extent& extent, ConstPointSpan<3> particles, Progress& progress,
    vtkPointData* output) const = 0;

  // Moves particles, in index space, out of the parts of cells that are outside of a solid.
  virtual void MoveInside(PointSpan<3> /*particles*/, Progress& /*progress*/) const {}

  // Makes Prepare find what empty cells count as even if this density has none.
  void FindEmptyDensity() { this->MustFindEmpty = true; }
  // What empty cells count as, from Prepare on.
  double EmptyDensity() const { return this->Empty; }
  // What Prepare found about the values, without the summary of the densities.
  const SuspectValues& Suspect() const { return this->Known; }
  // Precedes each line if a filter has several inputs.
  void SetInputName(const std::string& name) { this->InputName = name; }
  // Receives one line for each finding of values that are probably not meant, and their content.
  // Without lines, it gets no content.
  using Listener =
    std::function<void(const std::vector<std::string>& lines, const DataIdentity& content)>;
  void SetListener(const Listener& listener) { this->Notify = listener; }
  // Call it when the values have been read, by this filter or another one. Collective.
  virtual void ReportSuspect(const SuspectValues& values, Progress& progress);

  // Throws the Failure for values that are no density.
  [[noreturn]] void ThrowInvalid(const DensitySummary& summary) const;
  // The density whose array the values are from; the summary then has its indices.
  virtual const InputDensity& SourceOf(DensitySummary& /*summary*/) const { return *this; }

protected:
  // What may differ between arrays of one name.
  struct ArrayForm
  {
    int Type;
    int Components;
    bool HasPointGhosts;
    bool HasCellGhosts;
  };

  InputDensity(const std::string& name, const DensityRules& rules);
  // For another density on its grid grown by `margin` cells, which this rule fills.
  InputDensity(const InputDensity& inner, const ImageGrid& grown, const GridSize<3>& margin,
    const EmptyRule& rule);
  // Once, with the grid. Finds the component that is taken. `times` are the modification times of
  // what has the values. Throws Failure if the array has no such component.
  void SetForm(const ArrayForm& form, const std::vector<std::uint64_t>& times);
  bool NeedsWhite() const { return this->Rules.NeedsWhite(this->Read.Components); }
  bool Clamps() const { return this->Rules.ClampNegative && !this->Rules.Invert; }
  bool FillsEmpty() const
  {
    return this->Rules.Empty.Cells != EmptyCells::Zero && (this->MayBeEmpty || this->MustFindEmpty);
  }
  // The value read as white, as soon as Known has it.
  double White() const;
  // The findings about values, one line each.
  virtual std::vector<std::string> Describe(const SuspectValues& values) const;

  ImageGrid Geometry;
  DensityRules Rules;
  DensityReading Read; // from SetForm on
  SuspectValues Known;
  double Empty = 0.0;
  std::vector<FillValue> FillValues; // those in the input's field data

private:
  // The values on ranks, for the core.
  template <int D>
  class Boxes final : public DistributedDensity<D>
  {
  public:
    explicit Boxes(const InputDensity& density)
      : Density(density)
    {
    }
    std::shared_ptr<const DensityValues> Gather(
      const GridSize<D>& low, const GridSize<D>& high) const override
    {
      return this->Density.Part(inSpace<D>(low, 0), inSpace<D>(high, 1));
    }

  private:
    const InputDensity& Density;
  };

  virtual std::uint64_t Fingerprint(Progress& progress) const = 0;

  const std::string Name;
  std::string InputName;
  Listener Notify;
  bool MayBeEmpty = false; // some cells
  bool MustFindEmpty = false;
  DataIdentity Reading; // the parameters of reading the values, and their times
  mutable std::optional<std::uint64_t> Hashed;
  const std::tuple<Boxes<1>, Boxes<2>, Boxes<3>> OnRanks{ *this, *this, *this };
};

} // namespace RectifiedTransport::Bridge

#endif
