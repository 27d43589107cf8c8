// SPDX-License-Identifier: BSD-3-Clause
// What the outputs of several filters have in common.
#ifndef Campaign_OutputChecks_h
#define Campaign_OutputChecks_h

#include "FilterKind.h"

#include <initializer_list>
#include <string>

class vtkDataArray;
class vtkDataSetAttributes;
class vtkTransportAlgorithm;

namespace Campaign
{

// What a filter has to make of a density, with the properties that it has.
State densityState(vtkAlgorithm* filter, const Input& input);

// The mass of a sound density, summed in a plain way.
double massOf(vtkAlgorithm* filter, const Input& input);
// A value of its density, by the filter's Component: not a colour's.
double valueAt(vtkAlgorithm* filter, const Input& input, vtkIdType i);

// The product of the spacings along the axes of more than one point.
double cellMeasure(vtkImageData* image);

// An array of doubles without NaN and infinity, of as many tuples as there should be; nullptr, and
// a finding, if it is not.
vtkDataArray* requireArray(
  vtkFieldData* data, const char* name, int components, vtkIdType tuples, Findings& findings);

// The density of an image, on its points or its cells.
vtkDataArray* requireDensity(vtkImageData* image, bool onPoints, Findings& findings);

// The only value of an array of the field data; 0, and a finding, if there is none.
double requireField(vtkDataObject* data, const char* name, Findings& findings);

// The bound of the least cost and the gap of a map of this cost, where they are to be.
void checkBound(vtkTransportAlgorithm* filter, vtkDataObject* output, bool isWhole, double cost,
  Findings& findings);

void requireFinitePoints(vtkPointSet* set, Findings& findings);

// As many vertices as points, each with one.
void requireVertices(vtkPolyData* particles, Findings& findings);

double sumOf(vtkDataArray* array, int component = 0);

// All points are in the domain of a sound density.
void requireInside(vtkPointSet* set, const Input& density, Findings& findings);

// The arrays of an input are in the output, but for those that the filter names.
void requirePassed(
  vtkFieldData* from, vtkFieldData* to, std::initializer_list<const char*> own, Findings& findings);

} // namespace Campaign

#endif
