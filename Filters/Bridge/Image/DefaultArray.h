// SPDX-License-Identifier: BSD-3-Clause
// Which array of an image is meant where none is named, as by a host that has not seen the data.
#ifndef RectifiedTransport_DefaultArray_h
#define RectifiedTransport_DefaultArray_h

#include "Bridge/VTKCompatibility.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkDataSet;
class vtkInformation;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// The active scalars of the points, else of the cells, else the only array that there is; nullptr
// where there is none or a choice. Says whose it is, of vtkDataObject::FieldAssociations.
vtkDataArray* defaultArray(vtkDataSet* data, int& association);

// Whether the values of a data set are those of its points: those of the default array, else, where
// there is a choice, of any array.
bool hasPointValues(vtkDataSet* data);

// Whether active scalars are announced before the data, of vtkDataObject::FieldAssociations.
bool announcesScalars(vtkInformation* information, int association);

} // namespace RectifiedTransport

#endif
