// SPDX-License-Identifier: BSD-3-Clause
// The inputs of a filter that runs on the first rank alone.
#ifndef RectifiedTransport_GatheredInputs_h
#define RectifiedTransport_GatheredInputs_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Ranks.h"

#include "vtkSmartPointer.h"

#include <map>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

enum class GatheredKind
{
  Points,  // a point set, all of whose points count
  Surface, // a vtkPolyData, whose polygons count
  Density  // an image, any other data set, or a composite one
};

// On the first rank, of the data of all ranks; nullptr on the others, and where none has data. What
// is whole on every rank stays as it is. Called by all ranks. Throws Failure and std::bad_alloc.
vtkSmartPointer<vtkDataObject> gatherOnFirst(
  vtkDataObject* own, GatheredKind kind, const Ranks& ranks);

class GatheredInputs
{
public:
  // The kind of the data of each port. Called by all ranks, as gatherOnFirst.
  GatheredInputs(
    vtkInformationVector** inputs, const std::map<int, GatheredKind>& kinds, const Ranks& ranks);

  // As those of the executive, with the gathered data.
  vtkInformationVector** Vectors() { return this->Pointers.data(); }

private:
  std::vector<vtkSmartPointer<vtkInformationVector>> Made;
  std::vector<vtkInformationVector*> Pointers;
};

} // namespace RectifiedTransport

#endif
