// SPDX-License-Identifier: BSD-3-Clause
// The self-driving mode: a script of mouse events in place of a user.
#ifndef Drive_h
#define Drive_h

#include <ostream>

class Stippling;
class vtkRenderWindowInteractor;

// Paints a letter S, turns the wheel, removes ink and waits, in `updates` updates altogether.
// Prints how many updates a second are computed, and with drawing, and how far points move.
void drive(
  Stippling& stippling, vtkRenderWindowInteractor* interactor, int updates, std::ostream& out);

#endif
