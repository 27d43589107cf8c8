// SPDX-License-Identifier: BSD-3-Clause
// The array of an image to use if none is named, for example because a host sets no array before
// the data are read.
#ifndef RectifiedTransport_DefaultArray_h
#define RectifiedTransport_DefaultArray_h

#include "Bridge/VTKCompatibility.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
class vtkDataArray;
class vtkDataSet;
class vtkDataSetAttributes;
class vtkInformation;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

vtkDataSetAttributes* attributesOf(vtkDataSet* data, bool onPoints);

// Whether an array holds ids or flags of points or cells, by its attribute or its name.
bool isIds(vtkDataSetAttributes* attributes, vtkAbstractArray* array);

// The active scalars of the points, else of the cells, else the only numeric array; nullptr if
// there is none or more than one. Ids and ghost flags do not count. Sets `association`, one of
// vtkDataObject::FieldAssociations.
vtkDataArray* defaultArray(vtkDataSet* data, int& association);

// Whether there are numeric arrays other than ids and ghost flags; whether there are ids or flags.
bool hasArrays(vtkDataSet* data);
bool hasIds(vtkDataSet* data);

// Whether the default array is point data; without a default, whether there are numeric point
// arrays.
bool hasPointValues(vtkDataSet* data);

// Whether the pipeline information has active scalars, of vtkDataObject::FieldAssociations.
bool announcesScalars(vtkInformation* information, int association);

} // namespace RectifiedTransport::Bridge

#endif
