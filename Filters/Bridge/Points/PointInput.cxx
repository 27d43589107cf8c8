// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Points/PointInput.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/InputBlock.h"

#include "vtkBoundingBox.h"
#include "vtkDataObject.h"

#include <sstream>
#include <string>

namespace RectifiedTransport
{

vtkPointSet* pointSetOf(vtkInformationVector* port)
{
  return requireBlock<vtkPointSet>(
    vtkDataObject::GetData(port), "The input", "a vtkPointSet, as Extract Surface makes one of it");
}

void findBounds(vtkPointSet* points, double bounds[6])
{
  vtkBoundingBox::ComputeBounds(points->GetPoints(), bounds);
}

void NotFinitePoints::Add(std::int64_t count, std::int64_t first)
{
  this->Count += count;
  std::int64_t known = this->First;
  while ((known < 0 || first < known) && !this->First.compare_exchange_weak(known, first))
  {
  }
}

void NotFinitePoints::RequireNone(const std::string& what) const
{
  if (this->Count == 0)
  {
    return;
  }
  std::ostringstream message;
  message << "The " << what << " has " << this->Count
          << (this->Count == 1 ? " point that is" : " points that are")
          << " NaN or infinite, the first at index " << this->First
          << "; all coordinates must be finite";
  throw Failure(message.str());
}

} // namespace RectifiedTransport
