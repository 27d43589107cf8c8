// SPDX-License-Identifier: BSD-3-Clause
// The site of each pixel of a domain, kept between executions.
#ifndef RectifiedTransport_SiteLabels_h
#define RectifiedTransport_SiteLabels_h

#include "Bridge/SiteCells/DataStamp.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"

#include "vtkLongArray.h"
#include "vtkLongLongArray.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <type_traits>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

using SiteIdArray =
  std::conditional_t<std::is_same_v<std::int64_t, long>, vtkLongArray, vtkLongLongArray>;

// The labels of the last execution, for the next one where only the cost's exponents change.
class SiteLabels
{
public:
  // Whether the labels are of these sites, grid and options by modification times alone. Where
  // false, Update compares the sites' coordinates.
  bool IsFor(vtkPointSet* sites, const ImageGrid& grid, const FlowOptions& options) const;

  // Returns the labels of these sites, grid and options: the kept ones if valid, else those that
  // make() returns. Comparing the sites is the work of the current stage. Throws Cancelled, and
  // what make() throws; then no labels are kept.
  template <class Make>
  SiteIdArray* Update(vtkPointSet* sites, const ImageGrid& grid, const FlowOptions& options,
    Progress& progress, const Make& make)
  {
    if (this->IsFor(sites, grid, options))
    {
      return this->Labels;
    }
    const bool sameSites = this->UpdateStamp(sites, progress);
    if (!sameSites || !this->IsFor(sites, grid, options))
    {
      this->Labels = nullptr; // releases memory before make()
      this->Labels = make();
      this->Grid = grid;
      this->Options = options;
    }
    return this->Labels;
  }

private:
  // Returns whether the sites are those of the last call.
  bool UpdateStamp(vtkPointSet* sites, Progress& progress);

  vtkSmartPointer<SiteIdArray> Labels;
  DataStamp<std::pair<vtkSmartPointer<vtkPoints>, vtkMTimeType>> Stamp;
  ImageGrid Grid;
  FlowOptions Options;
};

} // namespace RectifiedTransport

#endif
