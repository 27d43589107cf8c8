// SPDX-License-Identifier: BSD-3-Clause
// Which site each pixel of a domain goes to, kept from run to run.
#ifndef RectifiedTransport_SiteLabels_h
#define RectifiedTransport_SiteLabels_h

#include "Bridge/Density/Fingerprint.h"
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

// The labels of a run, kept for the next one, which may ask for other figures of the same cells.
class SiteLabels
{
public:
  // Whether these plainly are the labels of such sites on such a grid. Else Update tells.
  bool IsFor(vtkPointSet* sites, const ImageGrid& grid, const FlowOptions& options) const;

  // The labels of such sites on such a grid: those that are kept, or those that make() makes. The
  // work of the host's current stage is to look whether the sites are the same. Throws Cancelled,
  // and what make() throws; then no labels are kept.
  template <class Make>
  SiteIdArray* Update(vtkPointSet* sites, const ImageGrid& grid, const FlowOptions& options,
    Progress& progress, const Make& make)
  {
    if (this->IsFor(sites, grid, options))
    {
      return this->Labels;
    }
    const bool sameSites = this->Renew(sites, progress);
    if (!sameSites || !this->IsFor(sites, grid, options))
    {
      this->Labels = nullptr; // what is outdated need not take memory meanwhile
      this->Labels = make();
      this->Grid = grid;
      this->Options = options;
    }
    return this->Labels;
  }

private:
  // Returns whether the sites are those of the run before.
  bool Renew(vtkPointSet* sites, Progress& progress);

  vtkSmartPointer<SiteIdArray> Labels;
  DataStamp<std::pair<vtkSmartPointer<vtkPoints>, vtkMTimeType>> Stamp;
  ImageGrid Grid;
  FlowOptions Options;
};

} // namespace RectifiedTransport

#endif
