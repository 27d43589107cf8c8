// SPDX-License-Identifier: BSD-3-Clause
// The tables of a flow: whole tables or tiles.
#ifndef RectifiedTransport_FlowTables_h
#define RectifiedTransport_FlowTables_h

#include "../Geometry/GridSize.h"
#include "FlowOptions.h"

#include <cstdint>

namespace RectifiedTransport
{

enum class FlowTables
{
  Whole, // the tables of all levels
  Tiled  // few nodes; those of tiles are made in each advection, one tile after another
};

// Limits of the memory of tiles. Results depend on them.
struct TileLimits
{
  std::int64_t GradedNodes = std::int64_t{ 1 } << 23; // most of the graded tables
  std::int64_t Cells = std::int64_t{ 1 } << 26;       // most of a tile's tables
  std::int64_t Width = 0; // about that of a tile, in grid cells; 0: chosen by the boxes
};

// Whether tiles support valid options: Multistep with Interpolated and enough steps, in 2D and 3D.
template <int Dimension>
bool servesTiles(const GridSize<Dimension>& size, const FlowOptions& options,
  FlowDirection direction, const TileLimits& limits = {});
// Throws std::invalid_argument if they do not.
template <int Dimension>
void requireTiles(const GridSize<Dimension>& size, const FlowOptions& options,
  FlowDirection direction, const TileLimits& limits = {});

} // namespace RectifiedTransport

#endif
