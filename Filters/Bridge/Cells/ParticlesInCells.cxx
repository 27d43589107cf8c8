// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cells/ParticlesInCells.h"

#include "Bridge/Data/SampledArrays.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Stages.h"
#include "Core/Resampling/PlacesInCells.h"

#include "vtkDataSet.h"
#include "vtkPointData.h"

namespace RectifiedTransport::Bridge
{

namespace
{

class PlacesInLattice : public SampledPlaces
{
public:
  PlacesInLattice(const LatticeLookup& lookup, ConstPointSpan<3> places)
    : Lookup(lookup)
    , Places(places)
  {
  }

  std::int64_t Count() const override { return this->Places.size(); }
  SampledPlace Find(std::int64_t place) const override
  {
    const LatticeLookup::Place found = this->Lookup.Find(this->Places[place]);
    SampledPlace sampled{ {}, {}, found.Count, found.Cell, static_cast<int>(found.Set) };
    std::copy_n(found.Points.begin(), found.Count, sampled.Points);
    std::copy_n(found.Weights.begin(), found.Count, sampled.Weights);
    return sampled;
  }

private:
  const LatticeLookup& Lookup;
  const ConstPointSpan<3> Places;
};

class PlacesInMeshes : public SampledPlaces
{
public:
  explicit PlacesInMeshes(const LargeBuffer<MeshPlace>& found)
    : Found(found)
  {
  }

  std::int64_t Count() const override { return this->Found.size(); }
  SampledPlace Find(std::int64_t place) const override
  {
    const MeshPlace& found = this->Found.data()[place];
    SampledPlace sampled{ {}, {}, 0, found.Cell, found.Set };
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
  const LargeBuffer<MeshPlace>& Found;
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
    sampleArrays(source, PlacesInLattice(lookup, particles), stages["arrays"], output);
    return;
  }
  const LargeBuffer<MeshPlace> found =
    withMemory({ "the places of the particles in the input's cells",
                 static_cast<double>(particles.size()) * sizeof(MeshPlace) },
      [&]() { return findPlaces(blocks.Cells, grid, particles, stages["places"]); });
  sampleArrays(source, PlacesInMeshes(found), stages["arrays"], output);
}

} // namespace RectifiedTransport::Bridge
