// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cells/CellSampling.h"

#include "Bridge/Data/ArraySampling.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Stages.h"
#include "Core/Resampling/CellLocator.h"

#include "vtkDataSet.h"
#include "vtkPointData.h"

namespace RectifiedTransport::Bridge
{

namespace
{

class LatticeProbe : public ProbeLocations
{
public:
  LatticeProbe(const LatticeLookup& lookup, ConstPointSpan<3> places)
    : Lookup(lookup)
    , Places(places)
  {
  }

  std::int64_t Count() const override { return this->Places.size(); }
  ProbeLocation Find(std::int64_t place) const override
  {
    const LatticeLookup::Place found = this->Lookup.Find(this->Places[place]);
    ProbeLocation sampled{ {}, {}, found.Count, found.Cell, static_cast<int>(found.Set) };
    std::copy_n(found.Points.begin(), found.Count, sampled.Points);
    std::copy_n(found.Weights.begin(), found.Count, sampled.Weights);
    return sampled;
  }

private:
  const LatticeLookup& Lookup;
  const ConstPointSpan<3> Places;
};

class MeshProbe : public ProbeLocations
{
public:
  explicit MeshProbe(const LargeBuffer<MeshLocation>& found)
    : Found(found)
  {
  }

  std::int64_t Count() const override { return this->Found.size(); }
  ProbeLocation Find(std::int64_t place) const override
  {
    const MeshLocation& found = this->Found.data()[place];
    ProbeLocation sampled{ {}, {}, 0, found.Cell, found.Set };
    for (int i = 0; i < 4; ++i)
    {
      // A weight of 0 would not keep out values that are not finite.
      if (found.Weights[i] > 0.0)
      {
        sampled.Points[sampled.Count] = found.Points[i];
        sampled.Weights[sampled.Count++] = found.Weights[i];
      }
    }
    return sampled;
  }

private:
  const LargeBuffer<MeshLocation>& Found;
};

} // namespace

void sampleCells(const BlockValues& blocks, const std::optional<CellLattice>& lattice,
  const ImageGrid& grid, ConstPointSpan<3> particles, Progress& progress, vtkPointData* output)
{
  Stages stages(progress, { { "places", 1 }, { "arrays", 1 } });
  const ArraySource source{ { blocks.Data.begin(), blocks.Data.end() }, "input", false };
  if (lattice)
  {
    const auto lookup =
      withMemory({ "the cells in a lattice",
                   static_cast<double>(lattice->Grid().NumberOfCells()) * sizeof(std::int64_t) },
        [&]() { return LatticeLookup(*lattice, blocks.Cells, stages["places"]); });
    sampleArrays(source, LatticeProbe(lookup, particles), stages["arrays"], output);
    return;
  }
  const LargeBuffer<MeshLocation> found =
    withMemory({ "the places of the particles in the input's cells",
                 static_cast<double>(particles.size()) * sizeof(MeshLocation) },
      [&]() { return locateInCells(blocks.Cells, grid, particles, stages["places"]); });
  sampleArrays(source, MeshProbe(found), stages["arrays"], output);
}

} // namespace RectifiedTransport::Bridge
