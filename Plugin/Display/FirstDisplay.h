// SPDX-License-Identifier: BSD-3-Clause
// How an output looks when it is shown for the first time, by elements among the hints of a
// filter's proxy; the first one that applies holds:
//   <FirstDisplay port="0" dimension="3" property="OutputPaths" value="1" type="Wireframe"
//     array="Time" categories="1"> <Set property="LineWidth" values="2"/> </FirstDisplay>
// port, dimension (of the data) and property with value (of an input 1 if it is given, else 0) say
// when it applies, each if given. type is
// the type of the representation, or Dots (see DotDisplay.h). array colours it, by categories if
// they are 1, on a logarithmic scale if the highest value is more than `log` times the lowest; an
// empty name colours by none. In a chart,
//   <FirstDisplay port="2" type="Scatter" x="Coordinate0" y="Coordinate1"/>
// shows the rows of a table as points (see ScatterDisplay.h). Points of a producer without such
// elements are Dots where they come of particles: behind what the view shows as Dots, and where
// they have SeedId.
#ifndef RectifiedTransport_FirstDisplay_h
#define RectifiedTransport_FirstDisplay_h

class vtkSMProxy;
class vtkSMSourceProxy;
class vtkSMViewProxy;

namespace RectifiedTransport
{

// Sets up a representation that has just been made, and will be shown in a view. If the elements
// depend on properties of the producer, the representation follows these later until the user
// chooses another type.
void applyFirstDisplay(
  vtkSMSourceProxy* producer, int port, vtkSMViewProxy* view, vtkSMProxy* representation);

} // namespace RectifiedTransport

#endif
