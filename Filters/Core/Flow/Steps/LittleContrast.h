// SPDX-License-Identifier: BSD-3-Clause
// Whether a density is like a photograph.
#ifndef RectifiedTransport_LittleContrast_h
#define RectifiedTransport_LittleContrast_h

#include "Core/Flow/FlowEngine.h"
#include "Core/Parallel/Progress.h"

namespace RectifiedTransport
{

// Whether densities about blocks of 4 cells a side hardly differ from scale to scale, nor those of
// the cells in a block. Not if one block in ten has empty cells. Collective. Throws Cancelled.
template <int Dimension>
bool hasLittleContrast(FlowEngine<Dimension>& engine, Progress& progress);

} // namespace RectifiedTransport

#endif
