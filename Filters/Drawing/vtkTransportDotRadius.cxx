// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportDotRadius.h"

#include "Bridge/Data/DoubleTuples.h"
#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Ranks/DistributedPoints.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Core/Parallel/Stages.h"
#include "Core/Quality/DotRadius.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportDotRadius);

using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

namespace
{

// The coordinates of those that are finite.
std::vector<double> placesOf(const DistributedPoints& points, Progress& progress)
{
  std::vector<double> places;
  const std::int64_t count = points.Counted().Count();
  if (count > 0)
  {
    places.reserve(3 * static_cast<std::size_t>(count));
    const DoubleTuples given(points.Set()->GetPoints()->GetData(), points.Counted(), progress);
    for (const double* point = given.data(); point != given.data() + 3 * count; point += 3)
    {
      if (std::all_of(point, point + 3, [](double x) { return std::isfinite(x); }))
      {
        places.insert(places.end(), point, point + 3);
      }
    }
  }
  return places;
}
} // namespace

//------------------------------------------------------------------------------
vtkTransportDotRadius::vtkTransportDotRadius()
{
  this->AddInputPort(PORT_PARTITIONED_POINTS, { "vtkPointSet" });
  this->AddOutputPort("vtkTable");
}

//------------------------------------------------------------------------------
int vtkTransportDotRadius::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  AlgorithmProgress progress(this, this->Threading, this->GetRanks());
  const DistributedPoints points(pointSetOf(inputVector[0]), ghostPoint, this->GetRanks());
  if (points.All() == 0)
  {
    return 1;
  }
  Stages stages(progress, { { "points", 1 }, { "radius", 9 } });
  const std::vector<double> places =
    placesOf(points, stages["points"].Expect(points.Counted().Count()));
  vtkNew<vtkDoubleArray> column;
  column->SetName("DotRadius");
  column->InsertNextValue(radiusOfDots(
    { places.data(), static_cast<std::int64_t>(places.size() / 3) }, stages["radius"]));
  vtkTable::GetData(outputVector)->AddColumn(column);
  return 1;
}

//------------------------------------------------------------------------------
void vtkTransportDotRadius::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
VTK_ABI_NAMESPACE_END
