// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/PaddedDensity.h"

#include "Bridge/Density/InputDensity.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Tables/Reading/PaddedValues.h"

#include "vtkImageData.h"

#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// A density with a margin of empty cells around it, which count as the rule for empty cells says.
// The inner density reads the values; indices of cells in messages are translated back to its own.
class PaddedDensity final : public InputDensity
{
public:
  PaddedDensity(std::unique_ptr<InputDensity> inner, const ImageGrid& grid,
    const GridSize<3>& margin, const EmptyRule& rule)
    : InputDensity(*inner, grid, margin, rule)
    , Inner(std::move(inner))
    , Box{ margin, this->Inner->CellsInSpace() }
  {
    this->Inner->FindEmptyDensity();
  }

  std::string NameOfArray() const override { return this->Inner->NameOfArray(); }
  void Prepare(FlowTables tables, Progress& progress) override
  {
    this->Inner->Prepare(tables, progress);
    this->Known = this->Inner->Suspect();
    this->Empty = this->Inner->EmptyDensity();
    const DensityValues* values = this->Inner->Values();
    this->Padded = values ? this->Pad({ std::shared_ptr<void>(), values }) : nullptr;
  }
  const DensityValues* Values() const override { return this->Padded.get(); }
  std::shared_ptr<const DensityValues> Part(
    const GridSize<3>& low, const GridSize<3>& high) const override
  {
    LatticePart<3> wanted{ low, {} };
    for (std::size_t a = 0; a < 3; ++a)
    {
      wanted.Cells[a] = high[a] - low[a];
    }
    const LatticePart<3> common = this->Box.And(wanted);
    GridSize<3> first{};
    GridSize<3> end{};
    for (std::size_t a = 0; a < 3 && !common.IsEmpty(); ++a)
    {
      first[a] = common.Low[a] - this->Box.Low[a];
      end[a] = first[a] + common.Cells[a];
    }
    return this->Pad(this->Inner->Part(first, end));
  }
  void ReleaseGathered() override
  {
    this->Inner->ReleaseGathered();
    if (!this->Inner->Values())
    {
      this->Padded.reset();
    }
  }

  const ImagePieces* Pieces() const override { return this->Inner->Pieces(); }
  vtkSmartPointer<vtkImageData> ImageIn(const Extent& extent) const override
  {
    return this->Inner->ImageIn(intersectionOf(extent, this->Inner->Grid().Extent()));
  }
  void SampleArrays(const Extent& extent, ConstPointSpan<3> particles, Progress& progress,
    vtkPointData* output) const override
  {
    this->Inner->SampleArrays(extent, particles, progress, output);
  }

  void ReportSuspect(const SuspectValues& values, Progress& progress) override
  {
    SuspectValues inner = values;
    inner.Found.FirstMaximum = this->IndexInInner(values.Found.FirstMaximum);
    this->Inner->ReportSuspect(inner, progress);
  }
  const InputDensity& SourceOf(DensitySummary& summary) const override
  {
    summary.FirstNotFinite = this->IndexInInner(summary.FirstNotFinite);
    summary.FirstNegative = this->IndexInInner(summary.FirstNegative);
    return this->Inner->SourceOf(summary);
  }

private:
  std::uint64_t Fingerprint(Progress& progress) const override
  {
    return this->Inner->Hash(progress);
  }

  std::shared_ptr<const DensityValues> Pad(std::shared_ptr<const DensityValues> inner) const
  {
    return std::make_shared<PaddedValues>(
      std::move(inner), this->Box, this->CellsInSpace(), this->Empty);
  }

  // -1 for a cell that is not of the inner density.
  std::int64_t IndexInInner(std::int64_t index) const
  {
    if (index < 0)
    {
      return index;
    }
    const GridSize<3> cell = LatticePart<3>::WholeOf(this->CellsInSpace()).CellOf(index);
    return this->Box.Contains(cell) ? this->Box.NumberOf(cell) : -1;
  }

  const std::unique_ptr<InputDensity> Inner;
  const LatticePart<3> Box; // the cells of the inner density
  std::shared_ptr<const DensityValues> Padded;
};

} // namespace

std::unique_ptr<InputDensity> withMargin(
  std::unique_ptr<InputDensity> density, double margin, const EmptyRule& rule)
{
  if (!density || margin == 0.0)
  {
    return density;
  }
  const ImageGrid& grid = density->Grid();
  const GridSize<3> cells = cellsOfMargin(grid, margin);
  return std::make_unique<PaddedDensity>(std::move(density), grid.Grown(cells), cells, rule);
}

} // namespace RectifiedTransport::Bridge
