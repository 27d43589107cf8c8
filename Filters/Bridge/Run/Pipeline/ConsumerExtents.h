// SPDX-License-Identifier: BSD-3-Clause
// Corrects the extents that filters downstream of an image output expect.
//
// A filter should change only its own information. But in VTK 9.1 to 9.6 the executive computes the
// extents of all filters downstream before any data are made, and keeps them. An image may turn out
// empty, after an error or an abort, or smaller, for a piece after the first or at another time.
// Imaging filters downstream then read everything that was announced, past the end of the image
// (TestDownstream.py, TestAnnounced.py).
#ifndef RectifiedTransport_ConsumerExtents_h
#define RectifiedTransport_ConsumerExtents_h

#include "Bridge/VTKCompatibility.h"

#include <array>

VTK_ABI_NAMESPACE_BEGIN
class vtkInformation;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Sets empty whole and update extents on structured outputs, and on those of the filters
// downstream. Returns false if some of them cannot be reached. The request must then fail, so that
// they do not execute.
bool announceEmptyExtents(vtkInformationVector* outputs);

// Empties the update extents downstream of structured outputs that hold less than the requested
// extent (pieces after the first), for this update only. Returns as above.
bool clearUnmetRequests(vtkInformationVector* outputs);

// Makes ParaView show the whole of an image whose extent is another one than was announced, as
// where the grid of a series changes: after every filter ParaView has one that passes data on, and
// views draw what that one announces, of the first time step. `before`: the whole extent that the
// output had before this execution.
void announceToViews(vtkInformation* output, const std::array<int, 6>& before);

// Calls UpdateInformation of all filters downstream of a structured output whose extent changed
// within an update. Returns false if some of them cannot be reached.
bool updateConsumerInformation(vtkInformation* output);

} // namespace RectifiedTransport::Bridge

#endif
