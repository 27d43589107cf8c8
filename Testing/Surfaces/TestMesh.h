// SPDX-License-Identifier: BSD-3-Clause
// A triangle mesh that tests make and change.
#ifndef TestMesh_h
#define TestMesh_h

#include "Surfaces/Mesh/TriangleSurface.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

const double pi = std::acos(-1.0);

struct Mesh
{
  std::vector<Point<3>> Points;
  std::vector<std::array<std::int64_t, 3>> Triangles;

  TriangleSurface Surface() const
  {
    return { this->Points, this->Triangles.empty() ? nullptr : this->Triangles[0].data(),
      static_cast<std::int64_t>(this->Triangles.size()) };
  }

  void Add(const Mesh& other)
  {
    const auto first = static_cast<std::int64_t>(this->Points.size());
    this->Points.insert(this->Points.end(), other.Points.begin(), other.Points.end());
    for (const auto& t : other.Triangles)
    {
      this->Triangles.push_back({ t[0] + first, t[1] + first, t[2] + first });
    }
  }

  Mesh Turned() const
  {
    Mesh turned = *this;
    for (auto& triangle : turned.Triangles)
    {
      std::swap(triangle[1], triangle[2]);
    }
    return turned;
  }

  template <class Map>
  Mesh Mapped(const Map& map) const
  {
    Mesh mapped = *this;
    for (Point<3>& point : mapped.Points)
    {
      point = map(point);
    }
    return mapped;
  }

  double Volume() const
  {
    double volume = 0.0;
    for (const auto& t : this->Triangles)
    {
      const Point<3>& a = this->Points[t[0]];
      const Point<3>& b = this->Points[t[1]];
      const Point<3>& c = this->Points[t[2]];
      volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0])) /
        6.0;
    }
    return volume;
  }
};

} // namespace RectifiedTransport

#endif
