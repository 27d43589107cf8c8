// SPDX-License-Identifier: BSD-3-Clause
// The site of each pixel of a domain and, with Shape Power, the polygons of the sites' cells, kept
// between executions.
#ifndef RectifiedTransport_SiteLabels_h
#define RectifiedTransport_SiteLabels_h

#include "Bridge/Density/ContentHash.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"
#include "Core/SiteCells/PowerSiteCells.h"

#include "vtkLongArray.h"
#include "vtkLongLongArray.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <memory>
#include <type_traits>

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

using SiteIdArray =
  std::conditional_t<std::is_same_v<std::int64_t, long>, vtkLongArray, vtkLongLongArray>;

// The division of the last execution. The next one reuses it if only the cost's exponents change.
class SiteLabels
{
public:
  struct Division
  {
    vtkSmartPointer<SiteIdArray> Labels;
    std::shared_ptr<const PowerSiteCells> Power; // of Shape Power, else nullptr
    FlowReport Flow;                             // of Shape Flow
  };
  // What it depends on besides the sites.
  struct Settings
  {
    ImageGrid Grid;
    bool IsPower;
    FlowOptions Flow; // counts where not IsPower
    bool IsOfDensity = false;
    ContentHash Density{}; // counts where IsOfDensity

    bool operator==(const Settings& other) const
    {
      return this->Grid == other.Grid && this->IsPower == other.IsPower &&
        (this->IsPower || this->Flow == other.Flow) && this->IsOfDensity == other.IsOfDensity &&
        (!this->IsOfDensity || this->Density == other.Density);
    }
  };

  // Identifies a density. Does not read its values if modification times show that the division is
  // of it. Throws Cancelled.
  ContentHash HashOf(InputDensity& density, Progress& progress) const
  {
    return this->Of.Density.IsOf(density) ? this->Of.Density : ContentHash(density, progress);
  }

  // Whether the division is of these sites and settings, only by modification times. If false,
  // Update compares the sites' coordinates.
  bool IsFor(vtkPointSet* sites, const Settings& settings) const;

  // Returns the division of these sites and settings: the kept one if valid, else the one that
  // make() returns. `progress` is of comparing the sites alone. Throws Cancelled, and what make()
  // throws; then none is kept.
  template <class Make>
  const Division& Update(
    vtkPointSet* sites, const Settings& settings, Progress& progress, const Make& make)
  {
    if (this->IsFor(sites, settings))
    {
      return this->Kept;
    }
    const bool sameSites = this->UpdateStamp(sites, progress);
    if (!sameSites || !this->IsFor(sites, settings))
    {
      this->Kept = {}; // releases memory before make()
      this->Kept = make();
      this->Of = settings;
    }
    return this->Kept;
  }

private:
  // Identifies sites. Programs that write into an array often call Modified() only on the data set;
  // but hosts such as ParaView also make a new data set of the same points at every run. Where only
  // the time of the data set differs, the hashes are compared.
  struct Stamp
  {
    vtkSmartPointer<vtkPoints> Points;
    vtkMTimeType PointsTime = 0;
    vtkMTimeType SetTime = 0;
    std::uint64_t Bits = 0; // the hash of the coordinates; 0 if there is none

    bool HasPointsOf(const Stamp& other) const
    {
      return this->Points == other.Points && this->PointsTime == other.PointsTime;
    }
  };
  static Stamp StampOf(vtkPointSet* sites);
  // Returns whether the sites are those of the last call.
  bool UpdateStamp(vtkPointSet* sites, Progress& progress);

  Division Kept;
  Stamp Sites;
  Settings Of{};
};

} // namespace RectifiedTransport::Bridge

#endif
