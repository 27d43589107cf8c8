// SPDX-License-Identifier: BSD-3-Clause
// The first isovalue of ParaView's Contour of a density, by an element among the hints of the
// density's filter:
//   <FirstContour port="0" array="Density" value="0.5"/>
//   <FirstContour port="0" half_of="Input DensityArray Target TargetArray"/>
// array is the one to contour; without it, any one.
// half_of names pairs of a property of inputs and the one of their array: half of the least of the
// arrays' largest values, which all mixtures of them reach, unless MassMode or InvertDensity change
// the scale.
#ifndef RectifiedTransport_FirstContour_h
#define RectifiedTransport_FirstContour_h

#include "vtkType.h"

class vtkSMProxy;

namespace RectifiedTransport
{

// Whether a proxy is a Contour whose isovalues were not set after `time`.
bool isUnsetContour(vtkSMProxy* proxy, vtkMTimeType time);

// Replaces ParaView's choice, the middle of the range. Leaves it if the contoured array has no such
// element, or does not reach the value.
void applyFirstContour(vtkSMProxy* contour);

} // namespace RectifiedTransport

#endif
