// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a surface by the layers of grid cells that they cross.
#ifndef RectifiedTransport_TriangleLayers_h
#define RectifiedTransport_TriangleLayers_h

#include "Core/Parallel/LargeBuffer.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// For each layer of cells, k <= z <= k + 1, the triangles with a part between these planes, in
// their order. Triangles in a plane z of constant value are in none: nothing is above or below them
// along axis 0.
class TriangleLayers
{
public:
  // Lists for the layers [firstLayer, endLayer) of `layers`. Memory: 8 bytes for each layer
  // that a triangle crosses. Throws std::bad_alloc and Cancelled.
  TriangleLayers(const TriangleSurface& surface, std::int64_t layers, std::int64_t firstLayer,
    std::int64_t endLayer, Progress& progress);

  std::int64_t Begin(std::int64_t layer) const { return this->First.data()[layer]; }
  std::int64_t End(std::int64_t layer) const { return this->First.data()[layer + 1]; }
  std::int64_t Triangle(std::int64_t at) const { return this->Triangles.data()[at]; }

private:
  // Layers [First, End).
  struct Range
  {
    std::int64_t First;
    std::int64_t End;
  };

  Range LayersOf(std::int64_t triangle) const;
  template <class Visit>
  void ForTriangles(Progress& progress, const Visit& visit);

  TriangleSurface Surface;
  std::int64_t FirstLayer;
  std::int64_t EndLayer;
  LargeBuffer<std::int64_t> First;     // by layers: where the layer's list begins
  LargeBuffer<std::int64_t> Triangles; // lists of all layers
};

} // namespace RectifiedTransport

#endif
