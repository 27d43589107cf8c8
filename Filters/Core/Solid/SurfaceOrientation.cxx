// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Solid/SurfaceOrientation.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

SurfaceOrientation::SurfaceOrientation(
  const double* points, std::int64_t* triangles, std::int64_t count, const SurfaceEdges& edges)
  : Points(points)
  , Triangles(triangles)
  , Count(count)
  , Edges(edges)
  , Turns(count)
  , Queue(count)
{
  std::fill_n(this->Turns.data(), count, static_cast<signed char>(0));
}

double SurfaceOrientation::AreaOf(std::int64_t triangle) const
{
  const std::int64_t* ids = this->Triangles + 3 * triangle;
  double u[3];
  double v[3];
  for (int i = 0; i < 3; ++i)
  {
    u[i] = this->Points[3 * ids[1] + i] - this->Points[3 * ids[0] + i];
    v[i] = this->Points[3 * ids[2] + i] - this->Points[3 * ids[0] + i];
  }
  return std::hypot(
    u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
}

std::int64_t SurfaceOrientation::Visit(std::int64_t most)
{
  std::int64_t visited = 0;
  while (visited < most)
  {
    if (this->QueueNext == this->QueueEnd)
    {
      this->FinishComponent();
      while (this->Start < this->Count && this->Turns.data()[this->Start] != 0)
      {
        ++this->Start;
      }
      if (this->Start == this->Count)
      {
        break;
      }
      this->Turns.data()[this->Start] = 1;
      this->Queue.data()[this->QueueEnd++] = this->Start;
    }
    this->VisitNeighbours(this->Queue.data()[this->QueueNext++]);
    ++visited;
  }
  return visited;
}

void SurfaceOrientation::VisitNeighbours(std::int64_t triangle)
{
  const signed char turn = this->Turns.data()[triangle];
  this->Area += turn * this->AreaOf(triangle);
  for (std::int64_t side = 3 * triangle; side < 3 * triangle + 3; ++side)
  {
    const std::int64_t other = this->Edges.Other(side);
    const std::int64_t neighbour = other / 3;
    // Sides of triangles that turn the same way begin at different ends of the edge.
    const bool same = this->Triangles[side] != this->Triangles[other];
    const auto wanted = static_cast<signed char>(same ? turn : -turn);
    signed char& found = this->Turns.data()[neighbour];
    if (found == 0)
    {
      found = wanted;
      this->Queue.data()[this->QueueEnd++] = neighbour;
    }
    else if (found != wanted)
    {
      this->Orientable = false;
    }
  }
}

void SurfaceOrientation::FinishComponent()
{
  const signed char keep = this->Area < 0.0 ? -1 : 1;
  for (; this->QueueBegin < this->QueueEnd; ++this->QueueBegin)
  {
    const std::int64_t triangle = this->Queue.data()[this->QueueBegin];
    if (this->Turns.data()[triangle] != keep)
    {
      std::swap(this->Triangles[3 * triangle + 1], this->Triangles[3 * triangle + 2]);
    }
  }
  this->Area = 0.0;
}

} // namespace RectifiedTransport
