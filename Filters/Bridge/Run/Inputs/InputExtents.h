// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_InputExtents_h
#define RectifiedTransport_InputExtents_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"

#include <functional>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkDataObject;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Calls visit for a data object, which may be nullptr, or for each block of a composite one; for
// all inputs of a filter. Messages call it `name`.
using VisitLeaf = std::function<void(vtkDataObject* leaf, const std::string& name)>;
void visitLeaves(vtkDataObject* data, const std::string& name, const VisitLeaf& visit);
void visitLeaves(vtkAlgorithm* filter, vtkInformationVector** inputVector, const VisitLeaf& visit);

// Throws Failure unless the extent of an image or a structured grid, or of such a block, is
// readable: VTK would count points and cells that do not exist.
void requireExtents(vtkAlgorithm* filter, vtkInformationVector** inputVector);
// The same for one input; `name` is its name in messages.
void requireExtents(vtkDataObject* data, const std::string& name);

} // namespace RectifiedTransport::Bridge

#endif
