// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Points/PointInput.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/InputBlock.h"

#include "vtkBoundingBox.h"
#include "vtkDataObject.h"

#include <algorithm>
#include <array>
#include <limits>
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

std::array<double, 6> boundsOfAll(const Ranks& ranks, const std::array<double, 6>& own)
{
  std::array<double, 6> all = own;
  for (const std::array<double, 6>& bounds : gatherValues(ranks, own))
  {
    if (bounds[0] > bounds[1])
    {
      continue;
    }
    const bool isFirst = all[0] > all[1];
    for (std::size_t i = 0; i < 6; i += 2)
    {
      all[i] = isFirst ? bounds[i] : std::min(all[i], bounds[i]);
      all[i + 1] = isFirst ? bounds[i + 1] : std::max(all[i + 1], bounds[i + 1]);
    }
  }
  return all;
}

void findBounds(vtkPointSet* points, const Ranks* ranks, double bounds[6])
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 6> found{ infinity, -infinity, infinity, -infinity, infinity, -infinity };
  if (points && points->GetNumberOfPoints() > 0)
  {
    findBounds(points, found.data());
  }
  if (ranks)
  {
    found = boundsOfAll(*ranks, found);
  }
  std::copy_n(found.begin(), 6, bounds);
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
