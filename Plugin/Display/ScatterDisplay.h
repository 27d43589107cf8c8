// SPDX-License-Identifier: BSD-3-Clause
// How rows of a table look as points of a chart when they are shown for the first time.
#ifndef RectifiedTransport_ScatterDisplay_h
#define RectifiedTransport_ScatterDisplay_h

class vtkPVXMLElement;
class vtkSMProxy;
class vtkSMSourceProxy;
class vtkSMViewProxy;

namespace RectifiedTransport
{

// Whether an output is shown as such points.
bool hasScatter(vtkSMProxy* producer, int port);

// The columns `x` and `y` of the element are the coordinates of the points and the titles of the
// axes; no other column is shown. Nothing where the representation is not one of a chart.
void showScatter(vtkPVXMLElement* element, vtkSMSourceProxy* producer, int port,
  vtkSMViewProxy* view, vtkSMProxy* representation);

} // namespace RectifiedTransport

#endif
