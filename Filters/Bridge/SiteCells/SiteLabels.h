// SPDX-License-Identifier: BSD-3-Clause
// The site of each pixel of a domain and, with Shape Power, the polygons of the sites' cells, kept
// between executions. The next one reuses them if only the cost's exponents change.
#ifndef RectifiedTransport_SiteLabels_h
#define RectifiedTransport_SiteLabels_h

#include "Bridge/Store/DataIdentity.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/SiteCells/PowerSiteCells.h"

#include "vtkLongArray.h"
#include "vtkLongLongArray.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <memory>
#include <type_traits>

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

class InputDensity;

using SiteIdArray =
  std::conditional_t<std::is_same_v<std::int64_t, long>, vtkLongArray, vtkLongLongArray>;

struct SiteDivision
{
  vtkSmartPointer<SiteIdArray> Labels;
  std::shared_ptr<const PowerSiteCells> Power; // only with Shape Power
  FlowReport Flow;                             // only with Shape Flow
};

// What a division depends on. `flow`: nullptr with Shape Power; `density`: nullptr for none.
DataIdentity identityOfDivision(vtkPointSet* sites, const ImageGrid& grid, const FlowOptions* flow,
  const InputDensity* density = nullptr);

} // namespace RectifiedTransport::Bridge

#endif
